//! Recordings with values that no gyroscope at rest gives.

use crate::common::{Folder, stderr, stdout};
use fogcoil::input::{CHAMBER, RATE, RecordCase, RecordOptions, read_record};

const HEADER: &str = "time_s,chamber_c,spool_c,rate_deg_per_h\n";

/// Noise in [-1, 1] of a row and a channel.
fn noise(row: usize, channel: u64) -> f64 {
    let mut state = (row as u64 * 4 + channel).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((state ^ (state >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Chamber, spool, rate of a row of a sound record from 20 to 50 degC.
fn sound(row: usize) -> [f64; 3] {
    let chamber = 35.0 - 15.0 * (row as f64 / 95.0).cos();
    [chamber + 0.01 * noise(row, 0), chamber - 2.0 + 0.01 * noise(row, 1), 0.2 + 0.02 * noise(row, 2)]
}

/// A record of 300 rows, each changed.
fn record(change: impl Fn(usize, [f64; 3]) -> [String; 3]) -> String {
    (0..300).fold(HEADER.to_owned(), |text, n| text + &format!("{},{}\n", 30 * n, change(n, sound(n)).join(",")))
}

fn written(values: [f64; 3]) -> [String; 3] {
    values.map(|value| format!("{value:.5}"))
}

/// The fields of a record in which one column is replaced where `at` says so.
fn replaced(column: usize, with: &str, at: impl Fn(usize) -> bool) -> String {
    record(|n, values| {
        let mut fields = written(values);
        if at(n) {
            fields[column] = with.to_owned();
        }
        fields
    })
}

fn read(text: &str) -> RecordCase {
    let folder = Folder::new();
    folder.write("r.csv", text);
    read_record(&folder.path("r.csv"), &RecordOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn findings(case: &RecordCase) -> String {
    case.report.findings.iter().map(|finding| format!("{finding}\n")).collect()
}

/// Runs `check` and expects exit status 2 with every part in the one message.
fn refused(text: &str, parts: &[&str]) {
    let folder = Folder::new();
    folder.write("r.csv", text);
    let output = folder.run(&["check", "r.csv"]);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{message}{}", stdout(&output));
    assert_eq!(message.lines().count(), 1, "{message}");
    parts.iter().for_each(|part| assert!(message.contains(part), "`{part}` in {message}"));
}

#[test]
fn a_sound_record_is_not_suspected() {
    let case = read(&record(|_, values| written(values)));
    assert_eq!(findings(&case), "");
}

/// Codes of meters and of lost sensors, one row or many together, at the end too.
#[test]
fn codes_are_not_used() {
    let sound = read(&record(|_, values| written(values)));
    for rows in [100..101, 100..140, 296..300, 0..1] {
        for (column, codes) in [
            (0, &["9.9E37", "9999", "-999.9", "-273.16", "850", "OVLD", "-OVERLOAD"][..]),
            (2, &["9.9E37", "-9.9E37", "+OVLD", "9999"][..]),
        ] {
            for code in codes {
                let case = read(&replaced(column, code, |n| rows.contains(&n)));
                let (name, number) = if column == 0 { (CHAMBER, 0) } else { (RATE, 2) };
                let (used, before) = (&case.report.channels[number], &sound.report.channels[number]);
                assert!(case.report.usable(), "{code} {rows:?}: {}", findings(&case));
                assert!(used.largest <= before.largest && used.least >= before.least, "{code} {rows:?} in {name}: {used:?}");
                assert_eq!(used.used, 300 - rows.len(), "{code} {rows:?} in {name}: {}", findings(&case));
                assert!(findings(&case).contains("not used"), "{code}: {}", findings(&case));
            }
        }
    }
}

#[test]
fn temperatures_beyond_physics_are_refused_where_they_are_most() {
    for (column, name) in [(0, "chamber_c"), (1, "spool_c")] {
        refused(
            &replaced(column, "2.1e301", |_| true),
            &[&format!("r.csv:2: {name}: 2.1e301 degC is impossible"), "300 of 300", "--unit"],
        );
    }
    refused(
        &replaced(0, "2931", |n| n > 20),
        &["r.csv:23: chamber_c: 2931 degC is impossible (-273.15 to 400 degC)", "--scale chamber"],
    );
    refused(&replaced(2, "1e300", |_| true), &["r.csv:2: rate_deg_per_h: 1e300 deg/h is impossible"]);
}

#[test]
fn a_unit_that_was_moved_is_refused() {
    let moved = record(|n, [chamber, spool, rate]| {
        let rate = if (150..162).contains(&n) { 3000.0 * (1.0 + noise(n, 3)) } else { rate };
        written([chamber, spool, rate])
    });
    refused(
        &moved,
        &["cannot be used: rate_deg_per_h: values of up to", "impossible at rest", "from 4500 to 4830 s", "cut out the rows"],
    );
    let spinning = record(|_, [chamber, spool, rate]| written([chamber, spool, 5000.0 + rate]));
    refused(&spinning, &["cannot be used: rate_deg_per_h: values of 5000 deg/h are implausible"]);
    // a lone spike is an outlier as before
    let spike = read(&replaced(2, "5000", |n| n == 77));
    assert!(spike.report.usable() && findings(&spike).contains("outliers of up to"), "{}", findings(&spike));
}

#[test]
fn another_unit_is_recognised_by_its_scale() {
    let scaled = |factor: f64| record(|_, [c, s, r]| [format!("{c:.2}"), format!("{s:.2}"), format!("{:e}", r * factor)]);
    for (factor, unit) in [(1.0 / 3600.0, "deg/s"), (1.0 / 206_264.8, "rad/s")] {
        refused(
            &scaled(factor),
            &["cannot be used: rate_deg_per_h: noise of", unit, "--unit rate=deg/s (or ", "or unit in the map file"],
        );
    }
    let fahrenheit = |t: f64| 1.8 * t + 32.0;
    let text = record(|_, [c, s, r]| written([fahrenheit(c), fahrenheit(s), r]));
    let case = read(&text);
    for channel in ["chamber_c", "spool_c"] {
        let hint = format!("{channel}: starts at ");
        assert!(
            findings(&case).lines().any(|line| line.starts_with(&hint) && line.contains("is it in degF?; if so, say it: --unit"))
        );
    }
    assert!(case.report.usable());
}

/// The one error is said once, and the map that is proposed has the unit.
#[test]
fn a_unit_that_was_not_said_is_proposed() {
    let text = record(|_, [c, s, r]| [format!("{c:.2}"), format!("{s:.2}"), format!("{:e}", r / 3600.0)]);
    let folder = Folder::new();
    folder.write("r.csv", text);
    for arguments in [&["check", "r.csv"][..], &["check", "r.csv", "--quiet"]] {
        let output = folder.run(arguments);
        let said = stdout(&output) + &stderr(&output);
        assert_eq!((output.status.code(), said.matches("rate_deg_per_h: noise of").count()), (Some(2), 1), "{said}");
        assert!(
            said.contains(
                "; if so, say it: --unit rate=deg/s (or rad/s, mrad/s), or unit in the map file; or --scale rate=FACTOR where"
            ),
            "{said}"
        );
    }
    let output = folder.run(&["check", "r.csv", "--write-map"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let warning = "warning: no unit of the rate is told, and its values may be in deg/s or rad/s or mrad/s: the map takes deg/s; in rad/s alone its median, 11.4";
    let hint = " deg/h, may be Earth's rate, if that was not taken off; see which it is, and write it into the map [unit]";
    assert!(stdout(&output).contains(warning) && stdout(&output).contains(hint), "{}", stdout(&output));
    let map = std::fs::read_to_string(folder.path("r.map.ron")).unwrap();
    let says = "    rate: (unit: \"deg/s\"), // the values are not of the size of deg/h: taken as deg/s, or rad/s, or mrad/s\n";
    assert!(map.contains(says), "{map}");
    assert_eq!(folder.run(&["check", "r.csv"]).status.code(), Some(0));
    // a rate that is no Earth's in any of them has no hint
    let folder = Folder::new();
    folder.write("r.csv", record(|_, [c, s, r]| [format!("{c:.2}"), format!("{s:.2}"), format!("{:e}", (r + 500.0) / 3600.0)]));
    let said = stdout(&folder.run(&["check", "r.csv", "--write-map"]));
    assert!(!said.contains("may be Earth's rate, if"), "{said}");
    // so is a temperature's
    let kelvin = |row: [f64; 3]| written([row[0] + 273.15, row[1], row[2]]);
    let folder = Folder::new();
    folder.write("r.csv", record(|_, row| kelvin(row)));
    let output = folder.run(&["check", "r.csv", "--write-map"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let map = std::fs::read_to_string(folder.path("r.map.ron")).unwrap();
    assert!(map.contains("    chamber: (unit: \"K\"), // the values are not of the size of degC: taken as K"), "{map}");
    assert_eq!(folder.run(&["check", "r.csv"]).status.code(), Some(0));
}

#[test]
fn a_unit_that_the_user_says_stays() {
    let folder = Folder::new();
    folder.write("r.csv", record(|_, [c, s, r]| [format!("{c:.2}"), format!("{s:.2}"), format!("{:e}", r / 3600.0)]));
    let output = folder.run(&["check", "r.csv", "--write-map", "--unit", "rate=deg/h"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
}

#[test]
fn an_offset_beyond_the_earths_rate_is_noted() {
    for (offset, says) in [
        (8.0, "is more than 0.5 deg/h: perhaps Earth's rate not removed"),
        (40.0, "is more than 0.5 deg/h, which this does not explain: Earth's rate not removed"),
    ] {
        let case = read(&record(|_, [c, s, r]| written([c, s, r + offset])));
        let note = case.report.findings.iter().find(|finding| finding.to_string().contains(says));
        assert_eq!(note.map(|note| note.severity), Some(recording::check::Severity::Note), "{}", findings(&case));
    }
}

/// Who tells where the axis points need not be told of Earth's rate, but of what is beyond it.
#[test]
fn an_offset_of_the_earths_rate_that_is_told_is_not_noted() {
    let folder = Folder::new();
    folder.write("meta.ron", "(rate_deg_per_h: (latitude_deg: Some(48.1), elevation_deg: Some(90.0)))");
    let opposite = ": perhaps Earth's rate, 11.20 deg/h by the meta file, with the other sign";
    let [below, half, beyond] =
        ["-0.6", "-5.0", "-24.2"].map(|by| format!("differs from Earth's rate, 11.20 deg/h by the meta file, by {by}"));
    for (offset, says) in [(11.2, ""), (0.0, ""), (-11.2, opposite), (10.35, &below), (5.95, &half), (-13.25, &beyond)] {
        let path = folder.write("r.csv", record(|_, [c, s, r]| written([c, s, r + offset])));
        let case = read_record(&path, &RecordOptions::default()).expect("a record");
        let told = findings(&case);
        assert_eq!(told.contains("the median"), !says.is_empty(), "{offset}: {told}");
        assert!(told.contains(says), "{offset}: {told}");
    }
}

/// Minutes, milliseconds and days under `time_s` are asked for by name.
#[test]
fn instants_in_another_unit_are_suspected() {
    let table = |time: &dyn Fn(usize) -> String| {
        (0..1000).fold(HEADER.to_owned(), |text, n| text + &format!("{},{}\n", time(n), written(sound(n)).join(",")))
    };
    let seconds = |n: usize| 60.0 * n as f64;
    for (unit, kind, text) in [
        ("min", "[too-fast]", table(&|n| format!("{}", seconds(n) / 300.0))),
        ("ms", "[span]", table(&|n| format!("{}", 1e3 * seconds(n)))),
        ("d", "[span]", table(&|n| format!("{:.9}", 45_000.0 + seconds(n) / 86_400.0))),
    ] {
        let folder = Folder::new();
        folder.write("r.csv", text);
        let said = stdout(&folder.run(&["check", "r.csv"]));
        let line = said.lines().find(|line| line.starts_with("warning: ") && line.ends_with(kind));
        assert!(line.is_some_and(|line| line.contains(&format!("--unit time={unit}"))), "{unit}: {said}");
        let said = stdout(&folder.run(&["check", "r.csv", "--unit", &format!("time={unit}")]));
        assert!(said.contains("usable") && !said.contains(kind), "{unit}: {said}");
    }
}
