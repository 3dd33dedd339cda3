//! What is kept of the nominal model somewhere.

use crate::course::Parts;

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

/// How much of a series another one is: ⟨a, b⟩/⟨b, b⟩.
pub(super) fn share(a: &[f64], b: &[f64]) -> f64 {
    let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = of(b, b);
    if size > 0.0 { of(a, b) / size } else { 0.0 }
}
