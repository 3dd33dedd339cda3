//! `cargo xtask bench diagnose`: whole diagnoses of open and of ordinary units, on one thread.

use super::publish::{Progress, publish};
use fogcoil::cache::Cache;
use fogcoil::diagnose;
use fogcoil::input::{self, CoilCase, RecordOptions};
use proof::Failure;
use proof::files::{names, root};
use proof::peers::Stopwatch;
use proof::statistics::middle as median;
use std::fmt::Write as _;
use std::path::Path;

/// Rows of a day at 30 s, to which times are scaled.
const DAY_ROWS: f64 = 2880.0;

/// Units of a kind: what they are, the records of each that are fitted, and the one that is held out.
struct Kind {
    what: &'static str,
    fitted: &'static [&'static str],
    days: &'static str,
}

const OPEN: Kind = Kind { what: "concealed", fitted: &["fit.csv"], days: "a day and a day held out" };
const ORDINARY: Kind = Kind { what: "ordinary", fitted: &["run1.csv", "run2.csv"], days: "two days and a day held out" };
const HELD_OUT: &str = "holdout.csv";

/// A diagnosis that was timed.
struct Row {
    unit: String,
    /// of all its records
    rows: usize,
    verdict: String,
    seconds: f64,
    /// the same for days at 30 s
    scaled: f64,
}

impl Kind {
    /// Diagnoses a unit whose records are in a folder, its page included.
    fn timed(&self, unit: &str, coil: &CoilCase, folder: &Path, cache: &Cache) -> Result<Row, Failure> {
        let mut watch = Stopwatch::start();
        let read = |file: &&str| input::read_record(&folder.join(file), &RecordOptions::default());
        let fitted = self.fitted.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let held = read(&HELD_OUT)?;
        let rows = fitted.iter().chain([&held]).map(|record| record.kept().time().len()).sum();
        let outcome = diagnose::diagnose(coil, ::mechanisms::CATALOGUE, &[], &fitted, &[held], cache, &|_| ())?;
        let (json, page) = (outcome.json(), outcome.report());
        let seconds = watch.lap();
        std::hint::black_box(page);
        let scaled = seconds * DAY_ROWS * (self.fitted.len() + 1) as f64 / rows as f64;
        Ok(Row { unit: unit.to_owned(), rows, verdict: json["verdict"].as_str().unwrap_or_default().to_owned(), seconds, scaled })
    }

    fn table(&self, rows: &[Row]) -> String {
        let mut out = format!(
            "| {} unit | rows of its records | verdict | CPU s | scaled to {} at 30 s |\n|---|---|---|---|---|\n",
            self.what, self.days
        );
        for Row { unit, rows, verdict, seconds, scaled } in rows {
            let _ = writeln!(out, "| {unit} | {rows} | {verdict} | {seconds:.1} | {scaled:.1} |");
        }
        let all: Vec<f64> = rows.iter().map(|row| row.scaled).collect();
        let most = all.iter().fold(0.0_f64, |m, s| m.max(*s));
        let _ = writeln!(
            out,
            "\nMedian {:.1} CPU s, longest {most:.1} CPU s of one thread for {} at 30 s.\n",
            median(all),
            self.days
        );
        out
    }
}

pub(crate) fn run() -> Result<(), Failure> {
    let (progress, cache, fixtures) = (Progress::new(), Cache::of_user(), root().join("fixtures"));
    let once = |kind: &Kind, unit: &str, coil: &CoilCase, folder: &Path, first: bool| {
        if first {
            progress.say("one that is not counted, for the library to be in the cache");
            kind.timed(unit, coil, folder, &cache)?;
        }
        progress.say(unit);
        kind.timed(unit, coil, folder, &cache)
    };
    let coil = input::read_coil(&fixtures.join("coil-reference.ron"))?;
    let folder = fixtures.join("concealed/open");
    let units = names(&folder)?;
    let open = units.iter().enumerate().map(|(n, unit)| once(&OPEN, unit, &coil, &folder.join(unit), n == 0));
    let open = open.collect::<Result<Vec<_>, Failure>>()?;
    let mut ordinary = Vec::new();
    for drawing in names(&fixtures.join("ordinary"))? {
        let folder = fixtures.join("ordinary").join(&drawing).join("open");
        if folder.is_dir() {
            let coil = input::read_coil(&fixtures.join("ordinary").join(&drawing).join("drawing.ron"))?;
            for (n, unit) in names(&folder)?.iter().enumerate() {
                ordinary.push(once(&ORDINARY, unit, &coil, &folder.join(unit), n == 0)?);
            }
        }
    }
    publish("diagnose", &format!("{}{}", OPEN.table(&open), ORDINARY.table(&ordinary)))
}
