//! `simulate --spool`: the chamber inferred from a thermometer's record.

use crate::common::{COIL, Folder, change, stderr, stdout};
use std::fmt::Write;

const SENSOR: &str = "sensor: (radius_mm: 39.5, y_mm: 10.01)";

/// Rest, up by 20 °C within some 40 min, rest; every 30 s.
fn profile() -> String {
    (0..300).fold("time_s,chamber_c\n".to_owned(), |mut text, k| {
        let _ = writeln!(text, "{},{}", 30 * k, 30.0 + 10.0 * ((f64::from(k) - 100.0) / 25.0).tanh());
        text
    })
}

/// The columns of a result: time, chamber, thermometer and total rate.
fn columns(table: &str) -> [Vec<f64>; 4] {
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().unwrap()).collect()).collect();
    [0, 1, 2, 6].map(|column| rows.iter().map(|row| row[column]).collect())
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |m: f64, v| m.max(v.abs()))
}

#[test]
fn exact_a_thermometers_record_gives_the_chamber_and_the_bias_back() {
    let lagging = change(COIL, SENSOR, "sensor: (radius_mm: 39.5, y_mm: 10.01, lag_s: 90.0)");
    let heated = change(COIL, SENSOR, &format!("heat: (heaters: [(side: Right, power_w: 0.1)]), {SENSOR}"));
    for coil in [COIL, &lagging, &heated] {
        let folder = Folder::new();
        folder.write("coil.ron", coil);
        folder.write("p.csv", profile());
        let run = |arguments: &[&str]| {
            let output = folder.run(&[&["simulate", "coil.ron", "--json"], arguments].concat());
            assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
            (serde_json::from_str::<serde_json::Value>(&stdout(&output)).unwrap(), stderr(&output))
        };
        let (json, _) = run(&["--profile", "p.csv", "--out", "b.csv"]);
        assert!(json["inferred"].is_null());
        // the result is a record: its chamber and its rates are not read
        let (json, notes) = run(&["--spool", "b.csv", "--spool-noise", "0.0001", "--out", "c.csv", "--report", "r.html"]);
        assert!(notes.contains("note: b.csv: not read: chamber_c, ") && !notes.contains("only"), "{notes}");
        assert!(json["inferred"]["sensor_residual_rms_k"].as_f64().unwrap() < 1e-4);
        assert_eq!(json["inferred"]["noise_k"].as_f64(), Some(1e-4));
        let read = |name| std::fs::read_to_string(folder.path(name)).unwrap();
        let [[time, chamber, spool, rate], [again, inferred, reproduced, estimated]] =
            [columns(&read("b.csv")), columns(&read("c.csv"))];
        assert_eq!(time, again);
        let sd = json["inferred"]["chamber_sd_largest_k"].as_f64().unwrap();
        let off = |a: &[f64], b: &[f64]| largest(a.iter().zip(b).map(|(a, b)| a - b));
        assert!(off(&chamber, &inferred) < (4.0 * sd).min(0.2), "{} of {sd}", off(&chamber, &inferred));
        assert!(off(&spool, &reproduced) < 1e-3);
        assert!(off(&rate, &estimated) < 5e-3 * largest(rate.iter().copied()), "{}", off(&rate, &estimated));
        assert!(read("r.html").contains("inferred from the spool's thermometer"));
    }
}

