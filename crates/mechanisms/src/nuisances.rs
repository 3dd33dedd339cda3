//! Channels of the recording, and what of the nominal model is uncertain.

use coil::Design;
use diagnosis::{Channel, NoisePrior, Nuisance, Parameter, Prior, Role};

// order of the nuisances
pub(crate) const GAIN: usize = 0;
pub(crate) const AIR: usize = 1;
pub(crate) const REST: usize = 2;
pub(crate) const MODULUS: usize = 3;
pub(crate) const ALPHA_R: usize = 4;
/// E_z, α_z, spool expansion
pub(crate) const LINEAR: usize = 5;
pub(crate) const CONDUCTIVITY: usize = 8;
pub(crate) const THERMO_OPTIC: usize = 9;
pub(crate) const SHUPE: usize = 10;

pub(crate) fn channels(averaging: f64) -> Vec<Channel> {
    let spool = NoisePrior { white: (0.012, 0.5), drift: (0.004, 0.8), drift_time: (3000.0, 0.8), walk: (1e-6, 1.5) };
    let rate = NoisePrior { white: (0.008, 0.8), drift: (0.0025, 0.6), drift_time: (6500.0, 0.5), walk: (5e-6, 1.2) };
    vec![
        Channel { name: "spool_c".into(), unit: "degC".into(), offset_sd: 0.05, averaging: 0.0, noise: spool },
        Channel { name: "rate_deg_per_h".into(), unit: "deg/h".into(), offset_sd: 0.1, averaging, noise: rate },
    ]
}

/// What the forward model is off by: discretisation, and a start that was not quite at rest.
const GAIN_ERROR: f64 = 0.003;
const AIR_ERROR: f64 = 0.001;
/// The Shupe part is what differences of temperature within the coil leave: small, and the first to feel a coarse mesh or a coarse record.
const SHUPE_ERROR: f64 = 0.006;
const REST_ERROR_K: f64 = 0.012;

pub(crate) fn nuisances() -> Vec<Nuisance> {
    let spread = |name: &str, spread: f64| Nuisance {
        parameter: Parameter::new(name, Prior::LogNormal { median: 1.0, spread }),
        role: Role::Constant,
        local: false,
    };
    vec![
        Nuisance::normal("gain of the rate", 1.0, GAIN_ERROR, Role::ModelError),
        Nuisance { role: Role::ModelError, ..spread("conductivity of the surroundings (model)", AIR_ERROR) },
        Nuisance { local: true, ..Nuisance::normal("start off rest [K]", 0.0, REST_ERROR_K, Role::ModelError) },
        spread("E_r and G", 0.10),
        Nuisance::normal("alpha_r", 1.0, 0.03, Role::Constant),
        Nuisance::normal("E_z", 1.0, 0.03, Role::Constant),
        Nuisance::normal("alpha_z", 1.0, 0.03, Role::Constant),
        Nuisance::normal("spool expansion", 1.0, 0.02, Role::Constant),
        spread("conductivity of the surroundings", 0.05),
        Nuisance::normal("dn/dT", 1.0, 0.10, Role::Constant),
        Nuisance::normal("gain of the Shupe part (model)", 1.0, SHUPE_ERROR, Role::ModelError),
    ]
}

/// A constant of the design times a factor, by the name that the forward model gives it; `None` for a name of something else.
pub fn with_constant(design: &Design, name: &str, factor: f64) -> Option<Design> {
    let mut changed = design.clone();
    let elastic = &mut changed.body.elastic;
    match name {
        "E_r and G" => {
            elastic.e_r *= factor;
            elastic.g_zr *= factor;
        }
        "alpha_r" => elastic.alpha_r *= factor,
        "E_z" => elastic.e_z *= factor,
        "alpha_z" => elastic.alpha_z *= factor,
        "spool expansion" => {
            if let Some(spool) = &mut changed.spool {
                spool.material.elastic.thermal_expansion *= factor;
            }
        }
        "conductivity of the surroundings" => changed.surroundings.conductivity *= factor,
        "dn/dT" => changed.optics.thermo_optic *= factor,
        _ => return None,
    }
    Some(changed)
}
