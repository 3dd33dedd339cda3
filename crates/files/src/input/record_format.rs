//! How a logger's file is to be read: flags, or a file `<record>.map.ron` beside it.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use recording::check::Unit;
use schemars::JsonSchema;
use serde::Deserialize;

use super::InputError;
use super::profile_columns::TIME;
use super::rows::Dialect;
use super::source::Source;
use crate::Error;
use crate::units::{ColumnUnit, RATES, TEMPERATURES, TIMES};

/// The chamber's temperature \[°C\].
pub const CHAMBER: &str = "chamber_c";
/// The thermometer on the spool \[°C\].
pub const SPOOL: &str = "spool_c";
/// The gyro's rate, mean over the interval that ends at the instant \[deg/h\].
pub const RATE: &str = "rate_deg_per_h";

/// A column that the program knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Key {
    /// The instant.
    Time,
    /// The chamber's temperature.
    Chamber,
    /// The thermometer on the spool.
    Spool,
    /// The gyro's rate.
    Rate,
}

impl Key {
    pub(super) const ALL: [Self; 4] = [Self::Time, Self::Chamber, Self::Spool, Self::Rate];

    /// Its name in flags and map files.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Chamber => "chamber",
            Self::Spool => "spool",
            Self::Rate => "rate",
        }
    }

    /// Name of its column in a standard recording.
    pub(super) fn standard(self) -> &'static str {
        match self {
            Self::Time => TIME,
            Self::Chamber => CHAMBER,
            Self::Spool => SPOOL,
            Self::Rate => RATE,
        }
    }

    /// Its units, the standard one first.
    pub(super) fn units(self) -> &'static [ColumnUnit] {
        match self {
            Self::Time => &TIMES,
            Self::Chamber | Self::Spool => &TEMPERATURES,
            Self::Rate => &RATES,
        }
    }

    /// The unit that a column's name ends in, like `T [K]` or `Zeit (min)`, if it is one of the key's.
    pub(super) fn unit_in(self, name: &str) -> Option<ColumnUnit> {
        let pair = [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| name.strip_suffix(close)?.rsplit_once(open))?;
        self.unit(pair.1.trim()).ok()
    }

    fn unit(self, name: &str) -> Result<ColumnUnit, String> {
        let found = self.units().iter().find(|unit| unit.names.contains(&name));
        let choices = || self.units().iter().map(|unit| unit.names[0]).collect::<Vec<_>>().join(", ");
        found.copied().ok_or_else(|| format!("`{name}` is no unit of {}; choose {}", self.name(), choices()))
    }
}

impl FromStr for Key {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL
            .into_iter()
            .find(|key| key.name() == text)
            .ok_or_else(|| format!("`{text}` is not a column here; choose {}", Self::ALL.map(Self::name).join(", ")))
    }
}

/// What the user says about a record's file; what is not said comes from the map file, then from the standard.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RecordOptions {
    /// A map file in place of the one beside the record.
    pub map: Option<PathBuf>,
    /// A meta file in place of the one beside the record.
    pub meta: Option<PathBuf>,
    /// Names of columns in the file.
    pub columns: Vec<(Key, String)>,
    /// Units of columns.
    pub units: Vec<(Key, String)>,
    /// Factors that make counts a unit.
    pub scales: Vec<(Key, f64)>,
    /// Between the fields: a character, or `tab`.
    pub separator: Option<String>,
    /// Whether numbers have a decimal comma.
    pub decimal_comma: bool,
    /// Seconds between rows, for a file without instants.
    pub interval: Option<f64>,
}

/// How a logger's file is read, `RECORD.map.ron`; what is left out is standard.
#[derive(Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct MapFile {
    /// Between the fields: a character, or `tab`; empty: a comma.
    separator: String,
    /// Whether numbers are written like 20,5.
    decimal_comma: bool,
    /// Seconds between rows, for a file without instants; 0: it has them.
    interval_s: f64,
    /// The instants: s, ms, us, ns, min, h; dates need no unit.
    time: ColumnFile,
    /// The chamber's temperature: degC, K or degF.
    chamber: ColumnFile,
    /// The spool's thermometer: degC, K or degF.
    spool: ColumnFile,
    /// The rate: deg/h, deg/s, rad/s or mrad/s.
    rate: ColumnFile,
}

/// A column of a logger's file.
#[derive(Deserialize, JsonSchema, Default, Clone)]
#[serde(deny_unknown_fields, default)]
struct ColumnFile {
    /// Its name in the file; empty: the standard one.
    column: String,
    /// Its unit; empty: the standard one.
    unit: String,
    /// Units in a count; 0: it holds no counts.
    scale: f64,
}

