//! The comparison as text, as docs/validation.md, as the README's headline table, as JSON.

use super::Section;
use super::row::{Agreement, ComparisonRow, Verdict};
use crate::{Failure, files};
use std::fmt::Write as _;

/// The word for a kind of agreement.
pub fn kind(kind: Agreement) -> &'static str {
    match kind {
        Agreement::Predicted => "predicted",
        Agreement::Verified => "verified",
        Agreement::Identified => "identified",
        Agreement::Calibrated => "calibrated",
        Agreement::Misprint => "misprint",
    }
}

/// The word for a row's verdict.
pub fn verdict(row: &ComparisonRow) -> &'static str {
    match row.verdict {
        Verdict::Holds => "holds",
        Verdict::Shown => "shown",
        Verdict::Differs => "differs",
        Verdict::Fails => "FAILS",
    }
}

/// The terminal's table.
pub fn text(sections: &[Section]) -> String {
    let mut out = String::new();
    for section in sections {
        let _ = writeln!(out, "\n{}", section.title);
        for row in &section.rows {
            let (verdict, kind, printed) = (verdict(row), kind(row.kind), row.printed.as_deref().unwrap_or(""));
            let (quantity, computed, unit) = (&row.quantity, row.computed_text(), &row.unit);
            let _ = writeln!(out, "  {verdict:<8} {kind:<10} {quantity:<58} {printed:>8}  {computed:<28} {unit}");
            if matches!(row.verdict, Verdict::Differs | Verdict::Fails) {
                let _ = writeln!(out, "  {:<8} {}", "", row.reason);
            }
        }
        for line in &section.timings {
            let _ = writeln!(out, "  [{line}]");
        }
    }
    out
}

fn markdown_table(out: &mut String, section: &Section) {
    let _ = writeln!(out, "| id | quantity | printed | computed | unit | verdict | kind | reason |");
    let _ = writeln!(out, "|---|---|---|---|---|---|---|---|");
    for row in &section.rows {
        let [id, quantity, reason] = [&row.id, &row.quantity, &row.reason].map(|text| text.replace('|', "\\|"));
        let (printed, computed, unit) = (row.printed.as_deref().unwrap_or(""), row.computed_text(), &row.unit);
        let (verdict, must, kind) = (verdict(row), if row.must_hold { " (must)" } else { "" }, kind(row.kind));
        let _ = writeln!(out, "| {id} | {quantity} | {printed} | {computed} | {unit} | {verdict}{must} | {kind} | {reason} |");
    }
}

/// docs/validation.md.
fn markdown(sections: &[Section]) -> String {
    let mut out = String::from(include_str!("preamble.md"));
    for section in sections {
        let _ = writeln!(out, "\n## {}\n", section.title);
        for note in &section.notes {
            let _ = writeln!(out, "{note}\n");
        }
        markdown_table(&mut out, section);
        if !section.lines.is_empty() {
            let _ = writeln!(out, "\n| spool | S, (deg/h)/(degC/min) |\n|---|---|");
            for (name, s) in &section.lines {
                let _ = writeln!(out, "| {name} | {s:.3} |");
            }
        }
    }
    out.push_str("\n## Sabotage\n\n");
    out.push_str(
        "`cargo xtask sabotage` breaks the cell's crates on purpose, one line at a time, and lists the tests that turn red.\n\n",
    );
    out.push_str(include_str!("sabotage.md"));
    out.push('\n');
    out.push_str(include_str!("commands.md"));
    out
}

/// Rows of the README's headline table.
#[rustfmt::skip]
const HEADLINE: [&str; 10] = [
    "I.E_z", "I.E_r", "I.alpha_r", "II.M_rx", "II.M_rz.free", "III.length", "III.height", "IV.theory", "IV.own", "IV.quadrupole",
];

fn headline(sections: &[Section]) -> String {
    let mut out = String::from("| | paper | fogcoil | unit | kind of agreement |\n|---|---|---|---|---|\n");
    for row in sections.iter().flat_map(|s| &s.rows).filter(|row| HEADLINE.contains(&row.id.as_str())) {
        let (table, printed) = (row.id.split('.').next().unwrap_or(""), row.printed.as_deref().unwrap_or("–"));
        let (quantity, computed) = (row.quantity.replace('|', "\\|"), row.computed_text());
        let _ = writeln!(out, "| Table {table}: {quantity} | {printed} | {computed} | {} | {} |", row.unit, kind(row.kind));
    }
    out
}

/// Marks of the README's headline table.
const MARKS: [&str; 2] = ["<!-- headline: written by `cargo xtask validate` -->", "<!-- headline end -->"];

/// Writes docs/validation.md and the README's headline table. [`Failure`] names the file that cannot be written.
pub fn write_documents(sections: &[Section]) -> Result<(), Failure> {
    files::write(&files::root().join("docs/validation.md"), &markdown(sections))?;
    files::renew(&files::root().join("README.md"), MARKS, &format!("\n{}", headline(sections)))
}

/// The rows as JSON (docs/schema/validate.schema.json).
pub fn json(sections: &[Section], holds: bool) -> serde_json::Value {
    let rows: Vec<&ComparisonRow> = sections.iter().flat_map(|s| &s.rows).collect();
    serde_json::json!({ "version": env!("CARGO_PKG_VERSION"), "holds": holds, "rows": rows })
}
