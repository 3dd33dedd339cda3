//! `check --write-map` on files as loggers write them: what it proposes is what is then read.

use std::process::Output;

use crate::common::{Folder, stderr, stdout};
use fogcoil::input::{CHAMBER, RATE, RecordOptions, SPOOL, read_record};

/// Instant, chamber, spool, rate in s, degC, degC, deg/h.
pub(crate) fn rows() -> Vec<[f64; 4]> {
    let noise = |n: usize, k: usize| ((n * 7919 + k * 104_729) % 1009) as f64 / 504.5 - 1.0;
    let row = |n: usize| {
        let chamber = 20.0 + 0.1 * n as f64;
        [30.0 * n as f64, chamber + 0.01 * noise(n, 1), chamber - 2.0 + 0.01 * noise(n, 2), 0.2 + 0.02 * noise(n, 3)]
    };
    (0..200).map(row).collect()
}

pub(crate) fn lines(row: impl Fn(usize, [f64; 4]) -> String) -> String {
    rows().into_iter().enumerate().map(|(n, values)| row(n, values) + "\r\n").collect()
}

fn date(n: usize) -> String {
    format!("2026-03-02 {:02}:{:02}:{:02}", 8 + n / 120, n / 2 % 60, n % 2 * 30)
}

fn utf16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(bytes).collect()
}

fn latin(text: &str) -> Vec<u8> {
    text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect()
}

/// Writes the map beside `r.csv`, expects its content, and that the file is read as the recording of [`rows`].
pub(crate) fn proposes(content: Vec<u8>, map: &str) {
    let folder = Folder::new();
    folder.write("r.csv", content);
    let output = folder.run(&["check", "r.csv", "--write-map"]);
    assert_eq!(output.status.code(), Some(0), "{}{}", stderr(&output), stdout(&output));
    assert!(
        stderr(&output).contains("note: r.map.ron is written") && stdout(&output).starts_with("r.csv: usable"),
        "{}",
        stderr(&output)
    );
    let written = std::fs::read_to_string(folder.path("r.map.ron")).unwrap();
    let (heading, rest) = written.split_once('\n').unwrap();
    assert!(heading.starts_with("// How `r.csv` is read, proposed by"), "{written}");
    assert_eq!(rest, map);
    let case = read_record(&folder.path("r.csv"), &RecordOptions::default()).unwrap();
    assert_eq!(folder.names(), ["r.csv", "r.map.ron"]);
    for (k, name) in [(1, CHAMBER), (2, SPOOL), (3, RATE)] {
        let values = &case.recording.channel(name).unwrap().values;
        for (row, (t, value)) in rows().iter().zip(case.recording.time().iter().zip(values)) {
            assert!((row[0] - t).abs() < 1e-9 && (row[k] - value).abs() < 1e-3, "{name} at {t}: {value} {}", row[k]);
        }
    }
}

#[test]
fn a_german_logger_in_windows_1252() {
    let comma = |value: f64| format!("{value:.6}").replace('.', ",");
    let text = "Zeit [s];T_Kammer (°C);T_Spule (°C);Drehrate [°/s];Status\r\n".to_owned()
        + &lines(|_, [t, c, s, r]| {
            format!("{};{};{};{};ok", comma(t), comma(c), comma(s), format!("{:.9}", r / 3600.0).replace('.', ","))
        });
    proposes(
        latin(&text),
        r#"(
    encoding: "windows-1252",
    separator: ";",
    decimal_comma: true,
    time: (column: "Zeit [s]"),
    chamber: (column: "T_Kammer (°C)"),
    spool: (column: "T_Spule (°C)"),
    rate: (column: "Drehrate [°/s]", unit: "deg/s"),
)
"#,
    );
}

