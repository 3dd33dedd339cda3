//! The library's interpolated responses against the chain itself: every mechanism as a changed design, modelled anew.

use coil::{
    Body, Contact, Dehomogenization, Design, Drifts, Drive, Dynamics, Flange, HeatPaths, Mechanics, Profile, STANDARD, Sensor,
    Side, Solid, Spool, Surroundings,
};
use diagnosis::{Active, ForwardModel};
use mechanisms::{Gyro, Library, Prepared, RATE, SPOOL};
use std::sync::OnceLock;

fn design() -> Design {
    use bias::{Optics, StrainConvention};
    use fem_core::material::{Isotropic, TransverselyIsotropic};
    use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength};
    Design {
        winding: Spec {
            pattern: Pattern::PracticalQuadrupole,
            layers: 36,
            turns_odd_layers: 106,
            turns_even_layers: 105,
            inner_radius: 43.5e-3,
            pitch: 0.17e-3,
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
            material: Solid {
                elastic: Isotropic { youngs_modulus: 68.9e9, poisson_ratio: 0.33, thermal_expansion: 23.6e-6 },
                conductivity: 167.0,
                density: 2700.0,
                specific_heat: 896.0,
            },
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

/// Twelve hours of a smooth course between −20 and 60 °C that starts at rest, a row a minute.
fn course() -> (Vec<f64>, Vec<f64>) {
    let time: Vec<f64> = (0..720).map(|n| 60.0 * f64::from(n)).collect();
    let rise = |t: f64| 1.0 - (-(t / 2000.0).powi(2)).exp();
    let chamber = time.iter().map(|t| 20.0 + rise(*t) * 40.0 * (t / 4000.0).sin() * (0.3 + 0.7 * (t / 9000.0).cos())).collect();
    (time, chamber)
}

fn gyro() -> &'static std::sync::Mutex<Gyro> {
    static GYRO: OnceLock<std::sync::Mutex<Gyro>> = OnceLock::new();
    GYRO.get_or_init(|| {
        let library = Library::build(&design(), |_| ()).expect("library");
        let (time, chamber) = course();
        let prepared = Prepared::new(&library, &time, &chamber, 60.0).expect("prepared");
        std::sync::Mutex::new(Gyro::new(library, vec![prepared]).expect("gyro"))
    })
}

/// Thermometer and rate \[deg/h\] of a design modelled anew.
fn anew(design: &Design) -> [Vec<f64>; 2] {
    const PARTS: usize = 4;
    let dynamics = Dynamics::new(design, &[Drive::Chamber], &STANDARD).expect("dynamics");
    let (time, chamber) = course();
    let rows = dynamics.simulate(&Profile { time, drives: vec![chamber] }.smoothed(PARTS)).expect("run");
    let scale = bias::units::DEG_PER_H_PER_RAD_PER_S;
    let rate = |rows: &[coil::Response]| rows.iter().map(|r| scale * r.rate()).sum::<f64>() / PARTS as f64;
    let rates = [scale * rows[0].rate()].into_iter().chain(rows[1..].chunks(PARTS).map(rate)).collect();
    [rows.iter().step_by(PARTS).map(|r| r.sensor).collect(), rates]
}

fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt()
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Largest share of a mechanism's effect by which the library may differ from the chain.
const SHARE: f64 = 0.02;

fn agrees(id: &str, values: &[f64], choice: Option<f64>, changed: &Design, channels: &[usize]) {
    static NOMINAL: OnceLock<[Vec<f64>; 2]> = OnceLock::new();
    let responses = || {
        let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let mechanism = gyro.find(id).expect("a mechanism");
        let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
        let active = Active { mechanism, values: values.to_vec(), choice };
        [&[][..], &[active]].map(|active| gyro.respond(0, &middle, active).expect("response"))
    };
    // modelled anew while another test has the library
    let (exact, [nominal, with]) = (anew(changed), responses());
    let exact_nominal = NOMINAL.get_or_init(|| anew(&design()));
    for &channel in channels {
        let effect = minus(&exact[channel], &exact_nominal[channel]);
        let off = rms(&minus(&minus(&with[channel], &nominal[channel]), &effect));
        assert!(off < SHARE * rms(&effect), "{id} {values:?}, channel {channel}: off by {off:e} of {:e}", rms(&effect));
    }
    assert!(rms(&minus(&nominal[RATE], &exact_nominal[RATE])) < 2e-4 * rms(&exact_nominal[RATE]));
}

#[test]
fn winding_type_mechanisms_follow_the_chain() {
    let d = design();
    agrees("tail-asymmetry", &[-0.63], None, &mechanisms::with_tail(&d, -0.63), &[RATE]);
    let mut defective = d.clone();
    defective.winding.defect = Some(winding::LayerDefect { layer: 24, turns: -3 });
    agrees("winding-defect", &[-3.0], Some(24.0), &defective, &[RATE]);
}

#[test]
fn material_mechanisms_follow_the_chain() {
    let d = design();
    agrees("adhesive-content", &[0.037], None, &mechanisms::with_polymer(&d, 0.037), &[RATE, SPOOL]);
    agrees("viscoelastic-relaxation", &[0.3, 5000.0], None, &mechanisms::with_relaxation(&d, 0.3, 5000.0), &[RATE]);
    let transition = mechanisms::with_glass_transition(&d, 28.0, 6.0, 0.65, 1.08);
    agrees("glass-transition", &[28.0, 6.0, 0.65, 1.08], None, &transition, &[RATE]);
}

#[test]
fn a_bond_that_opens_follows_the_chain() {
    let d = design();
    agrees("debond", &[28.0, 8.0, 0.24], None, &mechanisms::with_opening(&d, 28.0, 8.0, 0.24), &[RATE]);
}

#[test]
fn heat_paths_follow_the_chain() {
    let d = design();
    agrees("interface-resistance", &[1.3e-3], None, &mechanisms::with_hub_resistance(&d, 1.3e-3), &[RATE, SPOOL]);
    agrees("air-path", &[1.17], None, &mechanisms::with_air(&d, 1.17), &[RATE, SPOOL]);
    agrees("axial-heat-path", &[0.9], None, &mechanisms::with_mount(&d, 0.9), &[RATE, SPOOL]);
}

#[test]
fn optics_read_out_and_sensor_follow_the_chain() {
    let d = design();
    let mut changed = d.clone();
    changed.drifts.thermo_optic_curvature = 2.5e-8;
    agrees("thermo-optic-curvature", &[2.5e-8], None, &changed, &[RATE]);
    let mut changed = d.clone();
    changed.drifts.read_out = 2e-3 / bias::units::DEG_PER_H_PER_RAD_PER_S;
    agrees("rate-temperature-coefficient", &[2e-3], None, &changed, &[RATE]);
    let mut changed = d;
    changed.sensor.lag = 70.0;
    agrees("sensor-lag", &[70.0], None, &changed, &[SPOOL]);
}
