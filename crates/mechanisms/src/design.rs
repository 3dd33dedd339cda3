//! Places of a design at which mechanisms act.

use coil::{Contact, Design, Flange, Heater, Side};
use diagnosis::Active;

/// Temperature at which ∂n/∂T has its nominal value, and at which a read-out's temperature coefficient is zero \[°C\].
pub const REFERENCE_C: f64 = 20.0;

/// Sides of a design's flanges, in its order.
pub(crate) fn flanges(design: &Design) -> Vec<Side> {
    flanges_that(design, |_| true)
}

/// Sides of the flanges whose bond to the coil holds.
pub(crate) fn bonded_flanges(design: &Design) -> Vec<Side> {
    flanges_that(design, |flange| flange.contact == Contact::Bonded)
}

/// Sides of the flanges that may be heated: none in a design with heaters of its own.
pub(crate) fn heatable_flanges(design: &Design) -> Vec<Side> {
    flanges_that(design, |_| design.heat.heaters.is_empty())
}

fn flanges_that(design: &Design, may: impl Fn(&Flange) -> bool) -> Vec<Side> {
    let flanges = design.spool.iter().flat_map(|spool| &spool.flanges);
    flanges.filter(|flange| may(flange)).map(|flange| flange.side).collect()
}

/// The choice among flanges, counted from 1 in the design's order; none where there is but one.
pub(crate) fn choice_of(flanges: &[Side]) -> Option<(String, Vec<f64>)> {
    (flanges.len() > 1).then(|| ("flange".to_owned(), (1..=flanges.len()).map(|k| k as f64).collect()))
}

/// The place of the flange that was chosen, counted from 0.
pub(crate) fn chosen(active: &Active) -> usize {
    active.choice.map_or(0, |k| k as usize - 1)
}

/// The design with its drifts about [`REFERENCE_C`], if its own vanish there or nowhere.
pub(crate) fn drifts_about_reference(design: &Design) -> Option<Design> {
    let mut changed = design.clone();
    let drifts = &mut changed.drifts;
    let none = drifts.thermo_optic_curvature == 0.0 && drifts.read_out == 0.0;
    if !none && drifts.reference != REFERENCE_C {
        return None;
    }
    drifts.reference = REFERENCE_C;
    Some(changed)
}

/// The CW tail longer than the CCW tail by so much more \[m\].
pub(crate) fn with_tail(design: &Design, cw_minus_ccw: f64) -> Design {
    let mut changed = design.clone();
    changed.winding.tails.cw += cw_minus_ccw.max(0.0);
    changed.winding.tails.ccw += (-cw_minus_ccw).max(0.0);
    changed
}

/// Power in a flange \[W\].
pub(crate) fn with_heater(design: &Design, side: Side, power: f64) -> Design {
    let mut changed = design.clone();
    changed.heat.heaters.push(Heater { side, power });
    changed
}
