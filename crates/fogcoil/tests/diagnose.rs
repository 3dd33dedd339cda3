//! `fogcoil diagnose` as a user runs it, on a recording in which a bond opens.

mod common;

use common::{COIL, Folder, change, stderr, stdout};

const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/concealed/open/case_13");

#[test]
fn a_concealed_bond_is_named_and_the_held_out_record_predicted() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let (fit, holdout) = (format!("{CASE}/fit.csv"), format!("{CASE}/holdout.csv"));
    let arguments = ["diagnose", "coil.ron", "--fit", &fit, "--holdout", &holdout, "--json", "j.json", "--prediction", "p.csv"];
    let output = folder.run(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).contains("Most likely: debond."), "{}", stdout(&output));
    let json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(folder.path("j.json")).unwrap()).unwrap();
    assert_eq!(json["verdict"], "explained");
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
}
