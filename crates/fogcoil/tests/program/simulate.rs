//! `simulate` on good profiles: the contract, the physics, the report.

use crate::common::{COIL, Folder, change, schema, stderr, stdout};
use std::fmt::Write;
use std::path::Path;

const HEADER: &str = "time_s,chamber_c,spool_c,shupe_deg_per_h,eo_axial_deg_per_h,eo_radial_deg_per_h,rate_deg_per_h";
const PAPER: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/profiles/paper.csv"));
const SENSOR: &str = "sensor: (radius_mm: 39.5, y_mm: 10.01)";

/// From 20 °C up by 1 °C/min for an hour, every minute.
fn ramp() -> String {
    (0..=60).fold("time_s,chamber_c\n".to_owned(), |mut text, k| {
        let _ = writeln!(text, "{},{}", 60 * k, 20 + k);
        text
    })
}

fn with_heat(heat: &str) -> String {
    change(COIL, SENSOR, &format!("heat: ({heat}),\n    {SENSOR}"))
}

/// Runs `profile` on `coil` and returns the rows.
fn simulate(coil: &str, profile: &str) -> Vec<[f64; 7]> {
    let folder = Folder::new();
    folder.write("coil.ron", coil);
    folder.write("p.csv", profile);
    let output = folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(output.stderr.is_empty());
    rows(&std::fs::read_to_string(folder.path("b.csv")).unwrap())
}

fn rows(table: &str) -> Vec<[f64; 7]> {
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some(HEADER));
    let row = |line: &str| line.split(',').map(|field| field.parse().unwrap()).collect::<Vec<f64>>().try_into().unwrap();
    lines.map(row).collect()
}

/// A slope that trimmed tails bring near zero keeps the error that the parts bring along; without a slope there is none.
#[test]
fn the_error_of_a_slope_is_not_relative_to_it() {
    let folder = Folder::new();
    folder.write("coil.ron", change(COIL, "tails_m: (cw: 0.0", "tails_m: (cw: 1.4999"));
    folder.write("p.csv", PAPER);
    folder.write("still.csv", "time_s,chamber_c\n0,20\n60,20\n120,20\n");
    let run = |profile: &str| -> serde_json::Value {
        let output = folder.run(&["simulate", "coil.ron", "--profile", profile, "--out", "b.csv", "--json", "--quiet"]);
        serde_json::from_str(&stdout(&output)).unwrap()
    };
    let [trimmed, still] = ["p.csv", "still.csv"].map(run);
    let number = |value: &serde_json::Value| value.as_f64().unwrap().abs();
    // elements of order 9 give a slope 5.6e-4 away
    assert!(number(&trimmed["slope"]) < 5e-3 && number(&trimmed["numerical_error"]["slope"]) > 5.6e-4, "{trimmed}");
    assert!(still["slope"].is_null() && still["numerical_error"]["slope"].is_null(), "{still}");
}

