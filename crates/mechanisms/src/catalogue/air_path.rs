//! Surroundings that conduct heat better or worse than still air.

use crate::interpolation::nodes;
use crate::mechanism::{Effect, Extent, HeatPath, Named, Offer, Stage, Steady};
use coil::{Design, Parameter};
use diagnosis::Prior;

pub(crate) const ID: &str = "air-path";

pub(super) const AIR_PATH: Named = Named {
    id: ID,
    title: "Surroundings that conduct better or worse",
    stage: Stage::Thermal,
    equation: "The conductivity of the medium around the coil is k = f k_air: convection, another gas, another gap.",
    place: "The heat flow: `surroundings.medium`.",
    signature: "Coil and spool follow the chamber faster or slower, and both channels shift in time. A mount that is coupled to the chamber does nearly the\n\
        same from one side. Only the difference between the two faces tells them apart; fast changes make it large.",
    source: "F. P. Incropera and D. P. DeWitt, *Fundamentals of Heat and Mass Transfer*, Wiley, ch. 9; H. S. Carslaw and J. C. Jaeger, *Conduction of Heat in Solids*, 2nd ed., Oxford (1959), ch. 1.",
    meaning: "the surroundings conduct heat better or worse than designed, by conductivity_factor",
    inspection: "measure the gap to the chamber wall (surroundings.margin_mm): a factor below one acts like a wider gap; then stop the fan, or change the gas",
    columns: &[],
    heat_path: Some(|| HeatPath {
        places: |design| usize::from(applies(design)),
        nodes: nodes(-FARTHEST, FARTHEST, 17),
        design: |design, _, x| with_air(design, x.exp()),
        coordinate: None,
        nowhere: 1.0,
        nudge: Some(coordinate(1.02)),
        factor_on: Some(Parameter::MediumConductivity),
        imitates: Some(moving),
    }),
    steady: &[Steady::Design(with_air)],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        applies(design)
            .then(|| Offer::one("conductivity_factor", Prior::LogNormal { median: 1.0, spread: SPREAD }, &[0.4, 1.0, 2.5]))
    },
    effect: |chain, record, active| Ok(Effect::Coil(chain.along(record, ID, 0, coordinate(active.values[0])))),
    extended: |design, active| Some(with_air(design, active.values[0])),
};

/// Spread of ln of the factor: convection in a gap of centimetres may double what still gas conducts or more, a thinner or a heavier gas halve it.
const SPREAD: f64 = 0.6;
/// Largest |ln of the factor| that is modelled, four spreads.
const FARTHEST: f64 = 4.0 * SPREAD;

fn applies(design: &Design) -> bool {
    // a film takes the place of the still medium
    design.heat.film.is_none()
}

/// Coordinate in which the response is smooth.
pub(crate) fn coordinate(factor: f64) -> f64 {
    factor.max(1e-3).ln()
}

/// Air that moves: a film that conducts as much over the gap, on every surface alike, where still air conducts more past edges.
fn moving(design: &Design, factor: f64) -> String {
    let still = &design.surroundings;
    format!("air that moves, drawn as heat.film_w_per_m2k: Some({:.1})", factor * still.conductivity / still.margin)
}

/// Surroundings that conduct better by a factor.
fn with_air(design: &Design, factor: f64) -> Design {
    let mut changed = design.clone();
    changed.surroundings.conductivity *= factor;
    changed
}
