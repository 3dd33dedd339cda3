//! Fields at the turns, rebuilt from a reduced model: they carry the bias, obey uniform temperature, and agree with all unknowns.

use crate::common::{QUICK, changed, half_minutes, reference};
use bias::{Bias, bias};
use coil::{Drive, Dynamics, FactorsAt, Mechanics, Model, Profile, Side, ThermalModel, ThermalState};
use winding::Tails;

/// Rest, a ramp of 1 K/min for ten minutes, a soak.
fn ramp_and_soak(drives: usize) -> Profile {
    let time = half_minutes(60);
    let course = |drive: usize| time.iter().map(|t| 20.0 + (t - 120.0).clamp(0.0, 600.0) / 60.0 / (drive + 1) as f64).collect();
    Profile { drives: (0..drives).map(course).collect(), time }
}

fn with_fields(design: &coil::Design, drives: &[Drive]) -> (Dynamics, coil::TurnFields) {
    Dynamics::with_fields(design, drives, &QUICK).expect("model")
}

/// Drives and modes at every instant of a profile, and the mean bias that `simulate` gives since the one before.
type Course = (Vec<ThermalState>, Vec<Bias>);

fn course(dynamics: &Dynamics, profile: &Profile) -> Course {
    let mut steps = dynamics.steps(profile).expect("steps");
    let mut states = vec![steps.state().clone()];
    while steps.next().is_some() {
        states.push(steps.state().clone());
    }
    let rows = dynamics.simulate(profile).expect("run");
    assert_eq!(rows.len(), states.len());
    (states, rows.iter().map(|r| r.bias).collect())
}

fn rates(a: &ThermalState, b: &ThermalState, dt: f64) -> ThermalState {
    let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (b - a) / dt).collect();
    ThermalState { drives: of(&a.drives, &b.drives), amplitudes: of(&a.amplitudes, &b.amplitudes) }
}

#[test]
fn exact_the_bias_of_the_turns_is_the_bias_of_the_model() {
    let ends = [Drive::Chamber, Drive::EndWall(Side::Left)];
    let tailed = changed(|d| d.winding.tails = Tails { cw: 1.5, ccw: 0.4 });
    for (design, drives) in [(reference(), &ends[..1]), (tailed, &ends[..])] {
        let (dynamics, fields) = with_fields(&design, drives);
        let profile = ramp_and_soak(drives.len());
        let (states, expected) = course(&dynamics, &profile);
        let winding = winding::wind(&design.winding).expect("winding");
        let parts = |b: &Bias| [b.shupe, b.eo_axial, b.eo_radial];
        let peak = [0, 1, 2].map(|p| expected.iter().map(|b| parts(b)[p].abs()).fold(0.0, f64::max));
        for n in 1..states.len() {
            let dt = profile.time[n] - profile.time[n - 1];
            let slices = fields.at(&rates(&states[n - 1], &states[n], dt)).slices(&winding, design.optics.thermal_expansion);
            let found = bias(&design.optics, winding.length(), &slices).expect("bias");
            for (p, peak) in peak.iter().enumerate() {
                let error = (parts(&found)[p] - parts(&expected[n])[p]).abs();
                assert!(error < 1e-9 * peak, "part {p} at {} s: {error:.1e} of {peak:.1e}", profile.time[n]);
            }
        }
    }
}

#[test]
fn exact_a_coil_at_rest_has_one_temperature_and_the_strain_of_uniform_warming() {
    let design = reference();
    let (dynamics, fields) = with_fields(&design, &[Drive::Chamber]);
    let amplitudes = vec![0.0; dynamics.reduced().rates().len()];
    let rest = fields.at(&ThermalState { drives: vec![1.0], amplitudes });
    assert!(rest.temperature.iter().all(|t| (t - 1.0).abs() < 1e-12) && (rest.bore - 1.0).abs() < 1e-12);
    let model = Model::new(&design, &QUICK.resolution).expect("model");
    let uniform = model.at_turns(&[vec![1.0; model.grid().mesh().nodes().len()]]).expect("solve").remove(0);
    for (found, expected) in [(&rest.axial, &uniform.axial), (&rest.radial, &uniform.radial)] {
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            assert!((found - expected).abs() < 1e-12 * 1e-6 + 1e-10 * expected.abs(), "turn {i}");
        }
    }
}