#[test]
fn a_bench_logger_in_utf_16_below_a_preamble() {
    let preamble = "Name:,Climate test\r\nOwner:,Lab\r\nComments:,\r\nAcquisition Date:,2026-03-02\r\n\r\n";
    let header = "Scan,Time,101 <Chamber set> (C),102 <Temp Chamber> (C),Alarm 102,103 <Temp Spool> (C),Gyro rate (deg/hr)\r\n";
    let text =
        preamble.to_owned() + header + &lines(|n, [_, c, s, r]| format!("{n},{},{:.1},{c:.5},0,{s:.5},{r:.6}", date(n), 20.0));
    for bytes in [u16::to_le_bytes, u16::to_be_bytes] {
        let name = if bytes(1) == [1, 0] { "utf-16le" } else { "utf-16be" };
        let map = r#"(
    encoding: "NAME",
    preamble_lines: 5,
    time: (column: "Time"),
    chamber: (column: "102 <Temp Chamber> (C)"),
    spool: (column: "103 <Temp Spool> (C)"),
    rate: (column: "Gyro rate (deg/hr)"),
)
"#;
        proposes(utf16(&text, bytes), &map.replace("NAME", name));
    }
}

#[test]
fn tabs_milliseconds_fahrenheit_and_radians_below_a_mark() {
    let text = "\u{feff}# run 7\r\ntime_ms\tTemp Chamber (°F)\tHub (°F)\tomega [rad/s]\r\n".to_owned()
        + &lines(|_, [t, c, s, r]| {
            format!("{}\t{:.5}\t{:.5}\t{:e}", 1e3 * t, 1.8 * c + 32.0, 1.8 * s + 32.0, r / 206_264.806_247)
        });
    proposes(
        text.into_bytes(),
        r#"(
    preamble_lines: 1,
    separator: "tab",
    time: (column: "time_ms", unit: "ms"),
    chamber: (column: "Temp Chamber (°F)", unit: "degF"),
    spool: (column: "Hub (°F)", unit: "degF"),
    rate: (column: "omega [rad/s]", unit: "rad/s"),
)
"#,
    );
}

/// A doubt stands beside its column.
#[test]
fn doubts_are_written_down() {
    let text = "t,oven,ambient,coil,gyro\n".to_owned() + &lines(|_, [t, c, s, r]| format!("{t},{c:.5},25,{s:.5},{r:.6}"));
    proposes(
        text.into_bytes(),
        r#"(
    time: (column: "t"), // its name says no unit: taken as s
    chamber: (column: "oven"), // its name says no unit: taken as degC // or `ambient`
    spool: (column: "coil"), // its name says no unit: taken as degC
    rate: (column: "gyro"), // its name says no unit: taken as deg/h
)
"#,
    );
    let standard =
        "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &lines(|_, [t, c, s, r]| format!("{t},{c:.5},{s:.5},{r:.6}"));
    proposes(standard.into_bytes(), "(\n)\n");
}

