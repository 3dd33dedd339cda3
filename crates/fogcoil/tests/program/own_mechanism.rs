//! A mechanism of a user's own, as a user runs it; `docs/own-mechanism.md` has the diagnosis.

use crate::common::{CLEAN_COIL, Folder, change, stderr, stdout};

/// A ramp of an hour.
const PROFILE: &str = "time_s,chamber_c\n0,20\n600,20\n4200,50\n7200,50\n";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("coil.ron", CLEAN_COIL);
    folder.write("p.csv", PROFILE);
    let output = folder.run(&["new", "--kind", "mechanism", "m.ron"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    folder
}

fn text(folder: &Folder) -> String {
    std::fs::read_to_string(folder.path("m.ron")).unwrap()
}

#[test]
fn a_mechanism_with_values_is_added_to_a_simulation() {
    let folder = folder();
    let simulate = ["simulate", "coil.ron", "--profile", "p.csv", "--step", "60", "--out", "b.csv", "--quiet"];
    let own = [&simulate[..], &["--mechanism", "m.ron"]].concat();
    let output = folder.run(&own);
    assert_eq!(output.status.code(), Some(2));
    let message = stderr(&output);
    assert!(message.contains("m.ron:20: parameters[0]: the parameter has no value; give it, e.g. value: Some(0.1)"), "{message}");
    assert!(!folder.path("b.csv").exists());
    let with_values = change(
        &change(&text(&folder), "0.01))", "0.01), value: Some(0.002))"),
        "1800.0, 1.0))",
        "1800.0, 1.0), value: Some(600.0))",
    );
    folder.write("m.ron", &with_values);
    let output = folder.run(&own);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).contains("mechanisms") && stdout(&output).contains("the sum of the four"), "{}", stdout(&output));
    let rows = |name: &str| -> Vec<Vec<f64>> {
        let text = std::fs::read_to_string(folder.path(name)).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
    };
    let with = rows("b.csv");
    assert_eq!(folder.run(&simulate).status.code(), Some(0));
    for (with, without) in with.iter().zip(rows("b.csv")) {
        assert_eq!(with[..6], without[..6], "nothing else changes");
        assert!((with[6] - without[6] - with[7]).abs() < 1e-12);
    }
    let json: serde_json::Value = serde_json::from_str(&stdout(&folder.run(&[&own[..], &["--json"]].concat()))).unwrap();
    let mut parts: std::collections::BTreeMap<String, f64> = serde_json::from_value(json["peak"].clone()).unwrap();
    let [_, rate] = ["time_s", "rate_deg_per_h"].map(|key| parts.remove(key).unwrap());
    assert!(parts["mechanisms_deg_per_h"] > 0.005 && (parts.values().sum::<f64>() - rate).abs() < 1e-12, "{json}");
    // the board, followed by hand, the spool being linear between rows
    let (mut behind, mut before) = (0.0, 0.0);
    for pair in with.windows(2) {
        let (dt, forget) = (pair[1][0] - pair[0][0], (-(pair[1][0] - pair[0][0]) / 600.0_f64).exp());
        behind = behind * forget + (pair[1][2] - pair[0][2]) / dt * 600.0 * (1.0 - forget);
        assert!((pair[1][7] - 0.002 * (behind + before) / 2.0).abs() < 0.01 * 0.0073, "{pair:?}");
        before = behind;
    }
    assert!(with[70][7] > 0.007);
    // a column that the law names is taken from the profile: twice the supply, twice the effect
    let law = change(&with_values, "size * (spool", "supply_v * size * (spool");
    folder.write("m.ron", change(&law, "states: [", "columns: [(name: \"supply_v\", unit: \"1\")],\n    states: ["));
    let output = folder.run(&own);
    assert!(stderr(&output).contains("p.csv:1: supply_v: the column is missing"), "{}", stderr(&output));
    folder.write("p.csv", "time_s,supply_v,chamber_c\n0,2,20\n600,2,20\n4200,2,50\n7200,2,50\n");
    assert_eq!(folder.run(&own).status.code(), Some(0));
    for (one, two) in with.iter().zip(rows("b.csv")) {
        assert!((two[7] - 2.0 * one[7]).abs() < 1e-12, "{two:?}");
    }
    let output = folder.run(&simulate);
    assert!(stderr(&output).contains("unknown column `supply_v`"), "{}", stderr(&output));
}