/// A logger's own file drives the coil by its map; its thermometer and rate stand beside the result, and what is left of them in the summary.
#[test]
fn a_recording_stands_beside_its_simulation() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    for name in ["logger.csv", "logger.map.ron"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/recordings").join(name);
        folder.write(name, std::fs::read_to_string(path).unwrap());
    }
    let output = folder.run(&[
        "simulate",
        "coil.ron",
        "--record",
        "logger.csv",
        "--out",
        "b.csv",
        "--report",
        "r.html",
        "--json",
        "--quiet",
    ]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(fogcoil::schema::misfit(&json, &schema("simulate")), None);
    let table = std::fs::read_to_string(folder.path("b.csv")).unwrap();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some(format!("{HEADER},recorded_spool_c,recorded_rate_deg_per_h").as_str()));
    let field = |line: &str, k: usize| line.split(',').nth(k).unwrap().parse::<f64>().ok();
    let left: Vec<f64> = lines.clone().filter_map(|line| Some(field(line, 7)? - field(line, 2)?)).collect();
    let mean = left.iter().sum::<f64>() / left.len() as f64;
    let rms = (left.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / left.len() as f64).sqrt();
    let told = &json["recorded_less_simulated"]["spool_k"];
    assert!(
        (told["mean"].as_f64().unwrap() - mean).abs() < 1e-9 && (told["rms_about_mean"].as_f64().unwrap() - rms).abs() < 1e-9
    );
    assert!(json["recorded_less_simulated"]["rate_deg_per_h"]["rms_about_mean"].as_f64().unwrap() > 0.0);
    let page = std::fs::read_to_string(folder.path("r.html")).unwrap();
    assert!(page.contains("thermometer as recorded") && page.contains("as recorded, less"));
    // the figure's record is at 0 where the simulated rate is: less the intercept of a regression on it
    let pairs: Vec<(f64, f64)> = lines.clone().skip(1).filter_map(|line| Some((field(line, 6)?, field(line, 8)?))).collect();
    let over = |of: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
    let (x, y) = (over(&|p| p.0), over(&|p| p.1));
    let slope = over(&|p| (p.0 - x) * (p.1 - y)) / over(&|p| (p.0 - x).powi(2));
    let shown = page.split_once("as recorded, less ").unwrap().1.split_once(" °/h").unwrap().0.replace('\u{2212}', "-");
    let offset: f64 = shown.trim_start_matches('+').parse().unwrap();
    assert!((offset - (y - slope * x)).abs() < 6e-5, "{offset} {}", y - slope * x);
    // the result is a profile, and the record drives other commands: both have one chamber
    let peak = |arguments: &[&str]| {
        let output = folder.run(&[&["trim", "coil.ron", "--json", "--quiet"], arguments].concat());
        let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
        json["transients_deg_per_h"]["peak_before"].as_f64().unwrap()
    };
    let [by_record, by_result] = [peak(&["--record", "logger.csv"]), peak(&["--profile", "b.csv"])];
    assert!(by_record > 0.0 && (by_record / by_result - 1.0).abs() < 1e-9, "{by_record} {by_result}");
    let compared = stdout(&folder.run(&["compare", "coil.ron", "coil.ron", "--record", "logger.csv", "--quiet"]));
    assert!(compared.contains("largest |rate|"), "{compared}");
    // with its map elsewhere
    std::fs::copy(folder.path("logger.csv"), folder.path("moved.csv")).unwrap();
    let mapped = ["--record", "moved.csv", "--map", "logger.map.ron"];
    let elsewhere = peak(&mapped);
    assert!((by_record / elsewhere - 1.0).abs() < 1e-12, "{by_record} {elsewhere}");
    assert!(folder.run(&[&["simulate", "coil.ron", "--out", "m.csv", "--quiet"], &mapped[..]].concat()).status.success());
    let (moved, beside) = (folder.path("m.csv"), folder.path("b.csv"));
    assert!(std::fs::read(moved).unwrap() == std::fs::read(beside).unwrap());
    // the map is an input: no output may be written over it
    let output = folder.run(&["simulate", "coil.ron", "--record", "logger.csv", "--out", "logger.map.ron"]);
    assert_eq!(output.status.code(), Some(2));
    // a profile has nothing beside it
    folder.write("p.csv", PAPER);
    let output = folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--json", "--quiet"]);
    assert!(!stdout(&output).contains("recorded_less_simulated"));
}

