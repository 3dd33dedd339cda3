//! Every way a profile or the heat paths of a design can be wrong ends in one message, exit status 2, and nothing written.

use crate::common::{COIL, Folder, change, line_of, stderr};

const SENSOR: &str = "sensor: (radius_mm: 39.5, y_mm: 10.01)";

/// Simulates and expects the message to start with `place` and to hold `says`.
fn refuse(folder: &Folder, profile: &str, place: &str, says: &str) {
    let before = folder.names();
    let output = folder.run(&["simulate", "coil.ron", "--profile", profile, "--out", "b.csv", "--report", "r.html", "--json"]);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(output.stdout.is_empty() && message.trim_end().lines().count() == 1, "{message}");
    assert!(message.starts_with(&format!("error: {place}")), "not at {place}: {message}");
    assert!(message.contains(says), "`{says}` not in: {message}");
    assert_eq!(folder.names(), before, "something was written");
}

fn refuse_all(cases: &[(&str, &str, &str)]) {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    for (content, place, says) in cases {
        folder.write("p.csv", content);
        refuse(&folder, "p.csv", place, says);
    }
}

#[test]
fn a_header_that_names_no_profile() {
    refuse_all(&[
        ("", "p.csv: is empty", "time_s,chamber_c"),
        ("\n \r\n\n", "p.csv: is empty", "time_s,chamber_c"),
        ("time_s,chamber_c\n", "p.csv: has no row", "one for each instant"),
        ("time_s\n0\n", "p.csv:1: chamber_c: the column is missing", "starts with a line time_s,chamber_c"),
        ("chamber_c\n0\n", "p.csv:1: time_s: the column is missing", ""),
        ("\n\ntime_s,temp\n0,1\n", "p.csv:3: unknown column `temp`", "a profile has time_s, chamber_c, left_c"),
        ("time_s,chamber_c,Spool_C\n0,1,1\n", "p.csv:1: unknown column `Spool_C`", "spool_c"),
        ("time_s,chamber_c,\n0,1,\n", "p.csv:1: unknown column ``", ""),
        ("time_s,chamber_c,time_s\n0,1,1\n", "p.csv:1: time_s: the column is given twice", "remove one"),
        ("0,20\n30,20\n", "p.csv:1: the first line holds numbers", "put a line time_s,chamber_c above it"),
        ("time_s;chamber_c\n0;20,5\n", "p.csv:1: the fields are separated by semicolons", "decimals with a point"),
        ("time_s\tchamber_c\n0\t20\n", "p.csv:1: the fields are separated by tabs", "with commas"),
        ("time_s,chamber_c\r0,20\r", "p.csv:1: the lines end in carriage returns alone", "line feeds"),
        (
            "time_s,chamber_c,mount_left_c\n0,1,1\n",
            "p.csv:1: mount_left_c: the design has no mount at the side Left",
            "heat.mounts",
        ),
        ("# by hand\n# slow\ntime_s,temp\n0,1\n", "p.csv:3: unknown column `temp`", "a profile has"),
        (COIL, "p.csv: begins like a RON file", "time_s,chamber_c"),
    ]);
}

