//! Between the units of the files and SI: the only place where a factor is applied.
//!
//! Divisions by powers of ten are correctly rounded, so `from_mm(43.5)` is the double nearest to 0.0435.

use bias::units::{S_PER_H, S_PER_MIN};

/// What a key in a case file may end in, after the quantity's name.
pub(crate) const SUFFIXES: [&str; 14] =
    ["um", "mm", "m", "mpa", "gpa", "per_k", "w_per_mk", "kg_per_m3", "j_per_kgk", "c", "s", "w", "w_per_m2k", "m2k_per_w"];

/// Micrometres to metres.
pub fn from_um(value: f64) -> f64 {
    value / 1e6
}

/// Millimetres to metres.
pub fn from_mm(value: f64) -> f64 {
    value / 1e3
}

/// Metres to millimetres.
pub fn to_mm(metres: f64) -> f64 {
    metres * 1e3
}

/// Megapascals to pascals.
pub fn from_mpa(value: f64) -> f64 {
    value * 1e6
}

/// Pascals to megapascals.
pub fn to_mpa(pascals: f64) -> f64 {
    pascals / 1e6
}

/// Gigapascals to pascals.
pub fn from_gpa(value: f64) -> f64 {
    value * 1e9
}

/// Pascals to gigapascals.
pub fn to_gpa(pascals: f64) -> f64 {
    pascals / 1e9
}

/// 1/K to 10⁻⁶/K.
pub fn to_ppm(ratio: f64) -> f64 {
    ratio * 1e6
}

/// The unit in which a span of time is shown to people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DurationUnit {
    /// Up to five minutes.
    Seconds,
    /// Up to five hours.
    Minutes,
    /// Beyond.
    Hours,
}

impl DurationUnit {
    /// The unit for a span \[s\].
    pub fn of(seconds: f64) -> Self {
        if seconds <= 5.0 * S_PER_MIN {
            Self::Seconds
        } else if seconds <= 5.0 * S_PER_H {
            Self::Minutes
        } else {
            Self::Hours
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Seconds => "s",
            Self::Minutes => "min",
            Self::Hours => "h",
        }
    }

    /// Seconds in this unit.
    pub fn of_seconds(self, seconds: f64) -> f64 {
        match self {
            Self::Seconds => seconds,
            Self::Minutes => seconds / S_PER_MIN,
            Self::Hours => seconds / S_PER_H,
        }
    }
}
