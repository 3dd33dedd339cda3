//! `fogcoil measure` as a user runs it: figures with intervals, the design's beside them, and what a record does not tell.

use serde_json::Value;

use crate::common::{CLEAN_COIL, Folder, schema, stderr, stdout};

/// Rest, up at 1 K/min, rest, down, rest: instants \[s\] and temperatures \[degC\].
const PROGRAMME: [(f64, f64); 6] =
    [(0.0, -40.0), (3600.0, -40.0), (9600.0, 60.0), (16_800.0, 60.0), (22_800.0, -40.0), (30_000.0, -40.0)];

fn chamber(t: f64) -> f64 {
    let on = PROGRAMME.windows(2).find(|w| (w[0].0..=w[1].0).contains(&t)).unwrap();
    on[0].1 + (on[1].1 - on[0].1) * (t - on[0].0) / (on[1].0 - on[0].0)
}

/// Nearly normal numbers: sums of twelve uniform ones, less six.
fn normals() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }
}

/// Record of the reference coil, by `simulate`, with noise of the rate \[deg/h\] and of the thermometers \[K\].
fn record(folder: &Folder, offset: f64) {
    let rows =
        |of: &dyn Fn(f64) -> f64| (0..=500).map(|n| 60.0 * f64::from(n)).map(|t| format!("{t},{}\n", of(t))).collect::<String>();
    folder.write("coil.ron", CLEAN_COIL);
    folder.write("p.csv", "time_s,chamber_c\n".to_owned() + &rows(&chamber));
    let output = folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let table = std::fs::read_to_string(folder.path("b.csv")).unwrap();
    let mut lines = table.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let at = ["time_s", "chamber_c", "spool_c", "rate_deg_per_h"].map(|name| names.iter().position(|n| n == name).unwrap());
    let mut normal = normals();
    let mut text = "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned();
    for line in lines {
        let [time, chamber, spool, rate] = at.map(|column| line[column].parse::<f64>().unwrap());
        let [a, b, c] = [0.01 * normal(), 0.01 * normal(), 0.02 * normal() + offset];
        text += &format!("{time},{},{},{}\n", chamber + a, spool + b, rate + c);
    }
    folder.write("r.csv", text);
}