#[test]
fn a_row_that_cannot_be_used() {
    let row = |rows: &str| format!("time_s,chamber_c\n0,20\n{rows}\n90,20\n");
    let cases = [
        ("30,warm", "p.csv:3: chamber_c: `warm` is not a number", "write it like 20.5"),
        ("30,20 C", "p.csv:3: chamber_c: `20 C` is not a number", "without a unit"),
        ("30,", "p.csv:3: chamber_c: is empty", "remove the row"),
        ("30,nan", "p.csv:3: chamber_c: `nan` is not a finite number", "remove the row"),
        ("inf,20", "p.csv:3: time_s: `inf` is not a finite number", ""),
        ("30,-1e999", "p.csv:3: chamber_c: `-1e999` is not a finite number", ""),
        ("0,21", "p.csv:3: time_s: 0 s stands in the row above too", "keep one"),
        ("60,20\r\n\r\n30,20", "p.csv:5: time_s: 30 s comes before the row above, 60 s", "sort the rows"),
        ("1e-9,20", "p.csv:3: time_s: 0.000000001 s is less than 1e-6 s after", ""),
        ("1e13,20", "p.csv:3: time_s: 10000000000000 s is beyond 1e12 s", "give seconds"),
        ("30,-273.16", "p.csv:3: chamber_c: -273.16 degC is below absolute zero", "the unit"),
        ("30,2931.5", "p.csv:3: chamber_c: 2931.5 degC is more than 1000", "if it is in kelvin, subtract 273.15"),
        ("30", "p.csv:3: `30` has 1 field where the header has 2", "complete the row or remove it"),
        ("30,20,5", "p.csv:3: `30,20,5` has 3 fields where the header has 2", "decimals with a point"),
        ("30,\"20,5\"", "p.csv:3: ", "decimals with a point"),
        ("30;20", "p.csv:3: `30;20` has 1 field", "not semicolons"),
        ("time_s,chamber_c", "p.csv:3: time_s: `time_s` is not a number", ""),
    ];
    let owned: Vec<_> = cases.iter().map(|(rows, place, says)| (row(rows), *place, *says)).collect();
    refuse_all(&owned.iter().map(|(content, place, says)| (content.as_str(), *place, *says)).collect::<Vec<_>>());
}

#[test]
fn a_file_that_is_no_table() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("latin.csv", b"time_s,chamber_c\n0,20\n30,20\xb0\n");
    folder.write("utf16.csv", b"\xff\xfet\0i\0m\0e\0");
    folder.write("zeros.csv", vec![0; 1 << 17]);
    folder.write("quote.csv", format!("time_s,chamber_c\n\"{}", "0,20\n".repeat(3)));
    std::fs::create_dir(folder.path("folder.csv")).unwrap();
    refuse(&folder, "latin.csv", "latin.csv:3: is not UTF-8 text", "CSV UTF-8");
    refuse(&folder, "utf16.csv", "utf16.csv:1: is not UTF-8 text", "CSV UTF-8");
    refuse(&folder, "zeros.csv", "zeros.csv: cannot be read: it has a line of more than", "no table of numbers");
    refuse(&folder, "quote.csv", "quote.csv:2: time_s: `\\\"0` is not a number", "");
    refuse(&folder, "folder.csv", "folder.csv: is a directory", "a profile (*.csv)");
    refuse(&folder, "missing.csv", "missing.csv: cannot be read", "check the path");
}