/// Rows on the straight lines of a profile are those of a profile that has them.
#[test]
fn long_rows_are_noted_and_can_be_divided() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("long.csv", "time_s,chamber_c\n0,20\n3600,80\n");
    folder.write("short.csv", ramp());
    let run = |arguments: &[&str]| {
        let output = folder.run(&[&["simulate", "coil.ron", "--out", "b.csv"], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        (std::fs::read_to_string(folder.path("b.csv")).unwrap(), stderr(&output))
    };
    let (short, silent) = run(&["--profile", "short.csv"]);
    let (divided, also_silent) = run(&["--profile", "long.csv", "--step", "60"]);
    let (long, noted) = run(&["--profile", "long.csv"]);
    let far = |(a, b): (&[f64; 7], &[f64; 7])| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (divided, short) = (rows(&divided), rows(&short));
    assert!(divided.len() == short.len() && divided.iter().zip(&short).map(far).fold(0.0, f64::max) < 1e-9);
    assert_eq!(rows(&long).len(), 2);
    assert!(noted.contains("[long-rows]") && !(silent + &also_silent).contains("long-rows"), "{noted}");
    // rows every 1000 s from the first row, and the profile's own
    let (uneven, _) = run(&["--profile", "long.csv", "--step", "1000"]);
    assert_eq!(rows(&uneven).iter().map(|row| row[0]).collect::<Vec<f64>>(), [0.0, 1000.0, 2000.0, 3000.0, 3600.0]);
    assert_eq!(rows(&uneven)[3][1], 70.0);
    // the other commands under a profile add the same rows
    let answer = |arguments: &[&str]| stdout(&folder.run(arguments));
    for command in [&["trim", "coil.ron", "--json"] as &[&str], &["compare", "coil.ron", "coil.ron", "--json", "--no-cache"]] {
        let under = |profile: &[&str]| answer(&[command, profile].concat());
        let [short, divided, long] =
            [&["--profile", "short.csv"] as &[&str], &["--profile", "long.csv", "--step", "60"], &["--profile", "long.csv"]]
                .map(under);
        let part = |text: &str| -> serde_json::Value {
            let json: serde_json::Value = serde_json::from_str(text).unwrap();
            json["transients_deg_per_h"]["rms_before"]
                .as_f64()
                .map_or_else(|| json["bias"]["a"]["rms_deg_per_h"].clone(), Into::into)
        };
        let [short, divided, long] = [short, divided, long].map(|text| part(&text).as_f64().unwrap());
        assert!((short - divided).abs() < 1e-9 && (short - long).abs() > 1e-3, "{short} {divided} {long}");
    }
    folder.write("corners.csv", "time_s,chamber_c\n100,20\n170,20\n250,30\n");
    let (corners, _) = run(&["--profile", "corners.csv", "--step", "30"]);
    assert_eq!(rows(&corners).iter().map(|row| row[0]).collect::<Vec<f64>>(), [100.0, 130.0, 160.0, 170.0, 190.0, 220.0, 250.0]);
    let refused = |more: &[&str]| {
        let output = folder.run(&[&["simulate", "coil.ron", "--profile", "long.csv", "--out", "c.csv"], more].concat());
        assert_eq!(output.status.code(), Some(2));
        stderr(&output)
    };
    assert!(refused(&["--step", "60", "--between", "cubic"]).contains("does not go with --between cubic"));
    assert!(refused(&["--step", "0"]).contains("give seconds from 1 to"));
    folder.write("long.csv", "time_s,chamber_c\n0,20\n1e12,80\n");
    assert!(refused(&["--step", "30"]).contains("long.csv: has 33333333335 rows with this --step"));
}

#[test]
fn a_row_for_every_instant_and_a_summary() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("p.csv", ramp());
    let run = |more: &[&str]| {
        let output = folder.run(&[&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output)
    };
    let text = run(&[]);
    assert!(
        ["largest |rate|", "deg/h", "(deg/h)/(degC/min)", "-2.7335 ± 0.0016"].iter().all(|part| text.contains(part)),
        "{text}"
    );
    let json: serde_json::Value = serde_json::from_str(&run(&["--json"])).unwrap();
    let rows = rows(&std::fs::read_to_string(folder.path("b.csv")).unwrap());
    assert_eq!((rows.len(), json["rows"].as_u64()), (61, Some(61)));
    assert_eq!(rows[0][..2], [0.0, 20.0]);
    assert_eq!(rows[0][3..], [0.0; 4]);
    assert!((rows[0][2] - 20.0).abs() < 1e-6);
    for row in &rows {
        assert!((row[3] + row[4] + row[5] - row[6]).abs() <= 1e-12 && row[2] <= row[1] + 1e-6, "{row:?}");
    }
    let peak = rows.iter().map(|row| row[6].abs()).fold(0.0, f64::max);
    assert_eq!(json["peak"]["rate_deg_per_h"].as_f64().map(f64::abs), Some(peak));
    // equal intervals: the mean over time is the mean over the rows after the first
    let rms = (rows.iter().map(|row| row[6] * row[6]).sum::<f64>() / 60.0).sqrt();
    assert!((json["rms_deg_per_h"].as_f64().unwrap() / rms - 1.0).abs() < 1e-12);
    assert_eq!(json["duration_s"].as_f64(), Some(3600.0));
    assert_eq!(folder.names(), ["b.csv", "coil.ron", "p.csv"]);
}

#[test]
fn paper_the_slope_over_the_ramps_is_the_steady_sensitivity() {
    // rows every 30 s; ramps of 0.2 °C/min run from 7200 to 37200 s and from 44400 to 74400 s. The slowest thermal pole is 2200 s:
    // ten of them after a ramp's start its transient is e^-10 of the first, so the last 8000 s of each ramp are taken.
    let rows = simulate(COIL, PAPER);
    assert_eq!(rows.len(), 2721);
    let settled = |t: f64| (29_200.0..=37_200.0).contains(&t) || (66_400.0..=74_400.0).contains(&t);
    let points: Vec<(f64, f64)> = rows
        .windows(2)
        .filter(|pair| settled(pair[0][0]) && settled(pair[1][0]))
        .map(|pair| ((pair[1][2] - pair[0][2]) / 0.5, pair[1][6]))
        .collect();
    assert_eq!(points.len(), 2 * 266);
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>();
    let folder = Folder::new();
    let case = fogcoil::input::read_coil(&folder.write("coil.ron", COIL)).unwrap();
    let steady = case.steady_sensitivity().unwrap().sensitivity.total();
    assert!((slope / steady - 1.0).abs() < 1e-3, "{slope} against {steady}");
}

#[test]
fn exact_a_profile_may_come_from_any_program_and_start_at_any_time() {
    let plain = simulate(COIL, &ramp());
    let windows = format!("\u{feff}{}\r\n  \r\n\r\n", ramp().trim_end().replace('\n', "\r\n"));
    assert_eq!(simulate(COIL, &windows), plain);
    assert_eq!(simulate(COIL, &ramp().replace(',', " , ").replace("time_s", "\"time_s\"")), plain);
    assert_eq!(simulate(COIL, ramp().trim_end()), plain);
    let swapped: String = ramp().lines().map(|line| line.split_once(',').map(|(a, b)| format!("{b},{a}\n")).unwrap()).collect();
    assert_eq!(simulate(COIL, &swapped), plain);
    let later = ramp().lines().enumerate().fold(String::new(), |text, (i, line)| {
        let moved = line.split_once(',').filter(|_| i > 0).map(|(t, c)| format!("{},{c}", t.parse::<f64>().unwrap() - 1e9));
        text + &moved.unwrap_or_else(|| line.to_owned()) + "\n"
    });
    let moved = simulate(COIL, &later);
    assert_eq!(moved[0][0], -1e9);
    assert!(moved.iter().zip(&plain).all(|(a, b)| a[1..] == b[1..]));
}

#[test]
fn exact_one_row_gives_one_row_and_a_gap_is_linear() {
    assert_eq!(simulate(COIL, "time_s,chamber_c\n5,-40\n").len(), 1);
    let (full, sparse) = (simulate(COIL, &ramp()), simulate(COIL, "time_s,chamber_c\n0,20\n3600,80\n"));
    assert!((full[60][2] - sparse[1][2]).abs() < 1e-9);
    let mean = full.iter().map(|row| row[6]).sum::<f64>() / 60.0;
    assert!((sparse[1][6] / mean - 1.0).abs() < 1e-9, "the mean over a gap is the mean of the rows in it");
}

#[test]
fn exact_a_large_jump_is_a_small_one_enlarged() {
    let jump = |by: f64| simulate(COIL, &format!("time_s,chamber_c\n0,0\n0.001,{by}\n30,{by}\n600,{by}\n"));
    for (large, small) in jump(500.0).iter().zip(jump(5.0)).skip(1) {
        assert!((large[6] / small[6] / 100.0 - 1.0).abs() < 1e-9 && (large[2] / small[2] / 100.0 - 1.0).abs() < 1e-9);
    }
}

#[test]
fn bounds_lag_and_heat_paths_act_in_the_right_direction() {
    let last = |coil: &str| simulate(coil, &ramp())[60];
    let plain = last(COIL);
    let lagging = last(&change(COIL, SENSOR, "sensor: (radius_mm: 39.5, y_mm: 10.01, lag_s: 300.0)"));
    assert!(lagging[2] < plain[2] - 1.0 && lagging[6] == plain[6], "a slow thermometer changes nothing else: {lagging:?}");
    assert!(last(&with_heat("mounts: [(side: Right, conductance_w_per_m2k: 50.0)]"))[2] > plain[2] + 1.0);
    assert!(last(&with_heat("heaters: [(side: Right, power_w: 0.5)]"))[2] > plain[2] + 1.0);
    assert!(last(&with_heat("film_w_per_m2k: Some(20.0)"))[2] > plain[2] + 1.0);
    let poor = last(&with_heat("hub_resistance_m2k_per_w: 0.01"));
    assert!(poor[2] < plain[2] - 0.01, "the heat that enters at the coil's outside reaches the spool later: {poor:?}");
    assert_eq!(last(&with_heat("")), plain);
    assert_eq!(last(&with_heat("hub_resistance_m2k_per_w: 0.0, mounts: [], heaters: [], film_w_per_m2k: None")), plain);
}

#[test]
fn exact_drives_that_follow_the_chamber_change_nothing() {
    let coil = with_heat("mounts: [(side: Right, conductance_w_per_m2k: 50.0)]");
    let columns = |columns: &str, course: fn(&str) -> String| {
        let mut lines = ramp().lines().map(str::to_owned).collect::<Vec<_>>();
        lines[0] += columns;
        lines[1..].iter_mut().for_each(|line| *line += &course(line.split_once(',').unwrap().1));
        simulate(&coil, &lines.join("\n"))
    };
    let one = simulate(&coil, &ramp());
    let all = columns(",left_c,right_c,mount_right_c", |c| format!(",{c},{c},{c}"));
    let peak = one.iter().map(|row| row[6].abs()).fold(0.0, f64::max);
    for (a, b) in one.iter().zip(&all) {
        assert!((a[2] - b[2]).abs() < 1e-3 && (a[6] - b[6]).abs() < 2e-3 * peak, "{a:?} {b:?}");
    }
    // a mount that stays cold holds the spool back
    assert!(columns(",mount_right_c", |_| ",20".into())[60][2] < one[60][2] - 1.0);
    assert!(columns(",left_c", |_| ",20".into())[60][2] < one[60][2] - 1.0);
}

/// A chamber's own file through a map gives what the plain profile gives, in every command that takes one.
#[test]
fn a_profile_is_read_through_a_map() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("p.csv", "time_s,chamber_c\n0,20\n600,20\n3000,60.5\n");
    let own = "Programm 7\nProg minute;Kammer;Feuchte;\nmin;K;%;\n0;293,15;40;\n10;293,15;;\n50;333,65;x;\n";
    folder.write("own.csv", own);
    let map = "(preamble_lines: 1, lines_below_names: 1, separator: \";\", decimal_comma: true, \
               time: (column: \"Prog minute\", unit: \"min\"), chamber: (column: \"Kammer\", unit: \"K\"))";
    folder.write("own.ron", map);
    let run = |arguments: &[&str]| {
        let output = folder.run(arguments);
        (output.status.code(), stdout(&output), stderr(&output))
    };
    let simulate = ["simulate", "coil.ron", "--out", "b.csv", "--profile"];
    let result = |more: &[&str]| {
        let (status, _, notes) = run(&[&simulate[..], more].concat());
        assert_eq!(status, Some(0), "{notes}");
        (std::fs::read_to_string(folder.path("b.csv")).unwrap(), notes)
    };
    let (plain, _) = result(&["p.csv"]);
    let (mapped, notes) = result(&["own.csv", "--map", "own.ron"]);
    for (a, b) in plain.lines().zip(mapped.lines()).skip(1) {
        let numbers = |line: &str| line.split(',').map(|text| text.parse().unwrap()).collect::<Vec<f64>>();
        assert!(numbers(a).iter().zip(numbers(b)).all(|(a, b)| (a - b).abs() < 1e-9), "{a} {b}");
    }
    assert_eq!(plain.lines().count(), mapped.lines().count());
    assert!(notes.contains("own.csv: the column Feuchte drives nothing and is ignored"), "{notes}");
    assert!(notes.contains("own.csv: chamber is read from the column `Kammer`, in K [mapped-column]"), "{notes}");
    assert_eq!(run(&["trim", "coil.ron", "--profile", "own.csv", "--map", "own.ron"]).0, Some(0));
    // no map is passed over
    folder.write("wrong.ron", map.replace("Kammer", "Ofen"));
    folder.write("even.ron", map.replace("(preamble", "(interval_s: 30.0, preamble"));
    folder.write("point.csv", own.replace("333,65", "333.65"));
    for (arguments, says) in [
        (["own.csv", "--map", "none.ron"], "none.ron: cannot be read"),
        (
            ["own.csv", "--map", "wrong.ron"],
            "own.csv:2: Ofen: the column is missing; the columns here are `Prog minute`, `Kammer`",
        ),
        (
            ["own.csv", "--map", "even.ron"],
            "even.ron: interval_s: a profile has its instants in one column of numbers; take it out",
        ),
        (["point.csv", "--map", "own.ron"], "point.csv:6: Kammer: `333.65` has a point, but decimals have a comma here"),
    ] {
        let (status, _, message) = run(&[&simulate[..], &arguments].concat());
        assert!(status == Some(2) && message.contains(says), "{says}: {message}");
    }
    let (status, _, message) = run(&["trim", "coil.ron", "--map", "own.ron"]);
    assert!(status == Some(2) && message.contains("--map says how a table is read"), "{message}");
}

