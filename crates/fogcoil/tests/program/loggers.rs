//! Files as loggers write them: units in names, instants in two columns, quotes, lines of units, codes for an overload.

use crate::common::{Folder, stderr, stdout};
use crate::write_map::{lines, proposes, rows};

/// The time of day of a row, from `start` hours.
fn clock(start: usize, n: usize) -> [usize; 3] {
    [(start + n / 120) % 24, n / 2 % 60, n % 2 * 30]
}

fn run(text: &str, arguments: &[&str]) -> (Option<i32>, String, Folder) {
    let folder = Folder::new();
    folder.write("r.csv", text);
    let output = folder.run(&[&["check", "r.csv"], arguments].concat());
    (output.status.code(), stdout(&output) + &stderr(&output), folder)
}

#[test]
fn prefixed_units_in_names_are_heard() {
    for (unit, name, per) in [
        ("mdeg/s", "mdeg/s", 3.6),
        ("m°/s", "mdeg/s", 3.6),
        ("µrad/s", "urad/s", 0.206_264_806_247_096_36),
        ("deg/min", "deg/min", 60.0),
    ] {
        let text = format!("time_s,chamber_c,spool_c,Rate [{unit}]\n")
            + &lines(|_, [t, c, s, r]| format!("{t},{c:.5},{s:.5},{:.9}", r / per));
        let map = format!("(\n    rate: (column: \"Rate [{unit}]\", unit: \"{name}\"),\n)\n");
        proposes(text.into_bytes(), &map);
    }
}

/// A spreadsheet writes a row without values as its separators alone.
#[test]
fn empty_rows_are_none() {
    let all = lines(|_, [t, c, s, r]| format!("{t};{c:.5};{s:.5};{r:.6}"));
    let rows: String =
        all.split_inclusive('\n').enumerate().map(|(n, row)| row.to_owned() + if n == 9 { " ; ;;\n" } else { "" }).collect();
    let text = format!("Stand 3\ntime_s;chamber_c;spool_c;rate_deg_per_h\n;;;\n{rows};;;\n;;;\n");
    let map = "(\n    preamble_lines: 1,\n    separator: \";\",\n)\n";
    proposes(text.into_bytes(), map);
    // without instants each row stands for one
    let (_, said, _folder) = run("chamber_c,rate_deg_per_h\n20,1\n,\n20,2\n", &["--interval", "30"]);
    assert!(said.contains("of 3") || said.contains("too few rows, 3"), "{said}");
}

#[test]
fn what_is_no_unit_is_said() {
    let text = "time_s,chamber_c,spool_c,Rate [xyz]\n".to_owned() + &lines(|_, [t, c, s, r]| format!("{t},{c:.5},{s:.5},{r:.6}"));
    let map = "(\n    rate: (column: \"Rate [xyz]\"), // `xyz` is no unit here: taken as deg/h; write unit: ..., scale: ...\n)\n";
    proposes(text.clone().into_bytes(), map);
    let (code, said, _folder) = run(&text, &["--quiet", "--column", "rate=Rate [xyz]"]);
    assert_eq!(code, Some(0), "{said}");
    let says =
        "warning: the column `Rate [xyz]` is read in deg/h; `xyz` is no unit of rate here: say what it holds by --unit rate=UNIT";
    assert!(said.lines().any(|line| line.starts_with(says) && line.ends_with("[unknown-unit]")), "{said}");
    let (_, said, _folder) = run(&text, &["--quiet", "--column", "rate=Rate [xyz]", "--unit", "rate=deg/h"]);
    assert!(!said.contains("warning: "), "{said}");
}

