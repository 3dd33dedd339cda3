//! Surroundings that conduct heat better or worse than still air.

use crate::interpolation::nodes;
use crate::mechanism::{Effect, Extent, Facts, HeatPath, Mechanism, Naming, Offer, Stage, Steady};
use crate::{Chain, Prepared};
use coil::{Design, Error, MechanicalState};
use diagnosis::{Active, Prior};

pub(crate) const ID: &str = "air-path";

pub(super) struct AirPath;

impl Mechanism for AirPath {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "Surroundings that conduct better or worse",
            stage: Stage::Thermal,
            equation: "The conductivity of the medium around the coil is k = f k_air: convection, another gas, another gap.",
            place: "The heat flow: `surroundings.medium`.",
            signature: "Coil and spool follow the chamber faster or slower: both channels shift in time. A mount that is coupled to the chamber does nearly the same, from one\n\
                side; only the difference between the two faces tells them, which fast changes make large.",
            source: "F. P. Incropera and D. P. DeWitt, *Fundamentals of Heat and Mass Transfer*, Wiley, ch. 9; H. S. Carslaw and J. C. Jaeger, *Conduction of Heat in Solids*, 2nd ed., Oxford (1959), ch. 1.",
            naming: Naming::Named {
                meaning: "the surroundings conduct heat better or worse than designed, by conductivity_factor",
                inspection: "repeat the test in vacuum or in another gas",
            },
            heat_path: Some(HeatPath {
                applies,
                nodes: nodes(-0.9, 0.9, 9),
                nominal: 0.0,
                design: |design, x| with_air(design, x.exp()),
                nudge: Some(coordinate(1.02)),
            }),
            steady: vec![Steady::Changes { parameter: 0, changed: |d, x| (with_air(d, x), MechanicalState::NOMINAL), when: "" }],
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, design: &Design, _: [f64; 2]) -> Option<Offer> {
        applies(design).then(|| Offer::one("conductivity_factor", Prior::LogNormal { median: 1.0, spread: 0.2 }, &[1.0]))
    }

    fn effect(&self, chain: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        Ok(Effect::Coil(chain.along(record, ID, coordinate(active.values[0]))))
    }

    fn extended(&self, design: &Design, active: &Active) -> Option<Design> {
        Some(with_air(design, active.values[0]))
    }
}

fn applies(design: &Design) -> bool {
    // a film takes the place of the still medium
    design.heat.film.is_none()
}

/// Coordinate in which the response is smooth.
pub(crate) fn coordinate(factor: f64) -> f64 {
    factor.max(1e-3).ln()
}

/// Surroundings that conduct better by a factor.
fn with_air(design: &Design, factor: f64) -> Design {
    let mut changed = design.clone();
    changed.surroundings.conductivity *= factor;
    changed
}
