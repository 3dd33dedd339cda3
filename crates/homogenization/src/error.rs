//! What can go wrong in a homogenisation.

/// Errors of this crate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The cell's geometry is out of range.
    #[error(transparent)]
    Geometry(#[from] rve_mesh::Error),
    /// A constituent's constant is out of range.
    #[error("{constituent}: {source}")]
    Constituent {
        /// "ring 0", "ring 1", … from the inside, or "adhesive".
        constituent: String,
        /// What is wrong.
        source: fem_core::Error,
    },
    /// A constituent's conductivity is out of range.
    #[error("{constituent}: conductivity {value} W/(m K) must be finite and greater than 0")]
    Conductivity {
        /// "ring 0", "ring 1", … from the inside, or "adhesive".
        constituent: String,
        /// Its value.
        value: f64,
    },
    /// No ring is glass, so the dehomogenisation matrix has nothing to report on.
    #[error("no ring is glass; mark at least one so that the dehomogenisation matrix has a mean to report")]
    NoGlass,
    /// The mesh's phase areas differ from the exact ones.
    #[error("phase {phase}: the mesh covers {area:.9e} m², exact is {exact:.9e} m²; use a higher order or more sectors")]
    Area {
        /// Phase number from the inside.
        phase: usize,
        /// Area of the mesh \[m²\].
        area: f64,
        /// Exact area \[m²\].
        exact: f64,
    },
    /// The finite-element solution failed.
    #[error(transparent)]
    Solve(#[from] fem_core::Error),
}
