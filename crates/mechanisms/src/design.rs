//! Places of a design at which mechanisms act.

use coil::{Contact, Design, Heater, Side};

/// Temperature at which ∂n/∂T has its nominal value, and at which a read-out's temperature coefficient is zero \[°C\].
pub const REFERENCE_C: f64 = 20.0;

/// The first flange whose bond to the coil holds.
pub(crate) fn bonded_flange(design: &Design) -> Option<Side> {
    let flanges = &design.spool.as_ref()?.flanges;
    flanges.iter().find(|f| f.contact == Contact::Bonded).map(|f| f.side)
}

pub(crate) fn flange(design: &Design) -> Option<Side> {
    design.spool.as_ref()?.flanges.first().map(|f| f.side)
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

/// Whether a design has a flange to heat, and no heater of its own.
pub(crate) fn can_be_heated(design: &Design) -> bool {
    flange(design).is_some() && design.heat.heaters.is_empty()
}

/// Power in the first flange \[W\].
pub(crate) fn with_heater(design: &Design, power: f64) -> Design {
    let mut changed = design.clone();
    if let Some(side) = flange(design) {
        changed.heat.heaters.push(Heater { side, power });
    }
    changed
}
