//! Form of a logger's file, by flags or by a file `<record>.map.ron` beside it.

use std::path::Path;

use recording::check::Unit;

use super::InputError;
use super::encoding::Encoding;
use super::map_file::MapFile;
use super::meta::MOST_INTERVAL_S;
use super::opened::open;
use super::record_options::{Key, RecordOptions};
use super::rows::Dialect;
use crate::Error;
use crate::units::ColumnUnit;

/// Refuses a flag that speaks of a column twice.
fn once<T>(flag: &str, declared: &[(Key, T)]) -> Result<(), String> {
    let twice = |n: &usize| declared[..*n].iter().any(|(key, _)| *key == declared[*n].0);
    match (0..declared.len()).find(twice) {
        Some(n) => Err(format!("{flag}: {} is given twice; give it once", declared[n].0.name())),
        None => Ok(()),
    }
}

/// Complete form of a file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RecordFormat {
    pub(super) dialect: Dialect,
    /// Seconds between rows, for a file without instants.
    pub(super) interval: Option<f64>,
    pub(super) columns: [ColumnFormat; 4],
    /// Column of the time of day, where the instants' column holds the date alone.
    pub(super) time_of_day: Option<String>,
    /// Names of further columns that are read as they stand.
    pub(super) further: Vec<String>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct ColumnFormat {
    pub(super) name: Option<String>,
    pub(super) unit: ColumnUnit,
    /// Units in a count; 1 for a column of values.
    pub(super) count: f64,
    /// Whether the user, or a map file, says unit or scale.
    pub(super) is_said: bool,
}

impl RecordFormat {
    /// The form by the flags and the map file, if there is one.
    pub(super) fn read(record: &Path, options: &RecordOptions) -> Result<Self, Error> {
        let mut format = match options.map_of(record) {
            Some(path) => Self::from_file(&path)?,
            None => Self::standard(),
        };
        format.declare(options).map_err(Error::Usage)?;
        format.further.clone_from(&options.further);
        Ok(format)
    }

    pub(super) fn standard() -> Self {
        let columns = Key::ALL.map(|key| ColumnFormat { name: None, unit: key.units()[0], count: 1.0, is_said: false });
        Self { dialect: Dialect::STANDARD, interval: None, columns, time_of_day: None, further: Vec::new() }
    }

    pub(super) fn from_file(path: &Path) -> Result<Self, InputError> {
        let source = open(path)?;
        Self::of(&source.parse(None)?).map_err(|(field, problem)| source.fault(&field, problem, ""))
    }

    /// The form by a map that is proposed; the options win.
    pub(super) fn of_map(map: &MapFile, options: &RecordOptions) -> Result<Self, Error> {
        let mut format = Self::of(map).map_err(|(field, problem)| Error::Usage(format!("{field}: {problem}")))?;
        format.declare(options).map_err(Error::Usage)?;
        Ok(format)
    }

    /// The form by a map file; an error is field and problem.
    pub(super) fn of(file: &MapFile) -> Result<Self, (String, String)> {
        let at = |field: String| |problem: String| (field, problem);
        let mut format = Self::standard();
        if file.decimal_comma {
            format.dialect.decimal = ',';
        }
        if !file.separator.is_empty() {
            format.dialect.separator = separator(&file.separator).map_err(at("separator".into()))?;
        }
        if !file.encoding.is_empty() {
            format.dialect.encoding = encoding(&file.encoding).map_err(at("encoding".into()))?;
        }
        format.dialect.preamble = file.preamble_lines.into();
        format.dialect.below = file.lines_below_names;
        format.time_of_day = Some(file.time_of_day.clone()).filter(|name| !name.is_empty());
        format.interval = interval(file.interval_s).map_err(at("interval_s".into()))?;
        for (key, column) in Key::ALL.into_iter().zip([&file.time, &file.chamber, &file.spool, &file.rate]) {
            let format = &mut format.columns[key as usize];
            format.name = Some(column.column.clone()).filter(|name| !name.is_empty());
            if !column.unit.is_empty() {
                format.set_unit(key.unit(&column.unit).map_err(at(format!("{}.unit", key.name())))?);
            }
            if column.scale != 0.0 {
                format.set_count(column.scale).map_err(at(format!("{}.scale", key.name())))?;
            }
        }
        Ok(format)
    }

