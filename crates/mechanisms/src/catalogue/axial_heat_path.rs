//! A flange whose outer face exchanges heat with the chamber through its mount.

use crate::design::{choice_of, chosen, flanges};
use crate::interpolation::nodes;
use crate::mechanism::{Effect, Extent, HeatPath, Named, Offer, Stage, Steady};
use coil::{Design, Mount, Side};
use diagnosis::Prior;

const ID: &str = "axial-heat-path";

pub(super) const AXIAL_HEAT_PATH: Named = Named {
    id: ID,
    title: "A flange that is coupled to its mount",
    stage: Stage::Thermal,
    equation: "The outer face of the flange exchanges h (T_chamber − T) with the chamber, per area.",
    place: "The heat flow: `heat.mounts`.",
    signature: "The effect resembles that of better conducting surroundings, but from one face. The coil is warmed unevenly along its axis, and a practical\n\
        quadrupole is sensitive to that.",
    source: "F. P. Incropera and D. P. DeWitt, *Fundamentals of Heat and Mass Transfer*, Wiley, ch. 3.",
    meaning: "the flange's outer face exchanges heat with the chamber through its mount",
    inspection: "repeat the test with the flange insulated from its mount",
    columns: &[],
    heat_path: Some(|| HeatPath {
        places: |design| sides(design).len(),
        nodes: nodes(0.0, 0.99, 16),
        design: |design, place, x| with_mount(design, place, CONDUCTANCE * x / (1.0 - x)),
        coordinate: Some(coordinate),
        nowhere: 0.0,
        nudge: Some(coordinate(0.1)),
        factor_on: None,
        imitates: None,
    }),
    steady: &[Steady::Design(|design, conductance| with_mount(design, 0, conductance))],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        let (prior, sides) = (Prior::LogNormal { median: 10.0, spread: SPREAD }, sides(design));
        let offer = || Offer { choice: choice_of(&sides), ..Offer::one("conductance_w_per_m2k", prior, &[0.5, 4.0, 30.0]) };
        (!sides.is_empty()).then(offer)
    },
    effect: |chain, record, active| Ok(Effect::Coil(chain.along(record, ID, chosen(active), coordinate(active.values[0])))),
    extended: |design, active| Some(with_mount(design, chosen(active), active.values[0])),
};

/// Conductance at which the coordinate is one half [W/(m² K)]: that of two millimetres of air.
const CONDUCTANCE: f64 = 12.0;
/// Spread of ln of the conductance, about that of a plastic post or of air in a gap of some millimetres: from a flange that hangs free, 1 W/(m² K) and
/// less, to one that is screwed to metal through a washer, 100 W/(m² K) and more.
const SPREAD: f64 = 1.4;

/// Flanges that may be coupled: none in a design with mounts of its own.
fn sides(design: &Design) -> Vec<Side> {
    if design.heat.mounts.is_empty() { flanges(design) } else { Vec::new() }
}

/// Coordinate in which the response is smooth.
fn coordinate(conductance: f64) -> f64 {
    conductance.max(0.0) / (conductance.max(0.0) + CONDUCTANCE)
}

/// The outer face of a flange coupled to the chamber [W/(m² K)].
fn with_mount(design: &Design, place: usize, conductance: f64) -> Design {
    let mut changed = design.clone();
    if let Some(side) = flanges(design).get(place).filter(|_| conductance > 0.0) {
        changed.heat.mounts.push(Mount { side: *side, conductance });
    }
    changed
}
