//! The reference coil and small changes of it, for the tests and benches of this crate.
#![allow(dead_code)]

use bias::{Optics, StrainConvention};
use coil::{
    Body, Contact, Dehomogenization, Design, Drifts, Drive, Dynamics, Fidelity, Flange, HeatPaths, Mechanics, MeshFineness,
    Profile, Response, Sensor, Side, Solid, Spool, Surroundings,
};
use fem_core::material::{Isotropic, TransverselyIsotropic};
use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength};

/// Enough for what holds on any mesh.
pub(crate) const QUICK: Fidelity = Fidelity { resolution: MeshFineness { order: 3, layers: 1, ratio: 0.2 }, modes: 24 };

/// Osunluk et al., Tables I to III, on an aluminium spool with one flange.
pub(crate) fn reference() -> Design {
    Design {
        winding: Spec {
            pattern: Pattern::PracticalQuadrupole,
            layers: 36,
            turns_odd_layers: 106,
            turns_even_layers: 105,
            inner_radius: 43.5e-3,
            pitch: 0.17e-3,
            start: 0.0,
            end: None,
            cw_climbs: ClimbSide::Right,
            turn_length: TurnLength::True,
            tails: Tails { cw: 0.0, ccw: 0.0 },
            defect: None,
        },
        body: Body {
            outer_radius: 48.825e-3,
            height: 18.02e-3,
            density: 1400.0,
            specific_heat: 1300.0,
            elastic: TransverselyIsotropic {
                e_z: 14.5e9,
                e_r: 95.2e6,
                g_zr: 24.1e6,
                nu_zr: 0.392,
                nu_r: 0.979,
                alpha_z: 3.36e-6,
                alpha_r: 193e-6,
            },
            conductivity_z: 0.51,
            conductivity_r: 0.34,
        },
        spool: Some(Spool {
            material: aluminium(),
            hub_thickness: 4e-3,
            hub_contact: Contact::Bonded,
            flanges: vec![Flange { side: Side::Right, thickness: 2e-3, overhang: 1e-3, contact: Contact::Bonded }],
        }),
        surroundings: Surroundings { conductivity: 0.026, density: 1.2, specific_heat: 1005.0, margin: 10e-3 },
        mechanics: Mechanics::default(),
        heat: HeatPaths::default(),
        sensor: Sensor { radius: 39.5e-3, y: 10.01e-3, lag: 0.0 },
        optics: Optics {
            refractive_index: 1.45,
            thermo_optic: 1e-5,
            thermal_expansion: 0.55e-6,
            p11: 0.121,
            p12: 0.270,
            sagnac_diameter: 92.325e-3,
            strain: StrainConvention::Total,
        },
        drifts: Drifts::default(),
        dehomogenization: Dehomogenization { m_rx: 0.0274, m_ry: 0.0270, m_rz: -0.17, m_rt: -9.98e-6 },
    }
}

pub(crate) fn aluminium() -> Solid {
    Solid {
        elastic: Isotropic { youngs_modulus: 68.9e9, poisson_ratio: 0.33, thermal_expansion: 23.6e-6 },
        conductivity: 167.0,
        density: 2700.0,
        specific_heat: 896.0,
    }
}

pub(crate) fn spool(design: &mut Design) -> &mut Spool {
    design.spool.as_mut().expect("the reference coil has a spool")
}

/// The reference with one change.
pub(crate) fn changed(change: impl FnOnce(&mut Design)) -> Design {
    let mut design = reference();
    change(&mut design);
    design
}

/// E_r and G_zr times a factor.
pub(crate) fn scaled(factor: f64) -> impl FnOnce(&mut Design) {
    move |design| {
        design.body.elastic.e_r *= factor;
        design.body.elastic.g_zr *= factor;
    }
}

/// The quick model of a design under some drives.
pub(crate) fn dynamics(design: &Design, drives: &[Drive]) -> Dynamics {
    Dynamics::new(design, drives, &QUICK).expect("model")
}

/// Response of the quick model of a design to a profile.
pub(crate) fn run(design: &Design, drives: &[Drive], profile: &Profile) -> Vec<Response> {
    dynamics(design, drives).simulate(profile).expect("run")
}

/// So many instants every half minute.
pub(crate) fn half_minutes(count: u32) -> Vec<f64> {
    (0..count).map(|k| 30.0 * f64::from(k)).collect()
}

/// A pseudo-random number in [0, 1).
pub(crate) fn random(seed: &mut u64) -> f64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

/// A standard normal number (Box and Muller).
pub(crate) fn normal(seed: &mut u64) -> f64 {
    let [a, b] = [random(seed), random(seed)];
    (-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}
