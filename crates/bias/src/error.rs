//! The faults of the optics, the fibre or the ramp.

/// Errors of this crate. Every message names the field, its value and the valid range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A constant of the fibre or the gyroscope is outside its range.
    #[error("{field} = {value}, but it must be {range}")]
    Range {
        /// Name of the field, of [`Optics`](crate::Optics) or `length`.
        field: &'static str,
        /// Its value \[SI\].
        value: f64,
        /// The valid range, in words, with its unit.
        range: &'static str,
    },
    /// A slice does not lie on the fibre.
    #[error(
        "slice {index} spans z = {z_start} m to {z_end} m, but it must lie on the fibre, from 0 to {length} m, with z_start \
         before z_end; check that the fibre's length includes its tails"
    )]
    Span {
        /// Index of the slice, from 0.
        index: usize,
        /// Its start \[m\].
        z_start: f64,
        /// Its end \[m\].
        z_end: f64,
        /// Length of the fibre \[m\].
        length: f64,
    },
    /// A slice changes at a rate that is not a finite number.
    #[error("slice {index}: {field} = {value}, but it must be finite; check the solver or recording that produced it")]
    Rate {
        /// Index of the slice, from 0.
        index: usize,
        /// Name of the field of [`Slice`](crate::Slice).
        field: &'static str,
        /// Its value \[SI\].
        value: f64,
    },
    /// A sensitivity was asked for without a ramp.
    #[error("temperature_rate = {value} K/s, but a sensitivity needs a ramp: a finite rate other than 0")]
    Ramp {
        /// The ramp's rate [K/s].
        value: f64,
    },
}
