//! `cargo xtask bench diagnose`: whole diagnoses of the open cases, on one thread.

use super::publish::{Progress, publish};
use fogcoil::cache::Cache;
use fogcoil::diagnose;
use fogcoil::input::{self, RecordOptions};
use proof::Failure;
use proof::files::{names, root};
use proof::peers::Stopwatch;
use proof::statistics::middle as median;
use std::fmt::Write as _;

/// Rows of a day at 30 s, to which times are scaled.
const DAY_ROWS: f64 = 2880.0;

pub(crate) fn run() -> Result<(), Failure> {
    let progress = Progress::new();
    let root = root();
    let coil = input::read_coil(&root.join("fixtures/coil-reference.ron"))?;
    let cache = Cache::of_user();
    let folder = root.join("fixtures/concealed/open");
    let mut rows = Vec::new();
    for (n, name) in names(&folder)?.into_iter().enumerate() {
        let record = |file: &str| input::read_record(&folder.join(&name).join(file), &RecordOptions::default());
        let once = || -> Result<(usize, String, f64), Failure> {
            let mut watch = Stopwatch::start();
            let (fit, holdout) = (record("fit.csv")?, record("holdout.csv")?);
            let count = fit.kept().time().len();
            let outcome = diagnose::diagnose(&coil, ::mechanisms::CATALOGUE, &[fit], &[holdout], &cache, &|_| ())?;
            let (json, page) = (outcome.json(), outcome.report());
            let seconds = watch.lap();
            std::hint::black_box(page);
            Ok((count, json["verdict"].as_str().unwrap_or_default().to_owned(), seconds))
        };
        if n == 0 {
            progress.say("one that is not counted, for the library to be in the cache");
            once()?;
        }
        progress.say(&name);
        let measured = once()?;
        rows.push((name, measured));
    }
    let mut out =
        String::from("| case | rows of the fitted record | verdict | CPU s | scaled to 2880 rows |\n|---|---|---|---|---|\n");
    let scaled = |(_, (count, _, seconds)): &(String, (usize, String, f64))| seconds * DAY_ROWS / *count as f64;
    for row in &rows {
        let (name, (count, verdict, seconds)) = row;
        let _ = writeln!(out, "| {name} | {count} | {verdict} | {seconds:.1} | {:.1} |", scaled(row));
    }
    let all: Vec<f64> = rows.iter().map(scaled).collect();
    let most = all.iter().fold(0.0_f64, |m, s| m.max(*s));
    let _ = writeln!(out, "\nMedian {:.1} CPU s, longest {most:.1} CPU s of one thread for a day at 30 s.", median(all));
    publish("diagnose", &out)
}
