//! A CSV table row by row: every complaint knows its line, and no file is held whole.
//!
//! Fields may stand in double quotes, with separators and doubled quotes inside (RFC 4180) but no line ends. Lines above the first row that
//! begin with # are a logger's remarks and skipped.

use std::fs::File;
use std::io::{self, Chain, Cursor, Read};
use std::path::{Path, PathBuf};

use csv::{ErrorKind, StringRecord, Terminator};

use super::InputError;
use super::encoding::{Decoded, Encoding};
use super::fingerprint::{Fingerprint, Hash};

/// Largest table [bytes]: 2 GiB.
pub(crate) const LARGEST: u64 = 2 << 30;
/// Longest line \[bytes\]; a file with a longer one is no table of numbers.
const LONGEST_LINE: usize = 1 << 16;
/// Longest part of the file that a message quotes \[characters\].
const QUOTED: usize = 40;

/// Form of a table's rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Dialect {
    pub(crate) separator: u8,
    pub(crate) decimal: char,
    pub(crate) encoding: Encoding,
    /// Lines above the names that are not read.
    pub(crate) preamble: u64,
    /// Lines below the names that are not read.
    pub(crate) below: u32,
}

impl Dialect {
    /// Commas between the fields, a point in numbers.
    pub(crate) const STANDARD: Self = Self { separator: b',', decimal: '.', encoding: Encoding::Utf8, preamble: 0, below: 0 };
}

/// Message on text in another encoding.
pub(super) const NOT_UTF8: &str = "is not UTF-8 text";
/// Words of a field without a value, in lower case.
const MISSING: [&str; 9] = ["", "nan", "na", "n/a", "null", "none", "-", "--", "#n/a"];
/// Words of a meter beyond its range, in lower case, perhaps behind a sign.
const OVERLOAD: [&str; 8] = ["ovld", "overload", "ol", "ovl", "over", "overrange", "over range", "overflow"];

pub(crate) struct Rows {
    path: PathBuf,
    dialect: Dialect,
    reader: csv::Reader<Chain<Decoded<Metered>, &'static [u8]>>,
    record: StringRecord,
    /// Whether a row was met.
    begun: bool,
    /// Whether a field stood in quotes.
    quotes: bool,
}

/// A file, or a text in memory, that is hashed and measured while it is read.
struct Metered {
    source: Box<dyn Read>,
    hash: Hash,
    line: usize,
}

impl Read for Metered {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        let piece = &buffer[..count];
        self.hash.update(piece);
        for line in piece.split_inclusive(|&byte| byte == b'\n') {
            self.line += line.len();
            if self.line > LONGEST_LINE {
                return Err(io::Error::other(format!(
                    "it has a line of more than {LONGEST_LINE} bytes, so it is no table of numbers"
                )));
            }
            if line.ends_with(b"\n") {
                self.line = 0;
            }
        }
        if self.hash.bytes > LARGEST {
            return Err(io::Error::other(format!("it is larger than {LARGEST} bytes; split it")));
        }
        Ok(count)
    }
}

impl Rows {
    /// Opens a table; `kind` says what is expected, e.g. "a profile (*.csv)".
    pub(crate) fn open(path: &Path, kind: &str, dialect: Dialect) -> Result<Self, InputError> {
        let fault = |problem: String, remedy: &str| InputError::whole(path, problem, remedy);
        let remedy = match path.to_str() {
            Some(several) if several.contains(',') && !path.exists() => "give the option once for each file, or check the path",
            _ => "check the path and its permissions",
        };
        let unreadable = |error: io::Error| fault(format!("cannot be read: {error}"), remedy);
        let file = File::open(path).map_err(unreadable)?;
        let about = file.metadata().map_err(unreadable)?;
        if about.is_dir() {
            return Err(fault("is a directory".into(), &format!("give the path of {kind}")));
        }
        if about.len() > LARGEST {
            return Err(fault(format!("is larger than {LARGEST} bytes"), "split it"));
        }
        Ok(Self::new(path, Box::new(file), dialect))
    }

    /// A table in memory in the standard dialect, called `path` in messages.
    pub(crate) fn of(path: &Path, text: String) -> Self {
        Self::new(path, Box::new(Cursor::new(text)), Dialect::STANDARD)
    }

