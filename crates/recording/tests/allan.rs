//! Allan deviation against its definition and against closed forms.

#![allow(clippy::print_stdout, reason = "the coverage reached is shown")]

use crate::common::{Random, even, simulate};
use proptest::prelude::*;
use recording::allan::{AllanPoint, allan};
use recording::noise::NoiseModel;

/// By the definition, with loops: two neighbouring means over m rows, at every start.
fn by_definition(values: &[f64], m: usize) -> f64 {
    let mean = |first: usize| values[first..first + m].iter().sum::<f64>() / m as f64;
    let squares: Vec<f64> = (0..=values.len() - 2 * m).map(|start| (mean(start + m) - mean(start)).powi(2)).collect();
    (squares.iter().sum::<f64>() / (2.0 * squares.len() as f64)).sqrt()
}

fn of(values: &[f64]) -> Vec<AllanPoint> {
    allan(&even(values.len(), 30.0), values, &vec![true; values.len()]).expect("valid series")
}

proptest! {
    #[test]
    fn it_is_the_definition(values in prop::collection::vec(-1e3..1e3_f64, 8..120)) {
        let points = of(&values);
        prop_assert_eq!(points[0].tau, 30.0);
        for point in points {
            let expected = by_definition(&values, (point.tau / 30.0).round() as usize);
            prop_assert!((point.deviation - expected).abs() <= 1e-9 * (1.0 + expected), "{} {expected}", point.deviation);
        }
    }
}

/// Mean variance at every averaging time over the seeds, the share of intervals that hold the truth, and the variance's own spread.
fn judge(model: &NoiseModel, seeds: u64) {
    let runs: Vec<Vec<AllanPoint>> = (0..seeds).map(|seed| of(&simulate(model, 2000, &mut Random::new(seed)))).collect();
    let (mut held, mut all) = (0.0, 0.0);
    for (i, point) in runs[0].iter().enumerate() {
        let truth = model.allan_deviation(point.tau, 30.0);
        let ratios: Vec<f64> = runs.iter().map(|run| (run[i].deviation / truth).powi(2)).collect();
        let mean = ratios.iter().sum::<f64>() / seeds as f64;
        let freedom = runs.iter().map(|run| run[i].freedom).sum::<f64>() / seeds as f64;
        let spread = (2.0 / freedom).sqrt();
        assert!((mean - 1.0).abs() < 5.0 * spread / (seeds as f64).sqrt(), "tau {}: {mean} of {model:?}", point.tau);
        if freedom > 5.0 {
            let found = (ratios.iter().map(|ratio| (ratio - mean).powi(2)).sum::<f64>() / seeds as f64).sqrt();
            assert!((found / spread).ln().abs() < 0.4, "tau {}: {found} {spread} of {model:?}", point.tau);
        }
        held += runs.iter().filter(|run| run[i].low <= truth && truth <= run[i].high).count() as f64;
        all += seeds as f64;
    }
    println!("90 % intervals cover {:.3}", held / all);
    assert!((0.85..0.95).contains(&(held / all)), "{} of {model:?}", held / all);
}

#[test]
fn closed_forms_lie_in_the_intervals() {
    let none = NoiseModel { white: 1e-9, ..NoiseModel::white(1.0, 30.0) };
    judge(&NoiseModel::white(1.0, 30.0), 100);
    judge(&NoiseModel { walk: 1.0, ..none }, 100);
    judge(&NoiseModel { quantisation: 30.0, ..none }, 100);
    judge(&NoiseModel { drift: 0.3, drift_time: 2000.0, ..NoiseModel::white(1.0, 30.0) }, 100);
}

#[test]
fn slopes_name_the_noise() {
    let none = NoiseModel { white: 1e-9, ..NoiseModel::white(1.0, 30.0) };
    let models = [
        (NoiseModel::white(1.0, 30.0), -0.5),
        (NoiseModel { walk: 1.0, ..none }, 0.5),
        (NoiseModel { quantisation: 30.0, ..none }, -1.0),
    ];
    for (model, slope) in models {
        let points = of(&simulate(&model, 20_000, &mut Random::new(3)));
        for point in points.iter().filter(|point| point.freedom > 100.0 && point.tau > 100.0) {
            assert!((point.slope - slope).abs() < 0.15, "{point:?} of {slope}");
        }
    }
}