#[test]
fn an_output_that_cannot_be_written() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    folder.write("p.csv", "time_s,chamber_c\n0,20\n");
    let run = |arguments: &[&str]| {
        let output = folder.run(&[&["simulate", "coil.ron", "--profile", "p.csv"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        stderr(&output)
    };
    assert!(run(&["--out", "b.csv", "--report", "none/r.html"]).contains("none/r.html: there is no folder none"));
    assert!(run(&["--out", "p.csv"]).contains("p.csv: is given twice, or is an input"));
    assert!(run(&["--out", "b.csv", "--report", "coil.ron"]).contains("coil.ron: is given twice, or is an input"));
    assert!(run(&[]).contains("--out"));
    assert_eq!(folder.names(), ["coil.ron", "p.csv"]);
}

#[test]
fn heat_paths_that_cannot_be() {
    let mount =
        |side: &str, value: &str| format!("heat: (mounts: [(side: {side}, conductance_w_per_m2k: {value})]),\n    {SENSOR}");
    let heater = |side: &str, value: &str| format!("heat: (heaters: [(side: {side}, power_w: {value})]),\n    {SENSOR}");
    let contact = |side: &str, value: &str| {
        format!("heat: (flange_contacts: [(side: {side}, resistance_m2k_per_w: {value})]),\n    {SENSOR}")
    };
    let cases = [
        ("sensor: (radius_mm: 39.5, y_mm: 10.01, lag_s: -1.0)".into(), "sensor.lag_s", "negative"),
        ("sensor: (radius_mm: 39.5, y_mm: 10.01, lag_s: NaN)".into(), "sensor.lag_s", "not a finite number"),
        (mount("Right", "0.0"), "heat.mounts[0].conductance_w_per_m2k", "not greater than 0"),
        (heater("Right", "inf"), "heat.heaters[0].power_w", "not a finite number"),
        (heater("Right", "0.5), (side: Right, power_w: 0.1"), "heat.heaters[1].side", "a second one"),
        (format!("heat: (hub_resistance_m2k_per_w: -1.0), {SENSOR}"), "heat.hub_resistance_m2k_per_w", "negative"),
        (contact("Left", "1e-3"), "heat.flange_contacts[0].side", "no flange at the side Left"),
        (contact("Right", "NaN"), "heat.flange_contacts[0].resistance_m2k_per_w", "not a finite number"),
        (contact("Right", "-1e-3"), "heat.flange_contacts[0].resistance_m2k_per_w", "negative"),
        (format!("heat: (film_w_per_m2k: Some(0.0)), {SENSOR}"), "heat.film_w_per_m2k", "not greater than 0"),
        (format!("heat: (film_w_per_m2k: 0.0), {SENSOR}"), "heat.film_w_per_m2k", "not greater than 0"),
        (format!("heat: (fan: 20.0), {SENSOR}"), "heat.fan", "unknown field `fan`; the fields here are hub_resistance_m2k_per_w"),
        ("heat: (film_w_per_m2k: Some(5.0)), sensor: (radius_mm: 55.0, y_mm: 10.01)".into(), "sensor", "a film stands in place"),
    ];
    let folder = Folder::new();
    folder.write("p.csv", "time_s,chamber_c\n0,20\n");
    let line = line_of(COIL, SENSOR);
    for (new, field, says) in cases {
        folder.write("coil.ron", change(COIL, SENSOR, &new));
        refuse(&folder, "p.csv", &format!("coil.ron:{line}: {field}: "), says);
    }
    let unbonded = change(COIL, "hub_bonded: true", "hub_bonded: false");
    folder.write("coil.ron", change(&unbonded, SENSOR, &format!("heat: (hub_resistance_m2k_per_w: 1e-4), {SENSOR}")));
    refuse(&folder, "p.csv", &format!("coil.ron:{line}: heat.hub_resistance_m2k_per_w: "), "no contact to resist");
    folder.write("coil.ron", change(COIL, SENSOR, &format!("heat: (film_w_per_m2k: Some(5.0)), {SENSOR}")));
    folder.write("p.csv", "time_s,chamber_c,left_c\n0,20,20\n");
    refuse(&folder, "p.csv", "p.csv:1: left_c: ", "no end wall acts on it");
}

/// 1 us apart from 1970 on, where doubles are a quarter of it apart.
#[test]
fn rows_a_microsecond_apart_are_read() {
    let folder = Folder::new();
    folder.write("coil.ron", COIL);
    let run = |times: [&str; 3]| {
        let rows: String = times.iter().map(|time| format!("{time},20\n")).collect();
        folder.write("p.csv", format!("time_s,chamber_c\n{rows}"));
        folder.run(&["simulate", "coil.ron", "--profile", "p.csv", "--out", "b.csv"])
    };
    for times in [
        ["1700000000.000001", "1700000000.000002", "1700000000.000003"],
        ["0.3", "0.300001", "0.300002"],
        ["100000.1", "100000.100001", "100000.100002"],
    ] {
        let output = run(times);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    let output = run(["0.3", "0.3000005", "0.300002"]);
    assert!(
        stderr(&output).contains("p.csv:3: time_s: 0.3000005 s is less than 1e-6 s after the row above"),
        "{}",
        stderr(&output)
    );
}