/// A logger's file is read as --record reads it: by the map beside it, or the one that is given.
#[test]
fn a_loggers_file_gives_the_chamber_by_its_map() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let spool = |k: i32| 20.0 + 10.0 * ((f64::from(k) - 150.0) / 40.0).tanh() + f64::from(k % 3) * 0.01;
    let rows = |row: &dyn Fn(i32) -> String| (0..300).map(|k| row(k) + "\n").collect::<String>();
    folder.write("plain.csv", "time_s,spool_c\n".to_owned() + &rows(&|k| format!("{},{:.2}", 30 * k, spool(k))));
    let german = |k: i32| format!("{};{:.2};0,{:04}", 30 * k, spool(k), (k * 7) % 13).replace('.', ",");
    let text = "Spule [\u{b0}C] und mehr\nZeit [s];Spule [\u{b0}C];Drehrate [\u{b0}/h]\n".to_owned() + &rows(&german);
    // cp1252
    std::fs::write(folder.path("logger.csv"), text.chars().map(|c| c as u32 as u8).collect::<Vec<_>>()).unwrap();
    let map = "(encoding: \"windows-1252\", preamble_lines: 1, separator: \";\", decimal_comma: true, time: (column: \"Zeit [s]\"), spool: (column: \"Spule [\u{b0}C]\"), rate: (column: \"Drehrate [\u{b0}/h]\"))";
    let simulated = |arguments: &[&str], out: &str| {
        let output = folder.run(&[&["simulate", "coil.ron", "--out", out, "--quiet", "--spool"], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        std::fs::read_to_string(folder.path(out)).unwrap()
    };
    let plain = simulated(&["plain.csv"], "a.csv");
    folder.write("m.ron", map);
    assert_eq!(simulated(&["logger.csv", "--map", "m.ron"], "b.csv"), plain);
    folder.write("logger.map.ron", map);
    assert_eq!(simulated(&["logger.csv"], "c.csv"), plain);
    // a record of too few readings is refused all the same
    folder.write(
        "few.csv",
        "time_s,spool_c,rate_deg_per_h\n".to_owned()
            + &rows(&|k| format!("{},{},0.{}", 30 * k, if k < 5 { "20.1" } else { "" }, (k * 7) % 13)),
    );
    folder.write("few.map.ron", "()");
    let output = folder.run(&["simulate", "coil.ron", "--spool", "few.csv", "--out", "d.csv"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn what_looks_wrong_in_a_record_is_noted() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let mut record = "time_s,spool_c\n".to_owned();
    (0..60).filter(|k| !(20..40).contains(k)).for_each(|k| {
        let _ = writeln!(record, "{},{}", 30 * k, 20.0 + if k % 2 == 0 { 0.15 } else { 0.0 });
    });
    folder.write("r.csv", &record);
    let output = folder.run(&["simulate", "coil.ron", "--spool", "r.csv", "--out", "b.csv"]);
    let notes = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{notes}");
    assert!(notes.contains("r.csv: no row for 630 s after 570 s, usually 30 s; there the chamber is taken as linear"), "{notes}");
    assert!(notes.contains("the model follows spool_c to ") && notes.contains("--spool-noise"), "{notes}");
    let text = stdout(&output);
    assert!(
        text.contains("chamber inferred from the spool's thermometer") && text.contains("K rms, of a noise of 0.01 K"),
        "{text}"
    );
}

#[test]
fn a_record_that_cannot_be_used_is_refused_in_one_message() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("p.csv", "time_s,chamber_c\n0,20\n");
    let refuse = |arguments: &[&str], says: &str| {
        let output = folder.run(&[&["simulate", "coil.ron", "--out", "b.csv"], arguments].concat());
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(says), "`{says}` not in: {message}");
        assert!(output.stdout.is_empty() && !folder.path("b.csv").exists());
    };
    let rows = |count: usize| (0..count).map(|k| format!("{},20.5\n", 30 * k)).collect::<String>();
    let twelve = rows(12);
    let jumping: String = (0..60).map(|k| format!("{},{}\n", 30 * k, 20.0 + f64::from(k % 2) * 5.0)).collect();
    let cases = [
        (format!("time_s,spool_c\n{jumping}"), "r.csv: spool_c: spool_c would need a chamber at "),
        (String::new(), "r.csv: is empty; its first line names the columns, time_s,spool_c"),
        ("time_s,chamber_c\n0,20\n".into(), "r.csv:1: spool_c: the column is missing; a record starts with"),
        ("spool_c\n20\n".into(), "r.csv:1: time_s: the column is missing"),
        ("time_s,spool_c,spool_c\n".into(), "r.csv:1: spool_c: the column is given twice"),
        ("time_s,spool_c,temp\n".into(), "r.csv:1: unknown column `temp`; a record has time_s,spool_c"),
        ("0,20\n".into(), "put a line time_s,spool_c above it"),
        (
            format!("time_s,spool_c\n{}", rows(9)),
            "r.csv: has 9 rows below its header, too few to infer the chamber from; give 10",
        ),
        (format!("time_s,spool_c\n{twelve}360,\n"), "r.csv:14: spool_c: is empty; give a number, or remove the row"),
        (format!("time_s,spool_c\n{twelve}360,nan\n"), "r.csv:14: spool_c: `nan` is not a finite number"),
        (format!("time_s,spool_c\n{twelve}330,20\n"), "r.csv:14: time_s: 330 s stands in the row above too"),
        (format!("time_s,spool_c\n{twelve}360\n"), "r.csv:14: `360` has 1 field where the header has 2"),
    ];
    for (content, says) in cases {
        folder.write("r.csv", content);
        refuse(&["--spool", "r.csv"], says);
    }
    folder.write("r.csv", format!("time_s,spool_c\n{twelve}"));
    refuse(&["--spool", "r.csv", "--profile", "p.csv"], "cannot be used with");
    refuse(&[], "<--profile <P.csv>|--record <RECORD.csv>|--spool <RECORD.csv>>");
    refuse(&["--profile", "p.csv", "--spool-noise", "0.1"], "cannot be used with");
    refuse(&["--profile", "r.csv"], "a record of the spool's thermometer goes to --spool");
    for noise in ["0", "-1", "nan", "inf", "much"] {
        refuse(&["--spool", "r.csv", &format!("--spool-noise={noise}")], "give kelvins from 0.000001 to 10");
    }
    refuse(&["--spool", "b.csv"], "b.csv: is given twice, or is an input");
    refuse(&["--spool", "none.csv"], "none.csv: cannot be read");
}