    fn new(path: &Path, source: Box<dyn Read>, dialect: Dialect) -> Self {
        let metered = Metered { source, hash: Hash::new(), line: 0 };
        // a line feed ends the last line too, so the line of a record is always the one before the reader's
        let reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .quoting(false)
            .delimiter(dialect.separator)
            .terminator(Terminator::Any(b'\n'))
            .from_reader(Decoded::new(metered, dialect.encoding).chain(&b"\n"[..]));
        Self { path: path.to_owned(), dialect, reader, record: StringRecord::new(), begun: false, quotes: false }
    }

    /// Moves to the next row that is not blank; `false` at the end.
    pub(crate) fn advance(&mut self) -> Result<bool, InputError> {
        loop {
            let read = self.reader.read_record(&mut self.record);
            if self.record.iter().any(is_quoted) {
                self.quotes = true;
                let fields: Vec<&str> = self.record.iter().collect();
                self.record = StringRecord::from(unquoted(&fields, char::from(self.dialect.separator)));
            }
            match read {
                Ok(false) => return Ok(false),
                Ok(true) if self.count() == 1 && self.field(0).is_empty() => {}
                Ok(true) if !self.begun && self.line() <= self.dialect.preamble => {}
                Ok(true) if !self.begun && self.field(0).starts_with('#') => {}
                Ok(true) => {
                    self.begun = true;
                    return Ok(true);
                }
                Err(error) => return Err(self.unreadable(&error)),
            }
        }
    }

    /// Moves to the first row, which names the columns, such as `columns`.
    pub(crate) fn header(&mut self, columns: &str) -> Result<(), InputError> {
        let remedy = format!("its first line names the columns, {columns}; a row for each instant follows");
        if !self.advance()? {
            return Err(self.whole_fault("is empty", remedy));
        }
        let first = self.field(0);
        if first.starts_with("//") || first.starts_with("/*") || first == "(" || (first.starts_with('(') && first.contains(':')) {
            return Err(self.whole_fault("begins like a RON file, but a table (CSV) is read here", remedy));
        }
        Ok(())
    }

    fn unreadable(&self, error: &csv::Error) -> InputError {
        match error.kind() {
            ErrorKind::Utf8 { .. } => self.fault(None, NOT_UTF8, "save the file as \"CSV UTF-8\""),
            ErrorKind::Io(error) => InputError::whole(&self.path, format!("cannot be read: {error}"), ""),
            _ => self.fault(None, error.to_string(), ""),
        }
    }

    /// Refuses a comma between the fields and in the numbers, unless there are quotes that tell one from the other.
    pub(crate) fn check_commas(&self) -> Result<(), InputError> {
        if self.dialect.separator != b',' || self.dialect.decimal != ',' || self.quotes {
            return Ok(());
        }
        let problem = "a comma cannot separate the fields and the decimals, unless numbers stand in quotes";
        Err(self.whole_fault(problem, "add --separator ';' (separator in the map file), or leave out --decimal-comma"))
    }

    pub(crate) fn count(&self) -> usize {
        self.record.len()
    }

    /// A field of this row without blanks and quotes around it; empty if there is none.
    pub(crate) fn field(&self, column: usize) -> &str {
        self.record.get(column).unwrap_or("").trim()
    }

    pub(crate) fn fields(&self) -> impl Iterator<Item = &str> {
        (0..self.count()).map(|column| self.field(column))
    }

    /// Refuses a row of another number of fields than the header; `remedy` is told the row, its fields joined, and how many they are.
    pub(crate) fn check_count(
        &self,
        expected: usize,
        between: &str,
        remedy: impl Fn(&str, usize) -> &'static str,
    ) -> Result<(), InputError> {
        let found = self.count();
        if found == expected {
            return Ok(());
        }
        let line = self.fields().collect::<Vec<_>>().join(between);
        let plural = if found == 1 { "" } else { "s" };
        let problem = format!("{} has {found} field{plural} where the header has {expected}", quoted(&line));
        Err(self.fault(None, problem, remedy(&line, found)))
    }

