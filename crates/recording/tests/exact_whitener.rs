//! Whitening against the dense covariance matrix of the same noise.

use crate::common::{Random, cholesky, even, simulate};
use proptest::prelude::*;
use recording::Error;
use recording::noise::{NoiseModel, Whitener};
use recording::statistics::whiteness;

/// Start and end of the sample of each row.
fn spans(model: &NoiseModel, time: &[f64]) -> Vec<[f64; 2]> {
    let span = |row: usize| if row == 0 { model.averaging } else { model.averaging.min(time[row] - time[row - 1]) };
    (0..time.len()).map(|row| [time[row] - span(row), time[row]]).collect()
}

/// Covariance of two samples by the closed integrals over their spans; momentary values as the limit.
fn covariance(model: &NoiseModel, [a, b]: [[f64; 2]; 2], origin: f64) -> f64 {
    let (first, second) = if a[1] <= b[1] { (a, b) } else { (b, a) };
    let same = first == second;
    let mean = |u: f64| if u == 0.0 { 1.0 } else { -(-u).exp_m1() / u };
    let mut sum = 0.0;
    for (size, drift_time) in [(model.drift, model.drift_time), (model.passed, model.passed_time)] {
        let u = |span: [f64; 2]| (span[1] - span[0]) / drift_time;
        sum += size.powi(2)
            * if same && u(first) > 0.0 {
                2.0 * (u(first) + (-u(first)).exp_m1()) / u(first).powi(2)
            } else if same {
                1.0
            } else {
                mean(u(first)) * mean(u(second)) * (-(second[0] - first[1]) / drift_time).exp()
            };
    }
    // walk: of two means, that over the earlier span counts
    let share = if same { 1.0 / 3.0 } else { 0.5 };
    sum += model.walk.powi(2) * (first[0] - origin + share * (first[1] - first[0]));
    // rounding at starts and ends
    if model.quantisation > 0.0 {
        let meet = |x: f64, y: f64| f64::from(u8::from((x - y).abs() < 1e-9));
        let shared = meet(a[1], b[1]) + meet(a[0], b[0]) - meet(a[1], b[0]) - meet(a[0], b[1]);
        sum += model.quantisation.powi(2) * shared / ((a[1] - a[0]) * (b[1] - b[0]));
    }
    if same {
        sum += model.white.powi(2) * if a[1] > a[0] { model.averaging / (a[1] - a[0]) } else { 1.0 };
    }
    sum
}

/// Whitened series and log determinant by the dense factor.
fn dense(model: &NoiseModel, time: &[f64], mask: &[bool], series: &[f64]) -> (Vec<f64>, f64) {
    let rows: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
    let spans = spans(model, time);
    let origin = rows.first().map_or(0.0, |&row| spans[row][0]);
    let matrix: Vec<Vec<f64>> =
        rows.iter().map(|&i| rows.iter().map(|&j| covariance(model, [spans[i], spans[j]], origin)).collect()).collect();
    let lower = cholesky(&matrix);
    let mut white: Vec<f64> = Vec::new();
    for (i, &row) in rows.iter().enumerate() {
        let known: f64 = (0..i).map(|k| lower[i][k] * white[k]).sum();
        white.push((series[row] - known) / lower[i][i]);
    }
    (white, (0..rows.len()).map(|i| 2.0 * lower[i][i].ln()).sum())
}

fn agree(model: &NoiseModel, time: &[f64], mask: &[bool], series: &[f64]) {
    let whitener = Whitener::new(model, time, mask).expect("valid model");
    let (expected, log_det) = dense(model, time, mask, series);
    let found = whitener.apply(series);
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(1.0_f64, |most, value| most.max(value.abs()));
    for (n, (found, expected)) in found.iter().zip(&expected).enumerate() {
        assert!((found - expected).abs() < 1e-8 * scale, "value {n}: {found} {expected} of {model:?}");
    }
    assert!((whitener.log_det() - log_det).abs() < 1e-8 * (1.0 + log_det.abs()), "{} {log_det}", whitener.log_det());
    let squares: f64 = expected.iter().map(|z| z * z).sum();
    let likelihood = -0.5 * (squares + log_det + expected.len() as f64 * std::f64::consts::TAU.ln());
    assert!((whitener.log_likelihood(series) - likelihood).abs() < 1e-7 * (1.0 + likelihood.abs()));
}