#[test]
fn nothing_is_overwritten_and_nothing_written_in_vain() {
    let folder = Folder::new();
    let refused = |arguments: &[&str], parts: &[&str]| {
        let before = folder.names();
        let output: Output = folder.run(arguments);
        let message = stderr(&output);
        assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), ""), "{message}");
        parts.iter().for_each(|part| assert!(message.contains(part), "`{part}` in {message}"));
        assert_eq!(folder.names(), before);
    };
    let text = "Zeit;Kammer;Wert\n".to_owned() + &lines(|n, [t, c, _, r]| format!("{t};{c:.3};{}", r + n as f64 * 1e-4));
    folder.write("r.csv", &text);
    folder.write("empty.csv", "");
    refused(&["check", "empty.csv", "--write-map"], &["empty.csv: shows no table", "a line of names above rows"]);
    folder.write("image.csv", [0x89, b'P', b'N', b'G', 0, 0, 1, 255].repeat(500));
    refused(&["check", "image.csv", "--write-map"], &["image.csv: shows no table"]);
    folder.write("wide.csv", utf16(&text, u16::to_le_bytes));
    refused(
        &["check", "wide.csv"],
        &["wide.csv:1: is not UTF-8 text; save the file as", "or let `fogcoil check RECORD --write-map` find"],
    );
    refused(&["check", "r.csv", "--write-map", "--map", "x.ron"], &["--write-map", "--map"]);
    refused(&["check", "r.csv", "--column", "rate=Wert", "--write-map", "r.csv"], &["r.csv: exists and is left as it is"]);

    // what the user says is in the map
    let output = folder.run(&[
        "check",
        "r.csv",
        "--write-map",
        "m.ron",
        "--column",
        "rate=Wert",
        "--unit",
        "rate=deg/s",
        "--scale",
        "rate=1e-3",
    ]);
    let map = std::fs::read_to_string(folder.path("m.ron")).unwrap();
    assert!(map.contains("    rate: (column: \"Wert\", unit: \"deg/s\", scale: 0.001),\n"), "{map}{}", stderr(&output));
    refused(
        &["check", "r.csv", "--column", "rate=Wert", "--write-map", "m.ron"],
        &["m.ron: exists and is left as it is; give another name"],
    );
    assert_eq!(std::fs::read_to_string(folder.path("m.ron")).unwrap(), map);
    assert_eq!(folder.run(&["check", "r.csv", "--map", "m.ron", "--scale", "rate=1"]).status.code(), Some(0));
}

/// `t/min` is how ISO 80000 writes it; a unit is read at the same places wherever one is read.
#[test]
fn the_time_is_known_by_its_letter_and_its_unit() {
    let below = lines(|n, [t, c, s, r]| format!("{};{c:.5};{s:.5};{}", t / 60.0, r + n as f64 * 1e-4));
    let folder = Folder::new();
    for name in ["t/min", "t_min", "t [min]", "T (min)", "Minutes", "minuten", "Prog minute", "Zeit/min"] {
        folder.write("r.csv", format!("{name};Cabinet;spool;gyro\r\n{below}"));
        let map = format!("{}.map.ron", name.replace(['/', ' '], "-"));
        let arguments = ["check", "r.csv", "--write-map", &map];
        let output = folder.run(&arguments);
        let written = std::fs::read_to_string(folder.path(&map)).unwrap_or_else(|_| panic!("{name}: {}", stderr(&output)));
        assert!(written.contains(&format!("    time: (column: \"{name}\", unit: \"min\"),\n")), "{written}");
        assert!(written.contains("// chamber: (column: \"Cabinet\")") && !written.contains("chamber: (column: \"T"), "{written}");
        assert!(!written.contains(&format!("chamber: (column: \"{name}\"")), "{written}");
        // a column that the user names is not offered again, and its unit is heard alike
        std::fs::remove_file(folder.path(&map)).unwrap();
        folder.run(&[&arguments[..], &["--column", &format!("time={name}"), "--column", "chamber=Cabinet"]].concat());
        let declared = std::fs::read_to_string(folder.path(&map)).unwrap();
        assert!(declared.contains(&format!("    time: (column: \"{name}\", unit: \"min\"),\n")), "{declared}");
        assert!(declared.contains("    chamber: (column: \"Cabinet\"),") && !declared.contains("// chamber"), "{declared}");
    }
    // without a map the unit in a name is warned of
    folder.write("r.csv", format!("t/min;chamber_c;spool_c;rate_deg_per_h\r\n{below}"));
    let output = folder.run(&["check", "r.csv", "--separator", ";", "--column", "time=t/min"]);
    assert!(stdout(&output).contains("`t/min` is read in s; if its name is right, add --unit time=min [unit-in-name]"));
    // a temperature in degrees, and a least temperature, are no instants
    for name in ["t/\u{b0}C", "T_min"] {
        folder.write(
            "r.csv",
            format!("Zeit;{name};spool;gyro\r\n{}", lines(|n, [t, _, s, r]| format!("{t};{};{s:.5};{r}", n % 3))),
        );
        folder.run(&["check", "r.csv", "--write-map", "zeit.ron"]);
        let written = std::fs::read_to_string(folder.path("zeit.ron")).unwrap();
        assert!(
            written.contains("time: (column: \"Zeit\"), // its name says no unit") && !written.contains(" or `"),
            "{written}"
        );
        std::fs::remove_file(folder.path("zeit.ron")).unwrap();
    }
}