#[test]
fn holes_change_little() {
    let model = NoiseModel { drift: 0.3, drift_time: 2000.0, ..NoiseModel::white(1.0, 30.0) };
    let values = simulate(&model, 6000, &mut Random::new(5));
    let whole = of(&values);
    let kept: Vec<usize> = (0..6000).filter(|i| !(2000..2100).contains(i)).collect();
    let time: Vec<f64> = kept.iter().map(|&i| 30.0 * (i + 1) as f64).collect();
    let mut mask = vec![true; kept.len()];
    let mut some: Vec<f64> = kept.iter().map(|&i| values[i]).collect();
    for row in (50..kept.len()).step_by(211) {
        (mask[row], some[row]) = (false, f64::NAN);
    }
    let holed = allan(&time, &some, &mask).unwrap();
    for (a, b) in whole.iter().zip(&holed).filter(|(a, _)| a.tau < 20_000.0) {
        assert_eq!(a.tau, b.tau);
        assert!((a.deviation / b.deviation).ln().abs() < 0.15, "{a:?} {b:?}");
    }
    // no mean spans the pause between two islands
    let time: Vec<f64> = (0..100).map(|i| f64::from(i) + if i >= 60 { 1e9 } else { 0.0 }).collect();
    assert!(allan(&time, &values[..100], &[true; 100]).unwrap().iter().all(|point| point.tau <= 30.0));
}

/// Bursts of ten rows: a pause of any length between them is a pause, and all of them count.
#[test]
fn exact_the_length_of_a_pause_is_no_matter() {
    let mut random = Random::new(5);
    let values: Vec<f64> = (0..2000).map(|_| random.normal()).collect();
    let bursts = |pause: f64| {
        let time: Vec<f64> = (0..2000).map(|n| f64::from(n) + f64::from(n / 10) * pause).collect();
        allan(&time, &values, &[true; 2000]).expect("points")
    };
    let [near, far, farthest] = [15.0, 40.0, 1e6].map(bursts);
    assert!(near.len() > 3 && near[0].freedom > 1000.0, "{near:?}");
    assert!((near[0].deviation - 1.0).abs() < 0.05, "{near:?}");
    for other in [far, farthest] {
        assert_eq!(other.len(), near.len());
        assert!(
            near.iter().zip(&other).all(|(a, b)| a.tau == b.tau && (a.deviation / b.deviation - 1.0).abs() < 1e-9),
            "{other:?}"
        );
    }
    // what stands before a pause and is not used takes nothing from what is; beyond ten rows a mean may lack one
    let time: Vec<f64> = (0..2000).map(|n| f64::from(n) + if n < 1100 { 0.0 } else { 2e5 }).collect();
    let mask: Vec<bool> = (0..2000).map(|n| n >= 1100).collect();
    let alone = allan(&time[1100..], &values[1100..], &[true; 900]).expect("points");
    let after = allan(&time, &values, &mask).expect("points");
    assert!(
        alone.iter().zip(&after).take_while(|(a, _)| a.tau < 10.0).all(|(a, b)| (a.deviation / b.deviation - 1.0).abs() < 1e-9),
        "{after:?}"
    );
}

#[test]
fn what_cannot_be_is_refused() {
    assert!(allan(&even(7, 1.0), &[0.0; 7], &[true; 7]).is_err());
    assert!(allan(&even(9, 1.0), &[f64::NAN; 9], &[true; 9]).is_err());
    assert!(allan(&even(9, 1.0), &[0.0; 8], &[true; 9]).is_err());
    let constant = of(&[4.0; 20]);
    assert!(constant.iter().all(|point| point.deviation == 0.0 && point.high == 0.0));
}
