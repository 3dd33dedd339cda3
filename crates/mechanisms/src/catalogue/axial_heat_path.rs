//! A flange whose outer face exchanges heat with the chamber through its mount.

use crate::design::flange;
use crate::interpolation::nodes;
use crate::mechanism::{Effect, Extent, Facts, HeatPath, Mechanism, Naming, Offer, Stage, Steady};
use crate::{Chain, Prepared};
use coil::{Design, Error, MechanicalState, Mount};
use diagnosis::{Active, Prior};

pub(crate) const ID: &str = "axial-heat-path";

pub(super) struct AxialHeatPath;

impl Mechanism for AxialHeatPath {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "A flange that is coupled to its mount",
            stage: Stage::Thermal,
            equation: "The outer face of the flange exchanges h (T_chamber − T) with the chamber, per area.",
            place: "The heat flow: `heat.mounts`.",
            signature: "Like better conducting surroundings, but from one face: the coil is warmed unevenly along its axis, which a practical quadrupole feels.",
            source: "F. P. Incropera and D. P. DeWitt, *Fundamentals of Heat and Mass Transfer*, Wiley, ch. 3.",
            naming: Naming::Named {
                meaning: "the flange's outer face exchanges heat with the chamber through its mount",
                inspection: "repeat the test with the flange insulated from its mount",
            },
            heat_path: Some(HeatPath {
                applies,
                nodes: nodes(0.0, 0.9, 12),
                nominal: 0.0,
                design: |design, x| with_mount(design, CONDUCTANCE * x / (1.0 - x)),
                nudge: Some(coordinate(0.1)),
            }),
            steady: vec![Steady::Changes {
                parameter: 0,
                changed: |d, x| (with_mount(d, x), MechanicalState::NOMINAL),
                when: "",
            }],
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, design: &Design, _: [f64; 2]) -> Option<Offer> {
        applies(design).then(|| Offer::one("conductance_w_per_m2k", Prior::LogNormal { median: 1.5, spread: 1.2 }, &[0.5, 4.0]))
    }

    fn effect(&self, chain: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        Ok(Effect::Coil(chain.along(record, ID, coordinate(active.values[0]))))
    }

    fn extended(&self, design: &Design, active: &Active) -> Option<Design> {
        Some(with_mount(design, active.values[0]))
    }
}

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
