//! A thermal contact resistance between hub and coil.

use crate::interpolation::nodes;
use crate::mechanism::{Effect, Extent, HeatPath, Named, Offer, Stage, Steady};
use coil::{Contact, Design};
use diagnosis::Prior;

const ID: &str = "interface-resistance";

pub(super) const INTERFACE_RESISTANCE: Named = Named {
    id: ID,
    title: "Contact resistance between hub and coil",
    stage: Stage::Thermal,
    equation: "A resistance R between hub and coil: the heat flux is q = ΔT/R across the interface.",
    place: "The heat flow: `heat.hub_resistance_m2k_per_w`.",
    signature: "The coil lags behind the hub. In a steady ramp the lag is constant, and the sensitivity does not change. Steps and turning points show the\n\
        lag.",
    source: "C. V. Madhusudana, *Thermal Contact Conductance*, Springer (1996).",
    meaning: "heat passes between hub and coil through a contact resistance",
    inspection: "heat the hub and record a thermometer on the coil's outer surface",
    columns: &[],
    heat_path: Some(|| HeatPath {
        places: |design| usize::from(applies(design)),
        nodes: nodes(0.0, 0.9, 11),
        design: |design, _, x| with_hub_resistance(design, RESISTANCE * x / (1.0 - x)),
        coordinate: Some(coordinate),
        nowhere: 0.0,
        nudge: Some(coordinate(2e-4)),
        factor_on: None,
        imitates: None,
    }),
    steady: &[Steady::Design(with_hub_resistance)],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        applies(design)
            .then(|| Offer::one("resistance_m2k_per_w", Prior::LogNormal { median: 7e-4, spread: SPREAD }, &[5e-4, 5e-3]))
    },
    effect: |chain, record, active| Ok(Effect::Coil(chain.along(record, ID, 0, coordinate(active.values[0])))),
    extended: |design, active| Some(with_hub_resistance(design, active.values[0])),
};

/// Resistance at which the coordinate is one half \[m² K/W\]: that of a tenth of a millimetre of air.
const RESISTANCE: f64 = 5e-3;
/// Spread of ln of the resistance, about that of some hundredths of a millimetre of air: from a joint that is glued well to one that has come off.
const SPREAD: f64 = 1.2;

fn applies(design: &Design) -> bool {
    design.spool.as_ref().is_some_and(|s| s.hub_contact == Contact::Bonded)
}

/// Coordinate in which the response is smooth.
fn coordinate(resistance: f64) -> f64 {
    resistance.max(0.0) / (resistance.max(0.0) + RESISTANCE)
}

/// More thermal resistance between hub and coil \[m² K/W\].
fn with_hub_resistance(design: &Design, resistance: f64) -> Design {
    let mut changed = design.clone();
    changed.heat.hub_resistance += resistance;
    changed
}
