//! The faults of a cell.

/// Errors of this crate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The pitch is not a positive number.
    #[error("pitch {0:e} m must be finite and greater than 0")]
    Pitch(f64),
    /// A ring's outer radius is not greater than the one inside it (or not a positive number).
    #[error("ring {ring}: outer radius {radius:e} m must be finite and greater than the radius inside it, {inner:e} m")]
    RingOrder {
        /// Ring number, from 0 inside.
        ring: usize,
        /// Its outer radius \[m\].
        radius: f64,
        /// The radius of the ring inside it \[m\].
        inner: f64,
    },
    /// The fibres touch or overlap.
    #[error("outermost radius {radius:e} m leaves no adhesive film at pitch {pitch:e} m; it must be less than half the pitch")]
    Overlap {
        /// Outermost radius \[m\].
        radius: f64,
        /// Pitch \[m\].
        pitch: f64,
    },
    /// The cell has no ring.
    #[error("the cell needs at least one ring")]
    NoRing,
    /// The requested resolution cannot be meshed.
    #[error("resolution: {0}")]
    Resolution(String),
}