#[test]
fn a_law_that_is_no_number_is_told_by_its_line() {
    let folder = folder();
    let values = change(
        &change(&text(&folder), "0.01))", "0.01), value: Some(0.002))"),
        "1800.0, 1.0))",
        "1800.0, 1.0), value: Some(600.0))",
    );
    let two = change(&values, "    laws: [", "    laws: [\n        Thermometer(\"0 * (spool - board)\"),\n        ");
    let broken = change(&two, "size * (spool", "ln(time / tau) / ln(time / tau) * size * (spool");
    let line = crate::common::line_of(&broken, "ln(time / tau) / ln(time / tau) * size");
    folder.write("m.ron", &broken);
    let output = folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--quiet", "--mechanism", "m.ron"]);
    assert_eq!(output.status.code(), Some(2));
    let says = format!("m.ron:{line}: laws[1]: the law of `slow-board` is no finite number at 0 s of the profile; bound it");
    assert!(stderr(&output).contains(&says), "{says}: {}", stderr(&output));
    assert!(!folder.path("b.csv").exists());
}

#[test]
fn a_mechanism_in_json_is_explained_and_its_fault_told() {
    let folder = folder();
    let json = |law: &str| {
        format!(
            r#"{{"id": "warm-board", "title": "A warm board", "stage": "Electronics", "meaning": "a rate for every kelvin", "inspection": "warm it",
            "signature": "it lasts", "source": "none", "parameters": [{{"name": "size", "unit": "deg/h/K", "prior": {{"Normal": [0.0, 0.01]}}}}],
            "laws": [{{"Rate": "{law}"}}]}}"#
        )
    };
    folder.write("m.json", json("size * spool"));
    let output = folder.run(&["explain", "m.json"]);
    let text = stdout(&output);
    assert!(text.starts_with("warm-board: A warm board") && text.contains("size * spool"), "{text}{}", stderr(&output));
    folder.write("m.json", json("size * spol"));
    let output = folder.run(&["explain", "m.json"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("m.json:3: laws[0]: `spol` is not known"), "{}", stderr(&output));
}

#[test]
fn what_cannot_be_is_refused_with_line_and_remedy() {
    let folder = folder();
    let refused = |arguments: &[&str], says: &str| {
        let output = folder.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stdout(&output));
        let message = stderr(&output);
        assert!(message.contains(says) && message.matches("error:").count() == 1, "{arguments:?}: {message}");
    };
    folder.write("wrong.ron", change(&text(&folder), "size * (spool - board)", "size * (spool - bord)"));
    refused(
        &["explain", "wrong.ron"],
        "wrong.ron:40: laws[0]: `bord` is not known (character 17); the names here are size, tau, time",
    );
    let record = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/slow-board/fit.csv");
    let diagnose = ["diagnose", "coil.ron", "--fit", record, "--mechanism", "m.ron"];
    refused(&[&diagnose[..], &["--mechanism", "m.ron"]].concat(), "m.ron: the mechanism `slow-board` is given twice");
    refused(&[&diagnose[..], &["--json", "m.ron"]].concat(), "m.ron");
    let damp = change(&text(&folder), "states: [", "columns: [(name: \"humidity\", unit: \"1\")],\n    states: [");
    folder.write("damp.ron", change(&damp, "size * (spool", "humidity * size * (spool"));
    refused(&[&diagnose[..], &["--mechanism", "moistures"]].concat(), "did you mean `moisture`?");
    refused(&[&diagnose[..], &["--mechanism", "air-path"]].concat(), "`air-path` is weighed in any case");
    refused(&["diagnose", "coil.ron", "--fit", "a.csv,b.csv"], "give the option once for each file");
    refused(&["diagnose", "coil.ron", "--fit", record, "--mechanism", "damp.ron"], "humidity: the column is missing");
    let recommend = ["recommend", "coil.ron", "--between", "slow-board,nominal", "--mechanism", "damp.ron"];
    refused(&recommend, "the law of `slow-board` names the column humidity, which no programme of the chamber tells");
    // what simulate runs has values: of a file, or in the design
    let simulate = ["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--mechanism"];
    refused(
        &[&simulate[..], &["debond"]].concat(),
        "--mechanism: simulate takes the files of your own mechanisms; `debond` is one of the program's: put it into the coil file (the bond of coil and \
         flange: `mechanics: Opening(...)`), or take the coil file that `fogcoil diagnose --model-out` writes",
    );
    refused(&[&simulate[..], &["ratcheting"]].concat(), "(the bond of coil and spool; a coil file has no key for it)");
    refused(&[&simulate[..], &["debnd"]].concat(), "did you mean `debond`?");
    refused(
        &["explain", "coil.ron"],
        "coil.ron: is a coil file; add --sensitivity S, as it was measured, and the changes that would give it are explained",
    );
    refused(
        &["explain", "missing.csv"],
        "missing.csv: is no file, and no id of a mechanism, a warning or a note; `fogcoil explain` lists all",
    );
    // a folder of that name is no mechanism's file
    std::fs::create_dir(folder.path("debond")).unwrap();
    assert!(stdout(&folder.run(&["explain", "debond"])).starts_with("debond: "));
    refused(&[&simulate[..], &["debond"]].concat(), "`debond` is one of the program's");
    refused(&["explain", "p.csv"], "p.csv: is no mechanism's file; give an id, a mechanism's file (*.ron or *.json)");
    assert_eq!(text(&folder), include_str!("../../templates/mechanism.ron"), "nothing was overwritten");
}