/// The rows of a record say whether the day or the month is first, where it passes midnight; within a day it does not matter.
#[test]
fn dates_between_slashes_are_read_by_their_rows() {
    let at = |n: usize, first: u8| {
        let ([h, m, s], later) = (clock(23, n), usize::from(n >= 120));
        let day = 2 + later;
        if first == b'd' { format!("{day:02}/03/2026 {h:02}:{m:02}:{s:02}") } else { format!("3/{day}/26 {h}:{m:02}:{s:02}") }
    };
    let text = |first: u8, kept: usize| {
        let all = lines(|n, [_, c, s, r]| format!("{},{c:.5},{s:.5},{r:.6}", at(n, first)));
        "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &all.split_inclusive('\n').take(kept).collect::<String>()
    };
    for (first, name) in [(b'd', "day"), (b'm', "month")] {
        let (code, said, _folder) = run(&text(first, usize::MAX), &[]);
        assert!(code == Some(0) && said.contains("99.50  min"), "{said}");
        assert!(said.contains(&format!("instants are dates, the {name} first, as only so they go on evenly")), "{said}");
        let (code, said, _folder) = run(&text(first, 120), &[]);
        assert!(code == Some(0) && said.contains("59.50  min") && said.contains("instants are dates; they"), "{said}");
        let (code, said, _folder) = run(&text(first, 120), &["--unit", "time=min"]);
        assert!(
            code == Some(2) && said.contains("r.csv:2: time_s: `") && said.contains("is a date, which has no unit"),
            "{said}"
        );
    }
}

#[test]
fn date_and_time_of_day_in_two_columns() {
    let iso = |n: usize| {
        let [h, m, s] = clock(23, n);
        format!("2026-03-{:02},{h:02}:{m:02}:{s:02}", if n < 120 { 2 } else { 3 })
    };
    let text = "Date,Time,chamber_c,spool_c,rate_deg_per_h\n".to_owned()
        + &lines(|n, [_, c, s, r]| format!("{},{c:.5},{s:.5},{r:.6}", iso(n)));
    proposes(text.clone().into_bytes(), "(\n    time: (column: \"Date\"),\n    time_of_day: \"Time\",\n)\n");

    let german = |n: usize| {
        let [h, m, s] = clock(8, n);
        format!("02.03.2026;{h:02}:{m:02}:{s:02}")
    };
    let comma = |value: f64| format!("{value:.6}").replace('.', ",");
    let german = "Datum;Uhrzeit;chamber_c;spool_c;rate_deg_per_h\n".to_owned()
        + &lines(|n, [_, c, s, r]| format!("{};{};{};{}", german(n), comma(c), comma(s), comma(r)));
    let map =
        "(\n    separator: \";\",\n    decimal_comma: true,\n    time: (column: \"Datum\"),\n    time_of_day: \"Uhrzeit\",\n)\n";
    proposes(german.into_bytes(), map);

    // by flags, and what is said without them
    let (code, said, _folder) = run(&text, &["--column", "time=Date", "--time-of-day", "Time"]);
    assert!(code == Some(0) && said.contains("99.50  min") && said.contains("instants are dates"), "{said}");
    let (code, said, _folder) = run(&text, &["--column", "time=Date"]);
    assert!(code == Some(2) && said.contains("r.csv:2: Date: `2026-03-02` is not a number; if the time of day stands"), "{said}");
    assert!(said.contains("--time-of-day NAME"), "{said}");
    let (code, said, _folder) = run(&text, &["--column", "time=Date", "--time-of-day", "Clock"]);
    assert!(code == Some(2) && said.contains("r.csv:1: Clock: the column is missing"), "{said}");
    let (code, said, _folder) = run(&text, &["--column", "time=chamber_c", "--time-of-day", "Time"]);
    assert!(code == Some(2) && said.contains("is not a date and a time of day"), "{said}");
}

