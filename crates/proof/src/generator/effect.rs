//! Effects that can be concealed: the families of the library, built straight into a design, with parameters at random.

use super::build::{Build, Softening};
use super::outside::Outside;
use super::random::Random;
use crate::truth::ConcealedEffect;
use coil::{Body, Heater, Mechanics, Mount, Opening, Side};
use winding::LayerDefect;

/// Fused silica: E \[Pa\], α \[1/K\], k \[W/(m K)\], ρc \[J/(m³ K)\].
const GLASS: [f64; 4] = [70.2e9, 0.55e-6, 1.38, 2200.0 * 740.0];
/// Share of polymer to which the design's constants belong.
const POLYMER: f64 = 0.80;
/// The flange of the reference coil.
const FLANGE: Side = Side::Right;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EffectFamily {
    Tail,
    Defect,
    Polymer,
    GlassTransition,
    Relaxation,
    Debond,
    HubResistance,
    Air,
    Mount,
    SelfHeating,
    SensorLag,
    Curvature,
    ReadOut,
}

impl EffectFamily {
    pub(super) const ALL: [Self; 13] = [
        Self::Tail,
        Self::Defect,
        Self::Polymer,
        Self::GlassTransition,
        Self::Relaxation,
        Self::Debond,
        Self::HubResistance,
        Self::Air,
        Self::Mount,
        Self::SelfHeating,
        Self::SensorLag,
        Self::Curvature,
        Self::ReadOut,
    ];

    /// Whether it is a law of stiffness or bonds, of which a unit has one.
    pub(super) fn is_law(self) -> bool {
        matches!(self, Self::GlassTransition | Self::Relaxation | Self::Debond)
    }
}

/// Something concealed, with its parameters in the units of the truth files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Effect {
    Tail { m: f64 },
    Defect { layer: usize, turns: f64 },
    Polymer { change: f64 },
    GlassTransition { at: f64, width: f64, modulus: f64, expansion: f64 },
    Relaxation { fraction: f64, time: f64 },
    Debond { below: f64, hysteresis: f64, fraction: f64 },
    HubResistance { resistance: f64 },
    Air { factor: f64 },
    Mount { conductance: f64 },
    SelfHeating { power: f64 },
    SensorLag { time: f64 },
    Curvature { per_k2: f64 },
    ReadOut { per_k: f64 },
    Outside(Outside),
}

impl Effect {
    /// A member of the family; its size is to be scaled.
    pub(super) fn draw(family: EffectFamily, random: &mut Random) -> Self {
        match family {
            EffectFamily::Tail => Self::Tail { m: 0.05 * random.sign() },
            EffectFamily::Defect => Self::Defect { layer: 1 + random.below(36), turns: random.sign() },
            EffectFamily::Polymer => Self::Polymer { change: 0.005 * random.sign() },
            EffectFamily::GlassTransition => Self::GlassTransition {
                at: random.uniform(-20.0, 40.0),
                width: random.log_uniform(2.0, 8.0),
                modulus: random.uniform(0.7, 0.95),
                expansion: random.uniform(1.0, 1.1),
            },
            EffectFamily::Relaxation => Self::Relaxation { fraction: 0.1, time: random.log_uniform(700.0, 15000.0) },
            EffectFamily::Debond => Self::Debond {
                below: random.uniform(-28.0, 12.0),
                hysteresis: random.log_uniform(2.0, 12.0),
                fraction: random.log_uniform(0.04, 0.7),
            },
            EffectFamily::HubResistance => Self::HubResistance { resistance: 2e-4 },
            EffectFamily::Air => Self::Air { factor: (0.02 * random.sign()).exp() },
            EffectFamily::Mount => Self::Mount { conductance: 0.1 },
            EffectFamily::SelfHeating => Self::SelfHeating { power: 0.01 },
            EffectFamily::SensorLag => Self::SensorLag { time: 5.0 },
            EffectFamily::Curvature => Self::Curvature { per_k2: 1e-8 * random.sign() },
            EffectFamily::ReadOut => Self::ReadOut { per_k: 2e-4 * random.sign() },
        }
    }

    /// The same with its size multiplied, within what a unit can have; `None` where the size is no matter of degree.
    pub(super) fn scaled(self, by: f64) -> Option<Self> {
        let within = |x: f64, most: f64| (by * x).clamp(-most, most);
        Some(match self {
            Self::Tail { m } => Self::Tail { m: within(m, 1.5) },
            Self::Defect { layer, turns } => {
                Self::Defect { layer, turns: within(turns, 8.0).abs().round().max(1.0) * turns.signum() }
            }
            Self::Polymer { change } => Self::Polymer { change: within(change, 0.06) },
            Self::GlassTransition { at, width, modulus, expansion } => {
                let step = |x: f64| 1.0 + by * (x - 1.0);
                Self::GlassTransition { at, width, modulus: step(modulus).max(0.3), expansion: step(expansion).min(1.25) }
            }
            Self::Relaxation { fraction, time } => Self::Relaxation { fraction: within(fraction, 0.6), time },
            Self::Debond { .. } => return None,
            Self::HubResistance { resistance } => Self::HubResistance { resistance: within(resistance, 5e-3) },
            Self::Air { factor } => Self::Air { factor: within(factor.ln(), 0.4).exp() },
            Self::Mount { conductance } => Self::Mount { conductance: within(conductance, 8.0) },
            Self::SelfHeating { power } => Self::SelfHeating { power: within(power, 1.0) },
            Self::SensorLag { time } => Self::SensorLag { time: within(time, 90.0) },
            Self::Curvature { per_k2 } => Self::Curvature { per_k2: within(per_k2, 1e-6) },
            Self::ReadOut { per_k } => Self::ReadOut { per_k: within(per_k, 0.01) },
            Self::Outside(outside) => Self::Outside(Outside { size: by * outside.size, ..outside }),
        })
    }

