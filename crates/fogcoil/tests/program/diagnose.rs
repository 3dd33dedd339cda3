//! `fogcoil diagnose` as a user runs it, on a recording in which a bond opens.

use std::fmt::Write;

use crate::common::{CLEAN_COIL, COIL, Folder, change, schema, stderr, stdout};
use coil::{Design, Mechanics, Parameter};
use fogcoil::input::read_coil;
use mechanisms::with_constant;

const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/concealed/open/case_13");

#[test]
fn a_concealed_bond_is_named_and_the_held_out_record_predicted() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let (fit, holdout) = (format!("{CASE}/fit.csv"), format!("{CASE}/holdout.csv"));
    let mut arguments =
        vec!["diagnose", "coil.ron", "--fit", &fit, "--holdout", &holdout, "--json", "j.json", "--prediction", "p.csv"];
    arguments.extend(["--model-out", "m.ron", "--report", "r.html"]);
    let output = folder.run(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    let (before, sure) = said.split_once("Most likely: debond (probability ").unwrap();
    assert!(before.starts_with("The recording differs"), "{said}");
    assert!(sure.split_once(").").unwrap().0.parse::<f64>().unwrap() > 0.8, "{said}");
    assert!(said.contains("Next: inspect the unit. Only debond is left"), "{said}");
    let row = |name: &str| stdout(&output).lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    for (name, unit) in [("debond_c ", "degC"), ("hysteresis_k ", "K"), ("fraction ", "-")] {
        assert_eq!(row(name).split_whitespace().nth(2), Some(unit), "{}", row(name));
    }
    assert!(stdout(&output).contains("takes part, alone or with others"));
    let json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(folder.path("j.json")).unwrap()).unwrap();
    assert_eq!(fogcoil::schema::misfit(&json, &schema("diagnose")), None);
    assert_eq!((&json["verdict"], &json["named"]["id"]), (&"explained".into(), &"debond".into()));
    assert_eq!(json["mechanisms"][0]["id"], "debond");
    assert!(json["mechanisms"][0]["probability"].as_f64().unwrap() > 0.8);
    assert_eq!(json["set"], serde_json::json!(["debond"]));
    assert_eq!(json["located"]["stage"], "bond");
    // what the recording was made with: -7.2073 degC
    let at = &json["parameters"]["debond_c"];
    assert!((at["value"].as_f64().unwrap() + 7.2073).abs() < 0.5 && at["ci90"].as_array().unwrap().len() == 2, "{at}");
    let held = &json["holdout"];
    assert!(held["rmse_model"].as_f64().unwrap() < 0.95 * held["rmse_nominal"].as_f64().unwrap(), "{held}");
    let rows = |text: String| text.lines().map(|line| line.split(',').next().unwrap().to_owned()).collect::<Vec<_>>();
    let predicted = rows(std::fs::read_to_string(folder.path("p.csv")).unwrap());
    assert_eq!(predicted, rows(std::fs::read_to_string(holdout).unwrap()));
    the_model_is_the_design_with_the_bond(&folder, &json);
    the_page_stands_alone(&std::fs::read_to_string(folder.path("r.html")).unwrap());
}

/// Rests and ramps between −40 and 70 °C \[s, °C\].
const RAMPS: [(f64, f64); 8] = [
    (0.0, 20.0),
    (1800.0, 20.0),
    (4800.0, 70.0),
    (12_000.0, 70.0),
    (18_600.0, -40.0),
    (27_000.0, -40.0),
    (30_600.0, 20.0),
    (38_400.0, 20.0),
];

/// Rows of a simulation of the reference coil under a profile.
fn simulated(folder: &Folder, profile: &str, step: &[&str]) -> Vec<Vec<f64>> {
    simulated_as(folder, "coil.ron", profile, step)
}

