//! Where a page comes from: program, inputs with their hashes, options. Nothing of the day, so that the same inputs give the same page.

use super::tables::{facts, row};
use crate::input::Fingerprint;

/// The last section of a page: `what` was run of fogcoil, on which files, with which options and notes.
pub fn provenance(out: &mut String, what: &str, files: &[(&str, &Fingerprint)], options: &[(String, String)]) {
    let mut rows = vec![row("program", format!("fogcoil {}, {what}", env!("CARGO_PKG_VERSION")))];
    for (role, file) in files {
        rows.push(row(role, format!("{}, {} bytes, SHA-256 {}", file.file.display(), file.bytes, file.sha256)));
    }
    rows.extend_from_slice(options);
    out.push_str("<h2>Provenance</h2>\n");
    facts(out, "Program, inputs and options", &rows);
}
