//! Parts of the nominal model that are kept at a point.

use crate::course::{Parts, product};

/// The nominal model with its uncertain numbers somewhere.
pub(super) struct Recalibrated {
    pub(super) record: usize,
    /// the uncertain numbers
    pub(super) at: Vec<f64>,
    pub(super) parts: Parts,
    pub(super) thermometer: Vec<f64>,
    /// share of every nominal part in these
    pub(super) gain: [f64; 3],
}

/// Share of a second series, the sum of whose squares is known, in the first: ⟨a, b⟩/⟨b, b⟩.
pub(super) fn share(a: &[f64], b: &[f64], squares: f64) -> f64 {
    if squares > 0.0 { product(a, b) / squares } else { 0.0 }
}