    pub(super) fn declare(&mut self, options: &RecordOptions) -> Result<(), String> {
        if let Some(text) = &options.separator {
            self.dialect.separator = separator(text).map_err(|problem| format!("--separator: {problem}"))?;
        }
        if options.decimal_comma {
            self.dialect.decimal = ',';
        }
        if let Some(seconds) = options.interval {
            self.interval = interval(seconds).map_err(|problem| format!("--interval: {problem}"))?;
        }
        if options.time_of_day.is_some() {
            self.time_of_day.clone_from(&options.time_of_day);
        }
        once("--column", &options.columns)?;
        once("--unit", &options.units)?;
        once("--scale", &options.scales)?;
        for (key, name) in &options.columns {
            self.columns[*key as usize].name = Some(name.clone());
        }
        for (key, unit) in &options.units {
            self.columns[*key as usize].set_unit(key.unit(unit).map_err(|problem| format!("--unit: {problem}"))?);
        }
        for (key, scale) in &options.scales {
            self.columns[*key as usize].set_count(*scale).map_err(|problem| format!("--scale: {problem}"))?;
        }
        Ok(())
    }

    pub(super) fn column(&self, key: Key) -> &ColumnFormat {
        &self.columns[key as usize]
    }
}

impl ColumnFormat {
    fn set_unit(&mut self, unit: ColumnUnit) {
        (self.unit, self.is_said) = (unit, true);
    }

    fn set_count(&mut self, scale: f64) -> Result<(), String> {
        if scale == 0.0 || !scale.is_finite() {
            return Err(format!("{scale} is not a factor; give units per count, e.g. 0.01"));
        }
        (self.count, self.is_said) = (scale, true);
        Ok(())
    }

    /// Whether unit and count are those of the key's standard column.
    pub(super) fn is_standard(&self, key: Key) -> bool {
        self.unit == key.units()[0] && self.count == 1.0
    }

    pub(super) fn standard(&self, value: f64) -> f64 {
        self.unit.scale * self.count * value + self.unit.offset
    }

    /// The key's other units that are not rare, in which the column may be: conversion from the value read as standard to the value in that unit.
    pub(super) fn mistaken(&self, key: Key) -> Vec<Unit> {
        self.others(key, false)
    }

    /// All other units of the key likewise, the rare ones last; none of a column of counts.
    pub(super) fn other_units(&self, key: Key) -> Vec<Unit> {
        if self.count == 1.0 { [self.others(key, false), self.others(key, true)].concat() } else { Vec::new() }
    }

    fn others(&self, key: Key, rare: bool) -> Vec<Unit> {
        let others = key.units().iter().filter(|unit| **unit != self.unit && unit.is_rare == rare);
        let of = |unit: &ColumnUnit| {
            let scale = unit.scale / self.unit.scale;
            Unit { name: unit.names[0].into(), scale, offset: unit.offset - scale * self.unit.offset }
        };
        others.map(of).collect()
    }
}

fn separator(text: &str) -> Result<u8, String> {
    match text.as_bytes() {
        [byte] if byte.is_ascii() && !byte.is_ascii_alphanumeric() && !b".-+\"\n\r".contains(byte) => Ok(*byte),
        _ if text == "tab" || text == "\\t" => Ok(b'\t'),
        _ => Err(format!("`{}` cannot separate fields; give a character such as ';', or tab", text.escape_debug())),
    }
}

fn encoding(text: &str) -> Result<Encoding, String> {
    let found = Encoding::ALL.iter().find(|(_, name)| text.eq_ignore_ascii_case(name));
    let choices = || Encoding::ALL.map(|(_, name)| name).join(", ");
    found.map(|(encoding, _)| *encoding).ok_or_else(|| format!("`{}` is not read; choose {}", text.escape_debug(), choices()))
}

/// 0 is none.
fn interval(seconds: f64) -> Result<Option<f64>, String> {
    if !(0.0..=MOST_INTERVAL_S).contains(&seconds) {
        return Err(format!("{seconds} s is not an interval; give the seconds between rows"));
    }
    Ok((seconds > 0.0).then_some(seconds))
}