/// The day of the year is read; a column of instants in another form is listed all the same.
#[test]
fn days_of_the_year_are_read_and_unread_instants_are_listed() {
    let of = |day: &dyn Fn(String) -> String| {
        let folder = Folder::new();
        let row = |n: usize, [_, c, s, r]: [f64; 4]| format!("{},{c:.4},{s:.5},{r:.6}", day(date(n)));
        folder.write("r.csv", format!("Stamp,chamber [degC],spool [degC],rate [deg/h]\r\n{}", lines(row)));
        let output = folder.run(&["check", "r.csv", "--write-map"]);
        (output.status.code(), stderr(&output), std::fs::read_to_string(folder.path("r.map.ron")).unwrap())
    };
    let (code, message, map) = of(&|date| date.replace("03-02", "061"));
    assert!(code == Some(0) && map.contains("    time: (column: \"Stamp\"),"), "{message}{map}");
    let (code, message, map) = of(&|date| date.replace("-03-02 ", "W101/"));
    assert_eq!(code, Some(2), "{message}");
    assert!(map.contains("// time: (column: \"Stamp\"),") && map.contains("in a form that is not read: write them as "), "{map}");
}

/// Where no name says which column is the time, or the rate, the map lists what may be it.
#[test]
fn columns_that_are_not_known_are_left_to_choose() {
    let folder = Folder::new();
    let below = lines(|n, [t, c, s, r]| format!("{};{:.4};{s:.5};{}", t / 60.0, c - (n % 2) as f64, r + n as f64 * 1e-4));
    folder.write("r.csv", format!("Prog;Cabinet;spool;Wert\r\n{below}"));
    let output = folder.run(&["check", "r.csv", "--write-map"]);
    let message = stderr(&output);
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), ""), "{message}");
    for part in [
        "error: r.csv: no column's name says that it is the time, nor one that it is the rate",
        "; r.map.ron lists what may be it",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
    let written = std::fs::read_to_string(folder.path("r.map.ron")).unwrap();
    let (prog, wert) = ("// time: (column: \"Prog\", unit: \"?\"),", "// rate: (column: \"Wert\", unit: \"?\"),");
    assert!(
        written.contains(prog) && written.contains(wert) && written.contains("// chamber: (column: \"Cabinet\"),"),
        "{written}"
    );
    assert!(!written.contains("time: (column: \"Cabinet") && !written.contains("chamber: (column: \"Prog"), "{written}");
    // chosen without a unit is not chosen
    let chosen = written.replace(prog, &prog[3..]).replace(wert, &wert[3..]);
    folder.write("r.map.ron", &chosen);
    assert!(stderr(&folder.run(&["check", "r.csv"])).contains("time.unit: `?` is no unit of time; choose s, ms"));
    folder.write(
        "r.map.ron",
        chosen.replace("Prog\", unit: \"?\"", "Prog\", unit: \"min\"").replace("Wert\", unit: \"?\"", "Wert\""),
    );
    assert_eq!(folder.run(&["check", "r.csv"]).status.code(), Some(0));
    // an interval stands for the time
    let output = folder.run(&["check", "r.csv", "--write-map", "i.ron", "--interval", "30", "--column", "rate=Wert"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

#[test]
fn a_rate_is_known_by_its_unit_and_numbers_without_one_may_be_temperatures() {
    let row = |_: usize, [t, chamber, spool, rate]: [f64; 4]| format!("{t},{:.9},{chamber:.4},{spool:.4}", rate / 3600.0);
    let folder = Folder::new();
    folder.write("r.csv", "t [s],Achse Z [deg/s],TH1,TCH\r\n".to_owned() + &lines(row));
    let output = folder.run(&["check", "r.csv", "--write-map"]);
    let written = std::fs::read_to_string(folder.path("r.map.ron")).unwrap_or_else(|_| panic!("{}", stderr(&output)));
    for part in [
        "    rate: (column: \"Achse Z [deg/s]\", unit: \"deg/s\"),\n",
        "    // columns that may be temperatures; take the // from the lines that are right:\n",
        "    // chamber: (column: \"TCH\"),\n",
        "    // spool: (column: \"TH1\"),\n",
    ] {
        assert!(written.contains(part), "{part}{written}");
    }
    // a word says more than a unit: a table's rate is not the gyroscope's
    let row = |_: usize, [t, chamber, spool, rate]: [f64; 4]| format!("{t},{rate:.6},{rate:.6},{chamber:.4},{spool:.4}");
    folder.write("s.csv", "t [s],table [deg/h],gyro [deg/h],chamber [degC],spool [degC]\r\n".to_owned() + &lines(row));
    folder.run(&["check", "s.csv", "--write-map"]);
    let written = std::fs::read_to_string(folder.path("s.map.ron")).unwrap();
    assert!(written.contains("rate: (column: \"gyro [deg/h]\"") && written.contains("or `table [deg/h]`"), "{written}");
}

/// A spreadsheet's dates are numbers of days; a gyroscope that is told in counts has no unit until it is given.
#[test]
fn days_of_a_spreadsheet_are_days_and_counts_have_no_unit() {
    let folder = Folder::new();
    let row = |_: usize, [t, c, s, r]: [f64; 4]| format!("{:.8},{c:.4},{s:.5},{r:.6}", 46_332.312_5 + t / 86_400.0);
    folder.write("r.csv", format!("Stamp,chamber [degC],spool [degC],rate [deg/h]\r\n{}", lines(row)));
    let output = folder.run(&["check", "r.csv", "--write-map"]);
    let written = std::fs::read_to_string(folder.path("r.map.ron")).unwrap_or_else(|_| panic!("{}", stderr(&output)));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(written.contains("time: (column: \"Stamp\", unit: \"d\"), // numbers of days, as a spreadsheet writes"), "{written}");
    // an instant of a test that runs for long is none: it has no decimals of a day
    let row = |_: usize, [t, c, s, r]: [f64; 4]| format!("{:.2},{c:.4},{s:.5},{r:.6}", 46_332.31 + t / 1e4);
    folder.write("s.csv", format!("Stamp,chamber [degC],spool [degC],rate [deg/h]\r\n{}", lines(row)));
    folder.run(&["check", "s.csv", "--write-map"]);
    let written = std::fs::read_to_string(folder.path("s.map.ron")).unwrap();
    assert!(written.contains("time: (column: \"Stamp\"), // its name says no unit"), "{written}");

    let row = |_: usize, [t, c, s, r]: [f64; 4]| format!("{t},{c:.4},{s:.5},{:.0}", r / 0.02);
    folder.write("c.csv", format!("time [s],chamber [degC],spool [degC],gyro_counts\r\n{}", lines(row)));
    let output = folder.run(&["check", "c.csv", "--write-map"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("c.csv: no column's name says that it is the rate"), "{}", stderr(&output));
    let written = std::fs::read_to_string(folder.path("c.map.ron")).unwrap();
    assert!(written.contains("// rate: (column: \"gyro_counts\", unit: \"?\"),"), "{written}");
    let output = folder.run(&["check", "c.csv", "--write-map", "d.ron", "--scale", "rate=0.02"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    // what is called raw and has a unit is no count
    let row = |_: usize, [t, c, s, r]: [f64; 4]| format!("{t},{c:.4},{s:.5},{r:.6}");
    folder.write("u.csv", format!("time [s],chamber [degC],spool [degC],gyro_raw [deg/h]\r\n{}", lines(row)));
    let output = folder.run(&["check", "u.csv", "--write-map"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}
