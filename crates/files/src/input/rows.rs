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
use super::quotes::{is_quoted, unquoted};
use super::sniff::{Sniffed, sniff};

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

/// Remedy for a row without a number.
const REMOVED: &str = "remove the row: between rows the course is linear";
/// Message on text in another encoding.
pub(super) const NOT_UTF8: &str = "is not UTF-8 text";
/// Words of a field without a value, in lower case.
const MISSING: [&str; 9] = ["", "nan", "na", "n/a", "null", "none", "-", "--", "#n/a"];
/// Words of a meter beyond its range, in lower case, perhaps behind a sign.
const OVERLOAD: [&str; 8] = ["ovld", "overload", "ol", "ovl", "over", "overrange", "over range", "overflow"];

/// A table that is not in a file.
#[derive(Debug, Clone, PartialEq)]
pub enum Table {
    /// CSV, in the standard dialect.
    Text(String),
    /// Numbers by column, each with its name; a value that is missing is not a number.
    Columns(Vec<(String, Vec<f64>)>),
}

impl From<String> for Table {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

pub(crate) struct Rows {
    path: PathBuf,
    dialect: Dialect,
    source: Source,
    /// Fields of this row; of numbers by column the names alone.
    record: StringRecord,
    /// Whether a row was met.
    begun: bool,
    /// Whether a field stood in quotes.
    quotes: bool,
}

enum Source {
    Text(Box<csv::Reader<Chain<Decoded<Metered>, &'static [u8]>>>),
    Columns {
        columns: Vec<Vec<f64>>,
        /// From 1; 0 is the row of the names.
        row: usize,
        hash: Hash,
    },
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

    /// A table in memory, called `path` in messages.
    pub(crate) fn of(path: &Path, table: Table) -> Self {
        match table {
            Table::Text(text) => Self::new(path, Box::new(Cursor::new(text)), Dialect::STANDARD),
            Table::Columns(columns) => Self::of_columns(path, columns),
        }
    }

    fn of_columns(path: &Path, columns: Vec<(String, Vec<f64>)>) -> Self {
        let mut hash = Hash::new();
        for (name, values) in &columns {
            hash.update(name.as_bytes());
            values.iter().for_each(|value| hash.update(&value.to_le_bytes()));
        }
        let (names, columns): (Vec<String>, _) = columns.into_iter().unzip();
        Self::from(path, Source::Columns { columns, row: 0, hash }, Dialect::STANDARD, names.into())
    }

    fn from(path: &Path, source: Source, dialect: Dialect, record: StringRecord) -> Self {
        Self { path: path.to_owned(), dialect, source, record, begun: false, quotes: false }
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
        Self::from(path, Source::Text(Box::new(reader)), dialect, StringRecord::new())
    }

    /// Moves to the next row that is not blank; `false` at the end.
    pub(crate) fn advance(&mut self) -> Result<bool, InputError> {
        loop {
            let read = match &mut self.source {
                Source::Text(reader) => reader.read_record(&mut self.record),
                Source::Columns { .. } if !self.begun => {
                    self.begun = true;
                    return Ok(true);
                }
                Source::Columns { columns, row, .. } => {
                    self.record.clear();
                    *row += 1;
                    return Ok(columns.iter().any(|values| *row <= values.len()));
                }
            };
            if self.record.iter().any(is_quoted) {
                self.quotes = true;
                let fields: Vec<&str> = self.record.iter().collect();
                self.record = StringRecord::from(unquoted(&fields, char::from(self.dialect.separator)));
            }
            match read {
                Ok(false) => return Ok(false),
                Ok(true) if self.count() == 1 && self.field(0).is_empty() => {}
                Ok(true) if !self.begun && self.line().is_some_and(|line| u64::from(line) <= self.dialect.preamble) => {}
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
            let remedy = format!("{remedy}; a coil file is checked by every command that takes one, e.g. fogcoil wind");
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
        match &self.source {
            Source::Text(_) => self.record.len(),
            Source::Columns { columns, .. } => columns.len(),
        }
    }

    /// A number of this row; `None` of a text. What is missing is not a number.
    fn of_column(&self, column: usize) -> Option<f64> {
        let Source::Columns { columns, row, .. } = &self.source else { return None };
        let value = row.checked_sub(1).and_then(|row| columns.get(column)?.get(row).copied());
        Some(value.unwrap_or(f64::NAN))
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
        if let Some(value) = self.of_column(column) {
            let fault = || self.fault(Some(name), format!("`{value}` is not a finite number"), REMOVED);
            return Some(value).filter(|value| value.is_finite()).ok_or_else(fault);
        }
        let text = self.field(column);
        self.check_point(text, name)?;
        match text.replace(self.dialect.decimal, ".").parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => {
                let problem = format!("{} is not a finite number", quoted(text));
                Err(self.fault(Some(name), problem, REMOVED))
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
        if let Some(value) = self.of_column(column) {
            let fault =
                || self.fault(Some(name), format!("`{value}` is not a finite number"), "give nan where a value is missing");
            return if value.is_infinite() { Err(fault()) } else { Ok(Some(value).filter(|value| !value.is_nan())) };
        }
        let text = self.field(column);
        self.check_point(text, name)?;
        let value = text.replace(self.dialect.decimal, ".").parse::<f64>();
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

    /// Refuses a number with a point where decimals have a comma.
    fn check_point(&self, text: &str, name: &str) -> Result<(), InputError> {
        let decimal = self.dialect.decimal;
        if decimal != '.' && text.contains('.') && text.replace([decimal, '.'], "").parse::<f64>().is_ok() {
            let problem = format!("{} has a point, but decimals have a comma here", quoted(text));
            let remedy = "take out points between thousands, or leave out --decimal-comma (decimal_comma in the map file)";
            return Err(self.fault(Some(name), problem, remedy));
        }
        Ok(())
    }

    /// The line of this row, from 1; `None` of a table without lines.
    pub(crate) fn line(&self) -> Option<u32> {
        match &self.source {
            Source::Text(reader) => Some(u32::try_from(reader.position().line().saturating_sub(1).max(1)).unwrap_or(u32::MAX)),
            Source::Columns { .. } => None,
        }
    }

    /// The table in the file that is read, if it shows one.
    pub(super) fn sniffed(&self) -> Option<Sniffed> {
        match self.source {
            Source::Text(_) => sniff(&self.path).ok(),
            Source::Columns { .. } => None,
        }
    }

    /// A complaint about this row: at a line of a text, at an element of a column.
    pub(crate) fn fault(&self, column: Option<&str>, problem: impl Into<String>, remedy: impl Into<String>) -> InputError {
        let line = self.line().map(|line| line as usize);
        let field = match &self.source {
            Source::Text(_) | Source::Columns { row: 0, .. } => column.map(str::to_owned),
            Source::Columns { row, .. } => column.map(|column| format!("{column}[{}]", row - 1)),
        };
        InputError { line, field, ..InputError::whole(&self.path, problem, remedy) }
    }

    pub(crate) fn whole_fault(&self, problem: &str, remedy: impl Into<String>) -> InputError {
        InputError { line: None, ..self.fault(None, problem, remedy) }
    }

    /// The content read so far.
    pub(crate) fn fingerprint(&self) -> Fingerprint {
        let hash = match &self.source {
            Source::Text(reader) => &reader.get_ref().get_ref().0.source.hash,
            Source::Columns { hash, .. } => hash,
        };
        hash.fingerprint(self.path.clone())
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers() -> Rows {
        let columns = vec![("a".to_owned(), vec![1.0, f64::NAN, 0.1]), ("b".to_owned(), vec![f64::INFINITY, 2.0])];
        Rows::of(Path::new("t"), Table::Columns(columns))
    }

    #[test]
    fn numbers_by_column_are_rows_without_a_text_between() {
        let mut rows = numbers();
        rows.header("a,b").unwrap();
        assert_eq!(rows.fields().collect::<Vec<_>>(), ["a", "b"]);
        assert!(rows.advance().unwrap());
        assert_eq!((rows.count(), rows.value(0, "a"), rows.number(0, "a")), (2, Ok(Some(1.0)), Ok(1.0)));
        let infinite = rows.value(1, "b").unwrap_err();
        assert_eq!((infinite.line, infinite.field.as_deref()), (None, Some("b[0]")));
        assert!(rows.number(1, "b").is_err() && rows.advance().unwrap());
        assert_eq!((rows.value(0, "a"), rows.value(1, "b")), (Ok(None), Ok(Some(2.0))));
        assert_eq!(rows.number(0, "a").unwrap_err().to_string(), format!("t: a[1]: `NaN` is not a finite number; {REMOVED}"));
        // a column that is too short has no value
        assert!(rows.advance().unwrap() && rows.value(1, "b") == Ok(None) && rows.value(0, "a") == Ok(Some(0.1)));
        assert!(!rows.advance().unwrap() && !rows.advance().unwrap());
    }

    #[test]
    fn other_numbers_by_column_have_another_fingerprint() {
        let of = |a: f64| Rows::of_columns(Path::new("t"), vec![("a".into(), vec![a])]).fingerprint();
        assert!(of(0.0) == of(0.0) && of(0.0) != of(-0.0));
        assert_eq!(numbers().fingerprint().bytes, 2 + 8 * 5);
    }
}