    /// A field as a finite number.
    pub(crate) fn number(&self, column: usize, name: &str) -> Result<f64, InputError> {
        let text = self.field(column);
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => {
                let problem = format!("{} is not a finite number", quoted(text));
                Err(self.fault(Some(name), problem, "remove the row: between rows the course is linear"))
            }
            Err(_) if text.is_empty() => {
                Err(self.fault(Some(name), "is empty", "give a number, or remove the row: between rows the course is linear"))
            }
            Err(_) => {
                let remedy = "write it like 20.5, decimals with a point, without a unit";
                Err(self.fault(Some(name), format!("{} is not a number", quoted(text)), remedy))
            }
        }
    }

    /// A field as a finite number in the table's dialect; `None` if it says that there is none.
    pub(crate) fn value(&self, column: usize, name: &str) -> Result<Option<f64>, InputError> {
        let text = self.field(column);
        let decimal = self.dialect.decimal;
        if decimal != '.' && text.contains('.') && text.replace([decimal, '.'], "").parse::<f64>().is_ok() {
            let problem = format!("{} has a point, but decimals have a comma here", quoted(text));
            let remedy = "take out points between thousands, or leave out --decimal-comma (decimal_comma in the map file)";
            return Err(self.fault(Some(name), problem, remedy));
        }
        let value = text.replace(decimal, ".").parse::<f64>();
        match value {
            Ok(value) if value.is_finite() => Ok(Some(value)),
            _ if is_missing(text) => Ok(None),
            Ok(_) => Err(self.fault(Some(name), format!("{} is not a finite number", quoted(text)), "leave the field empty")),
            Err(_) if self.dialect.decimal == '.' && text.replacen(',', ".", 1).parse::<f64>().is_ok() => {
                Err(self.fault(Some(name), format!("{} has a decimal comma", quoted(text)), "add --decimal-comma"))
            }
            Err(_) => {
                let remedy = "write it like 20.5 without a unit, or leave the field empty if the value is missing";
                Err(self.fault(Some(name), format!("{} is not a number", quoted(text)), remedy))
            }
        }
    }

    /// The line of this row, from 1.
    fn line(&self) -> u64 {
        self.reader.position().line().saturating_sub(1)
    }

    /// A complaint about this row.
    pub(crate) fn fault(&self, column: Option<&str>, problem: impl Into<String>, remedy: impl Into<String>) -> InputError {
        let line = usize::try_from(self.line()).unwrap_or(usize::MAX);
        InputError { line: Some(line.max(1)), field: column.map(str::to_owned), ..InputError::whole(&self.path, problem, remedy) }
    }

    pub(crate) fn whole_fault(&self, problem: &str, remedy: impl Into<String>) -> InputError {
        InputError { line: None, ..self.fault(None, problem, remedy) }
    }

    /// The content read so far.
    pub(crate) fn fingerprint(&self) -> Fingerprint {
        let metered = &self.reader.get_ref().get_ref().0.source;
        metered.hash.fingerprint(self.path.clone())
    }
}

fn is_quoted(field: &str) -> bool {
    field.trim_start().starts_with('"')
}

/// The fields of a line that was split at every separator: a text in quotes is one field, without them. A quote that is not closed stays.
pub(super) fn unquoted(pieces: &[&str], separator: char) -> Vec<String> {
    let mut fields = Vec::new();
    let mut rest = pieces;
    while let Some(first) = rest.first() {
        let quoted = is_quoted(first).then(|| quoted_field(rest, separator)).flatten();
        let (field, count) = quoted.unwrap_or_else(|| ((*first).to_owned(), 1));
        fields.push(field);
        rest = &rest[count..];
    }
    fields
}

/// The field in quotes that `pieces` begin with, without its quotes, and of how many pieces it is.
fn quoted_field(pieces: &[&str], separator: char) -> Option<(String, usize)> {
    let mut quotes = 0;
    let last = pieces.iter().position(|piece| {
        quotes += piece.matches('"').count();
        quotes % 2 == 0
    })?;
    let whole = pieces[..=last].join(&separator.to_string());
    let inner = whole.trim().strip_prefix('"')?.strip_suffix('"')?;
    Some((inner.replace("\"\"", "\""), last + 1))
}

/// Whether a field says that its value is missing, or beyond what the meter can tell.
pub(super) fn is_missing(text: &str) -> bool {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text).trim_end_matches('.');
    MISSING.iter().any(|word| text.eq_ignore_ascii_case(word)) || OVERLOAD.iter().any(|word| unsigned.eq_ignore_ascii_case(word))
}

/// A piece of a file in a message: short, on one line.
pub(crate) fn quoted(text: &str) -> String {
    let shown: String = text.chars().take(QUOTED).collect();
    let more = if shown.len() < text.len() { "..." } else { "" };
    format!("`{}{more}`", shown.escape_debug())
}
