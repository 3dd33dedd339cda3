//! The errors of a coil.

/// Errors of this crate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A dimension or property is out of range.
    #[error("{field}: {problem}")]
    Design {
        /// Path of the field within [`crate::Design`], e.g. `spool.hub_thickness`.
        field: String,
        /// The fault and its remedy.
        problem: String,
    },
    /// A profile cannot be run.
    #[error("instant {row}: {problem}")]
    Profile {
        /// Number of the instant, from 0.
        row: usize,
        /// The fault and its remedy.
        problem: String,
    },
    /// A thermometer's record cannot be inverted.
    #[error("{0}")]
    Record(String),
    /// The resolution cannot be meshed.
    #[error("resolution: {0}")]
    Resolution(String),
    /// The winding cannot be laid.
    #[error(transparent)]
    Winding(#[from] winding::Error),
    /// The optics are out of range.
    #[error(transparent)]
    Bias(#[from] bias::Error),
    /// A material is out of range or the finite-element solution failed.
    #[error("{part}: {source}")]
    Solve {
        /// `coil`, `spool` or `structure`.
        part: &'static str,
        /// The fault.
        source: fem_core::Error,
    },
}

impl Error {
    pub(crate) fn design(field: &str, problem: String) -> Self {
        Self::Design { field: field.into(), problem }
    }
}
