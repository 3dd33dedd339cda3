//! The last section of a page.

use charts::row;
use maud::Markup;

use crate::input::Fingerprint;

/// The last section of a page: the command `what`, its files with their hashes, and its options; the same inputs give the same section.
pub fn provenance(what: &str, files: &[(&str, &Fingerprint)], options: &[(String, String)]) -> (&'static str, Markup) {
    let program = row("program", format!("fogcoil {}, {what}", env!("CARGO_PKG_VERSION")));
    let of = |(role, file): &(&str, &Fingerprint)| {
        row(role, format!("{}, {} bytes, SHA-256 {}", files::shown_path(&file.file), file.bytes, file.sha256))
    };
    let rows: Vec<_> = std::iter::once(program).chain(files.iter().map(of)).chain(options.iter().cloned()).collect();
    ("Provenance", charts::facts("Program, inputs and options", &rows))
}