proptest! {
    #[test]
    fn it_is_the_dense_factor(
        // an interval never pauses less than half a span: there the rounding's model says "contiguous", the test's says not
        intervals in prop::collection::vec(prop_oneof![Just(30.0), 5.0..30.0_f64, 45.0..4000.0_f64], 1..60),
        seed in any::<u64>(),
        averaging in prop_oneof![Just(0.0), Just(30.0)],
        sizes in (1e-2..10.0_f64, 0.0..5.0_f64, 0.0..0.5_f64, 0.0..100.0_f64, 0.0..5.0_f64),
        drift_time in 1.0..1e5_f64,
        present in prop::array::uniform3(any::<bool>()),
    ) {
        let mut random = Random::new(seed);
        let time: Vec<f64> = intervals.iter().scan(1e6, |t, dt| { *t += dt; Some(*t) }).collect();
        let mask: Vec<bool> = time.iter().map(|_| random.uniform() < 0.8).collect();
        let series: Vec<f64> = mask.iter().map(|used| if *used { 3.0 * random.normal() } else { f64::NAN }).collect();
        let keep = |present: bool, size: f64| if present { size } else { 0.0 };
        let model = NoiseModel {
            averaging,
            white: sizes.0,
            drift: keep(present[0], sizes.1),
            drift_time,
            walk: keep(present[1], sizes.2),
            quantisation: keep(present[2] && averaging > 0.0, sizes.3),
            passed: keep(present[1], sizes.4),
            passed_time: drift_time / 7.0,
        };
        agree(&model, &time, &mask, &series);
    }

    #[test]
    fn it_is_linear(seed in any::<u64>(), a in -3.0..3.0_f64, b in -3.0..3.0_f64) {
        let mut random = Random::new(seed);
        let time = even(200, 30.0);
        let mask: Vec<bool> = time.iter().map(|_| random.uniform() < 0.9).collect();
        let (x, y) = (random.normals(200), random.normals(200));
        let model = NoiseModel { drift: 0.4, drift_time: 3000.0, walk: 1e-3, quantisation: 5.0, ..NoiseModel::white(1.0, 30.0) };
        let whitener = Whitener::new(&model, &time, &mask).unwrap();
        let sum: Vec<f64> = x.iter().zip(&y).map(|(x, y)| a * x + b * y).collect();
        let (wx, wy) = (whitener.apply(&x), whitener.apply(&y));
        for ((sum, x), y) in whitener.apply(&sum).iter().zip(wx).zip(wy) {
            prop_assert!((sum - a * x - b * y).abs() < 1e-11);
        }
    }
}

#[test]
fn long_even_stretches_use_settled_gains_that_are_right() {
    // the gains settle after some tens of rows; the gap and the mask unsettle them
    let mut time = even(300, 30.0);
    time[170..].iter_mut().for_each(|t| *t += 1000.0);
    let mut mask = vec![true; 300];
    mask[100] = false;
    mask[101] = false;
    let model = NoiseModel { drift: 0.5, drift_time: 600.0, walk: 0.01, quantisation: 10.0, ..NoiseModel::white(1.0, 30.0) };
    agree(&model, &time, &mask, &Random::new(1).normals(300));
}

#[test]
fn noise_of_the_model_comes_out_white() {
    let model = NoiseModel { drift: 0.6, drift_time: 3600.0, walk: 2e-3, quantisation: 20.0, ..NoiseModel::white(1.0, 30.0) };
    let (time, mask) = (even(4000, 30.0), vec![true; 4000]);
    let whitener = Whitener::new(&model, &time, &mask).unwrap();
    let plain = Whitener::new(&NoiseModel::white(1.0, 30.0), &time, &mask).unwrap();
    let mut probabilities = Vec::new();
    for seed in 0..40 {
        let series = simulate(&model, 4000, &mut Random::new(seed));
        let white = whitener.apply(&series);
        let variance = white.iter().map(|z| z * z).sum::<f64>() / 4000.0;
        assert!((variance - 1.0).abs() < 5.0 * (2.0 / 4000.0_f64).sqrt(), "seed {seed}: {variance}");
        probabilities.push(whiteness(&white, 40).unwrap());
        assert!(whiteness(&plain.apply(&series), 40).unwrap() < 1e-9, "the series itself is not white");
    }
    // uniform in (0, 1): mean 0.5 ± 0.29/√40, and none impossibly small
    let mean = probabilities.iter().sum::<f64>() / 40.0;
    assert!((mean - 0.5).abs() < 4.0 * 0.29 / 40.0_f64.sqrt(), "{mean}");
    assert!(probabilities.iter().all(|p| *p > 1e-4), "{probabilities:?}");
}

#[test]
fn what_cannot_be_is_refused() {
    let model = NoiseModel::white(1.0, 30.0);
    let refused = |model: &NoiseModel, time: &[f64], mask: &[bool]| Whitener::new(model, time, mask).unwrap_err();
    assert!(matches!(refused(&model, &[0.0, 0.0], &[true; 2]), Error::Time { row: 1, .. }));
    assert!(matches!(refused(&model, &[0.0, f64::NAN], &[true; 2]), Error::Time { row: 1, .. }));
    assert!(matches!(refused(&model, &[0.0, 1.0], &[true]), Error::Length { found: 1, expected: 2, .. }));
    let bad = [
        NoiseModel { white: 0.0, ..model },
        NoiseModel { white: f64::NAN, ..model },
        NoiseModel { drift: -1.0, ..model },
        NoiseModel { drift_time: 0.0, ..model },
        NoiseModel { walk: f64::INFINITY, ..model },
        NoiseModel { quantisation: 1.0, averaging: 0.0, ..model },
    ];
    for bad in bad {
        assert!(matches!(refused(&bad, &[0.0], &[true]), Error::Parameter { .. }), "{bad:?}");
    }
    assert!(Whitener::new(&model, &[], &[]).unwrap().apply(&[]).is_empty());
}
