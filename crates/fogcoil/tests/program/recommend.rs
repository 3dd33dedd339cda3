//! `fogcoil recommend` and `fogcoil explain` as a user runs them.

use crate::common::{CLEAN_COIL, COIL, Folder, change, schema, stderr, stdout};
use serde_json::Value;

const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/concealed/open/case_13");

fn json(folder: &Folder, arguments: &[&str], name: &str) -> Value {
    let output = folder.run(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let object: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(fogcoil::schema::misfit(&object, &schema(name)), None, "{name}");
    object
}

fn log_odds(of: &Value) -> f64 {
    of["log_odds"].as_f64().unwrap()
}

#[test]
fn a_fast_profile_is_recommended_and_can_be_simulated() {
    let folder = Folder::new();
    folder.write("coil.ron", CLEAN_COIL);
    let between =
        ["recommend", "coil.ron", "--between", "tail-asymmetry, adhesive-content", "--json", "--out", "p.csv", "--quiet"];
    let r = json(&folder, &between, "recommend");
    let profiles = r["profiles"].as_array().unwrap();
    assert!(profiles.windows(2).all(|p| log_odds(&p[0]) >= log_odds(&p[1])));
    assert!(profiles[0]["decides"] == true && r["repeat"]["decides"] == false, "{}", r["recommendation"]);
    assert!(profiles[0]["gain_over_repeat"].as_f64().unwrap() > 5.0);
    let out = folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv", "--quiet"]);
    assert_eq!(out.status.code(), Some(0), "{}", stderr(&out));
    let last = std::fs::read_to_string(folder.path("p.csv")).unwrap().lines().last().unwrap().to_owned();
    assert!(last.starts_with("86400.0,"), "{last}");
    // a chamber that hardly moves tells nothing
    let narrow =
        [&between[..4], &["--coldest", "19", "--hottest", "21", "--fastest", "0.05", "--hours", "12", "--json"]].concat();
    let output = folder.run(&narrow);
    assert!(!stderr(&output).contains("modelling"), "the library is in the cache: {}", stderr(&output));
    let r: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(r["profiles"][0]["decides"], false);
    for profile in r["profiles"].as_array().unwrap() {
        assert!(!profile["name"].as_str().unwrap().contains(" 0.00 K/min"), "{profile}");
    }
    // without a record nothing is done again
    let output = folder.run(&between[..4]);
    let table = stdout(&output);
    assert!(!table.contains("again") && !table.contains("last record"), "{table}");
    assert!(table.contains("for comparison: slow ramp") && table.contains("gain: in ln odds, over the slow ramp"), "{table}");
    let says = r["recommendation"].as_str().unwrap();
    assert!(says.starts_with("No profile within the limits") && says.contains("tails' lengths"), "{says}");
    assert!(says.contains("the best of the insufficient ones, "), "{says}");
    // a profile that does not separate is written where it is asked for, and said to be none that does
    let output = folder.run(&[&narrow[..], &["--out", "narrow.csv"]].concat());
    let note = "note: narrow.csv does not separate tail-asymmetry, adhesive-content";
    assert!(folder.path("narrow.csv").exists() && stderr(&output).contains(note), "{}", stderr(&output));
}

#[test]
fn a_record_gives_sizes_and_the_test_that_is_repeated() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let fit = format!("{CASE}/fit.csv");
    let r = json(
        &folder,
        &["recommend", "coil.ron", "--between", "debond,nominal", "--from", &fit, "--json", "--quiet"],
        "recommend",
    );
    assert!(r["fitted"] == true && r["repeat"]["name"] == "the recorded test");
    // what the record was made with: -7.2073 degC
    assert!((r["sizes"][0]["parameters"]["debond_c"].as_f64().unwrap() + 7.2073).abs() < 1.0, "{}", r["sizes"]);
    assert!(log_odds(&r["repeat"]) > 3.5);
    // half of the test is not half as good: its noise is larger by the root of two, and the unit's constants are known as before
    let narrow = ["--hours", "12", "--coldest", "19", "--hottest", "21", "--fastest", "0.05", "--out", "p.csv", "--json"];
    let output = folder.run(&[&["recommend", "coil.ron", "--between", "debond,nominal", "--from", &fit], &narrow[..]].concat());
    let half: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!(log_odds(&half["repeat"]) > 0.55 * log_odds(&r["repeat"]), "{} {}", half["repeat"], r["repeat"]);
    // the profile that is written is another than what is recommended, and said to be
    let said = stderr(&output);
    assert!(said.contains("p.csv holds ") && said.contains("; the recorded test, done again, gives more (ln odds "), "{said}");
}

