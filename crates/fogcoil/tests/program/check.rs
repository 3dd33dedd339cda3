//! `fogcoil check` on recordings that can be used.

use std::fmt::Write;
use std::path::Path;

use crate::common::{Folder, stderr, stdout};
use fogcoil::check::Analysis;
use fogcoil::input::{CHAMBER, Key, RATE, RecordCase, RecordOptions, SPOOL, read_record};
use serde_json::Value;

/// xorshift64* and Box–Muller.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// White noise of a sample \[deg/h\], the drift beside it \[deg/h\] and its time \[s\].
const WHITE: f64 = 0.011;
const DRIFT: f64 = 0.008;
const DRIFT_TIME: f64 = 2500.0;

/// Instant, chamber, spool, rate: ramps and soaks, a spool that lags 900 s, a bias in proportion to how fast it warms.
fn rows(count: usize) -> Vec<[f64; 4]> {
    let mut random = Random(0x5eed);
    let (mut spool, mut drift) = (20.0, DRIFT * random.normal());
    let kept = (-30.0 / DRIFT_TIME).exp();
    let row = |i: usize| {
        let t = 30.0 * i as f64;
        let chamber = 20.0 + 15.0 * ((t / 9000.0).min(3.0) - ((t - 40_000.0) / 6000.0).clamp(0.0, 4.0));
        let rate = (chamber - spool) / 15.0;
        spool += (chamber - spool) * (1.0 - (-30.0 / 900.0_f64).exp());
        drift = kept * drift + DRIFT * (1.0 - kept * kept).sqrt() * random.normal();
        [t, chamber + 0.01 * random.normal(), spool + 0.01 * random.normal(), -0.05 + rate + drift + WHITE * random.normal()]
    };
    (0..count).map(row).collect()
}

fn standard(rows: &[[f64; 4]]) -> String {
    let mut text = String::from("time_s,chamber_c,spool_c,rate_deg_per_h\n");
    rows.iter().for_each(|[t, a, b, r]| writeln!(text, "{t},{a:.2},{b:.2},{r:.5}").expect("a text takes everything"));
    text
}