    pub(super) fn build_into(&self, build: &mut Build) {
        let design = &mut build.design;
        match *self {
            Self::Tail { m } if m > 0.0 => design.winding.tails.cw += m,
            Self::Tail { m } => design.winding.tails.ccw -= m,
            Self::Defect { layer, turns } => design.winding.defect = Some(LayerDefect { layer, turns: turns as i32 }),
            Self::Polymer { change } => polymer(&mut design.body, POLYMER + change),
            Self::GlassTransition { at, width, modulus, expansion } => {
                build.softening = Some(Softening { at, width, modulus, expansion });
            }
            Self::Relaxation { fraction, time } => build.relaxing = Some((fraction, time)),
            Self::Debond { below, hysteresis, fraction } => {
                design.mechanics = Mechanics::Opening(Opening { side: FLANGE, below, hysteresis, fraction });
            }
            Self::HubResistance { resistance } => design.heat.hub_resistance += resistance,
            Self::Air { factor } => design.surroundings.conductivity *= factor,
            Self::Mount { conductance } => design.heat.mounts.push(Mount { side: FLANGE, conductance }),
            Self::SelfHeating { power } => design.heat.heaters.push(Heater { side: FLANGE, power }),
            Self::SensorLag { time } => build.lag += time,
            Self::Curvature { per_k2 } => build.curvature += per_k2,
            Self::ReadOut { per_k } => build.read_out += per_k,
            Self::Outside(_) => {}
        }
    }

    /// As the truth files name it.
    pub(super) fn mechanism(&self) -> ConcealedEffect {
        let (id, parameters): (&str, &[(&str, f64)]) = match self {
            Self::Tail { m } => ("tail-asymmetry", &[("tail_m", *m)]),
            Self::Defect { layer, turns } => ("winding-defect", &[("layer", *layer as f64), ("turns", *turns)]),
            Self::Polymer { change } => ("adhesive-content", &[("polymer_fraction_change", *change)]),
            Self::GlassTransition { at, width, modulus, expansion } => (
                "glass-transition",
                &[("tg_c", *at), ("width_k", *width), ("e_r_factor", *modulus), ("alpha_r_factor", *expansion)],
            ),
            Self::Relaxation { fraction, time } => {
                ("viscoelastic-relaxation", &[("relaxing_fraction", *fraction), ("tau_s", *time)])
            }
            Self::Debond { below, hysteresis, fraction } => {
                ("debond", &[("debond_c", *below), ("hysteresis_k", *hysteresis), ("fraction", *fraction)])
            }
            Self::HubResistance { resistance } => ("interface-resistance", &[("resistance_m2k_per_w", *resistance)]),
            Self::Air { factor } => ("air-path", &[("conductivity_factor", *factor)]),
            Self::Mount { conductance } => ("axial-heat-path", &[("conductance_w_per_m2k", *conductance)]),
            Self::SelfHeating { power } => ("self-heating", &[("power_w", *power)]),
            Self::SensorLag { time } => ("sensor-lag", &[("lag_s", *time)]),
            Self::Curvature { per_k2 } => ("thermo-optic-curvature", &[("curvature_per_k2", *per_k2)]),
            Self::ReadOut { per_k } => ("rate-temperature-coefficient", &[("coefficient_deg_per_h_per_k", *per_k)]),
            Self::Outside(outside) => return outside.mechanism(),
        };
        ConcealedEffect { id: id.into(), parameters: parameters.iter().map(|(name, value)| ((*name).into(), *value)).collect() }
    }
}

/// Rules of mixtures for another share of polymer, whose constants are those that give the design's at [`POLYMER`].
fn polymer(body: &mut Body, share: f64) {
    let [glass_e, glass_alpha, glass_k, glass_c] = GLASS;
    let (old, e) = (POLYMER, &mut body.elastic);
    let e_p = (e.e_z - (1.0 - old) * glass_e) / old;
    let alpha_p = (e.alpha_z * e.e_z - (1.0 - old) * glass_e * glass_alpha) / (old * e_p);
    let resistivity = (1.0 / body.conductivity_r - (1.0 - old) / glass_k) / old;
    let stored = (body.density * body.specific_heat - (1.0 - old) * glass_c) / old;
    e.e_z = (1.0 - share) * glass_e + share * e_p;
    e.alpha_z = ((1.0 - share) * glass_e * glass_alpha + share * e_p * alpha_p) / e.e_z;
    (e.e_r, e.g_zr) = (e.e_r * old / share, e.g_zr * old / share);
    e.alpha_r *= share / old;
    body.conductivity_r = 1.0 / ((1.0 - share) / glass_k + share * resistivity);
    body.specific_heat = ((1.0 - share) * glass_c + share * stored) / body.density;
}