fn json(folder: &Folder, arguments: &[&str]) -> Value {
    let output = folder.run(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    serde_json::from_str(&stdout(&output)).unwrap()
}

fn interval(of: &Value) -> [f64; 3] {
    let number = |value: &Value| value.as_f64().unwrap();
    [number(&of["ci90"][0]), number(&of["value"]), number(&of["ci90"][1])]
}

#[test]
fn the_steady_sensitivity_of_a_coil_is_measured_again() {
    let folder = Folder::new();
    record(&folder, 7.0);
    let steady = json(&folder, &["sensitivity", "coil.ron", "--json"])["total"].as_f64().unwrap();
    let found = json(&folder, &["measure", "r.csv", "coil.ron", "--json"]);
    assert_eq!(fogcoil::schema::misfit(&found, &schema("measure")), None);
    for key in ["sensitivity", "heating", "cooling"] {
        let [low, value, high] = interval(&found[key]);
        assert!(low < value && value < high && high - low < 0.12 * steady.abs(), "{key}: {low} {value} {high}");
        assert!(low < steady && steady < high, "{key}: {low} {high} {steady}");
    }
    // the design predicts itself
    let [low, predicted, high] = interval(&found["prediction"]);
    assert!((predicted - steady).abs() < 1e-9 && low < predicted && predicted < high);
    assert!(found["prediction"]["sigmas"].as_f64().unwrap().abs() < 2.0, "{found}");
    // white noise of 0.02 deg/h over a minute
    let [low, _, high] = interval(&found["arw"]);
    assert!((low..high).contains(&(0.02 / 60.0_f64.sqrt())), "{found}");
    assert_eq!((&found["ramp_of"], &found["span_over"]), (&"chamber_c".into(), &"spool_c".into()));
    // no temperature is held from both sides
    let notes = found["notes"].to_string();
    assert!(found["hysteresis"].is_null() && notes.contains("hysteresis: no temperature is held"), "{notes}");
    // for people
    let output = folder.run(&["measure", "r.csv", "coil.ron"]);
    let text = stdout(&output);
    assert!(
        text.contains("the design's sensitivity") && text.contains("angle random walk") && text.contains("[not-measured]"),
        "{text}"
    );
    // the reason that figures share is said once, and not at all if notes are not asked for
    assert!(text.lines().filter(|line| line.ends_with("[not-measured]")).all(|line| !line.contains("r.csv")), "{text}");
    let quiet = stdout(&folder.run(&["measure", "r.csv", "coil.ron", "--quiet"]));
    assert!(quiet.contains("angle random walk") && !quiet.contains("note: "), "{quiet}");
    // another offset, another unit, another origin and fewer columns: the same
    let rows = std::fs::read_to_string(folder.path("r.csv")).unwrap();
    let moved = rows.lines().skip(1).map(|line| {
        let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        format!("{},{},{},{:e}\n", fields[0] + 86_400.0, fields[1], fields[2], (fields[3] - 7.0) / 3600.0)
    });
    folder.write("moved.csv", "time_s,chamber_c,spool_c,rate\n".to_owned() + &moved.collect::<String>());
    let other = json(&folder, &["measure", "moved.csv", "--column", "rate=rate", "--unit", "rate=deg/s", "--json"]);
    for key in ["sensitivity", "heating", "cooling", "bias_span", "peak", "arw"] {
        let [a, b] = [interval(&found[key]), interval(&other[key])];
        let width = a[2] - a[0];
        assert!((0..3).all(|n| (a[n] - b[n]).abs() < 0.02 * width), "{key}: {a:?} {b:?}");
    }
    assert!(other["prediction"].is_null());
    // several records are several objects
    let both = json(&folder, &["measure", "r.csv", "r.csv", "--json"]);
    assert_eq!(both["records"].as_array().unwrap().len(), 2);
    assert_eq!(both["records"][1]["sensitivity"], found["sensitivity"]);
    // of a folder its recordings; one that cannot be used does not keep the others from being measured
    std::fs::create_dir(folder.path("lot")).unwrap();
    std::fs::copy(folder.path("r.csv"), folder.path("lot/r.csv")).unwrap();
    folder.write("lot/bad.csv", "time_s,chamber_c,spool_c\n0,20,20\n");
    // a profile is no recording
    folder.write("lot/r.profile.csv", "time_s,chamber_c\n0,20\n600,30\n");
    let output = folder.run(&["measure", "lot", "--json"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("1 of 2 recordings cannot be used"), "{}", stderr(&output));
    assert!(!stderr(&output).contains("r.profile.csv") || stderr(&output).contains("note: lot/r.profile.csv: not read"));
    let lot: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(lot["records"][0]["file"], "lot/bad.csv");
    assert!(lot["records"][0]["problem"].as_str().unwrap().contains("rate_deg_per_h"), "{lot}");
    assert_eq!(lot["records"][1]["sensitivity"], found["sensitivity"]);
    let output = folder.run(&["measure", "lot", "--quiet"]);
    assert!(stdout(&output).contains("lot/bad.csv") && stdout(&output).contains("angle random walk"), "{}", stdout(&output));
    // a rate in rad/s that is read in deg/s is 57.3 times too small for the design, and one in deg/s that is read so is not
    let in_unit = |per: f64| -> String {
        let text = std::fs::read_to_string(folder.path("r.csv")).unwrap();
        let rows = text.lines().skip(1).map(|line| {
            let (rest, rate) = line.rsplit_once(',').unwrap();
            format!("{rest},{:e}\n", rate.parse::<f64>().unwrap() / per)
        });
        "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows.collect::<String>()
    };
    folder.write("rad.csv", in_unit(3600.0 * 180.0 / std::f64::consts::PI));
    folder.write("deg.csv", in_unit(3600.0));
    let [wrong, right, said] = [("rad.csv", "rate=deg/s"), ("deg.csv", "rate=deg/s"), ("rad.csv", "rate=rad/s")]
        .map(|(record, unit)| stdout(&folder.run(&["measure", record, "coil.ron", "--unit", unit, "--quiet"])));
    let warning = "warning: rad.csv: rate_deg_per_h seems to be in rad/s: its sensitivity is 57.3 times too small for ";
    assert!(wrong.contains(warning) && wrong.contains("give --unit rate=rad/s") && wrong.contains("[rate-unit]"), "{wrong}");
    assert!(!right.contains("[rate-unit]") && !said.contains("[rate-unit]"), "{right}{said}");
    // a line each, with the design's number once
    let table = stdout(&folder.run(&["measure", "r.csv", "lot/r.csv", "coil.ron"]));
    let [low, value, high] = interval(&found["sensitivity"]);
    let lines: Vec<&str> = table.lines().filter(|line| line.contains("r.csv ")).collect();
    assert!(lines.len() == 2 && table.matches("The sensitivity of").count() == 1, "{table}");
    for line in lines {
        let shown: Vec<f64> = line.split_whitespace().skip(1).step_by(2).take(2).map(|n| n.parse().unwrap()).collect();
        let half = (high - low) / 2.0;
        assert!((shown[0] - value).abs() < 0.1 * half && (shown[1] / half - 1.0).abs() < 0.05, "{line}: {value} {half}");
    }
}

/// Steady sensitivity of the reference coil \[(deg/h)/(degC/min)\].
const STEADY: f64 = -2.7335;

/// An independent code's responses of the reference coil, with noise: its sensitivity is told. Of a programme too fast for the coil it is told by what the spool's
/// thermometer says of its settling, and refused without that.
#[test]
fn the_independent_code_s_coil_is_measured() {
    let folder = Folder::new();
    let told = |name: &str, with_spool: bool| {
        let path = format!("{}/../../fixtures/nominal/{name}.csv", env!("CARGO_MANIFEST_DIR"));
        let mut normal = normals();
        let table = std::fs::read_to_string(path).unwrap();
        let row = |line: &str| {
            let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
            let spool = if with_spool { format!("{},", fields[2]) } else { String::new() };
            format!("{},{},{spool}{}\n", fields[0], fields[1], fields[6] + 0.05 * normal())
        };
        let rows: String = table.lines().skip(1).map(row).collect();
        let spool = if with_spool { "spool_c," } else { "" };
        folder.write("n.csv", format!("time_s,chamber_c,{spool}rate_deg_per_h\n{rows}"));
        json(&folder, &["measure", "n.csv", "--json"])
    };
    for name in ["P1", "P2", "P5", "P4"] {
        let found = told(name, true);
        let [low, value, high] = interval(&found["sensitivity"]);
        // the intervals hold what noise does; what the time constants cannot follow of a real coil is up to as much again
        let error = (value - STEADY).abs();
        println!("{name}: {value} from {low} to {high}");
        assert!(low < STEADY && STEADY < high, "{name}: {low} {value} {high}");
        assert!(error < high - low && error < 0.1 * STEADY.abs() + (high - low) / 2.0, "{name}: {low} {value} {high}");
    }
    // the other temperature tells how slowly the unit settles
    let notes = |found: &Value| found["notes"].to_string().contains("chamber_c alone does not tell how slowly the unit settles");
    assert!(notes(&told("P2", false)) && !notes(&told("P2", true)));
    // sines and steps of minutes: the coil takes half an hour to settle
    let fast = told("P4", false);
    assert!(
        fast["bias_span"].is_null()
            && fast["sensitivity"].is_null()
            && fast["notes"].to_string().contains("sensitivity: responses slower than"),
        "{fast}"
    );
}

#[test]
fn what_a_record_does_not_tell_is_null() {
    let folder = Folder::new();
    let mut normal = normals();
    let mut rows = |count: i32, of: &dyn Fn(i32) -> String| {
        (0..count).map(|n| format!("{},{}{}\n", 60 * n, of(n), 0.01 * normal())).collect::<String>()
    };
    // a temperature that stands still, none, and few rows
    folder.write("still.csv", "time_s,chamber_c,rate_deg_per_h\n".to_owned() + &rows(400, &|_| "20,".into()));
    folder.write("none.csv", "time_s,rate_deg_per_h\n".to_owned() + &rows(400, &|_| String::new()));
    folder.write("short.csv", "time_s,chamber_c,rate_deg_per_h\n".to_owned() + &rows(12, &|n| format!("{},", 20 + n * n)));
    for (file, says) in
        [("still.csv", "there is no ramp"), ("none.csv", "there is no temperature"), ("short.csv", "12 usable rows are too few")]
    {
        let found = json(&folder, &["measure", file, "--json"]);
        assert_eq!(fogcoil::schema::misfit(&found, &schema("measure")), None);
        for key in ["sensitivity", "heating", "cooling", "bias_span", "peak", "hysteresis"] {
            assert!(found[key].is_null(), "{file} {key}: {found}");
            let notes = found["notes"].as_array().unwrap();
            let said = notes.iter().any(|note| note.as_str().unwrap().contains(&format!("{key}: {says}")));
            assert!(said, "{file} {key}: {notes:?}");
        }
        assert_eq!(found["arw"].is_null(), file == "short.csv", "{found}");
        assert!(found["not_known"]["heating"].as_str().unwrap().contains(says), "{found}");
        let text = stdout(&folder.run(&["measure", file]));
        assert!(
            text.contains(&format!("sensitivity, heating, cooling, asymmetry, hysteresis, bias_span, peak: {says}")),
            "{text}"
        );
        // white noise has no floor
        let falls = found["notes"].to_string().contains("bias_instability: the Allan deviation still falls at");
        assert!(found["bias_instability"].is_null() && falls == (file != "short.csv"), "{found}");
    }
}

/// A drift on white noise: at rest its floor is measured, in a ramp the floor holds what of the thermal bias is no lag, too.
#[test]
fn a_floor_in_a_ramp_is_an_upper_bound() {
    let folder = Folder::new();
    let record = |name: &str, chamber: &dyn Fn(i32) -> f64| {
        let (mut normal, mut walk) = (normals(), 0.0);
        let mut row = |n: i32| {
            walk += 0.003 * normal();
            format!("{},{},{}\n", 60 * n, chamber(n) + 0.01 * normal(), walk + 0.01 * normal())
        };
        folder.write(name, "time_s,chamber_c,rate_deg_per_h\n".to_owned() + &(0..600).map(&mut row).collect::<String>());
        let found = json(&folder, &["measure", name, "--json"]);
        assert_eq!(fogcoil::schema::misfit(&found, &schema("measure")), None);
        (found, stdout(&folder.run(&["measure", name])))
    };
    let (still, said) = record("still.csv", &|_| 20.0);
    assert!(still["bias_instability_is_bound"] == false && !said.contains("at most"), "{still} {said}");
    let (ramp, said) = record("ramp.csv", &|n| 20.0 + f64::from((n - 100).clamp(0, 60)));
    assert!(ramp["bias_instability_is_bound"] == true && ramp["bias_instability"]["value"].is_f64(), "{ramp}");
    let line = said.lines().find(|line| line.starts_with("bias instability")).unwrap();
    assert!(line.contains("at most 0.0") && line.contains("upper bound: the temperature changed"), "{said}");
    // the record's clock need not begin at 0
    assert!(said.contains(" s on the record's clock, and relative to the bias in the first row."), "{said}");
    let checked = ["still.csv", "ramp.csv"].map(|name| stdout(&folder.run(&["check", name])));
    let floor = |text: &String| text.lines().any(|line| line.starts_with("bias instability") && line.contains("at most 0.0"));
    assert_eq!(checked.each_ref().map(floor), [false, true], "{checked:?}");
    let table = stdout(&folder.run(&["measure", "still.csv", "ramp.csv"]));
    let bounds =
        ["still.csv", "ramp.csv"].map(|name| table.lines().any(|line| line.starts_with(name) && line.contains("< 0.00")));
    assert!(bounds == [false, true] && table.contains("Behind < stands an upper bound"), "{table}");
}

#[test]
fn what_cannot_be_measured_is_said() {
    let folder = Folder::new();
    folder.write("coil.ron", CLEAN_COIL);
    folder.write("nan.csv", "time_s,chamber_c,rate_deg_per_h\n0,20,nan\n60,20,nan\n120,21,nan\n");
    let refused = |arguments: &[&str], says: &str| {
        let output = folder.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(says) && stdout(&output).is_empty(), "{says}: {}", stderr(&output));
    };
    refused(&["measure"], "RECORD.csv|FOLDER|COIL.ron");
    refused(&["measure", "coil.ron"], "no recording is given");
    refused(&["measure", "coil.ron", "coil.ron", "nan.csv"], "more than one coil file");
    refused(&["measure", "none.csv"], "none.csv");
    refused(&["measure", "nan.csv"], "nan.csv: cannot be used");
}

/// A design's electronics add nothing at rest: what a few lags miss of the coil's response is no bias over temperature.
#[test]
fn a_simulated_coil_has_no_bias_over_temperature() {
    let folder = Folder::new();
    let flanged = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/designs/flanged.ron");
    folder.write("p.csv", "time_s,chamber_c\n0,20\n1800,20\n5400,-40\n11000,-40\n17600,70\n24000,70\n27000,20\n40320,20\n");
    let simulated = ["simulate", flanged, "--profile", "p.csv", "--step", "60", "--out", "r.csv", "--quiet"];
    assert_eq!(folder.run(&simulated).status.code(), Some(0));
    let found = json(&folder, &["measure", "r.csv", "--json"]);
    let ([low, value, high], [_, peak, _]) = (interval(&found["bias_span"]), interval(&found["peak"]));
    assert!(low == 0.0 && high < 0.01 * peak.abs(), "{low} to {high}, {value}; {peak}");
}
