//! Errors, with the numbers behind them.

/// Errors of this crate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A material constant is outside its range.
    #[error("{field} = {value}, but it must be {range}")]
    Material {
        /// Name of the constant.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The valid range, in words.
        range: String,
    },
    /// The mesh's arrays do not fit each other, or an element is turned inside out.
    #[error("mesh: {0}")]
    Mesh(String),
    /// The matrix of constants of a region is missing or has the wrong shape.
    #[error("constants of region {region}: {found}, but the weak form needs {needed}")]
    Law {
        /// Region number.
        region: usize,
        /// The given shape.
        found: String,
        /// The shape that the form needs.
        needed: String,
    },
    /// A constraint cannot be applied.
    #[error("constraint: {0}")]
    Constraint(String),
    /// The matrix is not positive definite: a material law or a missing constraint.
    #[error(
        "the matrix of {unknowns} unknowns is not positive definite ({detail}); hold the rigid motions and check the material constants"
    )]
    NotPositiveDefinite {
        /// Number of unknowns.
        unknowns: usize,
        /// Message of the factorisation.
        detail: String,
    },
    /// A solve left a residual that rounding cannot explain.
    #[error("backward error {backward_error:.3e} of a solve with {unknowns} unknowns exceeds {limit:.1e}: the factor is wrong")]
    Residual {
        /// Largest residual relative to |A| |x| + |b|.
        backward_error: f64,
        /// The limit.
        limit: f64,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// No time step is short enough.
    #[error("even steps of {step:e} s leave an error above {tolerance:e}; raise the tolerance")]
    Step {
        /// The tolerance.
        tolerance: f64,
        /// The smallest step tried \[s\].
        step: f64,
    },
}
