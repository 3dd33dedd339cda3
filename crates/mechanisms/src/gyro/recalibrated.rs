//! Parts of the nominal model that are kept at a point.

use std::sync::OnceLock;

use crate::course::{Parts, product};
use crate::record_to_bias::Prepared;

/// The nominal model with its uncertain numbers somewhere.
pub(super) struct Recalibrated {
    pub(super) record: usize,
    /// the uncertain numbers
    pub(super) at: Vec<f64>,
    /// but for the tails'
    pub(super) parts: Parts,
    /// what the tails' difference adds
    pub(super) of_tails: Parts,
    pub(super) thermometer: Vec<f64>,
    /// share of every nominal part in `parts`
    pub(super) gain: [f64; 3],
    /// factor of every part beside what the constants do
    pub(super) factors: [f64; 3],
    /// the same as far as the temperatures make it, for who asks
    pub(super) by_heat: OnceLock<ByHeat>,
}

/// Parts with those constants moved that change the temperatures, and no other: these change what every turn adds alike, the others what one turn adds
/// over another.
pub(super) struct ByHeat {
    pub(super) parts: Parts,
    pub(super) gain: [f64; 3],
}

/// Share of a part of the nominal bias in a change: ⟨change, part⟩/⟨part, part⟩, as far as that part is more than the tolerances make of it. A winding
/// that cancels nearly leaves a part of which no change is a share.
pub(super) fn share(change: &[f64], record: &Prepared, part: usize) -> f64 {
    let certain = record.squares[part] + record.spread[part];
    if certain > 0.0 { product(change, &record.nominal.parts[part]) / certain } else { 0.0 }
}
