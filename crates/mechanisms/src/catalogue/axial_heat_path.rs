//! A flange whose outer face exchanges heat with the chamber through its mount.

use crate::design::flange;
use crate::interpolation::nodes;
use crate::mechanism::{Effect, Extent, HeatPath, Named, Offer, Stage, Steady};
use coil::{Design, Mount};
use diagnosis::Prior;

const ID: &str = "axial-heat-path";

pub(super) const AXIAL_HEAT_PATH: Named = Named {
    id: ID,
    title: "A flange that is coupled to its mount",
    stage: Stage::Thermal,
    equation: "The outer face of the flange exchanges h (T_chamber − T) with the chamber, per area.",
    place: "The heat flow: `heat.mounts`.",
    signature: "Like better conducting surroundings, but from one face: the coil is warmed unevenly along its axis, which a practical quadrupole feels.",
    source: "F. P. Incropera and D. P. DeWitt, *Fundamentals of Heat and Mass Transfer*, Wiley, ch. 3.",
    meaning: "the flange's outer face exchanges heat with the chamber through its mount",
    inspection: "repeat the test with the flange insulated from its mount",
    heat_path: Some(|| HeatPath {
        applies,
        nodes: nodes(0.0, 0.9, 12),
        design: |design, x| with_mount(design, CONDUCTANCE * x / (1.0 - x)),
        nudge: Some(coordinate(0.1)),
        factor_on: None,
    }),
    steady: &[Steady::Design(with_mount)],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        applies(design).then(|| Offer::one("conductance_w_per_m2k", Prior::LogNormal { median: 1.5, spread: 1.2 }, &[0.5, 4.0]))
    },
    effect: |chain, record, active| Ok(Effect::Coil(chain.along(record, ID, coordinate(active.values[0])))),
    extended: |design, active| Some(with_mount(design, active.values[0])),
};

/// Conductance at which the coordinate is one half [W/(m² K)].
const CONDUCTANCE: f64 = 2.0;

fn applies(design: &Design) -> bool {
    flange(design).is_some() && design.heat.mounts.is_empty()
}

/// Coordinate in which the response is smooth.
fn coordinate(conductance: f64) -> f64 {
    conductance.max(0.0) / (conductance.max(0.0) + CONDUCTANCE)
}

/// The outer face of the first flange coupled to the chamber [W/(m² K)].
fn with_mount(design: &Design, conductance: f64) -> Design {
    let mut changed = design.clone();
    if let Some(side) = flange(design).filter(|_| conductance > 0.0) {
        changed.heat.mounts.push(Mount { side, conductance });
    }
    changed
}
