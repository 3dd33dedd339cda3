//! `fogcoil calibrate` as a user runs it: a lot of good units in, a design out that every command reads.

use crate::common::{Folder, change, stderr, stdout};

const ORDINARY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/ordinary/B");

/// Two good units of the small coil, a third of each record: enough to see, quick to fit.
fn lot(folder: &Folder) -> Vec<String> {
    folder.write("drawing.ron", std::fs::read_to_string(format!("{ORDINARY}/drawing.ron")).unwrap());
    let unit = |name: &str| {
        let record = |run: &str| {
            let text = std::fs::read_to_string(format!("{ORDINARY}/open/{name}/{run}.csv")).unwrap();
            let file = format!("{name}-{run}.csv");
            folder.write(&file, text.lines().take(1100).map(|line| line.to_owned() + "\n").collect::<String>());
            file
        };
        ["run1", "run2"].map(record).join(",")
    };
    ["U4907", "U7986"].map(unit).to_vec()
}

#[test]
fn a_lot_is_a_design_that_other_commands_read() {
    let folder = Folder::new();
    let [first, second] = &lot(&folder)[..] else { panic!() };
    folder.write("meta.ron", "(design: \"coil-Z\")");
    let output = folder.run(&["calibrate", "drawing.ron", "--unit", first, "--unit", second, "--out", "lot.ron", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    // a batch's table names the same units
    let files = |unit: &str| unit.replace(',', "; ");
    folder.write("table.csv", format!("unit,judged,files\nA,pass,{}\nB,fail,no.csv\nC,pass,{}\n", files(first), files(second)));
    let of_batch = folder.run(&["calibrate", "drawing.ron", "--passed", "table.csv", "--out", "lot-2.ron", "--json"]);
    assert_eq!(stdout(&of_batch), stdout(&output), "{}", stderr(&of_batch));
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let notes = json["notes"].to_string();
    assert!(notes.contains("few-units") && notes.contains("built to `coil-Z`; this design is `coil-B`"), "{notes}");
    let constants = json["constants"].as_array().unwrap();
    // every constant of a material, by its key; none that is cut unit by unit
    let key = |of: &str| constants.iter().find(|c| c["key"] == of);
    assert!(key("coil.material.g_zr_mpa").is_some() && key("spool.hub_thickness_mm").is_none());
    for constant in constants {
        let [low, high] = [0, 1].map(|n| constant["ci90"][n].as_f64().unwrap());
        let value = constant["value"].as_f64().unwrap();
        assert!(low < value && value < high && constant["sigmas"].as_f64().unwrap().abs() < 3.0, "{constant}");
    }
    let units = json["units"].as_array().unwrap();
    // both fit: what is left of them is their noise; but the meta file names another design, so that neither is called good
    for unit in units {
        assert_eq!(unit["good"], false);
        for channel in ["rate_deg_per_h", "spool_c"] {
            let [rms, noise] = ["rms", "noise_with_drift"].map(|what| unit["left"][channel][what].as_f64().unwrap());
            assert!(0.3 * noise < rms && rms < 1.5 * noise, "{channel}: {rms} {noise}");
        }
    }
    assert!(!notes.contains("unit-misfit") && notes.contains("warning: U4907-run1.csv: the meta file says"), "{notes}");
    assert_eq!((units.len(), units[0]["files"].as_array().unwrap().len()), (2, 2));
    // what units of a lot have in common is known better than a unit, and a further unit better than one of the drawing
    let medium = "surroundings.medium.conductivity_w_per_mk";
    let tolerance = json["tolerances"].as_array().unwrap().iter().find(|t| t["key"] == medium).unwrap();
    assert!(tolerance["lot"].as_f64().unwrap() < 0.95 * tolerance["drawing"].as_f64().unwrap(), "{tolerance}");
    assert!(json["stands_out"].as_array().unwrap().iter().all(|e| e["lot"].as_f64() >= e["drawing"].as_f64()), "{json}");
    // the file has the values, says where they come from, and is a design
    let text = std::fs::read_to_string(folder.path("lot.ron")).unwrap();
    for says in ["the lot of 2 units, none of which can be called good", "// warning: drawing.ron: a lot of 2", "[other-design]"]
    {
        assert!(text.contains(says), "{says}: {text}");
    }
    assert!(text.contains("by fogcoil calibrate") && text.contains("U4907-run1.csv") && text.contains("correlations:"));
    let case = fogcoil::input::read_coil(&folder.path("lot.ron")).unwrap();
    assert!(case.is_calibrated() && !fogcoil::input::read_coil(&folder.path("drawing.ron")).unwrap().is_calibrated());
    let conductivity = key(medium).unwrap()["value"].as_f64().unwrap();
    assert!((case.design.surroundings.conductivity / conductivity - 1.0).abs() < 1e-9);
    assert_eq!(folder.run(&["sensitivity", "lot.ron"]).status.code(), Some(0));
    // a lot is not calibrated again, and correlations that contradict each other are refused
    for arguments in [["--unit", first, "lot.ron"], ["lot.ron", "--unit", first], ["lot.ron", "--units", first]] {
        let again = folder.run(&[&["calibrate"], &arguments[..], &["--out", "again.ron"]].concat());
        assert_eq!(again.status.code(), Some(2));
        assert!(stderr(&again).contains("correlations: is calibrated already; give the drawing"), "{}", stderr(&again));
    }
    let coil = std::fs::read_to_string(folder.path("drawing.ron")).unwrap();
    let [k, c, d] = ["coil.material.k_r_w_per_mk", "coil.specific_heat_j_per_kgk", "coil.density_kg_per_m3"];
    for (list, says) in [
        (format!("(\"{k}\", \"{c}\", 0.9), (\"{c}\", \"{d}\", 0.9), (\"{k}\", \"{d}\", -0.9)"), "contradict each other"),
        (format!("(\"{k}\", \"{k}\", 0.5)"), "are given twice, or are one"),
        (format!("(\"{k}\", \"{c}\", 1.0)"), "1 is no correlation"),
        (format!("(\"{k}\", \"{c}\", NaN)"), "NaN is no correlation"),
        (format!("(\"{k}\", \"coil.k\", 0.5)"), "\"coil.k\" is no number with a tolerance"),
    ] {
        let end = coil.rfind(')').unwrap();
        folder.write("bad.ron", format!("{}correlations: [{list}])\n", &coil[..end]));
        let output = folder.run(&["sensitivity", "bad.ron"]);
        assert_eq!(output.status.code(), Some(2), "{list}");
        assert!(stderr(&output).contains(says) && stderr(&output).contains("correlations"), "{list}: {}", stderr(&output));
    }
}

/// Records of another coil, of another size: whatever constants are fitted, much more than noise is left.
#[test]
fn units_of_another_design_are_not_called_good() {
    let folder = Folder::new();
    folder.write("drawing.ron", std::fs::read_to_string(format!("{ORDINARY}/drawing.ron")).unwrap());
    let other = std::fs::read_to_string(format!("{ORDINARY}/../A/open/U4615/run1.csv")).unwrap();
    folder.write("other.csv", other);
    let output = folder.run(&["calibrate", "drawing.ron", "--unit", "other.csv", "--out", "lot.ron"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let (text, warned) = (stdout(&output), stderr(&output));
    assert!(text.starts_with("coil-B: the lot of 1 unit, none of which can be called good."), "{text}");
    assert!(text.contains("does not fit") && text.contains("noise of a row"), "{text}");
    assert!(!text.contains("smallest effect found, of that without the lot"), "{text}");
    assert!(warned.contains("warning: other.csv: the design's constants leave") && warned.contains("[unit-misfit]"), "{warned}");
    let lot = std::fs::read_to_string(folder.path("lot.ron")).unwrap();
    assert!(lot.contains("other.csv (doubted)") && lot.contains("[unit-misfit]") && lot.contains("[few-units]"), "{lot}");
}

#[test]
fn what_cannot_be_calibrated_is_said_at_once() {
    let folder = Folder::new();
    let [first, second] = &lot(&folder)[..] else { panic!() };
    let refused = |arguments: &[&str], says: &str| {
        let output = folder.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{says}: {}", stderr(&output));
        assert!(!folder.path("lot.ron").exists());
    };
    refused(&["calibrate", "drawing.ron", "--out", "lot.ron"], "--unit");
    refused(&["calibrate", "drawing.ron", "--unit", "a.csv,,b.csv", "--out", "lot.ron"], "a record has no name");
    refused(&["calibrate", "drawing.ron", "--unit", first, "--unit", first, "--out", "lot.ron"], "same recording");
    // the second half of a record, its clock set back, proves nothing of what was fitted to the whole
    let whole = first.split(',').next().unwrap();
    let text = std::fs::read_to_string(folder.path(whole)).unwrap();
    let late = text.lines().skip(600).map(|line| {
        let (time, rest) = line.split_once(',').unwrap();
        format!("{},{rest}\n", time.parse::<f64>().unwrap() - 11_980.0)
    });
    folder.write("half.csv", text.lines().next().unwrap().to_owned() + "\n" + &late.collect::<String>());
    let says = format!("half.csv: is a part of another recording: all its rows stand in {whole}");
    refused(&["diagnose", "drawing.ron", "--fit", whole, "--holdout", "half.csv"], &says);
    refused(&["diagnose", "drawing.ron", "--fit", "half.csv", "--holdout", whole], &says);
    refused(&["calibrate", "drawing.ron", "--unit", first, "--unit", second, "--out", "drawing.ron"], "drawing.ron");
    let soft = std::fs::read_to_string(folder.path("drawing.ron")).unwrap();
    assert!(!soft.contains("mechanics:"));
    folder.write(
        "soft.ron",
        change(&soft, "    sensor:", "    mechanics: Relaxing((fraction: 0.3, time_s: 8000.0)),\n    sensor:"),
    );
    refused(&["calibrate", "soft.ron", "--unit", first, "--out", "lot.ron"], "mechanics");
}