#[test]
fn times_of_day_pass_midnight() {
    let table = |time: &dyn Fn(usize) -> String| {
        "Time,chamber_c,spool_c,rate_deg_per_h\n".to_owned()
            + &lines(|n, [_, c, s, r]| format!("{},{c:.5},{s:.5},{r:.6}", time(n)))
    };
    let plain = table(&|n| {
        let [h, m, s] = clock(23, n);
        format!("{h:02}:{m:02}:{s:02}")
    });
    let map = "(\n    time: (column: \"Time\"),\n)\n";
    proposes(plain.clone().into_bytes(), map);
    let (_, said, _folder) = run(&plain, &["--column", "time=Time"]);
    assert!(said.contains("a day is added where they pass midnight [times-of-day]"), "{said}");
    let noon = |n: usize| {
        let [h, m, s] = clock(11, n);
        format!("{:02}:{m:02}:{s:02} {}", (h + 11) % 12 + 1, if h < 12 { "AM" } else { "PM" })
    };
    proposes(table(&noon).into_bytes(), map);
    proposes(table(&|n| format!("14-Mar-2026 {}", noon(n))).into_bytes(), map);
    // what goes back by less is no midnight
    let back = plain.replacen("23:00:30", "22:00:00", 1);
    let (code, said, _folder) = run(&back, &["--column", "time=Time"]);
    assert!(code == Some(2) && said.contains("time goes back by 3600 s"), "{said}");
    let (code, said, _folder) = run(&plain, &["--column", "time=Time", "--unit", "time=ms"]);
    assert!(code == Some(2) && said.contains("r.csv:2: Time: `23:00:00` is a time of day, which has no unit"), "{said}");
    let (code, said, _folder) = run(&plain.replacen("23:00:30", "soon", 1), &["--column", "time=Time"]);
    assert!(code == Some(2) && said.contains("r.csv:3: Time: `soon` is not a time of day like that of the first row"), "{said}");
}

#[test]
fn separators_stand_within_quotes() {
    let text = "\"time_s\",\"Chamber, air (°C)\",\"5\"\" spool (°C)\",\"rate_deg_per_h\",\"Remark\"\n".to_owned()
        + &lines(|n, [t, c, s, r]| format!("{t},{c:.5},\"{s:.5}\",{r:.6},\"run {n}, \"\"good\"\"\""));
    let map = "(\n    chamber: (column: \"Chamber, air (°C)\"),\n    spool: (column: \"5\\\" spool (°C)\"),\n)\n";
    proposes(text.into_bytes(), map);
    // a decimal comma within quotes, commas between them
    let comma = |value: f64| format!("\"{value:.6}\"").replace('.', ",");
    let text = "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned()
        + &lines(|_, [t, c, s, r]| format!("\"{t}\",{},{},{}", comma(c), comma(s), comma(r)));
    proposes(text.clone().into_bytes(), "(\n    decimal_comma: true,\n)\n");
    assert_eq!(run(&text, &["--decimal-comma"]).0, Some(0));
    let (code, said, _folder) = run(&text.replace('"', ""), &["--decimal-comma"]);
    assert!(code == Some(2) && said.contains("a comma cannot separate the fields and the decimals"), "{said}");
    // a quote that is not closed is no more than a quote
    let (code, said, _folder) = run("time_s,rate_deg_per_h\n0,\"1\n30,2\n", &[]);
    assert!(code == Some(2) && said.contains("r.csv:2: rate_deg_per_h: `\\\"1` is not a number"), "{said}");
}

#[test]
fn codes_for_an_overload_are_missing_values() {
    for code in ["+OVLD.", "-OVLD", "OVER", "OVERLOAD", "+OVER"] {
        let text = "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned()
            + &lines(|n, [t, c, s, r]| match n {
                50 => format!("{t},{c:.5},{s:.5},{code}"),
                _ => format!("{t},{c:.5},{s:.5},{r:.6}"),
            });
        let (status, said, _folder) = run(&text, &[]);
        assert!(
            status == Some(0) && said.contains("note: line 52: rate_deg_per_h: values are missing, at 1500 s"),
            "{code}: {said}"
        );
    }
}