/// How a file is read, complete.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RecordFormat {
    pub(super) dialect: Dialect,
    /// Seconds between rows, for a file without instants.
    pub(super) interval: Option<f64>,
    pub(super) columns: [ColumnFormat; 4],
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct ColumnFormat {
    pub(super) name: Option<String>,
    pub(super) unit: ColumnUnit,
    /// Units in a count; 1 for a column of values.
    pub(super) count: f64,
}

impl RecordFormat {
    /// From the flags and the map file, if there is one.
    pub(super) fn read(record: &Path, options: &RecordOptions) -> Result<Self, Error> {
        let beside = record.with_extension("map.ron");
        let path = options.map.clone().or_else(|| beside.is_file().then_some(beside));
        let mut format = match path {
            Some(path) => Self::from_file(&path)?,
            None => Self::standard(),
        };
        format.declare(options).map_err(Error::Usage)?;
        Ok(format)
    }

    pub(super) fn standard() -> Self {
        let columns = Key::ALL.map(|key| ColumnFormat { name: None, unit: key.units()[0], count: 1.0 });
        Self { dialect: Dialect::STANDARD, interval: None, columns }
    }

    fn from_file(path: &Path) -> Result<Self, InputError> {
        let source = Source::read(path)?;
        Self::of(&source.parse(None)?).map_err(|(field, problem)| source.fault(&field, problem, ""))
    }

    /// From a map file; an error is field and problem.
    fn of(file: &MapFile) -> Result<Self, (String, String)> {
        let at = |field: String| |problem: String| (field, problem);
        let mut format = Self::standard();
        if file.decimal_comma {
            format.dialect.decimal = ',';
        }
        if !file.separator.is_empty() {
            format.dialect.separator = separator(&file.separator).map_err(at("separator".into()))?;
        }
        format.interval = interval(file.interval_s).map_err(at("interval_s".into()))?;
        for (key, column) in Key::ALL.into_iter().zip([&file.time, &file.chamber, &file.spool, &file.rate]) {
            let format = &mut format.columns[key as usize];
            format.name = Some(column.column.clone()).filter(|name| !name.is_empty());
            if !column.unit.is_empty() {
                format.unit = key.unit(&column.unit).map_err(at(format!("{}.unit", key.name())))?;
            }
            if column.scale != 0.0 {
                format.set_count(column.scale).map_err(at(format!("{}.scale", key.name())))?;
            }
        }
        Ok(format)
    }

    fn declare(&mut self, options: &RecordOptions) -> Result<(), String> {
        if let Some(text) = &options.separator {
            self.dialect.separator = separator(text).map_err(|problem| format!("--separator: {problem}"))?;
        }
        if options.decimal_comma {
            self.dialect.decimal = ',';
        }
        if let Some(seconds) = options.interval {
            self.interval = interval(seconds).map_err(|problem| format!("--interval: {problem}"))?;
        }
        for (key, name) in &options.columns {
            self.columns[*key as usize].name = Some(name.clone());
        }
        for (key, unit) in &options.units {
            self.columns[*key as usize].unit = key.unit(unit).map_err(|problem| format!("--unit: {problem}"))?;
        }
        for (key, scale) in &options.scales {
            self.columns[*key as usize].set_count(*scale).map_err(|problem| format!("--scale: {problem}"))?;
        }
        if self.dialect.separator == b',' && self.dialect.decimal == ',' {
            return Err("a comma cannot separate the fields and the decimals; add --separator ';'".into());
        }
        Ok(())
    }

    pub(super) fn column(&self, key: Key) -> &ColumnFormat {
        &self.columns[key as usize]
    }
}

impl ColumnFormat {
    fn set_count(&mut self, scale: f64) -> Result<(), String> {
        if scale == 0.0 || !scale.is_finite() {
            return Err(format!("{scale} is not a factor; give units per count, e.g. 0.01"));
        }
        self.count = scale;
        Ok(())
    }

    pub(super) fn standard(&self, value: f64) -> f64 {
        self.unit.scale * self.count * value + self.unit.offset
    }

    /// The key's other units, in which the column may be: from what was taken for the standard unit to what then is.
    pub(super) fn mistaken(&self, key: Key) -> Vec<Unit> {
        let others = key.units().iter().filter(|unit| **unit != self.unit);
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

/// 0 is none.
fn interval(seconds: f64) -> Result<Option<f64>, String> {
    if !(0.0..1e9).contains(&seconds) {
        return Err(format!("{seconds} s is not an interval; give the seconds between rows"));
    }
    Ok((seconds > 0.0).then_some(seconds))
}
