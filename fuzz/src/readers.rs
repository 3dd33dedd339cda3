//! A reader answers anything, without a panic; what it refuses it refuses in one line that begins with a file's name; what it accepts it reads the
//! same when it is written again.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use bolero::check;
use coil::Design;
use files::input;
use fogcoil::{batch, optimise, sweep};
use laws::Expression;
use tempfile::TempDir;

/// Longest input \[bytes\].
const LONGEST: usize = 4096;

/// Refused, in one line of printable text that begins with the name of a file of `folder`.
fn refused(folder: &Path, error: &dyn Display) {
    assert!(error.to_string().starts_with(&folder.display().to_string()), "{error}");
    in_one_line(error);
}

/// Refused, in one line of printable text, whatever file it is about.
fn in_one_line(error: &dyn Display) {
    let message = error.to_string();
    assert!(!message.is_empty() && !message.chars().any(char::is_control), "{message:?}");
}

fn reference() -> &'static Design {
    static DESIGN: OnceLock<Design> = OnceLock::new();
    DESIGN.get_or_init(|| {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../fixtures/coil-reference.ron");
        input::read_coil(file.as_ref()).expect("the reference design").design
    })
}

/// A folder with one file of the input's bytes.
fn file(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("a file");
    (folder, path)
}

#[test]
fn coils() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("coil.ron");
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| match input::check_coil(&path, &String::from_utf8_lossy(bytes)) {
        Err(error) => refused(folder.path(), &error),
        Ok(case) => {
            let text = files::output::coil_file(&case.name, &case.design, &case.tolerances, &[]);
            let again = input::check_coil(&path, &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(again.design, case.design);
            assert_eq!(again.name, case.name);
        }
    });
}

#[test]
fn cells() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("cell.ron");
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        if let Err(error) = input::check_any_cell(&path, &String::from_utf8_lossy(bytes)) {
            refused(folder.path(), &error);
        }
    });
}

#[test]
fn targets() {
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        let (folder, path) = file("targets.ron", bytes);
        if let Err(error) = input::read_targets(&path) {
            refused(folder.path(), &error);
        }
    });
}

#[test]
fn mechanisms() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("mechanism.ron");
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        match input::check_mechanism(&path, String::from_utf8_lossy(bytes).into_owned()) {
            Err(error) => refused(folder.path(), &error),
            Ok(case) => {
                let given: Option<Vec<f64>> = case.values.iter().copied().collect();
                let Some(values) = given else { return };
                let text = case.with_values(&values).expect("it was read");
                let again = input::check_mechanism(&path, text.clone()).unwrap_or_else(|error| panic!("{error}\n{text}"));
                assert_eq!(again.mechanism, case.mechanism);
            }
        }
    });
}

/// A law's expression, behind it eight bytes a value of each name.
#[test]
fn expressions() {
    const NAMES: [&str; 3] = ["spool", "chamber_rate", "size"];
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        let (text, values) = bytes.split_at(bytes.len().saturating_sub(8 * NAMES.len()));
        match Expression::parse(&String::from_utf8_lossy(text), &NAMES) {
            Err(fault) => assert!(!fault.problem.is_empty() && !fault.problem.chars().any(char::is_control)),
            Ok(expression) => {
                let value = |at: usize| values[8 * at..8 * at + 8].try_into().map(f64::from_le_bytes).expect("eight bytes");
                let values: Vec<f64> =
                    if values.len() == 8 * NAMES.len() { (0..NAMES.len()).map(value).collect() } else { vec![1.0; NAMES.len()] };
                let at = expression.at(&values);
                for k in 0..NAMES.len() {
                    let (same, slope) = expression.slope(&values, k);
                    assert!(same.to_bits() == at.to_bits() || (same.is_nan() && at.is_nan()), "{same} {at}");
                    assert!(expression.has(k) || slope == 0.0 || slope.is_nan(), "{slope}");
                }
            }
        }
    });
}

#[test]
fn profiles() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("profile.csv");
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        match input::check_profile(&path, text, reference(), &[]) {
            Err(error) => refused(folder.path(), &error),
            Ok(case) => assert!(case.chamber().iter().all(|value| value.is_finite())),
        }
    });
}

#[test]
fn thermometers() {
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        let (folder, path) = file("spool.csv", bytes);
        if let Err(error) = input::read_spool(&path, &input::RecordOptions::default(), reference()) {
            refused(folder.path(), &error);
        }
    });
}

/// A recording, behind a byte 0xff its map, behind another one its meta file.
#[test]
fn recordings() {
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        let mut parts = bytes.split(|byte| *byte == 0xff);
        let (folder, path) = file("run.csv", parts.next().unwrap_or_default());
        for (name, part) in ["run.map.ron", "meta.ron"].iter().zip(parts) {
            std::fs::write(folder.path().join(name), part).expect("a file");
        }
        match input::read_record(&path, &input::RecordOptions::default()) {
            Err(error) => refused(folder.path(), &error),
            Ok(case) => {
                let rows = case.recording.time().len();
                assert!(case.report.rows.iter().all(|row| *row < rows));
            }
        }
        // of a logger's own format, whatever it is
        if let Err(error) = input::propose_map(&path, &input::RecordOptions::default()) {
            refused(folder.path(), &error);
        }
    });
}

/// A plan of a sweep or of an optimisation, beside those of the repository; it may name a file of any folder.
#[test]
fn plans() {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../fixtures/plans/plan.ron"));
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes);
        match sweep::check_plan(path, &text) {
            Err(error) => in_one_line(&error),
            Ok(plan) => assert!((1..=sweep::MOST_POINTS).contains(&plan.count())),
        }
        if let Err(error) = optimise::check_plan(path, &text) {
            in_one_line(&error);
        }
    });
}

/// The two files of a batch: its limits, and the table that it writes.
#[test]
fn batches() {
    let folder = TempDir::new().expect("a folder");
    let (limits, table) = (folder.path().join("limits.ron"), folder.path().join("table.csv"));
    check!().with_max_len(LONGEST).for_each(|bytes: &[u8]| {
        if let Err(error) = batch::check_limits(&limits, &String::from_utf8_lossy(bytes)) {
            refused(folder.path(), &error);
        }
        std::fs::write(&table, bytes).expect("a file");
        match input::read_passed(&table) {
            Err(error) => refused(folder.path(), &error),
            Ok(passed) => assert!(!passed.units.is_empty() && passed.units.iter().all(|records| !records.is_empty())),
        }
    });
}
