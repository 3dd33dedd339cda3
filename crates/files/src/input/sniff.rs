//! Form of a logger's file: encoding, separator, decimal sign, the line of names, some rows below it.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::InputError;
use super::encoding::{Decoded, Encoding};
use super::quotes::unquoted;
use super::record_options::Key;
use super::timestamp;
use super::unit_names::spelled;

/// Bytes that are looked at.
const SAMPLE: u64 = 1 << 18;
/// Rows below the names that must fit them.
const ROWS: usize = 20;
/// Separators, and their names in map files; the first of those that fit equally well is taken.
const SEPARATORS: [(char, &str); 4] = [('\t', "tab"), (';', ";"), (',', ","), ('|', "|")];

/// A table in a file.
pub(super) struct Sniffed {
    pub(super) encoding: Encoding,
    /// Its name in map files.
    pub(super) separator: &'static str,
    pub(super) decimal_comma: bool,
    /// Lines above the names.
    pub(super) preamble: usize,
    pub(super) names: Vec<String>,
    /// Units from a line below the names; empty if there is none.
    pub(super) units: Vec<String>,
    /// Some rows, with as many fields as there are names.
    pub(super) rows: Vec<Vec<String>>,
}

impl Sniffed {
    pub(super) fn separator_byte(&self) -> u8 {
        SEPARATORS.iter().find(|(_, name)| *name == self.separator).map_or(b',', |(separator, _)| *separator as u8)
    }
}

/// Looks at the beginning of a file.
///
/// # Errors
/// If it cannot be read, or shows no line of names above rows of numbers.
pub(super) fn sniff(path: &Path) -> Result<Sniffed, InputError> {
    let fault = |problem: String, remedy: &str| InputError::whole(path, problem, remedy);
    let unreadable = |error: std::io::Error| fault(format!("cannot be read: {error}"), "check the path and its permissions");
    let file = File::open(path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.is_dir() {
        return Err(fault("is a directory".into(), "give the path of a recording (*.csv)"));
    }
    let mut bytes = Vec::new();
    file.take(SAMPLE).read_to_end(&mut bytes).map_err(unreadable)?;
    let encoding = Encoding::of(&bytes);
    let whole = (bytes.len() as u64) < SAMPLE;
    let mut decoded = Vec::new();
    Decoded::new(&bytes[..], encoding).read_to_end(&mut decoded).map_err(unreadable)?;
    let text = String::from_utf8_lossy(&decoded);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let mut lines: Vec<&str> = text.lines().collect();
    if !whole {
        lines.pop();
    }
    let tables = SEPARATORS.iter().filter_map(|(separator, name)| table(&lines, *separator, name));
    let best = tables.reduce(|best, other| if other.names.len() > best.names.len() { other } else { best });
    let nothing = || {
        let remedy = "a recording has a line of names above rows of numbers, separated by commas, semicolons, tabs or bars";
        fault("shows no table".into(), remedy)
    };
    best.map(|table| Sniffed { encoding, ..table }).ok_or_else(nothing)
}

/// The table that `separator` makes of the lines, if one stands there.
fn table(lines: &[&str], separator: char, name: &'static str) -> Option<Sniffed> {
    (0..lines.len()).find_map(|header| {
        let names = names(lines[header], separator)?;
        let mut below =
            lines[header + 1..].iter().filter(|line| fields(line, separator).iter().any(|f| !f.is_empty())).peekable();
        let units =
            below.peek().map(|line| fields(line, separator)).filter(|units| are_units(units) && units.len() == names.len());
        if units.is_some() {
            below.next();
        }
        let rows: Vec<Vec<String>> = below.take(ROWS).map(|line| fields(line, separator)).collect();
        let alike = |row: &Vec<String>| row.len() == names.len() && row.iter().any(|field| is_value(field));
        if rows.is_empty() || !rows.iter().all(alike) {
            return None;
        }
        let numbers = || rows.iter().flatten().filter(|field| timestamp::date(field).is_none());
        // between commas, only what stood in quotes has one
        let comma = numbers().any(|field| field.contains(',') && is_value(field));
        let point = numbers().any(|field| field.parse::<f64>().is_ok() && field.contains('.'));
        let (units, decimal_comma) = (units.unwrap_or_default(), comma && !point);
        Some(Sniffed { encoding: Encoding::Utf8, separator: name, decimal_comma, preamble: header, names, units, rows })
    })
}

/// The fields of a line if they may be names of columns.
fn names(line: &str, separator: char) -> Option<Vec<String>> {
    let names = fields(line, separator);
    let are_names = names.iter().all(|name| name.is_empty() || !is_value(name));
    let several = names.iter().filter(|name| !name.is_empty()).count() > 1;
    (several && are_names && !names[0].starts_with('#')).then_some(names)
}

/// Whether a line below names holds their units.
fn are_units(fields: &[String]) -> bool {
    let bare = |field: &str| field.trim_matches(['[', ']', '(', ')']).to_owned();
    let is_unit = |field: &String| Key::ALL.into_iter().any(|key| spelled(&bare(field), key).is_some());
    fields.iter().filter(|field| is_unit(field)).count() > 1 && !fields.iter().any(|field| is_value(field))
}

/// The fields of a line without blanks and quotes around them.
fn fields(line: &str, separator: char) -> Vec<String> {
    let pieces: Vec<&str> = line.split(separator).collect();
    unquoted(&pieces, separator).iter().map(|field| field.trim().to_owned()).collect()
}

/// Whether a field is a number, with a decimal point or comma, or an instant.
pub(super) fn is_value(field: &str) -> bool {
    let is_instant = || timestamp::is_date(field) || timestamp::is_day(field) || timestamp::time_of_day(field).is_some();
    field.replacen(',', ".", 1).parse::<f64>().is_ok() || is_instant()
}
