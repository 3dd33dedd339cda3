//! A case file's text: read, told from other kinds, parsed, and asked where a field stands.

use std::io::Read;
use std::path::{Path, PathBuf};

use ron::error::SpannedError;
use serde::de::DeserializeOwned;

use super::InputError;
use super::fields::{FieldMap, join};
use super::fingerprint::Fingerprint;
use super::json;
use super::scanner::{Scanner, Token};
use super::syntax::explain;

/// Largest case file [bytes]: some 300 times the reference files.
const LARGEST: u64 = 1 << 20;

/// The text of a case file, for [`check_coil`](super::check_coil) and the like.
///
/// # Errors
/// The reason why it cannot be read.
pub fn read_text(path: &Path) -> Result<String, InputError> {
    Source::read(path).map(|source| source.text)
}

/// Reads a RON file of a program's own type.
///
/// # Errors
/// The fault, in which file, line and field, and how to mend it.
pub fn read_ron<T: DeserializeOwned>(path: &Path) -> Result<T, InputError> {
    Source::read(path)?.parse(None)
}

/// A complaint about a field of a case file that was read before, with its line if the file is still there.
pub fn fault_in(path: &Path, field: &str, problem: String, remedy: String) -> InputError {
    match Source::read(path) {
        Ok(source) => source.fault(field, problem, remedy),
        Err(_) => InputError { field: Some(field.to_owned()), ..InputError::whole(path, problem, remedy) },
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Source {
    path: PathBuf,
    /// RON.
    text: String,
    /// The file's own text, if that is JSON.
    json: Option<String>,
}

impl Source {
    pub(crate) fn read(path: &Path) -> Result<Self, InputError> {
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
        let text = String::from_utf8(bytes).map_err(|error| {
            let (valid, bytes) = (error.utf8_error().valid_up_to(), error.as_bytes());
            let line = 1 + bytes[..valid].iter().filter(|&&b| b == b'\n').count();
            InputError { line: Some(line), ..fault("is not UTF-8 text".into(), "save the file as UTF-8") }
        })?;
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        if path.extension().is_none_or(|end| !end.eq_ignore_ascii_case("json")) {
            return Ok(Self::of(path, text));
        }
        let translated = json::ron(&text);
        let translated = translated.map_err(|(line, problem)| InputError {
            line: Some(line),
            ..fault(problem, "mend it, or write RON into a file whose name does not end in .json")
        })?;
        Ok(Self { json: Some(text), ..Self::of(path, translated) })
    }

    /// A text that is not in a file yet.
    pub(crate) fn of(path: &Path, text: String) -> Self {
        Self { path: path.to_owned(), text, json: None }
    }

    /// A file named inside this one: relative to it, or absolute.
    pub(crate) fn neighbour(&self, path: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(path)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    pub(crate) fn fingerprint(&self) -> Fingerprint {
        Fingerprint::of(self.path.clone(), self.json.as_ref().unwrap_or(&self.text).as_bytes())
    }

    /// The file's content, of a kind if `fogcoil new` writes such files.
    pub(super) fn parse<T: DeserializeOwned>(&self, kind: Option<&Kind>) -> Result<T, InputError> {
        ron::from_str(&self.text).map_err(|error| match mistaken(&self.text, kind) {
            Some((problem, remedy)) => InputError::whole(&self.path, problem, remedy),
            None => self.syntax_fault(&error),
        })
    }

    fn syntax_fault(&self, error: &SpannedError) -> InputError {
        let offset = self.offset(error.span.start.line, error.span.start.col);
        let map = FieldMap::new(&self.text);
        let mut field = map.path(map.at(offset));
        if let ron::Error::MissingStructField { field: missing, .. } = &error.code {
            field = join(&field, missing);
        }
        let (mut problem, mut remedy) = explain(&error.code, &self.text[offset..]);
        if field.split(['.', '[']).next() == Some("tolerances") && self.text[offset..].starts_with(is_number) {
            (problem, remedy) = ("a number alone is no tolerance".into(), HOW_MUCH.into());
        }
        if map.is_cut_short {
            problem = format!("the file is cut short, or a bracket is never closed (the reader stopped here: {problem})");
            remedy = "close every bracket, or get the whole file".into();
        }
        let line = Some(error.span.start.line);
        InputError { line, field: Some(field).filter(|f| !f.is_empty()), ..InputError::whole(&self.path, problem, remedy) }
    }

    /// Byte offset of a line and column, both from 1.
    fn offset(&self, line: usize, column: usize) -> usize {
        let start: usize = self.text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
        let within = self.text[start..].char_indices().nth(column.saturating_sub(1));
        within.map_or(self.text.len(), |(i, _)| start + i)
    }

    /// An error at `field`, which may lack its units and may reach below what the text has.
    pub(crate) fn fault(&self, field: &str, problem: impl Into<String>, remedy: impl Into<String>) -> InputError {
        let map = FieldMap::new(&self.text);
        let (found, rest) = map.find(field);
        let line = found.map_or(1, |f| 1 + self.text[..map.span(f).start].matches('\n').count());
        let path = map.path(found);
        let field = if rest.is_empty() { path } else { join(&path, rest) };
        InputError { line: Some(line), field: Some(field), ..InputError::whole(&self.path, problem, remedy) }
    }
}

/// How a tolerance is written.
const HOW_MUCH: &str =
    "write one standard deviation, Relative(0.05) for 5 % of the value, or Absolute(0.05) in the unit of the key";

/// Whether a number begins with it.
fn is_number(c: char) -> bool {
    c.is_ascii_digit() || "+-.".contains(c)
}

/// A kind of case file that `fogcoil new` writes.
pub(super) struct Kind {
    name: &'static str,
    /// A field that each has at its top, and no other kind.
    mark: &'static str,
    /// Command that writes one.
    command: &'static str,
}

pub(super) static COIL: Kind = Kind { name: "a coil file", mark: "winding", command: "fogcoil new FILE" };
pub(super) static CELL: Kind = Kind { name: "a cell file", mark: "adhesive", command: "fogcoil new --kind cell FILE" };
pub(super) static TARGETS: Kind = Kind { name: "a file of targets", mark: "targets", command: "fogcoil new --kind targets FILE" };
pub(super) static MECHANISM: Kind =
    Kind { name: "a mechanism's file", mark: "laws", command: "fogcoil new --kind mechanism FILE" };

/// Whether a file can be read and looks like a coil's.
pub fn is_coil(path: &Path) -> bool {
    Source::read(path).is_ok_and(|source| matches!(FieldMap::new(&source.text).find(COIL.mark), (Some(_), "")))
}

/// Problem and remedy if `text` is not of the kind that is wanted but of another, a table, or nothing.
fn mistaken(text: &str, wanted: Option<&Kind>) -> Option<(String, String)> {
    let mut tokens = Scanner::new(text).map(|(_, token)| token);
    let start = [tokens.next(), tokens.next()];
    let opens = start.iter().any(|token| matches!(token, Some(Token::Open(_))));
    let problem = if start[0].is_none() {
        "is empty".to_owned()
    } else if !opens && text.trim_start().lines().next().is_some_and(|line| line.contains([',', ';', '\t'])) {
        "looks like a table, not a RON file".to_owned()
    } else {
        let (map, wanted) = (FieldMap::new(text), wanted?);
        let is = |kind: &Kind| matches!(map.find(kind.mark), (Some(_), ""));
        let found = [&COIL, &CELL, &TARGETS, &MECHANISM].into_iter().find(|kind| is(kind)).filter(|_| !is(wanted))?;
        format!("is {}, but {} is read here", found.name, wanted.name)
    };
    let remedy = wanted.map_or("write fields in parentheses, (name: value, ...)".to_owned(), |kind| {
        format!("`{}` writes one to start from", kind.command)
    });
    Some((problem, remedy))
}
