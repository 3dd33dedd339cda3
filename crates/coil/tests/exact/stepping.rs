//! Order of the stepping, and the reduced model against the full one.

use super::QUICK;
use crate::common::reference;
use coil::{Drive, Dynamics, Fidelity, Model, Profile, STANDARD, ThermalModel, functionals};
use fem_core::{State, Transient};

/// Order of the stepping on the coil's own matrices, from its slowest mode: fem-core's tests measure it on a rod.
#[test]
fn mms_the_coils_heat_flow_is_stepped_to_second_order() {
    let thermal = ThermalModel::new(&reference(), &QUICK, &[Drive::Chamber]).expect("model");
    let conductivity = thermal.conductivity();
    let mut start = conductivity.solve(thermal.stored()).expect("solve").remove(0);
    for _ in 0..3 {
        start = conductivity.solve(&[thermal.capacity().multiply(&start)]).expect("solve").remove(0);
        let largest = start.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        start.iter_mut().for_each(|v| *v /= largest);
    }
    let load = vec![0.0; start.len()];
    let end = |steps: u32| {
        let mut transient = Transient::new(thermal.capacity().clone(), conductivity.matrix().clone()).expect("system");
        let flow: Vec<f64> = conductivity.matrix().multiply(&start).iter().map(|f| -f).collect();
        let mut state = State { rate: transient.rate_of_load(&flow).expect("rate"), value: start.clone() };
        for _ in 0..steps {
            state = transient.step(&state, &load, 2000.0 / f64::from(steps)).expect("step").0;
        }
        state.value
    };
    let finest = end(1024);
    let errors: Vec<f64> =
        [8, 16, 32, 64].map(|n| end(n).iter().zip(&finest).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)).to_vec();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.15, "order {order:.3} from errors {errors:?}");
    }
}

/// A staircase of 10 K steps at 2 K/min through a controller with a lag of 80 s, rows every 30 s.
fn staircase() -> Profile {
    let programme = |t: f64| (0..4).map(|k| (t - 600.0 - 3000.0 * f64::from(k)).clamp(0.0, 300.0) / 30.0).sum::<f64>();
    let time = crate::common::half_minutes(450);
    let mut chamber = 0.0;
    let mut course = Vec::new();
    for t in &time {
        course.push(chamber);
        for k in 0..30 {
            chamber += (programme(t + f64::from(k) + 0.5) - chamber) * (1.0 - (-1.0_f64 / 80.0).exp());
        }
    }
    Profile { drives: vec![course], time }
}

#[test]
fn exact_reduced_and_full_runs_agree_on_a_staircase() {
    let design = reference();
    let thermal = ThermalModel::new(&design, &QUICK, &[Drive::Chamber]).expect("model");
    let outputs = functionals(&design, &Model::new(&design, &QUICK).expect("model"), &thermal).expect("outputs");
    let profile = staircase();
    let [shupe, eo_axial, eo_radial] = outputs.parts[0].clone();
    let full = thermal.run(&profile, &[shupe, eo_axial, eo_radial, outputs.thermometer], 1e-5).expect("run").outputs;
    let fidelity = Fidelity { resolution: QUICK, ..STANDARD };
    let reduced = Dynamics::new(&design, &[Drive::Chamber], &fidelity).expect("model").simulate(&profile).expect("run");
    let rate = |n: usize, part: usize| (full[n][part] - full[n - 1][part]) / 30.0;
    let mut worst = [0.0_f64; 4];
    let peak = |f: &dyn Fn(usize) -> f64| (1..reduced.len()).map(|n| f(n).abs()).fold(0.0, f64::max);
    for (part, worst) in worst[..3].iter_mut().enumerate() {
        let of = |n: usize| [reduced[n].bias.shupe, reduced[n].bias.eo_axial, reduced[n].bias.eo_radial][part];
        *worst = peak(&|n| rate(n, part) - of(n)) / peak(&|n| rate(n, part));
    }
    worst[3] = peak(&|n| full[n][3] - reduced[n].sensor) / peak(&|n| full[n][3]);
    assert!(worst.iter().all(|w| *w < 1e-3), "{worst:?}");
}