fn read(folder: &Folder, name: &str, options: &RecordOptions) -> RecordCase {
    read_record(&folder.path(name), options).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_noise_is_found_under_ramps() {
    let folder = Folder::new();
    folder.write("r.csv", standard(&rows(2600)));
    let case = read(&folder, "r.csv", &RecordOptions::default());
    assert!(case.report.findings.is_empty() && case.notes.is_empty(), "{:?} {:?}", case.report.findings, case.notes);
    assert_eq!((case.averaging, case.kept().time().len()), (30.0, 2600));
    let noise = Analysis::new(&case).noise.unwrap();
    let (model, errors) = (noise.estimate.model, noise.estimate.standard_errors);
    assert_eq!(noise.driver, Some(CHAMBER));
    assert!((model.white / WHITE).ln().abs() < 3.0 * errors.white.unwrap(), "{model:?}");
    // the lags take some of the drift
    assert!(model.allan_deviation(2000.0, 30.0) < 2.0 * 0.617 * DRIFT, "{model:?}");
    let first = noise.allan[0];
    assert!(first.low < WHITE && WHITE < first.high * 1.02, "{first:?}");
    assert!((first.slope + 0.5).abs() < 0.1, "{first:?}");
}

#[test]
fn text_json_and_picture() {
    let folder = Folder::new();
    let mut rows = rows(900);
    rows[300][3] += 1.0;
    rows.drain(500..520);
    folder.write("r.csv", standard(&rows));
    folder.write("meta.ron", "(nominal_arw_deg_per_sqrt_h: Some(0.001), sample_interval_s: 30.0)");
    let output = folder.run(&["check", "r.csv", "--svg", "a.svg"]);
    let text = stdout(&output);
    assert!(output.status.success(), "{}", stderr(&output));
    for part in [
        "r.csv: usable",
        "rows kept",
        "gaps",
        "(20 rows missing)",
        "note: line 302: rate_deg_per_h: outliers of up to",
        ", at 9000 s; not used",
        "note: lines 501 to 502: gap of 630 s, 20 rows missing, from 14970 to 15600 s",
        "angle random walk",
        "the meta file's",
        "from neighbours' differences, 1 sd",
        "bias instability, the Allan floor",
        "tau [s]",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let picture = std::fs::read_to_string(folder.path("a.svg")).unwrap();
    for part in
        ["Allan deviation", "fitted model", "slopes −1/2, 0 and +1/2", "angle random walk 0.00", " °/√h, at 1 h", "line guide"]
    {
        assert!(picture.starts_with("<svg") && picture.contains(part), "{part}");
    }

    assert!(picture.contains("Allan deviation of the rate less its linear response to temperature"), "{picture}");

    // the result without notes, which are neither warnings nor errors
    let output = folder.run(&["check", "r.csv", "--quiet"]);
    assert!(output.status.success() && stderr(&output).is_empty(), "{}", stderr(&output));
    assert!(stdout(&output).contains("r.csv: usable") && !stdout(&output).contains("note: "), "{}", stdout(&output));
    folder.write("kelvin.csv", standard(&rows.iter().map(|[t, a, b, r]| [*t, a + 273.15, *b, *r]).collect::<Vec<_>>()));
    let output = folder.run(&["check", "kelvin.csv", "--quiet"]);
    assert!(stdout(&output).contains("\nwarning: ") && !stdout(&output).contains("note: "), "{}", stdout(&output));

    let output = folder.run(&["check", "r.csv", "--json"]);
    assert_eq!(stdout(&output).lines().count(), 1);
    let json: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(json["usable"], true);
    assert_eq!((&json["rows"], &json["interval_s"]), (&Value::from(880), &Value::from(30.0)));
    assert_eq!(json["gaps"][0]["missing_rows"], 20);
    assert_eq!(json["channels"][2]["used"], 879);
    assert_eq!(json["findings"].as_array().unwrap().len(), 2);
    let mut lines = json["findings"].as_array().unwrap().iter().map(|finding| &finding["lines"]);
    assert!(lines.all(|lines| *lines == serde_json::json!([302, 302]) || *lines == serde_json::json!([501, 502])), "{json}");
    let white = json["noise"]["white_deg_per_h"].as_f64().unwrap();
    let walk = json["noise"]["angle_random_walk_deg_per_sqrt_h"].as_f64().unwrap();
    assert!((walk / (white * (30.0 / 3600.0_f64).sqrt()) - 1.0).abs() < 1e-12, "N = white · √(30 s)");
    assert!(json["noise"]["allan"].as_array().unwrap().len() > 10);
}

/// Rows that are missing in a ramp are a gap and no jump of the chamber; a jump inside a gap is told as one.
#[test]
fn a_ramp_over_a_gap_is_no_jump() {
    let case = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/concealed/open/case_13/fit.csv");
    let whole = std::fs::read_to_string(case).unwrap();
    let folder = Folder::new();
    folder.write("ramp.csv", &whole);
    let text = stdout(&folder.run(&["check", "ramp.csv"]));
    assert!(text.contains("gap") && !text.contains("jumps"), "{text}");
    // the same with a chamber that is 4 K colder from the gap on
    let colder = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        match (fields[0].parse::<f64>(), fields[1].parse::<f64>()) {
            (Ok(time), Ok(chamber)) if time > 35_000.0 => format!("{time},{:.2},{},{}\n", chamber - 4.0, fields[2], fields[3]),
            _ => format!("{line}\n"),
        }
    };
    folder.write("jump.csv", whole.lines().map(colder).collect::<String>());
    let text = stdout(&folder.run(&["check", "jump.csv"]));
    assert!(text.contains(" K at 35280 s, in the gap before it and beyond the slopes on either side: "), "{text}");
}

#[test]
fn several_recordings_have_a_line_each() {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("lot/U2")).unwrap();
    folder.write("lot/a.csv", standard(&rows(600)));
    folder.write("lot/U2/b.csv", standard(&rows(700)));
    let output = folder.run(&["check", "lot"]);
    let text = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let line = |name: &str| text.lines().find(|line| line.starts_with(name)).unwrap_or_else(|| panic!("{name}: {text}"));
    assert!(line("lot/a.csv").contains("usable") && line("lot/U2/b.csv").contains(" 700 "), "{text}");
    assert!(line("recording").contains("± 1 sd") && line("lot/a.csv").contains(" %"), "{text}");
    assert_eq!(text.lines().count(), 3, "{text}");
    // a gap has a word in the line, of several the longest
    let kept = |gaps: &[[usize; 2]]| -> Vec<_> {
        rows(600)
            .into_iter()
            .enumerate()
            .filter(|(n, _)| !gaps.iter().any(|[from, to]| (*from..*to).contains(n)))
            .map(|(_, row)| row)
            .collect()
    };
    std::fs::create_dir_all(folder.path("gaps")).unwrap();
    folder.write("gaps/one.csv", standard(&kept(&[[100, 129]])));
    folder.write("gaps/two.csv", standard(&kept(&[[100, 129], [300, 301]])));
    let text = stdout(&folder.run(&["check", "gaps"]));
    let line = |name: &str| text.lines().find(|line| line.starts_with(name)).unwrap_or_else(|| panic!("{name}: {text}"));
    assert!(line("gaps/one.csv").trim_end().ends_with("gap 15 min"), "{text}");
    assert!(line("gaps/two.csv").trim_end().ends_with("2 gaps up to 15 min"), "{text}");
    // one that cannot be used does not hide the others
    folder.write("lot/c.csv", "time_s,rate_deg_per_h\n0,nan\n");
    let output = folder.run(&["check", "lot", "--json"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("1 of 3 recordings cannot be used"), "{}", stderr(&output));
    let found: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let usable: Vec<&Value> = found["records"].as_array().unwrap().iter().map(|record| &record["usable"]).collect();
    assert_eq!(usable, [true, false, true]);
    // what is left out, a size that nothing explains, and a meta file that says otherwise have a word in the line
    std::fs::create_dir_all(folder.path("lot/U3")).unwrap();
    let mut odd = rows(700);
    odd.iter_mut().for_each(|row| row[3] = 3.6 * row[3] + 40.0);
    odd[300][3] += 30.0;
    folder.write("lot/U3/f.csv", standard(&odd));
    folder.write("lot/U3/meta.ron", "(nominal_arw_deg_per_sqrt_h: Some(1e-5))");
    let text = stdout(&folder.run(&["check", "lot"]));
    let line = text.lines().find(|line| line.starts_with("lot/U3/f.csv")).unwrap();
    assert!(["outliers", "offset", "meta-contradicted"].iter().all(|id| line.contains(id)), "{text}");
    std::fs::remove_dir_all(folder.path("lot/U3")).unwrap();
    // the reason that two of them share stands once, below them
    folder.write("lot/d.csv", "t,rate\n0,1\n");
    folder.write("lot/e.csv", "t,rate\n0,1\n");
    let text = stdout(&folder.run(&["check", "lot"]));
    assert_eq!(text.matches("line 1: time_s: the column is missing").count(), 1, "{text}");
    assert!(text.lines().filter(|line| line.starts_with("lot/") && line.trim_end().ends_with("(1)")).count() == 2, "{text}");
    assert!(text.lines().last().is_some_and(|line| line.starts_with("(1) line 1: ")), "{text}");
    let output = folder.run(&["check", "lot", "--svg", "a.svg"]);
    assert!(output.status.code() == Some(2) && stderr(&output).contains("are of one recording"), "{}", stderr(&output));
}

#[test]
fn a_loggers_file_is_the_same_recording() {
    let folder = Folder::new();
    let rows = rows(400);
    folder.write("s.csv", standard(&rows));
    let plain = read(&folder, "s.csv", &RecordOptions::default());

    let comma = |value: f64, digits: usize| format!("{value:.digits$}").replace('.', ",");
    let mut text = String::from("\u{feff}Zeit;T;Omega;S\r\n");
    for [t, a, _, r] in &rows {
        let counts = r / 3600.0 / 1e-9; // of 1e-9 deg/s
        write!(text, "{};{};{};ok\r\n", comma(t * 1e3, 0), comma((a + 273.15) * 1.8, 6), comma(counts, 3)).unwrap();
    }
    folder.write("l.csv", text);
    // the temperature is in degrees Rankine: counts of 5/9 K
    folder.write(
        "l.map.ron",
        "(separator: \";\", decimal_comma: true, time: (column: \"Zeit\", unit: \"ms\"), \
         chamber: (column: \"T\", unit: \"K\", scale: 0.5555555555555556), rate: (column: \"Omega\", unit: \"deg/s\", scale: 1e-9))",
    );
    let same = |case: &RecordCase| {
        assert_eq!(case.number(SPOOL), None);
        assert_eq!(case.recording.time(), plain.recording.time());
        for (name, tolerance) in [(CHAMBER, 0.006), (RATE, 6e-6)] {
            let of = |case: &RecordCase| case.recording.channel(name).unwrap().values.clone();
            for (a, b) in of(case).iter().zip(of(&plain)) {
                assert!((a - b).abs() < tolerance, "{name}: {a} {b}");
            }
        }
    };
    let case = read(&folder, "l.csv", &RecordOptions::default());
    same(&case);
    let notes = case.notes.iter().map(|note| format!("{note}\n")).collect::<String>();
    for part in [
        "time is read from the column `Zeit`, in ms",
        "no column spool_c",
        "in counts of 0.000000001 deg/s",
        "the column `S` is not used",
    ] {
        assert!(notes.contains(part), "{part}: {notes}");
    }

    // the same by flags, of a file without a map beside it
    std::fs::rename(folder.path("l.csv"), folder.path("m.csv")).unwrap();
    let options = RecordOptions {
        separator: Some(";".into()),
        decimal_comma: true,
        columns: vec![(Key::Time, "Zeit".into()), (Key::Chamber, "T".into()), (Key::Rate, "Omega".into())],
        units: vec![(Key::Time, "ms".into()), (Key::Chamber, "K".into()), (Key::Rate, "deg/s".into())],
        scales: vec![(Key::Chamber, 5.0 / 9.0), (Key::Rate, 1e-9)],
        ..RecordOptions::default()
    };
    same(&read(&folder, "m.csv", &options));
    let mapped = RecordOptions { map: Some(folder.path("l.map.ron")), ..RecordOptions::default() };
    same(&read(&folder, "m.csv", &mapped));
}

#[test]
fn dates_fahrenheit_radians_and_no_instants() {
    let folder = Folder::new();
    folder.write(
        "d.csv",
        "time_s,chamber_c,rate_deg_per_h\n2026-12-31T23:59:30Z,68,1e-6\n2027-01-01T00:00:00Z,NaN,\n2027-01-01T02:00:30+02:00,32,2e-6\n",
    );
    let units = vec![(Key::Chamber, "degF".to_owned()), (Key::Rate, "rad/s".to_owned())];
    let case = read(&folder, "d.csv", &RecordOptions { units, ..RecordOptions::default() });
    assert_eq!(case.recording.time(), [0.0, 30.0, 60.0]);
    let chamber = &case.recording.channel(CHAMBER).unwrap().values;
    assert!((chamber[0] - 20.0).abs() < 1e-12 && chamber[1].is_nan() && chamber[2].abs() < 1e-12, "{chamber:?}");
    let rate = &case.recording.channel(RATE).unwrap().values;
    assert!((rate[2] - 2e-6 * 206_264.806_247_096_36).abs() < 1e-12 && rate[1].is_nan());
    assert!(case.notes.iter().any(|note| note.text.contains("count from the first row")));

    folder.write(
        "g.csv",
        "# logger 7\ntime_s,rate_deg_per_h\n31.12.2026 23:59:30,1\n01.01.2027 00:00,2\n01.01.2027 00:00:30.5,3\n",
    );
    assert_eq!(read(&folder, "g.csv", &RecordOptions::default()).recording.time(), [0.0, 30.0, 60.5]);

    folder.write("n.csv", "rate_deg_per_h\n1\n2\n3\n");
    let case = read(&folder, "n.csv", &RecordOptions { interval: Some(4.0), ..RecordOptions::default() });
    assert_eq!(case.recording.time(), [0.0, 4.0, 8.0]);
}

#[test]
fn mislabelled_units_are_suspected() {
    let folder = Folder::new();
    let mut rows = rows(600);
    rows.iter_mut().for_each(|row| row[3] /= 3600.0);
    let mut text = String::from("time_s,chamber_c,rate_deg_per_h\n");
    rows.iter().for_each(|[t, a, _, r]| writeln!(text, "{t},{:.2},{r:e}", a + 273.15).unwrap());
    folder.write("u.csv", &text);
    let texts = |case: &RecordCase| case.report.findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    let all = texts(&read(&folder, "u.csv", &RecordOptions::default()));
    assert!(all.contains("chamber_c: values of") && all.contains("is it in K or degF?"), "{all}");
    assert!(all.contains("rate_deg_per_h: noise of") && all.contains("deg/s"), "{all}");
    let units = vec![(Key::Chamber, "K".to_owned()), (Key::Rate, "deg/s".to_owned())];
    let declared = texts(&read(&folder, "u.csv", &RecordOptions { units, ..RecordOptions::default() }));
    assert_eq!(declared, "");
}

/// A column read in another unit than its name says is a warning, also for `--quiet`.
#[test]
fn a_unit_in_a_columns_name_is_heard() {
    let folder = Folder::new();
    let mut text = String::from("Zeit [min],T (K),rate_deg_per_h\n");
    rows(600).iter().for_each(|[t, a, _, r]| writeln!(text, "{},{:.2},{r:.5}", t / 60.0, a + 273.15).unwrap());
    folder.write("r.csv", text);
    let columns = ["check", "r.csv", "--quiet", "--column", "time=Zeit [min]", "--column", "chamber=T (K)"];
    let said = stdout(&folder.run(&columns));
    for part in ["`Zeit [min]` is read in s; ", "add --unit time=min [unit-in-name]", "--unit chamber=K"] {
        assert!(said.lines().any(|line| line.starts_with("warning: ") && line.contains(part)), "{part}: {said}");
    }
    assert_eq!(said.lines().filter(|line| line.ends_with("[unit-in-name]")).count(), 2, "{said}");
    let declared = folder.run(&[&columns[..], &["--unit", "time=min", "--unit", "chamber=K"]].concat());
    assert!(!stdout(&declared).contains("warning: "), "{}", stdout(&declared));
}

#[test]
fn the_example_of_the_manual_is_read() {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/recordings/logger.csv"));
    let case = read_record(path, &RecordOptions::default()).unwrap();
    assert!(case.report.usable());
    let kinds: Vec<String> = case.report.findings.iter().map(ToString::to_string).collect();
    assert_eq!(kinds.len(), 3, "a gap, a missing value, an outlier: {kinds:?}");
    assert!((case.report.channels[0].median - 30.0).abs() < 20.0, "°C");
    let noise = Analysis::new(&case).noise.unwrap().estimate;
    assert!((noise.model.white / 0.012).ln().abs() < 3.0 * noise.standard_errors.white.unwrap(), "made with 0.012 deg/h");
}

#[test]
fn instants_are_told_to_the_microsecond() {
    let folder = Folder::new();
    let rows: String = (0..200).map(|n| format!("{},20,20,{}\n", f64::from(n) / 60.0, 0.1 + 0.01 * f64::from(n % 7))).collect();
    let twice = format!("{},20,20,0.5\n", 31.0 / 60.0);
    let at = rows.match_indices('\n').nth(31).unwrap().0 + 1;
    folder.write("r.csv", format!("t,chamber_c,spool_c,rate_deg_per_h\n{}{twice}{}", &rows[..at], &rows[at..]));
    let output = folder.run(&["check", "r.csv", "--column", "time=t", "--unit", "time=h"]);
    let text = stdout(&output) + &stderr(&output);
    assert!(text.contains(" at 1860 s"), "{text}");
    assert!(!text.contains("00000000"), "{text}");
}

/// A term that slower noise hides has no size: a fit at its bound is no measurement.
#[test]
fn white_noise_that_is_hidden_is_not_told() {
    let folder = Folder::new();
    let record = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/ordinary/A/open/U4615/run2.csv");
    let json = |command: &str| -> Value { serde_json::from_str(&stdout(&folder.run(&[command, record, "--json"]))).unwrap() };
    let checked = json("check");
    assert!(checked["noise"]["angle_random_walk_deg_per_sqrt_h"].is_null(), "{checked}");
    let measured = json("measure");
    assert!(measured["arw"].is_null() && measured["without_interval"]["arw"].is_null(), "{measured}");
    assert!(measured["not_known"]["arw"].as_str().unwrap().contains("hidden by slower noise"), "{measured}");
    assert!(stdout(&folder.run(&["check", record])).contains("hidden by slower noise"));
}

/// The spool follows the chamber: where it is the other way round, the columns are exchanged, or the chamber's thermometer is the slower one.
#[test]
fn exchanged_thermometers_are_seen_without_a_model() {
    let folder = Folder::new();
    let record = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/concealed/open/case_13/fit.csv");
    let text = std::fs::read_to_string(record).unwrap();
    let exchanged = text.replacen("chamber_c,spool_c", "spool_c,chamber_c", 1);
    assert_ne!(exchanged, text);
    folder.write("r.csv", exchanged);
    folder.write("as-it-was.csv", text);
    let warned = |name: &str| stdout(&folder.run(&["check", name])).contains("warning: chamber_c follows spool_c");
    assert!(warned("r.csv") && !warned("as-it-was.csv"));
}

/// Of several records, one of which cannot be used, the object is another one, and keeps the same schema.
#[test]
fn several_records_keep_their_schema() {
    let folder = Folder::new();
    let row = |n: usize| format!("{},{},{},{}\n", 30 * n, 20 + n % 7, 20 + n % 5, n * n % 5);
    let rows: String = (0..121).map(row).collect();
    folder.write("a.csv", "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows);
    folder.write("b.csv", "time_s,chamber_c,spool_c,rate_deg_per_h\n0,20,x,0\n");
    for command in ["check", "measure"] {
        let output = folder.run(&[command, "a.csv", "b.csv", "--json"]);
        assert_eq!(output.status.code(), Some(2));
        let found: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
        assert_eq!(fogcoil::schema::misfit(&found, &crate::common::schema(command)), None, "{command}");
        assert!(found["records"][1]["problem"].as_str().unwrap().contains("spool_c"), "{found}");
    }
}
