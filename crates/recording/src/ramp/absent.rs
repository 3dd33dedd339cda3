//! Reasons why a number cannot be determined.

use crate::{Error, Seconds};

/// Reason why a record does not determine a number.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Absent {
    /// The temperature stands still.
    #[error(
        "there is no ramp: the temperature ranges over {range:.2} K, and only a course of {needed:.2} K stands out of its noise; record one with ramps"
    )]
    Still {
        /// Range of the temperature \[K\].
        range: f64,
        /// Range from which it is a course \[K\].
        needed: f64,
    },
    /// No ramp goes this way.
    #[error("no ramp of the record {0}s")]
    OneWay(Direction),
    /// The longest ramp is shorter than a few rows.
    #[error("the longest ramp takes {} s, fewer than {rows} rows; record at shorter intervals, or slower ramps", Seconds(*duration))]
    Fast {
        /// Its duration \[s\].
        duration: f64,
        /// Rows that it needs.
        rows: f64,
    },
    /// Its effect looks like an offset, a bias over temperature or a settling in this record.
    #[error(
        "its effect cannot be told from an offset or a bias over temperature; record a rest before and after the ramp, or ramps of several rates"
    )]
    Indistinct,
    /// The response settles more slowly than the ramps and rests last.
    #[error("responses slower than a third of the longest ramp or rest, which lasts {} s, change it, or the sensitivity beside it, by more than its errors: the unit may not have settled; record ramps and rests that last longer", Seconds(*.0))]
    Unsettled(f64),
    /// No temperature is held after heating and after cooling.
    #[error(
        "no temperature is held after heating and after cooling too; record rests at one temperature, reached from either side"
    )]
    NoRest,
    /// The noise cannot be identified.
    #[error("{0}")]
    Noise(#[from] Error),
}

/// Direction of a temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// Upwards.
    Heating,
    /// Downwards.
    Cooling,
}

impl std::fmt::Display for Direction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Heating => "heat",
            Self::Cooling => "cool",
        })
    }
}
