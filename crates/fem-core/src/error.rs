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
    /// A region has no entry among the laws.
    #[error("region {laws} has no law: {laws} {} for {regions} regions; give each region an entry, `None` where it takes no part", plural(*laws, "law"))]
    MissingLaw {
        /// Number of entries.
        laws: usize,
        /// Number of regions of the mesh.
        regions: usize,
    },
    /// The matrix of constants of a region has the wrong shape.
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
    /// A map was made for another form or another mesh.
    #[error(
        "the map has {found} unknowns, this form on this mesh has {needed}; make its `Constraints` with {needed} unknowns, \
         {components} for each node"
    )]
    Map {
        /// Unknowns of the map.
        found: usize,
        /// Unknowns of the form on the mesh.
        needed: usize,
        /// Unknowns of the form at each node.
        components: usize,
    },
    /// A body of revolution reaches its axis, where nothing keeps it from moving off.
    #[error("node {node} lies on the axis and its u_r is free; hold u_r there with `Constraints::hold_axis`")]
    Axis {
        /// Number of the node.
        node: usize,
    },
    /// An integral over the edges of elements cannot be taken.
    #[error("edges: {0}")]
    Edges(String),
    /// A quadrature has no point.
    #[error("points = 0, but a quadrature needs at least 1; give the mesh's order plus 1")]
    NoPoints,
    /// The matrix is not positive definite: a material law or a missing constraint.
    #[error(
        "the matrix of {unknowns} unknowns is not positive definite ({detail}); hold the rigid motions (of heat: a temperature, or give a surface that \
         exchanges it), check the material constants, and take at least one Gauss point more than the order"
    )]
    NotPositiveDefinite {
        /// Number of unknowns.
        unknowns: usize,
        /// Message of the factorisation.
        detail: String,
    },
    /// A solve left a residual that rounding cannot explain, or gave a number that is not finite.
    #[error("{}", residual(*backward_error, *limit, *unknowns))]
    Residual {
        /// Largest residual relative to |A| |x| + |b|; NaN if it is not finite.
        backward_error: f64,
        /// The limit.
        limit: f64,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// A load, a state, a matrix or a number of steps in time has the wrong size, or is outside its range.
    #[error("{0}")]
    Argument(String),
    /// No time step is short enough.
    #[error("even steps of {step:e} s leave an error above {tolerance:e}; raise the tolerance")]
    Step {
        /// The tolerance.
        tolerance: f64,
        /// The smallest step tried \[s\].
        step: f64,
    },
}

impl Error {
    /// An error if a vector, `name`, has not one entry for each of so many unknowns.
    pub(crate) fn check_length(name: &str, vector: &[f64], unknowns: usize) -> Result<(), Self> {
        if vector.len() == unknowns {
            return Ok(());
        }
        let (found, noun) = (vector.len(), plural(unknowns, "unknown"));
        Err(Self::Argument(format!(
            "the {name} has a length of {found}, the system has {unknowns} {noun}; give one entry for each"
        )))
    }
}

/// The text of [`Error::Residual`].
fn residual(backward_error: f64, limit: f64, unknowns: usize) -> String {
    let noun = plural(unknowns, "unknown");
    if backward_error.is_nan() {
        return format!(
            "a solve with {unknowns} {noun} gave a number that is not finite: its load has one, or is too large; check the load"
        );
    }
    format!("backward error {backward_error:.3e} of a solve with {unknowns} {noun} exceeds {limit:.1e}: the factor is wrong")
}

/// The noun of a count.
fn plural(count: usize, noun: &str) -> String {
    if count == 1 { noun.into() } else { format!("{noun}s") }
}
