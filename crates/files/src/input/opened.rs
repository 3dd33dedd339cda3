//! Case files read from the disk, RON or JSON by the ending of their names.

use std::io::Read;
use std::path::Path;

use serde::de::DeserializeOwned;

use super::InputError;
use super::fingerprint::Fingerprint;
use super::json;
use super::source::{COIL, Source};

/// Largest case file [bytes]: some 300 times the reference files.
const LARGEST: u64 = 1 << 20;

/// The text of a case file, for [`check_coil`](super::check_coil) and the like; that of a JSON file is its RON.
///
/// # Errors
/// The reason why it cannot be read.
pub fn read_text(path: &Path) -> Result<String, InputError> {
    open(path).map(Source::into_text)
}

/// Reads a RON file of a program's own type, with its fingerprint.
///
/// # Errors
/// The fault, in which file, line and field, and how to mend it.
pub fn read_ron<T: DeserializeOwned>(path: &Path) -> Result<(T, Fingerprint), InputError> {
    parsed(&open(path)?)
}

/// A RON text of a program's own type, with its fingerprint; messages call it `path`.
///
/// # Errors
/// The fault, in which line and field, and how to mend it.
pub fn check_ron<T: DeserializeOwned>(path: &Path, text: &str) -> Result<(T, Fingerprint), InputError> {
    parsed(&Source::of(path, text.to_owned()))
}

fn parsed<T: DeserializeOwned>(source: &Source) -> Result<(T, Fingerprint), InputError> {
    Ok((source.parse(None)?, source.fingerprint()))
}

/// A complaint about a field of a case file that was read before, with its line if the file is still there.
pub fn fault_in(path: &Path, field: &str, problem: String, remedy: String) -> InputError {
    match open(path) {
        Ok(source) => source.fault(field, problem, remedy),
        Err(_) => InputError { field: Some(field.to_owned()), ..InputError::whole(path, problem, remedy) },
    }
}

/// Whether a file can be read and looks like a coil's.
pub fn is_coil(path: &Path) -> bool {
    open(path).is_ok_and(|source| source.is(&COIL))
}

/// Ends of names of files that loggers write.
const TABLES: [&str; 6] = ["csv", "tsv", "txt", "dat", "xlsx", "parquet"];

pub(super) fn open(path: &Path) -> Result<Source, InputError> {
    let fault = |problem: String, remedy: &str| InputError::whole(path, problem, remedy);
    let unreadable = |error: std::io::Error| fault(format!("cannot be read: {error}"), "check the path and its permissions");
    let kind = std::fs::metadata(path).map_err(unreadable)?;
    if kind.is_dir() {
        return Err(fault("is a directory".into(), "give the path of a case file (*.ron)"));
    }
    let mut bytes = Vec::new();
    std::fs::File::open(path).map_err(unreadable)?.take(LARGEST + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST {
        return Err(fault(format!("is larger than {LARGEST} bytes"), "give a case file (*.ron), not a recording"));
    }
    let is_table = || path.extension().is_some_and(|end| TABLES.iter().any(|table| end.eq_ignore_ascii_case(table)));
    let text = String::from_utf8(bytes).map_err(|error| {
        if is_table() {
            let remedy = "the coil's file comes first: fogcoil COMMAND COIL.ron, and recordings behind it";
            return fault("looks like a table, not a RON file".into(), remedy);
        }
        let (valid, bytes) = (error.utf8_error().valid_up_to(), error.as_bytes());
        let line = 1 + bytes[..valid].iter().filter(|&&b| b == b'\n').count();
        InputError { line: Some(line), ..fault("is not UTF-8 text".into(), "save the file as UTF-8") }
    })?;
    let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
    if path.extension().is_none_or(|end| !end.eq_ignore_ascii_case("json")) {
        return Ok(Source::of(path, text));
    }
    let translated = json::ron(&text);
    let translated = translated.map_err(|(line, problem)| InputError {
        line: Some(line),
        ..fault(problem, "mend it, or write RON into a file whose name does not end in .json")
    })?;
    Ok(Source::of_json(path, text, translated))
}
