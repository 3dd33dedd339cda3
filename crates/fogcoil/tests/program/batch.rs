//! `fogcoil batch` as a user runs it: tables and a page of many units, limits, going on after a kill, what is refused.

use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use charts::faults;

use crate::common::{Folder, change, schema, stderr, stdout};

const ORDINARY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/ordinary/B");
const CACHE: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/cache");

/// Three units of the small coil: a folder with two records, two files of one; a part of each record, quick to fit.
fn lot() -> Folder {
    let folder = Folder::new();
    folder.write("drawing.ron", fs::read_to_string(format!("{ORDINARY}/drawing.ron")).unwrap());
    let part = |unit: &str, run: &str| {
        let text = fs::read_to_string(format!("{ORDINARY}/open/{unit}/{run}.csv")).unwrap();
        text.lines().take(700).map(|line| line.to_owned() + "\n").collect::<String>()
    };
    fs::create_dir_all(folder.path("lot/U7986")).unwrap();
    folder.write("lot/U7986/run1.csv", part("U7986", "run1"));
    folder.write("lot/U7986/holdout.csv", part("U7986", "holdout"));
    folder.write("lot/U7986/meta.ron", "(date: \"2026-03-02\", serial: Some(0017))");
    folder.write("U8378.csv", part("U8378", "run1"));
    folder.write("U4907.csv", part("U4907", "run1"));
    folder.write("limits.ron", "(limits: {\"arw\": Magnitude(1e-9)}, verdicts: [\"none\", \"recalibrate\", \"explained\"])");
    folder
}

const RUN: [&str; 7] = ["batch", "drawing.ron", "lot", "U8378.csv", "U4907.csv", "--limits", "limits.ron"];

fn tables(folder: &Folder, out: &str) -> Vec<Vec<u8>> {
    let read = |name: &str| fs::read(folder.path(&format!("{out}/{name}"))).unwrap();
    ["table.csv", "table.parquet", "table.xlsx", "report.html"].map(read).to_vec()
}