#[test]
fn exact_turn_temperatures_agree_with_all_unknowns() {
    let design = reference();
    let (dynamics, fields) = with_fields(&design, &[Drive::Chamber]);
    let profile = ramp_and_soak(1);
    let (states, _) = course(&dynamics, &profile);
    let thermal = ThermalModel::new(&design, &QUICK.resolution, &[Drive::Chamber]).expect("model");
    let winding = winding::wind(&design.winding).expect("winding");
    // the functional of one node: the one nearest to a turn, so within the coil
    let turn = 1700;
    let (r, y) = (winding.turns()[turn].r, winding.turns()[turn].y);
    let nodes = thermal.grid().mesh().nodes();
    let distance = |i: &usize| (nodes[*i][0] - r).hypot(nodes[*i][1] - y);
    let nearest = (0..nodes.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("nodes");
    let functional = (0..nodes.len()).map(|i| f64::from(u8::from(i == nearest))).collect();
    let full = thermal.run(&profile, &[functional], 1e-5).expect("run");
    for n in [10, 30, 59] {
        let at_turn = fields.at(&states[n]).temperature[turn];
        // the node is a millimetre away at most; the coil lags by kelvins
        assert!((at_turn - full.outputs[n][0]).abs() < 0.05, "{at_turn} against {} °C", full.outputs[n][0]);
        assert!(n != 30 || states[n].drives[0] - at_turn > 0.5, "the coil lags: {at_turn} °C");
    }
}

/// The functionals of the reduced model, made by adjoints, are those that the turns' own fields give.
#[test]
fn exact_the_bias_parts_of_the_turns_are_the_models() {
    let design = changed(|d| {
        d.winding.tails = Tails { cw: 1.5, ccw: 0.4 };
        d.optics.strain = bias::StrainConvention::Mechanical;
    });
    let (dynamics, fields) = with_fields(&design, &[Drive::Chamber]);
    let winding = winding::wind(&design.winding).expect("winding");
    let of_turns = fields.bias_parts(&design.optics, &winding).expect("optics");
    for (part, (turns, model)) in of_turns.iter().zip(dynamics.reduced().parts()).enumerate() {
        let (off, size) = ((turns - model.vector()).amax(), turns.amax());
        assert!(off < 1e-9 * size, "part {part}: {off:.1e} of {size:.1e}");
    }
}

#[test]
fn exact_fields_are_nominal_whatever_the_states() {
    let row = |temperature: f64, factor: f64| FactorsAt { temperature, transverse_modulus: factor, transverse_expansion: 1.0 };
    let table = changed(|d| d.mechanics = Mechanics::TemperatureTable(vec![row(-40.0, 1.3), row(60.0, 1.25)]));
    let (_, expected) = with_fields(&reference(), &[Drive::Chamber]);
    let (_, found) = with_fields(&table, &[Drive::Chamber]);
    assert_eq!(found, expected);
}

#[test]
fn exact_a_curved_thermo_optic_coefficient_and_a_read_out_act_as_their_definitions_say() {
    let (reference_c, curvature, per_kelvin) = (12.0, 3e-8, 2e-9);
    let plain = changed(|d| d.winding.tails = Tails { cw: 0.7, ccw: 0.2 });
    let drives = [Drive::Chamber, Drive::EndWall(Side::Left)];
    let (dynamics, fields) = with_fields(&plain, &drives);
    let drifting = |lag: f64| {
        let mut design = plain.clone();
        design.sensor.lag = lag;
        design.drifts = coil::Drifts { reference: reference_c, thermo_optic_curvature: curvature, read_out: per_kelvin };
        Dynamics::new(&design, &drives, &QUICK).expect("model")
    };
    let profile = ramp_and_soak(2);
    let (states, expected) = course(&dynamics, &profile);
    let rows = drifting(0.0).simulate(&profile).expect("run");
    let winding = winding::wind(&plain.winding).expect("winding");
    // phase Σ n b/(L D) W (T²/2 − T_ref T), tails at the bore's temperature
    let phase = |state: &ThermalState| {
        let at = fields.at(state);
        let term = |w: f64, t: f64| w * (t * t / 2.0 - reference_c * t);
        let turns: f64 = winding.weights().iter().zip(&at.temperature).map(|(w, t)| term(*w, *t)).sum();
        let (ccw, cw) = winding.tail_spans();
        let tails: f64 = [ccw, cw].iter().map(|(a, b)| term((b - a) * (winding.length() - a - b), at.bore)).sum();
        plain.optics.refractive_index * curvature / (winding.length() * plain.optics.sagnac_diameter) * (turns + tails)
    };
    let added = |n: usize| (phase(&states[n]) - phase(&states[n - 1])) / (profile.time[n] - profile.time[n - 1]);
    let peak = (1..rows.len()).map(|n| added(n).abs()).fold(0.0, f64::max);
    assert!(peak > 1e-3 * expected.iter().map(|b| b.shupe.abs()).fold(0.0, f64::max), "an effect that can be seen");
    for n in 1..rows.len() {
        let error = (rows[n].bias.shupe - expected[n].shupe - added(n)).abs();
        assert!(error < 1e-8 * peak, "{error:.1e} of {peak:.1e} at {} s", profile.time[n]);
        assert_eq!(rows[n].bias.eo_axial, expected[n].eo_axial);
    }
    // the read-out is that of the place, whatever the thermometer's lag, and a mean over the row however long
    let lagging = drifting(300.0).simulate(&profile).expect("run");
    assert!(rows.iter().zip(&lagging).all(|(a, b)| a.read_out == b.read_out) && rows[40].sensor != lagging[40].sensor);
    let long = Profile { time: vec![0.0, 120.0, 1770.0], drives: vec![vec![20.0, 20.0, 29.0], vec![20.0, 20.0, 24.0]] };
    let fine = Profile {
        time: (0..=1770).map(f64::from).collect(),
        drives: [9.0, 4.0]
            .map(|rise| (0..=1770).map(|t| 20.0 + rise * (f64::from(t) - 120.0).max(0.0) / 1650.0).collect())
            .to_vec(),
    };
    let of = |profile: &Profile| drifting(0.0).simulate(profile).expect("run");
    let mean = of(&fine)[121..].iter().map(|r| r.read_out).sum::<f64>() / 1650.0;
    assert!((of(&long)[2].read_out / mean - 1.0).abs() < 1e-9, "{} against {mean}", of(&long)[2].read_out);
    assert!((of(&fine)[0].read_out / (per_kelvin * (20.0 - reference_c)) - 1.0).abs() < 1e-9);
}
