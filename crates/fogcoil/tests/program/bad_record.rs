//! Recordings that cannot be used: one message, exit status 2, nothing written.

use crate::common::{Folder, stderr, stdout};

const HEADER: &str = "time_s,chamber_c,spool_c,rate_deg_per_h\n";

/// Runs `check` with arguments on `r.csv` and expects every part in the one message.
fn refuse(content: impl AsRef<[u8]>, arguments: &[&str], parts: &[&str]) {
    let folder = Folder::new();
    folder.write("r.csv", content);
    let output = folder.run(&[&["check", "r.csv", "--svg", "a.svg"], arguments].concat());
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{message}{}", stdout(&output));
    assert_eq!(message.lines().count(), 1, "{message}");
    for part in parts {
        assert!(message.contains(part), "`{part}` in {message}");
    }
    assert_eq!(folder.names(), ["r.csv"]);
}

fn rows(count: usize, row: impl Fn(usize) -> String) -> String {
    (0..count).fold(HEADER.to_owned(), |text, i| text + &row(i) + "\n")
}

#[test]
fn a_file_that_is_no_recording() {
    refuse("", &[], &["r.csv: is empty", "time_s,chamber_c,spool_c,rate_deg_per_h"]);
    refuse(HEADER, &[], &["r.csv: has no row below its header"]);
    refuse("0,20,20,0.1\n30,20,20,0.2\n", &[], &["r.csv:1: the first line holds numbers", "put a line above it"]);
    refuse(vec![0; 1 << 17], &[], &["r.csv: cannot be read", "no table of numbers"]);
    refuse(b"time_s,rate_deg_per_h\n0,\xb0\n", &[], &["r.csv:2: is not UTF-8"]);
    refuse("time_s,rate_deg_per_h\r0,1\r", &[], &["r.csv:1: the lines end in carriage returns alone"]);
}

#[test]
fn columns_and_dialects_that_were_not_declared() {
    refuse(
        "Zeit;rate_deg_per_h\n0;20,5\n",
        &[],
        &["r.csv:1: the fields seem to be separated by semicolons", "--separator ';'", "--decimal-comma"],
    );
    // a semicolon in a logger's remark separates nothing
    let remarks = "ACME DAQ 7; serial 99123\nOperator: MK\n";
    refuse(
        format!("{remarks}time_s,chamber_c,rate_deg_per_h\n0,20,0.1\n30,20,0.2\n"),
        &[],
        &["r.csv:1: the names of the columns seem to stand in line 3", "--write-map", "preamble_lines: 2"],
    );
    refuse(
        format!("{remarks}time_s\tchamber_c\trate_deg_per_h\n0\t20\t0.1\n"),
        &[],
        &["r.csv:1: the fields seem to be separated by tabs", "--write-map", "line 3", "--separator tab"],
    );
    refuse("time_s\trate_deg_per_h\n0\t1\n", &[], &["r.csv:1: ", "tabs", "--separator tab"]);
    refuse("time_s,rate_deg_per_h\n0,1\n", &["--separator", ";"], &["r.csv:1: ", "commas", "--separator ','"]);
    refuse(
        "Zeit;rate_deg_per_h\n0;1\n",
        &["--separator", ";"],
        &[
            "r.csv:1: time_s: the column is missing",
            "`Zeit`",
            "--column time=NAME",
            "--interval",
            "--write-map MAP.ron proposes one, with columns, units and lines above the names",
        ],
    );
    refuse("time_s,w\n0,1\n", &[], &["r.csv:1: rate_deg_per_h: the column is missing", "--column rate=NAME"]);
    refuse("time_s,w\n0,1\n", &["--column", "rate=v"], &["r.csv:1: v: the column is missing"]);
    refuse("time_s,w,w\n0,1,1\n", &["--column", "rate=w"], &["r.csv:1: w: the column is there more than once"]);
    refuse(
        "time_s;rate_deg_per_h\n0;0,5\n",
        &["--separator", ";"],
        &["r.csv:2: rate_deg_per_h: `0,5` has a decimal comma", "--decimal-comma"],
    );
    refuse("time_s,rate_deg_per_h\n0,0,5\n", &[], &["r.csv:2: ", "3 fields where the header has 2"]);
}

#[test]
fn rows_that_cannot_be_read() {
    let bad = |row: &str| format!("{HEADER}0,20,20,0.1\n{row}\n");
    refuse(bad("30,20,20"), &[], &["r.csv:3: ", "3 fields where the header has 4", "complete the row"]);
    refuse(bad("30,20,20,fast"), &[], &["r.csv:3: rate_deg_per_h: `fast` is not a number"]);
    refuse(bad("30,20,20,inf"), &[], &["r.csv:3: rate_deg_per_h: `inf` is not a finite number"]);
    refuse(bad(",20,20,1"), &[], &["r.csv:3: time_s: is empty", "every row needs an instant"]);
    refuse(bad("2026-01-01T00:00:00Z,20,20,1"), &[], &["r.csv:3: time_s: `2026-01-01T00:00:00Z` is not a number"]);
    refuse(
        format!("{HEADER}2026-01-01T00:00:00Z,20,20,1\n30,20,20,1\n"),
        &[],
        &["r.csv:3: time_s: `30` is not a date and time like that of the first row"],
    );
    refuse(
        format!("{HEADER}02/30/2026 08:00:00,20,20,1\n"),
        &[],
        &["r.csv:2: time_s: `02/30/2026 08:00:00` is a day that its month"],
    );
    // of two rows, each is a date with another order
    refuse(
        format!("{HEADER}02/13/2026 08:00,20,20,1\n13/02/2026 08:00,20,20,1\n"),
        &[],
        &["r.csv:3: time_s: `13/02/2026 08:00` is not a date and time like that of the first row", "01.05.2024"],
    );
    refuse(format!("{HEADER}noon,20,20,1\n"), &[], &["time_s: `noon` is not a number", "2024-05-01T12:00:00.5Z", "--interval"]);
    // a logger's remarks count as lines
    refuse(format!("# logger 7\n\n#a, b\n{}", bad("30,20,20,fast")), &[], &["r.csv:6: rate_deg_per_h: `fast`"]);
    refuse(bad("# paused\n30,20,20,1"), &[], &["r.csv:3: holds no number, and rows follow"]);
    refuse("# logger 7\n", &[], &["r.csv: is empty"]);
}

