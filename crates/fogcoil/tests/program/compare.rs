//! `fogcoil compare` as a user runs it: what differs, by how much, how surely.

use charts::faults;
use fogcoil::schema::misfit;
use serde_json::Value;

use crate::common::{COIL, Folder, change, schema, stderr, stdout};

const PARTS: [&str; 4] = ["shupe", "eo_axial", "eo_radial", "total"];
const PROFILE: &str = "time_s,chamber_c\n0,20\n600,20\n1800,30\n3600,30\n5400,15\n9000,15\n";

fn compared(folder: &Folder, arguments: &[&str]) -> Value {
    let output = folder.run(&[&["compare"], arguments, &["--json", "--quiet"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(misfit(&json, &schema("compare")), None);
    json
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn a_design_differs_from_itself_by_nothing() {
    let folder = Folder::new();
    folder.write("a.ron", COIL);
    folder.write("p.csv", PROFILE);
    let json = compared(&folder, &["a.ron", "a.ron", "--profile", "p.csv"]);
    assert_eq!((json["differing"].as_array().unwrap().len(), json["tolerances"].as_array().unwrap().len()), (0, 0));
    assert!(json["tolerance_changes"].as_array().unwrap().iter().all(|c| c["shared"] == true && c["a"] == c["b"]));
    let alone: Value = serde_json::from_str(&stdout(&folder.run(&["sensitivity", "a.ron", "--json"]))).unwrap();
    for part in PARTS {
        let [a, b, difference] = ["a", "b", "difference"].map(|which| &json["sensitivity"][part][which]);
        assert!(a == b && a["value"] == alone[part], "{part}");
        assert_eq!((number(&difference["value"]), number(&difference["tolerance_sd"])), (0.0, 0.0), "{part}");
        // two units of one drawing
        let apart = number(&difference["tolerance_sd_apart"]);
        assert!((apart - 2_f64.sqrt() * number(&a["tolerance_sd"])).abs() < 1e-12, "{part}: {apart}");
    }
    let total = &json["sensitivity"]["total"]["a"];
    assert!((number(&total["tolerance_sd"]) / number(&alone["tolerance_sd"]) - 1.0).abs() < 1e-9);
    assert_eq!(total["error_estimate"], alone["error_estimate"]);
    let bias = &json["bias"];
    assert!(bias["a"] == bias["b"] && number(&bias["a"]["peak_deg_per_h"]) > 0.1, "{bias}");
    for key in ["peak_deg_per_h", "rms_deg_per_h", "end_deg_per_h"] {
        assert_eq!(number(&bias["difference"][key]), 0.0, "{key}");
    }
}

#[test]
fn what_two_designs_do_not_share_adds_up_and_the_rest_cancels() {
    let folder = Folder::new();
    folder.write("a.ron", COIL);
    let other = change(COIL, "hub_thickness_mm: 4.0", "hub_thickness_mm: 4.4");
    let other = change(&other, "strain: Total,", "strain: Mechanical,");
    let tolerances = "    tolerances: {\"coil.material.nu_zr\": Relative(0.013)},\n)";
    folder.write("b.ron", format!("{}{tolerances}\n", other.trim_end().strip_suffix(')').unwrap()));
    folder.write("p.csv", PROFILE);
    let json = compared(&folder, &["a.ron", "b.ron", "--profile", "p.csv"]);
    let differing: Vec<String> = json["differing"]
        .as_array()
        .unwrap()
        .iter()
        .map(|d| format!("{} {} {} {}", d["key"], d["a"], d["b"], d["unit"]))
        .collect();
    let expected = [r#""spool.hub_thickness_mm" "4.0" "4.4" "mm""#, r#""optics.strain" "Total" "Mechanical" null"#];
    assert_eq!(differing, expected);
    let tolerances = json["tolerances"].as_array().unwrap();
    assert!(
        tolerances.len() == 1 && tolerances[0]["key"] == "coil.material.nu_zr" && tolerances[0]["b"] == "1.3 %",
        "{tolerances:?}"
    );
    let changes = json["tolerance_changes"].as_array().unwrap();
    let shared = |key: &str| changes.iter().find(|c| c["key"] == key).unwrap()["shared"].as_bool().unwrap();
    assert!(!shared("spool.hub_thickness_mm") && !shared("coil.material.nu_zr") && shared("coil.material.e_r_mpa"));
    // nothing is correlated here: the variance is written out
    let variance = |c: &Value| {
        let [a, b] = ["a", "b"].map(|which| number(&c[which]));
        if c["shared"] == true { (b - a).powi(2) } else { a * a + b * b }
    };
    let [a, b, difference] = ["a", "b", "difference"].map(|which| &json["sensitivity"]["total"][which]);
    let sd = number(&difference["tolerance_sd"]);
    assert!((sd / changes.iter().map(variance).sum::<f64>().sqrt() - 1.0).abs() < 1e-9, "{sd}");
    assert!(0.0 < sd && sd < 0.9 * number(&difference["tolerance_sd_apart"]), "{difference}");
    assert!((number(&difference["value"]) - (number(&b["value"]) - number(&a["value"]))).abs() < 1e-12);
    // the other way round everything but the signs is the same
    let back = compared(&folder, &["b.ron", "a.ron", "--profile", "p.csv"]);
    for part in PARTS {
        let [there, here] = [&json, &back].map(|json| &json["sensitivity"][part]["difference"]);
        assert_eq!(number(&there["value"]), -number(&here["value"]), "{part}");
        let [there, here] = [there, here].map(|d| number(&d["tolerance_sd"]));
        assert!((there - here).abs() <= 1e-12 * there, "{part}: {there} {here}");
    }
    let [there, here] = [&json, &back].map(|json| &json["bias"]["difference"]);
    assert_eq!(there["peak_deg_per_h"], here["peak_deg_per_h"]);
    assert_eq!(number(&there["end_deg_per_h"]), -number(&here["end_deg_per_h"]));
    assert!(number(&there["peak_deg_per_h"]) > 5.0 * number(&there["error_estimate"]["peak_deg_per_h"]), "{there}");
    // another origin of time changes nothing
    let later = PROFILE.lines().map(|line| match line.split_once(',') {
        Some((time, rest)) if time != "time_s" => format!("{},{rest}\n", time.parse::<f64>().unwrap() + 7200.0),
        _ => format!("{line}\n"),
    });
    folder.write("later.csv", later.collect::<String>());
    let later = compared(&folder, &["a.ron", "b.ron", "--profile", "later.csv"]);
    for key in ["peak_deg_per_h", "rms_deg_per_h", "end_deg_per_h"] {
        let [then, now] = [&json, &later].map(|json| number(&json["bias"]["difference"][key]));
        assert!((then - now).abs() <= 1e-9 * then.abs().max(1e-3), "{key}: {then} {now}");
    }
}

#[test]
fn what_acts_in_no_ramp_is_seen_under_a_profile_alone() {
    let folder = Folder::new();
    folder.write("a.ron", COIL);
    folder.write("b.ron", change(COIL, "specific_heat_j_per_kgk: 1300.0", "specific_heat_j_per_kgk: 1700.0"));
    folder.write("p.csv", PROFILE);
    let json = compared(&folder, &["a.ron", "b.ron", "--profile", "p.csv"]);
    let total = &json["sensitivity"]["total"]["difference"];
    assert_eq!((number(&total["value"]), number(&total["tolerance_sd"])), (0.0, 0.0));
    assert!(number(&json["bias"]["difference"]["peak_deg_per_h"]) > 0.01, "{}", json["bias"]);
    assert!(json["bias"]["a"] != json["bias"]["b"]);
}

#[test]
fn the_page_is_whole_and_the_text_says_how() {
    let folder = Folder::new();
    folder.write("a.ron", COIL);
    let (start, rest) = COIL.split_once("    spool: Some((").unwrap();
    let (_, end) = rest.split_once("    )),\n").unwrap();
    let free = format!("{start}    spool: None,\n{end}");
    folder.write("b.ron", change(&free, "name: \"reference-coil\"", "name: \"a <b> & \\\"c\\\"\""));
    folder.write("p.csv", PROFILE);
    let output = folder.run(&["compare", "a.ron", "b.ron", "--profile", "p.csv", "--report", "r.html"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = stdout(&output);
    for says in [
        "A: reference-coil, a.ron; fibre 1101.5666 m",
        "what differs",
        "sd apart",
        "that both designs share",
        "bias under p.csv",
        "B - A, row by row",
        "rows last up to 3600 s",
    ] {
        assert!(text.contains(says), "{says}: {text}");
    }
    let page = std::fs::read_to_string(folder.path("r.html")).unwrap();
    assert_eq!(faults(&page), [""; 0]);
    for says in [
        "reference-coil and a &lt;b&gt; &amp; &quot;c&quot;",
        "spool.hub_thickness_mm",
        "SHA-256",
        "id=\"parts-wide-title\"",
        "id=\"bias-wide-title\"",
        "id=\"coils-wide-title\"",
        "rows last up to 3600 s",
    ] {
        assert!(page.contains(says), "{says}");
    }
    // without a profile there is no course
    folder.run(&["compare", "a.ron", "b.ron", "--report", "s.html"]);
    let page = std::fs::read_to_string(folder.path("s.html")).unwrap();
    assert!(faults(&page).is_empty() && !page.contains("bias-wide-title") && page.contains("coils-wide-title"));
}

#[test]
fn what_cannot_be_compared_is_said_at_once() {
    let folder = Folder::new();
    folder.write("a.ron", COIL);
    folder.write("b.ron", change(COIL, "layers: 36", "layers: -3"));
    folder.write("p.csv", "time_s,chamber_c\n0,20\n60,NaN\n");
    let refused = |arguments: &[&str], says: &str| {
        let before = folder.names();
        let output = folder.run(&[&["compare"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{says}: {}", stderr(&output));
        assert_eq!(folder.names(), before);
    };
    refused(&["a.ron"], "B.ron");
    refused(&["a.ron", "none.ron"], "none.ron");
    refused(&["a.ron", "b.ron"], "b.ron:");
    refused(&["a.ron", "a.ron", "--profile", "p.csv"], "p.csv:3");
    for input in ["a.ron", "b.ron", "p.csv"] {
        refused(&["a.ron", "b.ron", "--profile", "p.csv", "--report", input], input);
    }
    assert_eq!(std::fs::read_to_string(folder.path("a.ron")).unwrap(), COIL);
}