#[test]
fn what_cannot_be_recommended_is_said_at_once() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    for (arguments, says) in [
        (&["--between", "tail-asymmetry"][..], "two or more"),
        (&["--between", "tail-asymmetry,tail-asymmetry"], "twice"),
        (
            &["--between", "tail-asymmetry,gremlins"],
            "`gremlins` is not in this design's library; it holds tail-asymmetry, winding-defect",
        ),
        (&["--between", "nominal,recalibrate"], "a mechanism's"),
        (&["--between", "tail-asymmetry,drying"], "`drying` is weighed on request: add --mechanism drying"),
        (&["--between", "debond,air-path", "--coldest", "60", "--hottest", "-40"], "--coldest 60 --hottest -40"),
        (&["--between", "debond,air-path", "--fastest", "0"], "--fastest 0"),
        (&["--between", "debond,air-path", "--hours", "nan"], "--hours NaN"),
        (&["--between", "debond,air-path", "--from", "none.csv"], "none.csv"),
        (&["--between", "debond,air-path", "--out", "coil.ron"], "coil.ron"),
    ] {
        let output = folder.run(&[&["recommend", "coil.ron", "--quiet"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{arguments:?}: {}", stderr(&output));
    }
    assert_eq!(folder.names(), ["coil.ron"]);
}

#[test]
#[ignore = "minutes"]
fn the_paper_s_second_coil_is_explained_by_a_tail_and_hardly_by_its_constants() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let e = json(&folder, &["explain", "coil.ron", "--sensitivity", "1.39", "--json", "--quiet"], "explain");
    let of = |id: &str| e["explanations"].as_array().unwrap().iter().find(|x| x["id"] == id).unwrap().clone();
    let tail = of("tail-asymmetry");
    // 0.74 m in an independent finite-element code
    assert!((tail["value"].as_f64().unwrap() - 0.74).abs() < 0.01 && tail["verdict"] == "plausible", "{tail}");
    assert!(e["recalibrate"]["verdict"] == "implausible");
    for id in ["interface-resistance", "air-path", "axial-heat-path", "sensor-lag", "self-heating", "thermo-optic-curvature"] {
        assert!(of(id)["able"] == false && of(id)["why"].is_string(), "{}", of(id));
    }
    // the solved tail gives the sensitivity
    let tails = format!("tails_m: (cw: {}, ccw: 0.0)", tail["value"]);
    folder.write("tail.ron", change(COIL, "tails_m: (cw: 0.0, ccw: 0.0)", &tails));
    let s: Value = serde_json::from_str(&stdout(&folder.run(&["sensitivity", "tail.ron", "--json"]))).unwrap();
    assert!((s["total"].as_f64().unwrap() + 1.39).abs() < 0.003, "{s}");
    let text = stdout(&folder.run(&["explain", "coil.ron", "--sensitivity", "1.39", "--quiet"]));
    assert!(text.contains("compensated-rate: it is of the electronics") && !text.contains("()"), "{text}");
    // a negative number has a sign, with and without the word
    let [alone, signed] = [&[][..], &["--signed"]].map(|word| {
        let command = ["explain", "coil.ron", "--sensitivity", "-1.0", "--json", "--quiet"];
        json(&folder, &[&command[..], word].concat(), "explain")
    });
    assert!(alone == signed && alone["sensitivity"] == -1.0 && alone["taken_as_magnitude"] == false, "{alone}");
}
