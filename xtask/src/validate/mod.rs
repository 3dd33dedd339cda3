//! `cargo xtask validate`: the whole chain once, against the paper's Tables I to IV and an independent code.

mod cell;
mod coil;
mod fixtures;
mod nominal;
mod page;
mod report;
mod row;
mod spread;
mod winding;

pub(crate) use fixtures::root;
pub(crate) use page::{on_spools, printed};
pub(crate) use report::write;

use fixtures::Fixtures;
use row::{Row, Verdict};
use std::path::Path;
use std::time::Instant;

/// Why the run could not be finished.
#[derive(Debug)]
pub(crate) struct Failure(pub(crate) String);

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

/// The rows of one table.
pub(crate) struct Section {
    title: String,
    notes: Vec<String>,
    timings: Vec<String>,
    rows: Vec<Row>,
    lines: Vec<(String, f64)>,
}

impl Section {
    fn new(title: &str) -> Self {
        Self { title: title.into(), notes: Vec::new(), timings: Vec::new(), rows: Vec::new(), lines: Vec::new() }
    }

    fn note(&mut self, text: impl Into<String>) {
        self.notes.push(text.into());
    }

    fn timing(&mut self, text: String) {
        self.timings.push(text);
    }
}

/// A result with the seconds it took.
fn timed<T, E: Into<Failure>>(work: impl FnOnce() -> Result<T, E>) -> Result<(T, f64), Failure> {
    let start = Instant::now();
    let result = work().map_err(Into::into)?;
    Ok((result, start.elapsed().as_secs_f64()))
}

/// Runs everything, writes the documents, and a page to `html` if it is given, and says whether every row that must hold does.
pub(crate) fn run(json: Option<&Path>, html: Option<&Path>) -> Result<bool, Failure> {
    let start = Instant::now();
    let step = |what: &str| eprintln!("[{:5.1} s] {what}", start.elapsed().as_secs_f64());
    let sections = compared(step)?;
    let failed: Vec<&Row> = sections.iter().flat_map(|s| &s.rows).filter(|row| row.verdict == Verdict::Fails).collect();
    println!("{}", report::text(&sections));
    report::write_documents(&sections)?;
    if let Some(path) = json {
        write(path, &format!("{:#}\n", report::json(&sections, failed.is_empty())))?;
    }
    if let Some(path) = html {
        write(path, &page::html(&sections)?)?;
    }
    step("docs/validation.md and the README's table are written");
    for row in &failed {
        eprintln!("FAILS: {} {}: {} {}; {}", row.id, row.quantity, row.computed_text(), row.unit, row.reason);
    }
    let must = sections.iter().flat_map(|s| &s.rows).filter(|row| row.must_hold).count();
    println!("{} of {must} rows that must hold do", must - failed.len());
    Ok(failed.is_empty())
}

/// The comparison as an HTML page; no document is written.
pub(crate) fn html() -> Result<String, Failure> {
    page::html(&compared(|_| ())?)
}

/// |S| over spools: (material, hub, flanges; S).
pub(crate) fn over_spools() -> Result<Vec<(String, f64)>, Failure> {
    Ok(spread::over_spools(&Fixtures::read()?)?.lines)
}

fn compared(step: impl Fn(&str)) -> Result<[Section; 5], Failure> {
    let fixtures = Fixtures::read()?;
    step("Table I: reference cell");
    let (table_1, cell) = cell::table_1(&fixtures)?;
    step("Table II: dehomogenisation");
    let table_2 = cell::table_2(&fixtures, &cell)?;
    step("Table III: winding");
    let table_3 = winding::table_3(&fixtures)?;
    step("Table IV: sensitivity, spools, tails, error estimates (some 10 s)");
    let table_4 = coil::table_4(&fixtures, &cell.constants)?;
    step("five profiles in time against an independent code (some 10 s)");
    let nominal = nominal::nominal(&fixtures)?;
    Ok([table_1, table_2, table_3, table_4, nominal])
}
