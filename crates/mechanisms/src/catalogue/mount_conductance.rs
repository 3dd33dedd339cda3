//! A mount of the drawing that couples its flange better or worse than it is drawn.

use crate::design::{choice_of, chosen, flanges};
use crate::interpolation::nodes;
use crate::mechanism::{Effect, Extent, HeatPath, Named, Offer, Stage, Steady};
use coil::{Design, Side};
use diagnosis::Prior;

const ID: &str = "mount-conductance";

pub(super) const MOUNT_CONDUCTANCE: Named = Named {
    id: ID,
    title: "A mount that couples better or worse than drawn",
    stage: Stage::Thermal,
    equation: "The outer face of the mounted flange exchanges f h (T_chamber − T) with the chamber, per area; h is the drawing's.",
    place: "The heat flow: `heat.mounts`.",
    signature: "As that of `axial-heat-path`, of either sign: the coil is warmed from its mount more or less than drawn, and follows the chamber faster or\n\
        slower. A plate that follows the chamber late, which the model does not know, resembles a factor below one.",
    source: "C. V. Madhusudana, *Thermal Contact Conductance*, Springer (1996).",
    meaning: "the mount couples its flange to the chamber by a factor better or worse than drawn: its screws, its surface, what lies between",
    inspection: "read the temperature of the plate beside the flange; then look at the torque of the screws and what lies between",
    columns: &[],
    heat_path: Some(|| HeatPath {
        places: |design| mounted(design).len(),
        nodes: nodes(-FARTHEST, FARTHEST, 17),
        design: |design, place, x| with_factor(design, place, x.exp()),
        coordinate: Some(coordinate),
        nowhere: 1.0,
        nudge: Some(coordinate(1.1)),
        factor_on: None,
        imitates: None,
    }),
    steady: &[Steady::Design(|design, factor| with_factor(design, 0, factor))],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        let prior = Prior::LogNormal { median: 1.0, spread: SPREAD };
        let offer = || Offer { choice: choice(design), ..Offer::one("mount_factor", prior, &[0.3, 1.0, 3.0]) };
        (!mounted(design).is_empty()).then(offer)
    },
    effect: |chain, record, active| Ok(Effect::Coil(chain.along(record, ID, chosen(active), coordinate(active.values[0])))),
    extended: |design, active| Some(with_factor(design, chosen(active), active.values[0])),
};

/// Spread of ln of the factor: a screwed joint conducts two to three times as much or as little by torque, flatness, and grease or air between its faces.
const SPREAD: f64 = 0.9;
/// Largest |ln of the factor| that is modelled, three spreads.
const FARTHEST: f64 = 3.0 * SPREAD;

/// Sides that have a mount, those of flanges in the design's order.
fn mounted(design: &Design) -> Vec<Side> {
    let has_mount = |side: &Side| design.heat.mounts.iter().any(|mount| mount.side == *side);
    let of_flanges: Vec<Side> = flanges(design).into_iter().filter(has_mount).collect();
    let all: Vec<Side> = [Side::Left, Side::Right].into_iter().filter(has_mount).collect();
    if all.len() == of_flanges.len() { of_flanges } else { all }
}

/// The choice among mounts: of flanges, or from the left where an end without a flange is mounted.
fn choice(design: &Design) -> Option<(String, Vec<f64>)> {
    let sides = mounted(design);
    let (name, values) = choice_of(&sides)?;
    let bare = sides.iter().any(|side| !flanges(design).contains(side));
    Some((if bare { "mount_from_left".to_owned() } else { name }, values))
}

/// Coordinate in which the response is smooth.
fn coordinate(factor: f64) -> f64 {
    factor.max(1e-3).ln()
}

/// The mount of a side with its conductance changed by a factor.
fn with_factor(design: &Design, place: usize, factor: f64) -> Design {
    let mut changed = design.clone();
    if let Some(side) = mounted(design).get(place) {
        changed.heat.mounts.iter_mut().filter(|mount| mount.side == *side).for_each(|mount| mount.conductance *= factor);
    }
    changed
}
