//! The representative cell: a coated fibre on an orthocyclic (hexagonal) lattice in adhesive. All SI.

use fem_core::material::Isotropic;

/// An isotropic constituent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constituent {
    /// Elastic constants and expansion.
    pub elastic: Isotropic,
    /// Thermal conductivity \[W/(m K)\].
    pub conductivity: f64,
}

/// One concentric ring of the fibre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Outer radius \[m\].
    pub outer_radius: f64,
    /// What it is made of.
    pub constituent: Constituent,
    /// Whether it guides the light or belongs to the glass whose mean strain M reports.
    pub role: Role,
}

/// What a ring is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Glass: counted in the mean strain of the dehomogenisation matrix.
    Glass,
    /// Coating.
    Coating,
}

/// A fibre's rings from the inside out, in adhesive, at the lattice pitch.
#[derive(Debug, Clone, PartialEq)]
pub struct FibreCell {
    /// Distance between neighbouring fibre axes \[m\].
    pub pitch: f64,
    /// Rings from the inside out, at least one; the outermost stays inside `pitch / 2`.
    pub rings: Vec<Ring>,
    /// Fills the rest of the hexagon.
    pub adhesive: Constituent,
}
