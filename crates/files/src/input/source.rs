//! A case file's text: told from other kinds, parsed, and asked where a field stands.

use std::path::{Path, PathBuf};

use ron::error::SpannedError;
use serde::de::DeserializeOwned;

use super::InputError;
use super::fields::{FieldMap, join};
use super::fingerprint::Fingerprint;
use super::scanner::{Scanner, Token};
use super::syntax::{explain, in_json};

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Source {
    path: PathBuf,
    /// RON.
    text: String,
    /// The file's own text, if that is JSON.
    json: Option<String>,
}

impl Source {
    /// A text that is not in a file yet.
    pub(crate) fn of(path: &Path, text: String) -> Self {
        Self { path: path.to_owned(), text, json: None }
    }

    /// The content of a file in JSON, with its RON.
    pub(super) fn of_json(path: &Path, json: String, ron: String) -> Self {
        Self { json: Some(json), ..Self::of(path, ron) }
    }

    /// RON.
    pub(super) fn into_text(self) -> String {
        self.text
    }

    /// Whether the file looks like one of a kind.
    pub(super) fn is(&self, kind: &Kind) -> bool {
        matches!(FieldMap::new(&self.text).find(kind.mark), (Some(_), ""))
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
        read(&self.text).map_err(|error| match mistaken(&self.text, kind) {
            Some((problem, remedy)) => InputError::whole(&self.path, problem, remedy),
            None => self.syntax_fault(&self.in_quotes::<T>(&error).unwrap_or(error)),
        })
    }

    /// The error of a key or choice in JSON that cannot be a name in RON, and stands there in quotes: what it would be, were it a name.
    fn in_quotes<T: DeserializeOwned>(&self, error: &SpannedError) -> Option<SpannedError> {
        let stopped = self.offset(error.span.start.line, error.span.start.col);
        let rest = self.text[stopped..].trim_start();
        let before = &self.text[..self.text.len() - rest.len()];
        if self.json.is_none() || !rest.starts_with('"') {
            return None;
        }
        let mut tokens = Scanner::new(rest);
        tokens.next()?;
        let (quoted, behind) = rest.split_at_checked(tokens.position())?;
        let mut named = read::<T>(&format!("{before}{UNNAMED}{behind}")).err()?;
        match &mut named.code {
            ron::Error::NoSuchStructField { found, .. } | ron::Error::NoSuchEnumVariant { found, .. } if found == UNNAMED => {
                *found = ron::from_str(quoted).ok()?;
                Some(named)
            }
            _ => None,
        }
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
        if self.json.is_some() {
            remedy = in_json(remedy);
        }
        let is_digit = |c: char| c.is_ascii_digit();
        let behind = self.text[offset..].trim_start_matches(is_digit);
        if behind.len() < self.text.len() - offset && behind.strip_prefix(',').is_some_and(|rest| rest.starts_with(is_digit)) {
            remedy = "write decimals with a point, and a blank behind a comma between fields".into();
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
        let problem = problem.into();
        let begins = found.map_or(0, |f| self.named_in(map.span(f), &problem));
        let line = 1 + self.text[..begins].matches('\n').count();
        let path = map.path(found);
        let field = if rest.is_empty() { path } else { join(&path, rest) };
        InputError { line: Some(line), field: Some(field), ..InputError::whole(&self.path, problem, remedy) }
    }
}

impl Source {
    /// Beginning of what a problem names first in quotes, where that stands in a field, as the key of a map does; else of the field.
    fn named_in(&self, field: std::ops::Range<usize>, problem: &str) -> usize {
        let named = problem.split('"').nth(1).filter(|name| !name.is_empty());
        let within = named.and_then(|name| self.text[field.clone()].find(&format!("\"{name}\"")));
        field.start + within.unwrap_or(0)
    }
}

/// Stands for what cannot be a name; none of a file's names.
const UNNAMED: &str = "_";

fn read<T: DeserializeOwned>(text: &str) -> Result<T, SpannedError> {
    // an optional value may stand as it is
    ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME).from_str(text)
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
