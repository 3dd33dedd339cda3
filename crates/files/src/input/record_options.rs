//! The columns that the program knows, and the user's options about a record's file.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use crate::units::{ColumnUnit, RATES, TEMPERATURES, TIMES};

/// The instant \[s\].
pub(super) const TIME: &str = "time_s";
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

    pub(super) fn unit(self, name: &str) -> Result<ColumnUnit, String> {
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

/// The user's options about a record's file; a missing one comes from the map file, then from the standard.
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
    /// Separator of the fields: a character, or `tab`.
    pub separator: Option<String>,
    /// Whether numbers have a decimal comma.
    pub decimal_comma: bool,
    /// Seconds between rows, for a file without instants.
    pub interval: Option<f64>,
    /// Column of the time of day, where the instants' column holds the date alone.
    pub time_of_day: Option<String>,
    /// Further columns that are read as they stand.
    pub further: Vec<String>,
}

impl RecordOptions {
    /// The map file of a record, if there is one.
    pub(super) fn map_of(&self, record: &Path) -> Option<PathBuf> {
        self.map.clone().or_else(|| Some(record.with_extension("map.ron")).filter(|beside| beside.is_file()))
    }

    /// The meta file of a record, if there is one.
    pub(super) fn meta_of(&self, record: &Path) -> Option<PathBuf> {
        self.meta.clone().or_else(|| Some(record.with_file_name("meta.ron")).filter(|beside| beside.is_file()))
    }

    /// Every file that is read for a record.
    pub fn files(&self, record: &Path) -> Vec<PathBuf> {
        [Some(record.to_owned()), self.map_of(record), self.meta_of(record)].into_iter().flatten().collect()
    }
}