/// The same of a unit that is made otherwise.
fn simulated_as(folder: &Folder, unit: &str, profile: &str, step: &[&str]) -> Vec<Vec<f64>> {
    folder.write("coil.ron", COIL);
    folder.write("profile.csv", profile);
    let arguments = [&["simulate", unit, "--profile", "profile.csv", "--out", "fine.csv"], step].concat();
    let output = folder.run(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let fine = std::fs::read_to_string(folder.path("fine.csv")).unwrap();
    fine.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
}

/// The same under [`RAMPS`], every 20 s.
fn under_ramps(folder: &Folder) -> Vec<Vec<f64>> {
    under_ramps_as(folder, "coil.ron")
}

fn under_ramps_as(folder: &Folder, unit: &str) -> Vec<Vec<f64>> {
    let rows = RAMPS.map(|(t, chamber)| format!("{t},{chamber}\n")).concat();
    simulated_as(folder, unit, &format!("time_s,chamber_c\n{rows}"), &["--step", "20"])
}

/// About normal, of standard deviation 0.8.
fn noise(n: usize) -> f64 {
    ((n * 7919) % 1009) as f64 / 504.5 + ((n * 104_729) % 997) as f64 / 498.5 - 2.0
}

/// A good unit whose logger writes momentary rates, stamps a mean where it begins, has another clock, or reads temperatures every five minutes and
/// repeats them: nothing says so, and it is no fault.
#[test]
fn another_loggers_stamp_is_no_fault() {
    stamped([(0, 15, 1)]);
}

#[test]
#[ignore = "minutes"]
fn another_loggers_rates_are_no_fault() {
    stamped([(0, 0, 15), (0, 0, 1), (2, 0, 1)]);
}

/// Rows ahead of the instant over which a rate is a mean, rows by which the chamber's clock is late, and rows of one reading.
fn stamped<const N: usize>(cases: [(usize, usize, usize); N]) {
    let folder = Folder::new();
    let fine = under_ramps(&folder);
    // each minute's row: the rate at its instant, or the mean of the minute that follows
    // the chamber's clock is late by so many rows, and temperatures are read once in so many
    let logged = |ahead: usize, late: usize, every: usize| -> String {
        let rate = |n: usize| fine[n..(n + ahead).min(fine.len() - 1) + 1].iter().map(|row| row[6]).sum::<f64>();
        let rows = (0..fine.len() - ahead).step_by(3).map(|n| {
            let read = n - n % every;
            let (time, spool, chamber) = (fine[n][0], fine[read][2], fine[read.saturating_sub(late)][1]);
            let rate = 3.0 + rate(n) / (ahead + 1) as f64 + 0.01 * noise(n);
            format!("{time},{:.2},{:.2},{rate:.5}\n", chamber + 0.02 * noise(read + 31), spool + 0.02 * noise(read + 77))
        });
        "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows.collect::<String>()
    };
    for (ahead, late, every) in cases {
        folder.write("r.csv", logged(ahead, late, every));
        let output = folder.run(&["diagnose", "coil.ron", "--fit", "r.csv", "--json"]);
        let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
        assert!(json["verdict"] == "none" || json["verdict"] == "recalibrate", "{ahead} {late} {every}: {json}");
        // a clock five minutes off is not believed without a word, nor are values that were repeated
        let is_told = |remark: &str| json["note_ids"].as_array().unwrap().iter().any(|id| id == remark);
        assert_eq!((is_told("instrument-off"), is_told("held")), (late > 0, every > 1), "{json}");
    }
}

/// A good unit of whose chamber the set point was logged, which the air at the unit follows with five minutes.
#[test]
fn a_logged_set_point_is_no_fault_of_the_unit() {
    const LAG: f64 = 300.0;
    let folder = Folder::new();
    let set_point = |t: f64| {
        let [a, b] = *RAMPS.windows(2).find(|pair| t <= pair[1].0).unwrap() else { panic!("two") };
        a.1 + (b.1 - a.1) * (t - a.0) / (b.0 - a.0)
    };
    let (mut air, mut profile) = (20.0, String::from("time_s,chamber_c\n"));
    for n in 0..=38_400 / 20 {
        let t = 20.0 * f64::from(n);
        air += (set_point(t) - air) * (1.0 - (-20.0 / LAG).exp());
        writeln!(profile, "{t},{air:.5}").unwrap();
    }
    let fine = simulated(&folder, &profile, &[]);
    let rows = (3..fine.len()).step_by(3).map(|n| {
        let rate = 3.0 + fine[n - 2..=n].iter().map(|row| row[6]).sum::<f64>() / 3.0 + 0.01 * noise(n);
        format!("{},{:.2},{:.2},{rate:.5}\n", fine[n][0], set_point(fine[n][0]), fine[n][2] + 0.02 * noise(n + 77))
    });
    folder.write("r.csv", "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows.collect::<String>());
    let output = folder.run(&["-q", "diagnose", "coil.ron", "--fit", "r.csv", "--json", "j.json", "--model-out", "m.ron"]);
    let json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(folder.path("j.json")).unwrap()).unwrap();
    assert_eq!((&json["verdict"], &json["named"]["id"]), (&"explained".into(), &"chamber-lag".into()), "{json}");
    let lag = &json["parameters"]["lag_s"];
    assert!((lag["value"].as_f64().unwrap() / LAG - 1.0).abs() < 0.1, "{lag}");
    // what is no part of the coil is in no coil file: a file that was asked for and is not written is warned of, also with -q
    let text = stdout(&output);
    assert!(
        text.lines().any(|line| line.starts_with("warning: m.ron: nothing to write: ") && line.ends_with("[no-model]")),
        "{text}"
    );
    assert!(json["note_ids"].as_array().unwrap().iter().any(|id| id == "no-model") && !folder.path("m.ron").exists(), "{json}");
}

/// A good unit that takes half of the bias that the design has off its rate by its own thermometer.
#[test]
fn a_compensated_rate_is_told() {
    compensated(0.5);
}

#[test]
#[ignore = "a minute"]
fn a_rate_compensated_in_full_is_told() {
    compensated(1.0);
}

fn compensated(taken: f64) {
    let folder = Folder::new();
    let fine = under_ramps(&folder);
    let nominal = folder.run(&["sensitivity", "coil.ron", "--json"]);
    let nominal: serde_json::Value = serde_json::from_str(&stdout(&nominal)).unwrap();
    let per_k_per_min = nominal["total"].as_f64().unwrap();
    // of the same size as above, and nothing in it repeats: a line would be taken off the rate
    let mut state = 1_u64;
    let mut noise = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (((state >> 40) as f64 + ((state >> 16) & 0xff_ffff) as f64) / f64::from(1_u32 << 23)) - 2.0
    };
    let rows = (3..fine.len()).step_by(3).map(|n| {
        let warmed = fine[n][2] - fine[n - 3][2];
        let rate = 3.0 + fine[n - 2..=n].iter().map(|row| row[6]).sum::<f64>() / 3.0 - taken * per_k_per_min * warmed;
        let [chamber, spool] = [1, 2].map(|column| fine[n][column] + 0.02 * noise());
        format!("{},{chamber:.2},{spool:.2},{:.5}\n", fine[n][0], rate + 0.01 * noise())
    });
    folder.write("r.csv", "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows.collect::<String>());
    let output = folder.run(&["diagnose", "coil.ron", "--fit", "r.csv", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!((&json["verdict"], &json["named"]["id"]), (&"explained".into(), &"compensated-rate".into()), "{json}");
    let ci = &json["parameters"]["compensated_fraction"]["ci90"];
    assert!(ci[0].as_f64().unwrap() < taken && taken < ci[1].as_f64().unwrap(), "{taken}: {json}");
}

/// A rate whose sign was changed is one that is compensated twice, to the digit: the mistake comes first, as nothing has to be fitted for it.
#[test]
#[ignore = "a minute"]
fn a_rate_of_the_other_sign_is_no_compensation() {
    let folder = Folder::new();
    let logged = logged(&folder, &under_ramps(&folder), -1.0);
    let said = diagnosed(&folder, logged);
    assert!(said.contains("[reversed-rate]") && said.contains("\nVoid if the rate has the other sign, as it seems."), "{said}");
}

/// A rate in rad/s that is read in deg/s is one of a sixtieth: the mistake comes before faults and before the drawing.
#[test]
#[ignore = "minutes"]
fn a_rate_in_another_unit_is_no_fault() {
    let folder = Folder::new();
    logged(&folder, &under_ramps(&folder), 1.0);
    let text = std::fs::read_to_string(folder.path("r.csv")).unwrap();
    let (head, rows) = text.split_once('\n').unwrap();
    let per = 3600.0 * 180.0 / std::f64::consts::PI;
    let in_rad_per_s = |row: &str| {
        let (rest, rate) = row.rsplit_once(',').unwrap();
        format!("{rest},{:e}\n", rate.parse::<f64>().unwrap() / per)
    };
    folder.write("r.csv", format!("{head}\n") + &rows.lines().map(in_rad_per_s).collect::<String>());
    let output = folder.run(&["diagnose", "coil.ron", "--fit", "r.csv", "--unit", "rate=deg/s"]);
    let said = stdout(&output);
    assert!(said.contains("rate_deg_per_h seems to be in rad/s: as it is read it is 57.3 times too small"), "{said}");
    assert!(
        said.contains("\nVoid if the rate is in another unit, as it seems.") && !said.contains("[doubted-drawing]"),
        "{said}"
    );
    assert!(said.contains("Next: Say the unit: "), "{said}");
}

/// A flange that the drawing has bonded and the unit has not: no mechanism is that, and others would be named.
#[test]
fn a_word_of_the_drawing_that_is_wrong_comes_before_faults() {
    let folder = Folder::new();
    folder.write("unit.ron", change(COIL, "overhang_mm: 1.0, bonded: true", "overhang_mm: 1.0, bonded: false"));
    let unit = under_ramps_as(&folder, "unit.ron");
    let said = diagnosed(&folder, logged(&folder, &unit, 1.0));
    assert!(said.contains("with spool.flanges[0].bonded: false (the right one)") && said.contains("[doubted-drawing]"), "{said}");
    assert!(said.contains("\nEither the unit differs from its drawing in one word, as the warning says, or this. "), "{said}");
    assert!(said.contains("Look at the unit, or ask its maker: "), "{said}");
}

/// A coil wound with the other handedness may look like a rate of the other sign; the word of the drawing that leaves far less is what is said.
#[test]
#[ignore = "minutes"]
fn the_other_handedness_is_no_sign_of_the_rate() {
    let folder = Folder::new();
    folder.write("unit.ron", change(COIL, "cw_climbs: Right", "cw_climbs: Left"));
    let unit = under_ramps_as(&folder, "unit.ron");
    let said = diagnosed(&folder, logged(&folder, &unit, 1.0));
    assert!(said.contains("with winding.cw_climbs: Left") && !said.contains("[reversed-rate]"), "{said}");
}

/// A heater that is on from the first row makes steps of the rate that a late clock would make otherwise: where nothing says how rows are stamped, its power
/// and its instant come out all the same, and no clock is late.
#[test]
#[ignore = "minutes"]
fn a_heater_makes_no_clock_late() {
    let folder = Folder::new();
    folder
        .write("unit.ron", change(COIL, "    sensor: (", "    heat: (heaters: [(side: Right, power_w: 0.25)]),\n    sensor: ("));
    let profile = "time_s,chamber_c\n0,22\n1800,22\n3600,-10\n9000,-10\n13800,70\n19200,70\n21600,40\n27000,22\n34200,22\n";
    let fine = simulated_as(&folder, "unit.ron", profile, &["--step", "30"]);
    let rows = fine.iter().enumerate().map(|(n, row)| {
        let [chamber, spool] = [(1, 0.03, 31), (2, 0.01, 77)].map(|(column, sd, seed)| row[column] + sd * noise(n + seed));
        format!("{},{chamber:.2},{spool:.2},{:.4}\n", row[0], 9.2 + row[6] + 0.013 * noise(n))
    });
    folder.write("record.csv", "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows.collect::<String>());
    let output = folder.run(&["diagnose", "coil.ron", "--fit", "record.csv", "--json", "found.json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output) + &stderr(&output);
    assert!(said.contains("Most likely: self-heating") && !said.contains("The rate is read"), "{said}");
    let found: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(folder.path("found.json")).unwrap()).unwrap();
    let value = |name: &str| found["parameters"][name]["value"].as_f64().unwrap();
    assert!((value("power_w") - 0.25).abs() < 0.005 && value("before_s") < 10.0, "{said}");
}

/// Minutes of a simulation as a logger writes them, the rate times a sign.
fn logged(folder: &Folder, fine: &[Vec<f64>], sign: f64) -> &'static str {
    let rows = (3..fine.len()).step_by(3).map(|n| {
        let rate = 3.0 + fine[n - 2..=n].iter().map(|row| row[6]).sum::<f64>() / 3.0;
        let [chamber, spool] = [(1, 31), (2, 77)].map(|(column, seed)| fine[n][column] + 0.02 * noise(n + seed));
        format!("{},{chamber:.2},{spool:.2},{:.5}\n", fine[n][0], sign * rate + 0.01 * noise(n))
    });
    folder.write("r.csv", "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows.collect::<String>());
    "r.csv"
}

/// What a diagnosis of a record says.
fn diagnosed(folder: &Folder, record: &str) -> String {
    let output = folder.run(&["diagnose", "coil.ron", "--fit", record]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    stdout(&output)
}

/// The order of records and of flags and the number of threads change no digit of an answer; the clock's zero and the rate's unit round its numbers otherwise.
#[test]
#[ignore = "minutes"]
fn order_clock_unit_and_threads_change_no_answer() {
    let folder = Folder::new();
    let profile = "time_s,chamber_c\n0,20\n1800,20\n6000,-40\n12000,-40\n16800,60\n24000,60\n";
    let runs = [under_ramps(&folder), simulated(&folder, profile, &["--step", "20"])];
    // with the effect of a tail
    let logged = |fine: &[Vec<f64>], zero: f64, name: &str, per_deg_per_h: f64| {
        let rows = (3..fine.len()).step_by(3).map(|n| {
            let rate = 3.0 + fine[n - 2..=n].iter().map(|row| row[6]).sum::<f64>() / 3.0 + 1.5 * (fine[n][2] - fine[n - 3][2]);
            let [chamber, spool] = [(1, 31), (2, 77)].map(|(column, seed)| fine[n][column] + 0.02 * noise(n + seed));
            format!("{},{chamber:.2},{spool:.2},{:?}\n", zero + fine[n][0], per_deg_per_h * (rate + 0.1 * noise(n)))
        });
        format!("time_s,chamber_c,spool_c,{name}\n") + &rows.collect::<String>()
    };
    for (fine, name) in runs.iter().zip(["a", "b"]) {
        folder.write(&format!("{name}.csv"), logged(fine, 0.0, "rate_deg_per_h", 1.0));
        folder.write(&format!("other-{name}.csv"), logged(fine, 1e6, "w", 1.0 / 3600.0));
    }
    let said = |arguments: &[&str]| stdout(&folder.run(arguments));
    let plain = said(&["diagnose", "coil.ron", "--fit", "a.csv", "--fit", "b.csv", "--json"]);
    assert!(said(&["--jobs", "1", "diagnose", "--json", "--fit", "b.csv", "coil.ron", "--fit", "a.csv"]) == plain);

    let read = ["--unit", "rate=deg/s", "--column", "rate=w", "--fit", "other-a.csv", "--fit", "other-b.csv"];
    let other = said(&[&["diagnose", "coil.ron", "--json"][..], &read].concat());
    let [plain, other]: [serde_json::Value; 2] = [plain, other].map(|json| serde_json::from_str(&json).unwrap());
    assert_eq!((&plain["verdict"], &plain["named"]["ids"]), (&other["verdict"], &other["named"]["ids"]), "{plain} {other}");
    let probabilities = |json: &serde_json::Value| -> std::collections::BTreeMap<String, f64> {
        let all = json["mechanisms"].as_array().unwrap().iter();
        all.map(|m| (m["id"].as_str().unwrap().to_owned(), m["probability"].as_f64().unwrap())).collect()
    };
    let (plain, other) = (probabilities(&plain), probabilities(&other));
    assert!(plain.values().any(|p| *p > 0.5) && plain.keys().eq(other.keys()), "{plain:?} {other:?}");
    for (id, probability) in &plain {
        assert!((probability - other[id]).abs() < 0.05, "{id}: {probability} {}", other[id]);
    }
}

fn the_model_is_the_design_with_the_bond(folder: &Folder, json: &serde_json::Value) {
    let below = json["parameters"]["debond_c"]["value"].as_f64().unwrap();
    let text = std::fs::read_to_string(folder.path("m.ron")).unwrap();
    for part in ["fit.csv", "Fitted, not measured", "debond_c = ", " to "] {
        assert!(text.contains(part), "`{part}` in {text}");
    }
    // both errors of the held-out record's rate, as the answer has them
    let held = text.lines().find(|line| line.contains("Held out: ")).unwrap_or_default();
    assert!(held.contains("holdout.csv; what was fitted predicts its rate to "), "{held}");
    let before =
        |unit: &str| held.split(unit).next().and_then(|said| said.rsplit(' ').next()).and_then(|n| n.parse::<f64>().ok());
    let fitted = before(" deg/h rms, the nominal").expect("a number");
    let nominal = held.trim_end_matches('.').rsplit(' ').next().and_then(|n| n.parse::<f64>().ok()).expect("a number");
    let of = |key: &str| json["holdout"][key].as_f64().expect("an error");
    assert!((fitted / of("rmse_model") - 1.0).abs() < 5e-3 && (nominal / of("rmse_nominal") - 1.0).abs() < 5e-3, "{held}");
    let [model, design] = ["m.ron", "coil.ron"].map(|name| read_coil(&folder.path(name)).unwrap().design);
    let Mechanics::Opening(bond) = model.mechanics else { panic!("{:?}", model.mechanics) };
    assert_eq!(bond.below, below);
    // its constants are those that the answer tells, each put in at its place, and nothing else
    let constants = json["unknowns"].as_array().unwrap().iter().filter(|c| c["kind"] == "design");
    let put = |design: Design, c: &serde_json::Value| {
        with_constant(&design, c["name"].as_str().unwrap(), c["value"].as_f64().unwrap()).unwrap()
    };
    let told = constants.fold(design.clone(), put);
    assert_ne!(told, design);
    let numbers = |design: &Design| -> Vec<f64> {
        let Design { optics, sensor, winding, .. } = design;
        let others = [optics.thermo_optic, sensor.lag, sensor.radius, sensor.y, winding.tails.cw, winding.tails.ccw];
        Parameter::ALL.iter().filter_map(|p| p.of(design)).chain(others).collect()
    };
    for (fitted, told) in numbers(&model).into_iter().zip(numbers(&told)) {
        assert!((fitted - told).abs() <= 1e-9 * told.abs(), "{fitted} {told}");
    }
    let as_drawn = Design { mechanics: Mechanics::Elastic, body: design.body, spool: design.spool.clone(), ..model };
    let as_drawn = Design { surroundings: design.surroundings, optics: design.optics, sensor: design.sensor, ..as_drawn };
    assert_eq!(Design { winding: design.winding, ..as_drawn }, design);
}

fn the_page_stands_alone(page: &str) {
    for part in [
        "Most likely: debond (probability ",
        "course-wide",
        "residuals-narrow",
        "spectrum-wide",
        "state-wide",
        "blocks-wide",
        "coherence-wide",
        "layers-wide",
        "parameters-wide",
        "held-out-wide",
        "allan-wide",
        "part of the chain: bond",
        "Ljung",
        "class=\"dot\"",
        // as docs/diagnosis.md says
        "gain of the rate 0.3 %, gain of the Shupe part 0.6 %, start off rest",
        "15 mechanisms with a name and 6 without one alone",
        "Inspect the unit. Only debond is left. A record that was held out confirms it.",
    ] {
        assert!(page.contains(part), "{part}");
    }
    // before is the design as drawn, without an instrument that may bend to the fault
    let (_, first) = page.split_once("id=\"before-and-after-wide").unwrap();
    let first = first.split("</figure>").next().unwrap();
    assert!(first.contains("recorded less nominal model") && first.contains("recorded less extended model"), "{first}");
    assert_eq!(charts::faults(page), [""; 0]);
    // a row for every mechanism but debond, the design, its constants and a structure; each rival does without debond
    let (_, rivals) = page.split_once("ln odds of debond over each rival</caption>").unwrap();
    // the first row holds the heads
    let rows: Vec<&str> = rivals.split("</table>").next().unwrap().split("<tr>").skip(2).collect();
    assert_eq!(rows.len(), 23, "{rows:?}");
    for row in rows {
        let cells: Vec<&str> = row.split("<td>").map(|cell| cell.split("</").next().unwrap()).collect();
        let tried = cells[2] != "not tried without debond";
        assert!(!tried || !cells[2].contains("debond"), "{row}");
        assert!(
            if tried { cells[1].trim_start_matches("&gt; ").parse::<f64>().unwrap() > 3.5 } else { cells[1] == "–" },
            "{row}"
        );
    }
    // the interval is two lines, neither of which turns back
    let (_, allan) = page.split_once("id=\"allan-wide").unwrap();
    let dotted: Vec<&str> = allan.split("</svg>").next().unwrap().split("<path class=\"line third\" d=\"M").skip(1).collect();
    assert_eq!(dotted.len(), 3, "a legend and two lines");
    for line in dotted {
        let x: Vec<f64> =
            line.split('"').next().unwrap().split(['L', 'H']).map(|p| p.split(' ').next().unwrap().parse().unwrap()).collect();
        assert!(x.windows(2).all(|pair| pair[1] > pair[0]), "{x:?}");
    }
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
}

/// A unit that two records leave to several mechanisms: both records are drawn, and the profile that would tell the mechanisms apart.
#[test]
#[ignore = "minutes"]
fn the_report_holds_every_record_and_the_recommended_profile() {
    let folder = Folder::new();
    folder.write("coil.ron", CLEAN_COIL);
    let unit = CASE.replace("case_13", "case_03");
    // ten hours of each: enough to see, quick to fit
    for name in ["fit.csv", "holdout.csv"] {
        let text = std::fs::read_to_string(format!("{unit}/{name}")).unwrap();
        folder.write(name, text.lines().take(1200).map(|line| line.to_owned() + "\n").collect::<String>());
    }
    let output = folder.run(&[
        "diagnose",
        "coil.ron",
        "--fit",
        "fit.csv",
        "--fit",
        "holdout.csv",
        "--json",
        "j.json",
        "--report",
        "r.html",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(folder.path("j.json")).unwrap()).unwrap();
    let set: Vec<&str> = json["set"].as_array().unwrap().iter().filter_map(|id| id.as_str()).collect();
    assert!(set.len() > 1, "{set:?}");
    let page = std::fs::read_to_string(folder.path("r.html")).unwrap();
    assert_eq!(charts::faults(&page), [""; 0]);
    for record in ["fit.csv", "holdout.csv"] {
        assert!(page.contains(&format!("recorded less nominal model, {record}</text>")), "{record}");
    }
    // the command of the page finds the profile of the page
    let (_, rest) = page.split_once("<code>fogcoil recommend ").unwrap();
    let command = rest.split("</code>").next().unwrap();
    assert!(command.ends_with("--out next.csv") && set.iter().take(2).all(|id| command.contains(id)), "{command}");
    let (_, rest) = page.split_once("<th scope=\"row\">profile</th><td>").unwrap();
    let profile = rest.split("</td>").next().unwrap();
    let output = folder.run(&[vec!["recommend", "--json", "--quiet"], command.split(' ').collect()].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let found: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(found["profiles"][0]["name"], profile);
    assert!(folder.path("next.csv").exists() && page.contains("next-test-narrow") && page.contains("expected separation"));
}

/// A mistake in the file's columns, not a mechanism: it is named before the verdict.
#[test]
fn exchanged_columns_and_a_reversed_rate_are_named() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let changed = |name: &str, row: &dyn Fn(&[&str]) -> String| {
        let text = std::fs::read_to_string(format!("{CASE}/{name}")).unwrap();
        let (head, rows) = text.split_once('\n').unwrap();
        rows.lines()
            .take(240)
            .map(|line| row(&line.split(',').collect::<Vec<_>>()) + "\n")
            .fold(head.to_owned() + "\n", |t, r| t + &r)
    };
    let negated =
        |f: &[&str]| format!("{},{},{},{}", f[0], f[1], f[2], f[3].parse::<f64>().map_or(String::new(), |r| (-r).to_string()));
    folder.write("negated.csv", changed("fit.csv", &negated));
    folder.write("exchanged.csv", changed("holdout.csv", &|f| format!("{},{},{},{}", f[0], f[2], f[1], f[3])));
    let output = folder.run(&["diagnose", "coil.ron", "--fit", "negated.csv", "--holdout", "exchanged.csv"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let (text, says) = (stdout(&output), |line: &str, words: [&str; 2]| words.iter().all(|w| line.contains(w)));
    let lines: Vec<&str> = text.lines().take_while(|line| line.starts_with("warning: ")).collect();
    assert!(lines.iter().any(|l| says(l, ["negated.csv: rate_deg_per_h", "other sign"])), "{text}");
    assert!(lines.iter().any(|l| says(l, ["exchanged.csv: chamber_c and spool_c", "exchanged"])), "{text}");
    assert!(text.contains("\nVoid if the rate has the other sign, as it seems. As it is read: "), "{text}");
    assert!(text.contains("\nNext: Check the ") && !text.contains("do not exclude"), "{text}");
    // what was not changed is not suspected: the other test's records have no warning
    assert!(!lines.iter().any(|l| l.contains("negated.csv: chamber_c") || l.contains("exchanged.csv: rate")), "{text}");
}

#[test]
fn what_cannot_be_diagnosed_is_said_at_once() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("soft.ron", change(COIL, "sensor:", "mechanics: Relaxing((fraction: 0.3, time_s: 900.0)),\n    sensor:"));
    let table = |rows: usize, head: &str, row: &dyn Fn(usize) -> String| {
        (0..rows).map(|k| row(k) + "\n").fold(head.to_owned() + "\n", |text, row| text + &row)
    };
    let head = "time_s,chamber_c,spool_c,rate_deg_per_h";
    let noisy = |k: usize| format!("{},20.0{},20.0{},0.0{}", 30 * k, k % 3, k % 5, k % 7);
    folder.write("short.csv", table(30, head, &noisy));
    folder.write("good.csv", table(300, head, &noisy));
    folder.write("cold.csv", table(300, "time_s,spool_c,rate_deg_per_h", &|k| format!("{},20.0{},0.0{}", 30 * k, k % 5, k % 7)));
    folder.write("empty.csv", head);
    folder.write("words.csv", "once upon a time");
    for (coil, record, says) in [
        ("coil.ron", "short.csv", "too few"),
        ("coil.ron", "cold.csv", "chamber"),
        ("coil.ron", "empty.csv", "empty.csv"),
        ("coil.ron", "words.csv", "words.csv"),
        ("coil.ron", "none.csv", "none.csv"),
        ("soft.ron", "good.csv", "mechanics"),
    ] {
        let output = folder.run(&["diagnose", coil, "--fit", record, "--json", "j.json"]);
        assert_eq!(output.status.code(), Some(2), "{record}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{record}: {}", stderr(&output));
        assert!(!folder.path("j.json").exists());
    }
    // a record cannot judge what was fitted to itself
    let output = folder.run(&["diagnose", "coil.ron", "--fit", "good.csv", "--holdout", "good.csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("same recording"), "{}", stderr(&output));
}
