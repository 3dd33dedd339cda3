//! ∂n/∂T that depends on temperature.

use crate::design::drifts_about_reference;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady};
use diagnosis::Prior;

pub(super) const THERMO_OPTIC_CURVATURE: Named = Named {
    id: "thermo-optic-curvature",
    title: "∂n/∂T that depends on temperature",
    stage: Stage::Optics,
    equation: "∂n/∂T = nominal + b (T − 20 °C), with the local temperature of every turn.",
    place: "The optics: `drifts.thermo_optic_curvature_per_k2`.",
    signature: "The Shupe part is scaled with temperature. In steady ramps, where that part is zero, nothing changes, and elsewhere little. Transients far from\n\
        20 °C show the effect.",
    source: "D. B. Leviton and B. J. Frey, *Proc. SPIE* 6273, 62732K (2006), for fused silica.",
    meaning: "the fibre's dn/dT depends on temperature",
    inspection: "measure the fibre's dn/dT at both ends of the range",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("dn/dT changes alike along the fibre where the temperature is even, and cancels")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, _| Some(Offer::one("curvature_per_k2", Prior::Size { scale: 6e-8 }, &[0.0])),
    effect: |_, record, active| {
        let zero = vec![0.0; record.time.len()];
        let shupe = record.curved.iter().map(|c| active.values[0] * c).collect();
        Ok(Effect::Coil(Change::of_parts([shupe, zero.clone(), zero])))
    },
    extended: |design, active| {
        let mut changed = drifts_about_reference(design)?;
        changed.drifts.thermo_optic_curvature += active.values[0];
        Some(changed)
    },
};
