//! The models of the examples, which know no coil, on data made in miniature: `cargo run --example` needs a file, this does not.

#[path = "../examples/models/tanks.rs"]
#[allow(dead_code)] // a part of the library is tried
mod tanks;
#[path = "../examples/models/thermal.rs"]
#[allow(dead_code)]
pub(crate) mod thermal;

use crate::common::normal;
use diagnosis::{Active, Diagnosis, ForwardModel, Hypothesis, Observation, Settings, Verdict, diagnose, fitted};
use tanks::{Feed, Tanks, UPPER_OVERFLOW};
use thermal::{RIPPLE, SLOW_PART, Thermal, coloured};

fn noisy(series: &[f64], white: f64, seed: u64) -> Vec<f64> {
    let mut normal = normal(seed);
    series.iter().map(|y| y + white * normal()).collect()
}

fn run(model: &dyn ForwardModel, observed: &Observation) -> Diagnosis {
    diagnose(model, &[0], std::slice::from_ref(observed), &Settings::default(), &|_| ()).expect("a diagnosis")
}

const STEP_S: f64 = 4.0;
const WHITE_V: f64 = 0.08;
const CONSTANTS: [f64; 8] = [0.053, 0.048, 0.05, 0.052, 4.2, 0.1, 0.5, 0.5];
/// The constants were measured to a tenth: an overflow cannot hide in them.
const DOUBT: f64 = 0.15;

/// Two feeds that fill the tanks to about 15 V if nothing spills.
fn tanks() -> Tanks {
    let pump = |slow: f64| -> Vec<f64> {
        (0..350).map(|n| 2.6 + 1.2 * (f64::from(n) / slow).sin() + 0.6 * (f64::from(n) / 11.0).sin()).collect()
    };
    let feed = |slow: f64| Feed { step: STEP_S, pump: pump(slow), start: 5.0 };
    Tanks::new(vec![feed(40.0), feed(31.0)], DOUBT)
}

fn level(tanks: &Tanks, record: usize, active: &[Active], seed: u64) -> Observation {
    let y = noisy(&tanks.run(record, &CONSTANTS, active).reading, WHITE_V, seed);
    Observation { time: (0..y.len()).map(|n| STEP_S * n as f64).collect(), channels: vec![y] }
}

/// The model with its state taken from the nominal fit, as the example does.
fn settled(observed: &Observation) -> Tanks {
    let mut tanks = tanks();
    let nominal = fitted(&tanks, &[0], std::slice::from_ref(observed), &[Hypothesis::NOMINAL]).expect("a fit");
    tanks.settle(&nominal.nuisances[0]);
    tanks
}

#[test]
fn an_overflow_is_named_measured_and_predicts_the_other_feed() {
    let truth = [Active { mechanism: UPPER_OVERFLOW, values: vec![7.0, 0.5], choice: None }];
    let observed = level(&tanks(), 0, &truth, 3);
    let tanks = settled(&observed);
    let found = run(&tanks, &observed);
    assert_eq!((found.verdict, found.mechanisms[0].0), (Verdict::Explained, UPPER_OVERFLOW), "{:?}", found.mechanisms);
    // three 90 % intervals' half widths, a chance of one in ten thousand to lie outside
    for (estimate, value) in found.parameters[0].iter().zip([7.0, 0.5]) {
        let half = (estimate.ci90[1] - estimate.ci90[0]) / 2.0;
        assert!((estimate.value - value).abs() < 3.0 * half && half < 0.15 * value, "{estimate:?}");
    }
    let best = &found.best().fit;
    let held = level(&tanks, 1, &truth, 4);
    let rms = |fit: &diagnosis::Fit| fit.hold_out(&tanks, 1, &held, best).expect("held out").rmse[0];
    assert!(rms(best) < 1.15 * WHITE_V && rms(&found.nominal) > 1.5 * rms(best), "{} against {}", rms(best), rms(&found.nominal));
}

#[test]
fn tanks_that_hold_raise_nothing() {
    for seed in 1..=6 {
        let observed = level(&tanks(), 0, &[], 100 + seed);
        let found = run(&settled(&observed), &observed);
        assert_eq!(found.verdict, Verdict::None, "seed {seed}: {:?}", found.mechanisms);
    }
}

const WHITE: f64 = 6e-5;

/// Down, up, and down again within 70 minutes; the last cooling is record 1.
fn cycle() -> Thermal {
    let corners = [(0.0, 50.0), (1500.0, -17.0), (3000.0, 74.0), (4200.0, 36.0)];
    let at = |t: f64| {
        let k = corners.iter().filter(|c| c.0 <= t).count().clamp(1, corners.len() - 1);
        let ((t0, a), (t1, b)) = (corners[k - 1], corners[k]);
        a + (b - a) * (t - t0) / (t1 - t0)
    };
    let time: Vec<f64> = (0..420).map(|n| 10.0 * f64::from(n)).collect();
    let temperature = time.iter().map(|t| at(*t)).collect();
    Thermal::new(time, temperature, 310, 0.01, coloured(WHITE))
}

fn rate(model: &Thermal, active: &[Active], seed: u64) -> Vec<Observation> {
    let y = model.run(&[0.02, -0.004, 0.003], active);
    model.observations(&noisy(&y, WHITE, seed))
}

#[test]
fn a_part_that_lags_is_named_and_predicts_the_last_cooling() {
    let model = cycle();
    let observed = rate(&model, &[Active { mechanism: SLOW_PART, values: vec![0.006, 500.0], choice: None }], 5);
    let found = run(&model, &observed[0]);
    assert_eq!((found.verdict, found.mechanisms[0].0), (Verdict::Explained, SLOW_PART), "{:?}", found.mechanisms);
    let best = &found.best().fit;
    let rms = |fit: &diagnosis::Fit| fit.hold_out(&model, 1, &observed[1], best).expect("held out").rmse[0];
    assert!(rms(best) < 4.0 * WHITE && rms(&found.nominal) > 5.0 * rms(best), "{} and {}", rms(best), rms(&found.nominal));
}

#[test]
fn a_ripple_is_no_history_and_a_cubic_is_enough_for_a_cubic() {
    let model = cycle();
    let ripple = rate(&model, &[Active { mechanism: RIPPLE, values: vec![4e-4, 2e-4, 12.0], choice: None }], 6);
    let found = run(&model, &ripple[0]);
    assert_eq!((found.verdict, found.mechanisms[0].0), (Verdict::Explained, RIPPLE), "{:?}", found.mechanisms);
    for seed in 1..=6 {
        let found = run(&model, &rate(&model, &[], 200 + seed)[0]);
        assert_eq!(found.verdict, Verdict::None, "seed {seed}: {:?}", found.mechanisms);
    }
}