#[test]
fn temperatures_of_nobody_are_told() {
    let text = "Time,101 (C),102 (C),103 <Chamber set> (C),Gyro rate (deg/hr)\n".to_owned()
        + &lines(|_, [t, c, s, r]| format!("{t},{c:.5},{s:.5},20,{r:.6}"));
    let (code, said, folder) = run(&text, &["--write-map"]);
    assert_eq!(code, Some(0), "{said}");
    let warning = "warning: 3 temperatures are not used: `101 (C)`, `102 (C)`, `103 <Chamber set> (C)`; if they are wanted, say which is \
                   which: --column chamber=NAME, --column spool=NAME [unused-temperature]";
    assert!(said.contains(warning), "{said}");
    let map = std::fs::read_to_string(folder.path("r.map.ron")).unwrap();
    let lines = "    // temperatures that are not used; take the // from the lines that are right:\n    // chamber: (column: \"101 (C)\"),\n    \
                 // chamber: (column: \"102 (C)\"),\n    // spool: (column: \"101 (C)\"),\n    // spool: (column: \"102 (C)\"),\n)\n";
    assert!(map.ends_with(lines), "{map}");
    // the lines are what the map means
    let mended = map.replacen("// chamber", "chamber", 1).replace("// spool: (column: \"102", "spool: (column: \"102");
    folder.write("r.map.ron", mended);
    let output = folder.run(&["check", "r.csv", "--quiet"]);
    assert_eq!((output.status.code(), stdout(&output).contains("warning: ")), (Some(0), false), "{}", stderr(&output));
}

#[test]
fn a_line_of_units_is_not_one_of_names() {
    let text = "Logger 7\nTime,Chamber,Spool,Gyro rate,Status\ns,°C,K,deg/s,-\n".to_owned()
        + &lines(|_, [t, c, s, r]| format!("{t},{c:.5},{:.5},{:e},ok", s + 273.15, r / 3600.0));
    proposes(
        text.into_bytes(),
        r#"(
    preamble_lines: 1,
    lines_below_names: 1,
    time: (column: "Time"),
    chamber: (column: "Chamber"),
    spool: (column: "Spool", unit: "K"),
    rate: (column: "Gyro rate", unit: "deg/s"),
)
"#,
    );
    let (code, said, _folder) = run("time_s,rate_deg_per_h\ns,deg/h\n0,1\n30,2\n", &[]);
    assert!(code == Some(2) && said.contains("r.csv:2: time_s: `s` is not a number; if the line holds the units"), "{said}");
    assert_eq!(rows().len(), 200);
}

/// A map that was given stands for every record: where one is of another form, the message says whose map it is.
#[test]
fn a_map_for_every_record_is_named_where_one_does_not_fit() {
    let folder = Folder::new();
    folder.write("a.csv", "Zeit,Rate\n".to_owned() + &lines(|_, [t, _, _, r]| format!("{t},{r:.6}")));
    folder.write("b.csv", "time_s,Rate\n".to_owned() + &lines(|_, [t, _, _, r]| format!("{t},{r:.6}")));
    folder.write("c.csv", "Zeit;Rate\n".to_owned() + &lines(|_, [t, _, _, r]| format!("{t};{r:.6}")));
    folder.write("d.csv", "Zeit,Rate\n0,x\n");
    folder.write("m.ron", "(time: (column: \"Zeit\"), rate: (column: \"Rate\", unit: \"deg/h\"))");
    let said = |record: &str| {
        let output = folder.run(&["check", record, "--map", "m.ron"]);
        (output.status.code(), stderr(&output))
    };
    let whose = " (read by --map m.ron, which stands for every record; a map beside each record, NAME.map.ron, is for it alone)";
    assert_eq!(said("a.csv").0, Some(0));
    for (record, problem) in
        [("b.csv", "b.csv:1: Zeit: the column is missing"), ("c.csv", "c.csv:1: the fields seem to be separated")]
    {
        let (code, said) = said(record);
        assert!(code == Some(2) && said.contains(problem) && said.contains(whose), "{said}");
    }
    // a row that is wrong is so by any map, and so is a map that was not given
    assert!(!said("d.csv").1.contains("--map m.ron"));
    std::fs::copy(folder.path("m.ron"), folder.path("b.map.ron")).unwrap();
    let beside = stderr(&folder.run(&["check", "b.csv"]));
    assert!(beside.contains("the column is missing") && !beside.contains("which stands for every record"), "{beside}");
}