#[test]
fn units_become_a_table_and_a_page_whatever_interrupts_them() {
    let folder = lot();
    let output = folder.run(&[&RUN[..], &["--out", "whole"]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    // that units fail is a result, no error
    let said = stderr(&output);
    assert!(said.contains("3 of 3 units do not keep the limits") && !said.contains("error:"), "{said}");
    assert!(stdout(&output).contains("more than 0.000000001 in magnitude"), "{}", stdout(&output));
    let whole = tables(&folder, "whole");
    let table = String::from_utf8(whole[0].clone()).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[0].starts_with("unit,serial,date,judged,reason,verdict,set,sensitivity,sensitivity_low,sensitivity_high,"));
    assert!(lines[1].starts_with("U4907,4907,,fail,") && lines[2].starts_with("U7986,0017,2026-03-02,fail,"), "{table}");
    assert!(lines.len() == 4 && lines[2].contains("run1.csv; ") && lines[2].contains("holdout.csv"), "{table}");
    let page = String::from_utf8(whole[3].clone()).unwrap();
    assert!(faults(&page).is_empty(), "{:?}", faults(&page));
    for unit in ["U4907", "U7986", "U8378"] {
        assert!(page.contains(&format!("<a href=\"units/{unit}.html\">{unit}</a>")));
        let own = fs::read_to_string(folder.path(&format!("whole/units/{unit}.html"))).unwrap();
        assert!(faults(&own).is_empty(), "{unit}: {:?}", faults(&own));
        assert!(own.contains(&format!("<title>{unit} (coil-B): ")) && own.contains(&format!("<h1>{unit} (coil-B): ")), "{unit}");
    }
    assert!(lines[0].contains(",verdict_probability,first_probability,first_mechanism,lot,"), "{table}");
    killed_and_gone_on(&folder, &whole);
    what_is_not_known_has_not_passed(&folder);
    // a record that is another counts anew, and limits that are kept pass
    folder.write("limits.ron", "(limits: {\"arw\": Within(0.0, 1e3)})");
    let before = fs::metadata(folder.path("whole/units/U8378.json")).unwrap().modified().unwrap();
    let record = fs::read_to_string(folder.path("U4907.csv")).unwrap();
    folder.write("U4907.csv", record.lines().take(600).map(|line| line.to_owned() + "\n").collect::<String>());
    let hash = |name: &str| fs::read_to_string(folder.path(&format!("whole/units/{name}.json"))).unwrap();
    let old = hash("U4907");
    let output = folder.run(&[&RUN[..], &["--out", "whole"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    a_unit_that_cannot_be_used_does_not_keep_the_others(&folder);
    assert!(hash("U4907") != old && fs::metadata(folder.path("whole/units/U8378.json")).unwrap().modified().unwrap() == before);
}

/// A unit whose record does not tell a figure neither passes nor fails; the table is one object, too.
fn what_is_not_known_has_not_passed(folder: &Folder) {
    folder.write("limits.ron", "(limits: {\"hysteresis\": Magnitude(10.0)})");
    let output = folder.run(&[&RUN[..], &["--out", "whole", "--json"]].concat());
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("2 of 3 units are not known to keep the limits: they have not passed"), "{said}");
    let found: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(fogcoil::schema::misfit(&found, &schema("batch")), None);
    assert_eq!((&found["failing"], &found["not_known"]), (&0.into(), &2.into()));
    let unit = &found["units"][1];
    assert_eq!((&unit["unit"], &unit["judged"], &unit["lot"]), (&"U7986".into(), &"pass".into(), &"lot".into()));
    let short = &found["units"][0];
    assert_eq!((&short["unit"], &short["judged"]), (&"U4907".into(), &"not known".into()));
    assert!(short["reason"].as_str().unwrap().starts_with("hysteresis is not known: no temperature is held"), "{short}");
    assert!(unit["verdict_probability"].as_f64().is_some() && unit["first_mechanism"].is_string(), "{unit}");
}

/// A run that is killed once the first unit is kept, and the next, give what one run gives.
fn killed_and_gone_on(folder: &Folder, whole: &[Vec<u8>]) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fogcoil"));
    let arguments = [&RUN[..], &["--out", "killed", "--quiet"]].concat();
    command.args(&arguments).env("FOGCOIL_CACHE", CACHE).env("RAYON_NUM_THREADS", "1").current_dir(folder.path(""));
    let mut run = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let kept = || {
        let files = fs::read_dir(folder.path("killed/units")).into_iter().flatten().flatten();
        files.filter(|file| file.path().extension().is_some_and(|end| end == "json")).count()
    };
    let begun = Instant::now();
    while kept() == 0 && begun.elapsed() < Duration::from_secs(120) {
        std::thread::sleep(Duration::from_millis(5));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    assert!((1..3).contains(&kept()) && !folder.path("killed/table.csv").exists(), "{}", kept());
    assert_eq!(folder.run(&arguments).status.code(), Some(1));
    assert!(tables(folder, "killed") == whole);
}

#[test]
fn bad_batches_are_refused_and_nothing_is_written() {
    let folder = lot();
    folder.write("none.csv", "time_s,rate_deg_per_h\n0,nan\n");
    fs::create_dir_all(folder.path("empty")).unwrap();
    let cases: [(&[&str], &str); 6] = [
        (&["drawing.ron", "empty"], "has no recording"),
        (&["drawing.ron", "missing.csv"], "missing.csv"),
        (&["drawing.ron", "none.csv"], "none.csv"),
        (&["drawing.ron", "lot", "lot/U7986"], "is the second unit of the name U7986"),
        (&["missing.ron", "lot"], "missing.ron"),
        (&["drawing.ron", "U8378.csv", "--limits", "missing.ron"], "missing.ron"),
    ];
    for (arguments, said) in cases {
        let output = folder.run(&[&["batch"], arguments, &["--out", "out"]].concat());
        assert!(output.status.code() == Some(2) && stderr(&output).contains(said), "{arguments:?}: {}", stderr(&output));
    }
    // a unit whose files are missing, and units of another run
    fs::create_dir_all(folder.path("lot/U9999")).unwrap();
    fs::create_dir_all(folder.path("kept/units")).unwrap();
    for unit in ["U1", "U2", "U7986"] {
        folder.write(&format!("kept/units/{unit}.json"), "{}");
    }
    let said = stderr(&folder.run(&["batch", "drawing.ron", "lot", "--limits", "missing.ron", "--out", "kept"]));
    assert!(said.contains("U9999 has no recording (*.csv) and is no unit"), "{said}");
    assert!(said.contains("units that this table does not hold are kept in kept/units: 2, U1 the first"), "{said}");
    let good = "(limits: {\"sensitivity\": Magnitude(3.0)}, verdicts: [\"none\"])";
    let cases = [
        (change(good, "sensitivity", "sensitivty"), "did you mean `sensitivity`?"),
        (change(good, "3.0", "-3.0"), "is no limit"),
        (change(good, "Magnitude(3.0)", "Within(3.0, 2.0)"), "is no limit"),
        (change(good, "Magnitude(3.0)", "Within(NaN, 2.0)"), "is no limit"),
        (change(good, "\"none\"", "\"good\""), "\"good\" is no verdict"),
        ("()".to_owned(), "nothing is limited"),
        (change(good, "verdicts", "verdict"), "verdict"),
    ];
    for (limits, said) in cases {
        folder.write("limits.ron", &limits);
        let output = folder.run(&["batch", "drawing.ron", "U8378.csv", "--limits", "limits.ron", "--out", "out"]);
        assert!(output.status.code() == Some(2) && stderr(&output).contains(said), "{limits}: {}", stderr(&output));
    }
    let output = folder.run(&["batch", "drawing.ron", "U8378.csv", "--out", "drawing.ron"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(!folder.path("out").exists());
    many_records_in_a_folder_are_of_one_unit(&folder);
    results_never_lie_on_inputs(&folder);
}

/// A unit whose record cannot be used is a row like the others, with its problem; the others are judged.
fn a_unit_that_cannot_be_used_does_not_keep_the_others(folder: &Folder) {
    fs::create_dir_all(folder.path("other")).unwrap();
    folder.write("other/A1.csv", "time_s,chamber_c,spool_c,rate_deg_per_h\n0,20,20,0\n60,20,x,0\n");
    folder.write("limits.ron", "(limits: {\"arw\": Within(0.0, 1e3)}, verdicts: [\"none\"])");
    let arguments =
        ["batch", "drawing.ron", "U8378.csv", "other/A1.csv", "U4907.csv", "--limits", "limits.ron", "--out", "whole"];
    let output = folder.run(&arguments);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("going on without 1 of 3 units, whose records cannot be used (A1 the first)"), "{said}");
    assert!(said.contains("1 of 3 units are not diagnosed; A1: other/A1.csv:3: spool_c: "), "{said}");
    let table = fs::read_to_string(folder.path("whole/table.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines.len() == 4 && lines[1].starts_with("A1,1,,not known,"), "{table}");
    assert!(lines[2].starts_with("U4907,4907,,") && lines[3].starts_with("U8378,8378,,"), "{table}");
    assert_eq!(lines[1].matches("other/A1.csv:3: spool_c: ").count(), 2, "as reason and as problem, each once: {table}");
    assert!(!folder.path("whole/units/A1.json").exists());
}

/// Who gives a folder of units, a file each, is told how they are taken; where columns have other names, how to say so once for all.
fn many_records_in_a_folder_are_of_one_unit(folder: &Folder) {
    fs::create_dir_all(folder.path("many")).unwrap();
    for unit in 0..5 {
        folder.write(&format!("many/U{unit}.csv"), "t,T1,T2,Omega\n0,20,20,0\n60,20,20,0\n");
    }
    let said = stderr(&folder.run(&["batch", "drawing.ron", "many", "--out", "out"]));
    assert!(said.contains("the 5 records in many are taken for those of one unit"), "{said}");
    assert!(said.contains("time: (column: \"NAME\") in a file for --map"), "{said}");
    folder.write(
        "map.ron",
        "(time: (column: \"t\"), chamber: (column: \"T1\"), spool: (column: \"T2\"), rate: (column: \"Omega\"))",
    );
    let files: Vec<String> = (0..4).map(|unit| format!("many/U{unit}.csv")).collect();
    let arguments: Vec<&str> = ["batch", "drawing.ron", "--map", "map.ron", "--out", "out"]
        .into_iter()
        .chain(files.iter().map(String::as_str))
        .collect();
    let said = stderr(&folder.run(&arguments));
    assert!(!said.contains("one unit") && !said.contains("is missing"), "{said}");
}

/// A file that is read is no place for a result; the message comes before anything is computed or written.
fn results_never_lie_on_inputs(folder: &Folder) {
    let record = fs::read_to_string(folder.path("U8378.csv")).unwrap();
    fs::create_dir_all(folder.path("mine/units")).unwrap();
    folder.write("mine/table.csv", &record);
    folder.write("mine/units/table.json", "{\"verdicts\": [\"none\"]}");
    for (arguments, said) in [
        (vec!["lot/U7986", "--out", "lot/U7986"], "give another --out"),
        (vec!["mine/table.csv", "--out", "mine"], "is an input"),
        (vec!["mine/table.csv", "--limits", "mine/units/table.json", "--out", "mine"], "is an input"),
    ] {
        let output = folder.run(&[&["batch", "drawing.ron"], &arguments[..]].concat());
        assert!(output.status.code() == Some(2) && stderr(&output).contains(said), "{arguments:?}: {}", stderr(&output));
        assert!(!stderr(&output).contains("diagnosing"), "{}", stderr(&output));
    }
    assert_eq!(fs::read_to_string(folder.path("mine/table.csv")).unwrap(), record);
    assert!(!folder.path("mine/units/table.html").exists() && !folder.path("lot/U7986/units").exists());
}
