//! Errors of results that cannot be computed.

use crate::Seconds;

/// Errors of this crate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A series is longer or shorter than its instants.
    #[error("`{name}` has {found} values where there are {expected} instants; give one for each")]
    Length {
        /// Name of the series.
        name: String,
        /// Its length.
        found: usize,
        /// Number of instants.
        expected: usize,
    },
    /// Two channels have one name.
    #[error("two channels are named `{0}`; rename one")]
    Name(String),
    /// An instant is not finite, or does not come after the one before.
    #[error("instant {row}, {} s, is not finite or not after the one before, {} s; drop repeats and sort by time", Seconds(*time), Seconds(*previous))]
    Time {
        /// Its row, from 0.
        row: usize,
        /// The instant \[s\].
        time: f64,
        /// The instant before \[s\].
        previous: f64,
    },
    /// A row that is used has no finite value, or an instant is not finite: no mask is of instants.
    #[error("`{name}` is {value} in row {row}, {}", remedy(name))]
    Value {
        /// Name of the series.
        name: String,
        /// The row, from 0.
        row: usize,
        /// The value.
        value: f64,
    },
    /// A parameter is outside its range.
    #[error("`{name}` is {value}; it has to be {range}")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// The value.
        value: f64,
        /// The range.
        range: &'static str,
    },
    /// Too few rows for what is asked.
    #[error("{found} usable rows are too few, at least {needed} are needed; give a longer stretch")]
    TooFew {
        /// Usable rows.
        found: usize,
        /// Rows needed.
        needed: usize,
    },
    /// The series is explained exactly: there is no noise to identify.
    #[error("the series has no noise beyond rounding: it is constant or explained exactly by the columns given")]
    NoNoise,
}

/// Remedy for a value that is not finite; no mask is of instants.
fn remedy(name: &str) -> &'static str {
    if name == "time" { "and every row needs an instant; drop the row" } else { "which is used; mask the row" }
}
