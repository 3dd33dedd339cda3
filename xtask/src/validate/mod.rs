//! `cargo xtask validate`: the whole chain once, against the paper's Tables I to IV and an independent code.

mod page;

pub(crate) use page::on_spools;

use proof::validation::{ComparisonRow, Verdict, compared, report};
use proof::{Failure, files};
use std::path::Path;
use std::time::Instant;

/// Runs everything, writes the documents, and a page to `html` if it is given, and says whether every row that must hold does.
pub(crate) fn run(json: Option<&Path>, html: Option<&Path>) -> Result<bool, Failure> {
    let start = Instant::now();
    let step = |what: &str| eprintln!("[{:5.1} s] {what}", start.elapsed().as_secs_f64());
    let sections = compared(step)?;
    let rows = || sections.iter().flat_map(|s| &s.rows);
    let failed: Vec<&ComparisonRow> = rows().filter(|row| row.verdict == Verdict::Fails).collect();
    println!("{}", report::text(&sections));
    report::write_documents(&sections)?;
    if let Some(path) = json {
        files::write(path, &format!("{:#}\n", report::json(&sections, failed.is_empty())))?;
    }
    if let Some(path) = html {
        files::write(path, &page::html(&sections)?)?;
    }
    step("docs/validation.md and the README's table are written");
    for row in &failed {
        eprintln!("FAILS: {} {}: {} {}; {}", row.id, row.quantity, row.computed_text(), row.unit, row.reason);
    }
    let must = rows().filter(|row| row.must_hold).count();
    println!("{} of {must} rows that must hold do", must - failed.len());
    Ok(failed.is_empty())
}

/// The comparison as an HTML page; no document is written.
pub(crate) fn html() -> Result<String, Failure> {
    page::html(&compared(|_| ())?)
}
