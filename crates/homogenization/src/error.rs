//! Errors of a homogenisation.

/// Errors of this crate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The cell's geometry is out of range.
    #[error(transparent)]
    Geometry(#[from] rve_mesh::Error),
    /// The arrangement of inclusions is out of range.
    #[error(transparent)]
    Layout(#[from] rve_mesh::LayoutError),
    /// A constituent's constant is out of range.
    #[error("{constituent}: {source}")]
    Constituent {
        /// "ring 0 (glass)", "ring 1 (coating)", … from the inside, or "adhesive".
        constituent: String,
        /// The fault.
        source: fem_core::Error,
    },
    /// A constituent's conductivity, density or specific heat is out of range.
    #[error("{constituent}: {what} {value} {unit} must be finite and greater than 0")]
    Property {
        /// "ring 0 (glass)", "ring 1 (coating)", … from the inside, or "adhesive".
        constituent: String,
        /// The property.
        what: &'static str,
        /// Its unit.
        unit: &'static str,
        /// Its value.
        value: f64,
    },
    /// The accuracy that is asked for is not a number, or negative.
    #[error("relative_error = {0}, but it must be 0 or more; `TOLERANCE` is 1e-6")]
    Tolerance(f64),
    /// A layout names a phase that the cell does not have.
    #[error("{place} names phase {phase}, there are {phases}, numbered from 0; add its material, or name another phase")]
    NoPhase {
        /// "inclusion 0", … or "the matrix".
        place: String,
        /// The number that is named.
        phase: usize,
        /// Number of phases.
        phases: usize,
    },
    /// A solution by multipoles failed.
    #[error("multipoles up to order {order}: {detail}")]
    Multipoles {
        /// Highest order.
        order: usize,
        /// The fault.
        detail: String,
    },
    /// The constants cannot be computed to the accuracy that was asked for.
    #[error(
        "{constant} cannot be computed to a relative error of {requested:.1e}: the best estimate reached is {reached:.1e}, with \
         {with}; {why}"
    )]
    Accuracy {
        /// The least accurate constant.
        constant: &'static str,
        /// Accuracy that was asked for.
        requested: f64,
        /// Accuracy that was reached.
        reached: f64,
        /// Effort with which it was reached: "multipoles up to order 41", "318 elements of order 12".
        with: String,
        /// The obstacle, and the remedy.
        why: String,
    },
    /// No ring is glass, so the dehomogenisation matrix has nothing to report on.
    #[error("no ring is glass; mark at least one so that the dehomogenisation matrix has a mean to report")]
    NoGlass,
    /// The mesh's phase areas differ from the exact ones.
    #[error("{name}: the mesh covers {area:.9e} m², exact is {exact:.9e} m²; use a higher order or more sectors")]
    Area {
        /// Phase number from the inside.
        phase: usize,
        /// Name of the phase.
        name: String,
        /// Area of the mesh \[m²\].
        area: f64,
        /// Exact area \[m²\].
        exact: f64,
    },
    /// The finite-element solution failed.
    #[error(transparent)]
    Solve(#[from] fem_core::Error),
}

impl Error {
    /// Refuses an accuracy that no result can have.
    pub(crate) fn unless_accuracy(relative_error: f64) -> Result<(), Self> {
        if relative_error >= 0.0 { Ok(()) } else { Err(Self::Tolerance(relative_error)) }
    }

    pub(crate) fn conductivity(constituent: String, value: f64) -> Self {
        Self::Property { constituent, what: "conductivity", unit: "W/(m K)", value }
    }

    /// Error of an effective stiffness that no positive definite set of constituents can have.
    pub(crate) fn singular() -> Self {
        Self::Solve(fem_core::Error::NotPositiveDefinite { unknowns: 6, detail: "effective stiffness".into() })
    }
}
