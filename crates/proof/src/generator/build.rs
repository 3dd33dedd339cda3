//! Parts from which a unit is built.

use coil::Design;

/// Parts from which a unit is built: a design, and properties that a design does not hold.
#[derive(Clone)]
pub(super) struct Build {
    pub(super) design: Design,
    pub(super) softening: Option<Softening>,
    /// Relaxing share of the transverse moduli, and its time \[s\].
    pub(super) relaxing: Option<(f64, f64)>,
    /// Curvature of ∂n/∂T \[1/K²\].
    pub(super) curvature: f64,
    /// [deg/h per K].
    pub(super) read_out: f64,
    /// Delay of the thermometer \[s\].
    pub(super) lag: f64,
    /// Factor on the whole rate, as a mesh has it on a sensitivity.
    pub(super) gain: f64,
}

/// A logistic step of the transverse constants.
#[derive(Clone, Copy)]
pub(super) struct Softening {
    /// \[°C\]
    pub(super) at: f64,
    /// \[K\]
    pub(super) width: f64,
    /// Factor on E_r and G.
    pub(super) modulus: f64,
    /// Factor on α_r.
    pub(super) expansion: f64,
}

impl Build {
    pub(super) fn new(design: Design) -> Self {
        Self { design, softening: None, relaxing: None, curvature: 0.0, read_out: 0.0, lag: 0.0, gain: 1.0 }
    }

    /// Whether heat flows in `other` as it does here.
    pub(super) fn shares_heat(&self, other: &Self) -> bool {
        let of = |b: &Self| {
            (b.design.body, b.design.spool.clone(), b.design.surroundings, b.design.heat.clone(), b.design.mechanics.clone())
        };
        of(self) == of(other)
    }
}