#[test]
fn notes_go_to_standard_error_unless_silenced() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("p.csv", "time_s,chamber_c,spool_c,rate_deg_per_h\n0,293.15,x,\n30,293.2,,y\n");
    let run =
        |more: &[&str]| folder.run(&[&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--json"], more].concat());
    let notes = stderr(&run(&[]));
    assert!(notes.contains("p.csv: the columns spool_c, rate_deg_per_h drive nothing and are ignored"), "{notes}");
    let warning = |line: &str| line.starts_with("warning: ") && line.contains("if it is in kelvin, subtract 273.15");
    assert!(notes.lines().all(|line| line.starts_with("note: ") || warning(line)) && notes.lines().any(warning), "{notes}");
    // 68 to 140 degF
    folder.write("p.csv", "time_s,chamber_c\n0,68\n1800,140\n");
    let notes = stderr(&run(&[]));
    let says = "warning: p.csv: chamber_c starts at 68 degC; a room has as many degF: if it is in degF, subtract 32 and divide by 1.8 \
                [fahrenheit]";
    assert!(notes.contains(says), "{notes}");
    folder.write("p.csv", "time_s,chamber_c\n0,20\n0.01,500\n");
    assert!(stderr(&run(&[])).contains("rows are as close as 0.010000 s"));
    let quiet = run(&["--quiet"]);
    assert!(quiet.stderr.is_empty() && stdout(&quiet).lines().count() == 1);
}

#[test]
fn many_rows_are_quick_and_the_report_stays_small() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let profile = (0..200_000).fold("time_s,chamber_c\n".to_owned(), |mut text, k| {
        let _ = writeln!(text, "{k},{:.3}", 20.0 + 30.0 * (f64::from(k) / 4000.0).sin());
        text
    });
    folder.write("p.csv", profile);
    let start = std::time::Instant::now();
    let arguments = ["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--report", "r.html"];
    assert_eq!(folder.run(&arguments).status.code(), Some(0));
    assert!(start.elapsed().as_secs() < 60);
    assert_eq!(std::fs::read_to_string(folder.path("b.csv")).unwrap().lines().count(), 200_001);
    let report = std::fs::read_to_string(folder.path("r.html")).unwrap();
    // the section's pictures have as many cells for any number of rows
    let section: usize = report.split("<figure").filter(|figure| figure.contains("id=\"section")).map(str::len).sum();
    assert!((100_000..700_000).contains(&section), "{section}");
    assert!(report.len() - section < 1_500_000, "{}", report.len() - section);
}