/// The slow board of the fixtures, with the board's lag behind the spool logged as a voltage of 0.1 V/K, and a further column that says nothing.
#[test]
#[ignore = "a minute"]
fn a_column_that_nobody_named_is_found() {
    let folder = folder();
    for name in ["fit", "holdout"] {
        let path = format!("{}/../../fixtures/slow-board/{name}.csv", env!("CARGO_MANIFEST_DIR"));
        let (mut before, mut lag, mut rows) = (None::<[f64; 2]>, 0.0_f64, String::new());
        for (n, line) in std::fs::read_to_string(path).unwrap().lines().enumerate() {
            if n == 0 {
                rows += &format!("{line},Ub [V],room\n");
                continue;
            }
            let field = |k: usize| line.split(',').nth(k).unwrap().parse::<f64>().unwrap();
            let now = [field(0), field(2)];
            if let Some(then) = before {
                let decay = (-(now[0] - then[0]) / 1500.0).exp();
                lag = lag * decay + (now[1] - then[1]) / (now[0] - then[0]) * 1500.0 * (1.0 - decay);
            }
            before = Some(now);
            rows += &format!("{line},{:.4},{}\n", 24.0 - 0.1 * lag, 21 + n * n % 3);
        }
        folder.write(&format!("{name}.csv"), rows);
    }
    let reference = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron");
    let output = folder.run(&[
        "diagnose",
        reference,
        "--fit",
        "fit.csv",
        "--holdout",
        "holdout.csv",
        "--json",
        "d.json",
        "--model-out",
        "m.ron",
        "--report",
        "d.html",
    ]);
    let (told, noted) = (stdout(&output), stderr(&output));
    assert_eq!(output.status.code(), Some(0), "{noted}");
    assert!(told.contains("Most likely: follows-ub (probability 0.9"), "{told}");
    assert!(told.contains("the rate follows the column Ub [V]") && !told.contains("follows-room"), "{told}");
    assert!(noted.contains("a column that the model does not use (`Ub [V]`, `room`)"), "{noted}");
    let answer: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(folder.path("d.json")).unwrap()).unwrap();
    assert_eq!(answer["follows_column"], "Ub [V]");
    // of 0.006 (deg/h)/K and 0.1 V/K
    let size = &answer["parameters"]["follows_ub_deg_per_h_per_v"];
    let [low, high] = [0, 1].map(|end| size["ci90"][end].as_f64().unwrap());
    assert!(low < -0.06 + 0.003 && -0.06 - 0.003 < high && high - low < 0.02, "{size}");
    // its file holds what was found, as one of a user's own
    let law = stdout(&folder.run(&["explain", "m.follows-ub.ron"]));
    assert!(law.contains("column: the column `Ub [V]` of the record") && law.contains("follows_ub_deg_per_h_per_v"), "{law}");
}