#[test]
fn recordings_without_information() {
    refuse(rows(1, |_| "0,20,20,0.1".into()), &[], &["r.csv: cannot be used: too few rows, 1"]);
    refuse(
        rows(300, |i| format!("{},20,20,0.1", 30 * i)),
        &[],
        &["cannot be used: rate_deg_per_h: is 0.1 deg/h throughout", "cable"],
    );
    refuse(rows(300, |i| format!("{},20,20,", 30 * i)), &[], &["cannot be used: rate_deg_per_h: has no value at all"]);
    refuse(rows(300, |i| format!("{},20,20,nan", 30 * i)), &[], &["rate_deg_per_h: has no value at all"]);
    refuse(
        rows(300, |i| format!("{},20,20,{}", 30 * (i % 150), i * i % 7 + 10 * (i / 150))),
        &[],
        &["r.csv:152: cannot be used: time goes back by 4470 s", "from 0 to 4470 s (150 rows)", "sort the rows"],
    );
    refuse(rows(300, |i| format!("30,20,20,{}", i * i % 7)), &[], &["one instant has different values"]);
    // the report of what cannot be used is there all the same
    let folder = Folder::new();
    folder.write("r.csv", rows(300, |i| format!("{},20,20,0.1", 30 * i)));
    let output = folder.run(&["check", "r.csv", "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!((&json["usable"], &json["noise"]), (&serde_json::Value::Bool(false), &serde_json::Value::Null));
}

#[test]
fn flags_and_map_files_that_cannot_be() {
    let good = rows(300, |i| format!("{},20,20,{}", 30 * i, i * i % 7));
    let check = |arguments: &[&str], parts: &[&str]| {
        let folder = Folder::new();
        folder.write("r.csv", &good);
        let output = folder.run(&[&["check", "r.csv"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        parts.iter().for_each(|part| assert!(stderr(&output).contains(part), "`{part}` in {}", stderr(&output)));
    };
    check(&["--unit", "rate=furlong"], &["--unit: `furlong` is no unit of rate; choose deg/h, deg/s, rad/s, mrad/s"]);
    check(&["--unit", "speed=m"], &["`speed` is not a column here; choose time, chamber, spool, rate"]);
    check(&["--column", "rate"], &["KEY=VALUE"]);
    check(&["--scale", "rate=0"], &["0 is not a factor"]);
    check(&["--separator", "ab"], &["cannot separate fields"]);
    check(&["--decimal-comma"], &["a comma cannot separate the fields and the decimals"]);
    check(&["--interval=-3"], &["--interval: -3 s is not an interval"]);
    check(&["--map", "none.ron"], &["none.ron: cannot be read"]);
    check(&["--meta", "none.ron"], &["none.ron: cannot be read"]);
    check(&["--svg", "r.csv"], &["r.csv: is given twice, or is an input"]);

    let map = |text: &str, parts: &[&str]| {
        let folder = Folder::new();
        folder.write("r.csv", &good);
        folder.write("r.map.ron", text);
        let message = stderr(&folder.run(&["check", "r.csv"]));
        parts.iter().for_each(|part| assert!(message.contains(part), "`{part}` in {message}"));
    };
    map("(\n colour: 1)", &["r.map.ron:2: ", "unknown field `colour`", "separator"]);
    map("(rate: (\n unit: \"kg\"))", &["r.map.ron:2: rate.unit: `kg` is no unit of rate"]);
    map("(separator: \"xx\")", &["r.map.ron:1: separator: `xx` cannot separate fields"]);
    map("(interval_s: -1.0)", &["r.map.ron:1: interval_s: "]);
    map("(encoding: \"ebcdic\")", &["r.map.ron:1: encoding: `ebcdic` is not read; choose utf-8, utf-16le"]);
    map("(preamble_lines: -1)", &["r.map.ron:1: preamble_lines: "]);
    map("(preamble_lines: 9999)", &["r.csv: is empty"]);

    let folder = Folder::new();
    folder.write("r.csv", &good);
    folder.write("meta.ron", "(\n nominal_arw_deg_per_sqrt_h: Some(-1.0))");
    assert!(stderr(&folder.run(&["check", "r.csv"])).contains("meta.ron:2: nominal_arw_deg_per_sqrt_h: -1 is not 0 or more"));
    folder.write("meta.ron", "(\n designs: \"x\")");
    assert!(stderr(&folder.run(&["check", "r.csv"])).contains("meta.ron:2: designs: unknown field `designs`"));
}