#[test]
fn a_smooth_course_between_rows_agrees_with_its_rows_written_out() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let table = |step: u32| {
        (0..=7200 / step).map(|k| f64::from(k * step)).fold("time_s,chamber_c\n".to_owned(), |mut text, t| {
            let _ = writeln!(text, "{t},{}", 20.0 + 30.0 * (t / 1500.0).sin().powi(3));
            text
        })
    };
    folder.write("rows.csv", table(120));
    folder.write("fine.csv", table(10));
    let run = |profile: &str, between: &str| {
        let output =
            folder.run(&["simulate", "coil.ron", "--profile", profile, "--out", "b.csv", "--between", between, "--quiet"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        rows(&std::fs::read_to_string(folder.path("b.csv")).unwrap())
    };
    // the truth: means over two minutes of ten-second rows
    let fine = run("fine.csv", "linear");
    let truth: Vec<f64> = fine[1..].chunks(12).map(|c| c.iter().map(|r| r[6]).sum::<f64>() / 12.0).collect();
    let off = |rows: &[[f64; 7]]| rows[1..].iter().zip(&truth).map(|(r, t)| (r[6] - t).abs()).fold(0.0, f64::max);
    let (linear, cubic) = (run("rows.csv", "linear"), run("rows.csv", "cubic"));
    assert_eq!((linear.len(), cubic.len()), (61, 61));
    assert!(off(&cubic) < 0.3 * off(&linear), "{} against {}", off(&cubic), off(&linear));
}

#[test]
fn the_read_out_s_drift_is_named_and_the_parts_add_up() {
    let folder = Folder::new();
    let drifts = "drifts: (read_out_deg_per_h_per_k: 0.01),\n    sensor:";
    folder.write("coil.ron", change(COIL, "sensor:", drifts));
    folder.write("p.csv", ramp());
    let output = folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--json", "--quiet"]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let of = |key: &str| json["peak"][key].as_f64().unwrap();
    let parts = of("shupe_deg_per_h") + of("eo_axial_deg_per_h") + of("eo_radial_deg_per_h");
    assert!(of("read_out_deg_per_h").abs() > 0.05);
    assert!((parts + of("read_out_deg_per_h") - of("rate_deg_per_h")).abs() < 1e-12);
    let table = std::fs::read_to_string(folder.path("b.csv")).unwrap();
    assert_eq!(table.lines().next(), Some(&*format!("{HEADER},read_out_deg_per_h")));
    for line in table.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        assert!((row[3] + row[4] + row[5] + row[7] - row[6]).abs() < 1e-12, "{line}");
    }
    // a profile may have the column, and it drives nothing
    let again = folder.run(&["simulate", "coil.ron", "--profile", "b.csv", "--out", "c.csv"]);
    assert!(again.status.code() == Some(0) && stderr(&again).contains("read_out_deg_per_h"), "{}", stderr(&again));
    let text = stdout(&folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--quiet"]));
    assert!(text.contains("read-out") && text.contains("the sum of the four"), "{text}");
}

/// In a profile that cools and comes back, the warmest instant is one at rest, where fields show nothing.
#[test]
fn the_section_is_drawn_at_the_largest_change_of_temperature() {
    let folder = Folder::new();
    folder.write("coil.ron", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/designs/small.ron")));
    folder.write("p.csv", "time_s,chamber_c\n0,20\n1800,-10\n3600,-10\n5400,20\n");
    let arguments = ["simulate", "coil.ron", "--profile", "p.csv", "--step", "60", "--out", "b.csv", "--report", "r.html"];
    let output = folder.run(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = std::fs::read_to_string(folder.path("r.html")).unwrap();
    for (event, drawn) in [("coldest, ", true), ("fastest warming, ", true), ("fastest cooling, ", true), ("warmest, ", false)] {
        assert_eq!(page.contains(event), drawn, "{event}");
    }
    // the coil is outlined in each of the maps at three instants, for wide and narrow pages; the strips over time have none
    let maps = page.matches("class=\"outline\"").count();
    assert!(maps >= 15 && maps.is_multiple_of(15), "{maps}");
}
