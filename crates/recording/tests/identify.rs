//! Simulated noise is found again, with intervals that cover it.

use crate::common::{Random, even, simulate};
use recording::Error;
use recording::noise::{Bounds, NoiseEstimate, NoiseModel, Parameter, Series, Term, identify};

const COUNT: usize = 2500;

fn estimate(time: &[f64], values: &[f64], bounds: &Bounds) -> NoiseEstimate {
    let (mask, one) = (vec![true; time.len()], vec![1.0; time.len()]);
    identify(&Series { time, values, mask: &mask, columns: &[&one] }, bounds).expect("valid series")
}

/// Share of 90 % intervals that hold the truth.
struct Coverage(Vec<bool>);

impl Coverage {
    fn add(&mut self, found: f64, truth: f64, error: Option<f64>) {
        if let Some(error) = error {
            self.0.push((found / truth).ln().abs() < 1.645 * error);
        }
    }

    fn share(&self) -> f64 {
        self.0.iter().filter(|&&holds| holds).count() as f64 / self.0.len() as f64
    }
}

#[test]
fn white_noise_and_drift() {
    let truth = NoiseModel { drift: 0.4, drift_time: 5000.0, ..NoiseModel::white(1.0, 30.0) };
    let time = even(COUNT, 30.0);
    let bounds = Bounds { terms: vec![Term::Drift], ..Bounds::new(30.0, &time) };
    let (mut white, mut slow, mut found) = (Coverage(vec![]), Coverage(vec![]), 0);
    for seed in 0..30 {
        let values: Vec<f64> = simulate(&truth, COUNT, &mut Random::new(seed)).iter().map(|x| x + 7.0).collect();
        let NoiseEstimate { model, standard_errors, terms, .. } = estimate(&time, &values, &bounds);
        found += usize::from(terms == [Term::Drift]);
        white.add(model.white, truth.white, standard_errors.white);
        slow.add(model.drift, truth.drift, standard_errors.drift);
        slow.add(model.drift_time, truth.drift_time, standard_errors.drift_time);
    }
    println!("found {found}/30, 90 % intervals cover: white {}, drift {}", white.share(), slow.share());
    assert_eq!(found, 30);
    // 30 trials at 0.9: 0.9 ± 0.055
    assert!(white.share() >= 0.75, "{}", white.share());
    assert!(slow.share() >= 0.75, "{}", slow.share());
}

/// A logger that is a thousand times faster or slower gives the same noise in its own time.
#[test]
fn exact_noise_does_not_depend_on_the_unit_of_time() {
    let cases = [
        (Term::Drift, NoiseModel { drift: 0.4, drift_time: 5000.0, ..NoiseModel::white(1.0, 30.0) }),
        (Term::Walk, NoiseModel { walk: 0.004, ..NoiseModel::white(1.0, 30.0) }),
        (Term::Quantisation, NoiseModel { quantisation: 60.0, ..NoiseModel::white(1.0, 30.0) }),
    ];
    for (term, truth) in cases {
        let values = simulate(&truth, COUNT, &mut Random::new(8));
        let of = |unit: f64| {
            let time = even(COUNT, 30.0 * unit);
            let model = estimate(&time, &values, &Bounds { terms: vec![term], ..Bounds::new(30.0 * unit, &time) }).model;
            let drift_time = if model.drift > 0.0 { model.drift_time / unit } else { 0.0 };
            [model.white, model.drift, drift_time, model.walk * unit.sqrt(), model.quantisation / unit]
        };
        let own = of(1.0);
        assert!(own[1] + own[3] + own[4] > 0.0, "{term:?} is found");
        for unit in [1e-3, 1e3] {
            for (a, b) in of(unit).into_iter().zip(own) {
                assert!((a - b).abs() <= 2e-3 * b.abs(), "{term:?} in {unit} s: {:?} {own:?}", of(unit));
            }
        }
    }
}

/// The error of a number that follows from the noise: of a parameter its own, of its square twice that, of a product with the correlation.
#[test]
fn exact_errors_of_derived_numbers() {
    let truth = NoiseModel { drift: 0.4, drift_time: 5000.0, ..NoiseModel::white(1.0, 30.0) };
    let time = even(COUNT, 30.0);
    let bounds = Bounds { terms: vec![Term::Drift], ..Bounds::new(30.0, &time) };
    let found = estimate(&time, &simulate(&truth, COUNT, &mut Random::new(3)), &bounds);
    let (white, drift) = (found.standard_errors.white.expect("known"), found.standard_errors.drift.expect("known"));
    let error = |of: &dyn Fn(&NoiseModel) -> f64| found.relative_error(of).expect("known");
    assert!((error(&|m| m.white) / white - 1.0).abs() < 1e-6, "{white}");
    assert!((error(&|m| m.drift.powi(2)) / (2.0 * drift) - 1.0).abs() < 1e-6, "{drift}");
    assert!(error(&|_| 5.0) < 1e-12);
    // Var(ln a + ln b) + Var(ln a − ln b) = 2 Var(ln a) + 2 Var(ln b)
    let (product, ratio) = (error(&|m| m.white * m.drift), error(&|m| m.white / m.drift));
    let sum = 2.0 * (white.powi(2) + drift.powi(2));
    assert!(((product.powi(2) + ratio.powi(2)) / sum - 1.0).abs() < 1e-6 && product != ratio, "{product} {ratio} {sum}");
}

/// N falls with the root of the time of a mean; momentary values have none.
#[test]
fn exact_the_angle_random_walk_is_that_of_the_allan_deviation() {
    let model = NoiseModel::white(0.3, 30.0);
    let walk = model.angle_random_walk().expect("a mean");
    for tau in [30.0, 300.0, 3000.0_f64] {
        assert!((model.allan_deviation(tau, 30.0) * tau.sqrt() / walk - 1.0).abs() < 1e-12, "{tau}");
    }
    assert_eq!(NoiseModel::white(0.3, 0.0).angle_random_walk(), None);
}

#[test]
fn white_noise_and_walk() {
    let truth = NoiseModel { walk: 0.01, ..NoiseModel::white(1.0, 30.0) };
    let time = even(COUNT, 30.0);
    let bounds = Bounds { terms: vec![Term::Walk], ..Bounds::new(30.0, &time) };
    let (mut coverage, mut ratio) = (Coverage(vec![]), 0.0);
    for seed in 100..140 {
        let result = estimate(&time, &simulate(&truth, COUNT, &mut Random::new(seed)), &bounds);
        assert_eq!(result.terms, [Term::Walk], "seed {seed}");
        coverage.add(result.model.white, truth.white, result.standard_errors.white);
        coverage.add(result.model.walk, truth.walk, result.standard_errors.walk);
        ratio += (result.model.walk / truth.walk).ln() / 40.0;
    }
    println!("90 % intervals cover {}, mean ln(walk/truth) {ratio}", coverage.share());
    assert_eq!(coverage.0.len(), 80);
    assert!((0.8..=0.98).contains(&coverage.share()), "{}", coverage.share());
    assert!(ratio.abs() < 0.08, "{ratio}");
}

#[test]
fn white_noise_alone_and_quantisation() {
    let time = even(COUNT, 30.0);
    let bounds = Bounds { terms: vec![Term::Drift, Term::Walk, Term::Quantisation], ..Bounds::new(30.0, &time) };
    let (mut alone, mut coverage) = (0, Coverage(vec![]));
    for seed in 200..220 {
        let white = simulate(&NoiseModel::white(1.0, 30.0), COUNT, &mut Random::new(seed));
        alone += usize::from(estimate(&time, &white, &bounds).terms.is_empty());
        let truth = NoiseModel { quantisation: 30.0, ..NoiseModel::white(1.0, 30.0) };
        let result = estimate(&time, &simulate(&truth, COUNT, &mut Random::new(seed)), &bounds);
        assert!(result.terms.contains(&Term::Quantisation), "seed {seed}: {:?}", result.terms);
        coverage.add(result.model.quantisation, truth.quantisation, result.standard_errors.quantisation);
    }
    println!("nothing invented in {alone}/20; 90 % intervals of the quantisation cover {}", coverage.share());
    assert!(alone >= 18, "{alone}");
    assert!(coverage.share() >= 0.7, "{}", coverage.share());
}

#[test]
fn columns_are_taken_off_and_gaps_do_not_matter() {
    let truth = NoiseModel { drift: 0.6, drift_time: 1200.0, ..NoiseModel::white(1.0, 30.0) };
    let mut random = Random::new(9);
    let all = simulate(&truth, 4000, &mut random);
    let kept: Vec<usize> = (0..4000).filter(|i| !(1000..1100).contains(i) && i % 97 != 0).collect();
    let time: Vec<f64> = kept.iter().map(|&i| 30.0 * (i + 1) as f64).collect();
    let ramp: Vec<f64> = time.iter().map(|t| t / 1e4).collect();
    let (one, wave): (Vec<f64>, Vec<f64>) = time.iter().map(|t| (1.0, (t / 3000.0).sin())).unzip();
    let mut values: Vec<f64> =
        kept.iter().zip(&ramp).zip(&wave).map(|((&i, r), w)| all[i] + 50.0 - 20.0 * r + 30.0 * w).collect();
    let mut mask = vec![true; time.len()];
    (mask[5], values[5]) = (false, f64::NAN);
    (mask[2000], values[2000]) = (false, 1e9);
    let twice: Vec<f64> = wave.iter().map(|w| 2.0 * w).collect();
    let series = Series { time: &time, values: &values, mask: &mask, columns: &[&one, &ramp, &wave, &twice] };
    let result = identify(&series, &Bounds::new(30.0, &time)).unwrap();
    assert_eq!(result.terms, [Term::Drift]);
    let close = |found: f64, truth: f64, error: Option<f64>| (found / truth).ln().abs() < 3.0 * error.unwrap();
    assert!(close(result.model.white, 1.0, result.standard_errors.white), "{result:?}");
    assert!(close(result.model.drift, 0.6, result.standard_errors.drift), "{result:?}");
    // and the residual is what was put in, but for the columns' own share of it
    let rest = recording::noise::residual(&series, &result.model).unwrap();
    let apart: Vec<f64> = rest.iter().zip(&kept).filter(|(r, _)| r.is_finite()).map(|(r, &i)| r - all[i]).collect();
    assert_eq!(rest.iter().filter(|r| r.is_nan()).count(), 2);
    assert!(apart.iter().all(|a| a.abs() < 1.0), "the wave of 30 and the ramp of 240 are gone");
    // without the column the wave is taken for slow noise
    let without = identify(&Series { columns: &[&one, &ramp], ..series }, &Bounds::new(30.0, &time)).unwrap();
    assert!(without.model.allan_deviation(3000.0, 30.0) > 5.0 * truth.allan_deviation(3000.0, 30.0), "{without:?}");
}

#[test]
fn long_series_are_thinned_and_give_the_same() {
    let truth = NoiseModel { drift: 0.3, drift_time: 400.0, walk: 2e-3, ..NoiseModel::white(1.0, 1.0) };
    let count = 100_000;
    let mut values = simulate(&truth, count, &mut Random::new(4));
    let mut time = even(count, 1.0);
    time[40_002..].iter_mut().for_each(|t| *t += 500.0); // a group must not reach across, nor hold a masked row
    let mask: Vec<bool> = (0..count).map(|row| row % 5003 != 7).collect();
    mask.iter().zip(&mut values).filter(|(used, _)| !**used).for_each(|(_, value)| *value = 1e3);
    let start = std::time::Instant::now();
    let series = Series { time: &time, values: &values, mask: &mask, columns: &[&vec![1.0; count]] };
    let result = identify(&series, &Bounds::new(1.0, &time)).unwrap();
    println!("{count} rows in {:?}: {:?} {:?}", start.elapsed(), result.model, result.standard_errors);
    assert_eq!(result.group, 5);
    let errors = result.standard_errors;
    let checks = [
        (result.model.white, truth.white, errors.white),
        (result.model.drift, truth.drift, errors.drift),
        (result.model.drift_time, truth.drift_time, errors.drift_time),
        (result.model.walk, truth.walk, errors.walk),
    ];
    for (found, truth, error) in checks {
        assert!((found / truth).ln().abs() < 3.5 * error.unwrap(), "{found} {truth} {error:?}");
    }
}

#[test]
fn momentary_values() {
    // with no span the samples are white noise and an autoregression of the first order
    let mut random = Random::new(12);
    let kept = (-30.0 / 2000.0_f64).exp();
    let mut drift = random.normal();
    let sample = |_| {
        drift = kept * drift + (1.0 - kept * kept).sqrt() * random.normal();
        0.5 * drift + 0.7 * random.normal()
    };
    let values: Vec<f64> = (0..COUNT).map(sample).collect();
    let time = even(COUNT, 30.0);
    let result = estimate(&time, &values, &Bounds::new(0.0, &time));
    assert_eq!(result.terms, [Term::Drift]);
    assert!((result.model.white / 0.7).ln().abs() < 3.0 * result.standard_errors.white.unwrap());
    assert!((result.model.drift / 0.5).ln().abs() < 3.0 * result.standard_errors.drift.unwrap());
}

#[test]
fn what_cannot_be_identified_is_refused() {
    let time = even(100, 30.0);
    let bounds = Bounds::new(30.0, &time);
    let run = |values: &[f64], mask: &[bool], columns: &[&[f64]], bounds: &Bounds| {
        identify(&Series { time: &time, values, mask, columns }, bounds).unwrap_err()
    };
    let (mask, noise, one) = ([true; 100], Random::new(1).normals(100), [1.0; 100]);
    assert_eq!(run(&[5.0; 100], &mask, &[&one], &bounds), Error::NoNoise);
    assert!(matches!(run(&noise, &[false; 100], &[], &bounds), Error::TooFew { found: 0, .. }));
    assert!(matches!(run(&noise[1..], &mask, &[], &bounds), Error::Length { found: 99, .. }));
    assert!(matches!(run(&noise, &mask, &[&one[1..]], &bounds), Error::Length { .. }));
    let mut holed = noise.clone();
    holed[7] = f64::NAN;
    assert!(matches!(run(&holed, &mask, &[], &bounds), Error::Value { row: 7, .. }));
    let backwards = Bounds { drift_time: [100.0, 10.0], ..bounds.clone() };
    assert!(matches!(run(&noise, &mask, &[], &backwards), Error::Parameter { name: "drift_time", .. }));
}

/// An offset is no noise, however large it is, and whether or not a column says so.
#[test]
fn a_series_may_have_any_offset() {
    let (time, one) = (even(400, 30.0), [1.0; 400]);
    let noise = walking(0.02, 400, 3);
    let of = |offset: f64, columns: &[&[f64]]| {
        let values: Vec<f64> = noise.iter().map(|value| value + offset).collect();
        identify(&Series { time: &time, values: &values, mask: &[true; 400], columns }, &Bounds::new(30.0, &time)).expect("noise")
    };
    let told = of(0.0, &[&one]);
    for offset in [0.0, -1e4, 1e6] {
        let found = of(offset, &[]);
        assert_eq!(found.terms, told.terms, "{offset}");
        assert!((found.model.white / told.model.white - 1.0).abs() < 1e-4, "{offset}: {found:?}");
    }
}

/// White noise of 1 with a walk, a row each second.
fn walking(walk: f64, count: usize, seed: u64) -> Vec<f64> {
    simulate(&NoiseModel { walk, ..NoiseModel::white(1.0, 1.0) }, count, &mut Random::new(seed))
}

fn means(values: &[f64], of: usize) -> Vec<f64> {
    values.chunks_exact(of).map(|rows| rows.iter().sum::<f64>() / of as f64).collect()
}

/// The least walk that a record tells is its white noise over its length: far below a thousandth of a value's in a long and quick one.
#[test]
fn a_faint_walk_is_told_by_the_length_of_the_record() {
    for (times, least) in [(12.0, 0.4), (40.0, 0.95)] {
        let (mut coverage, mut made) = (Coverage(vec![]), 0);
        for (count, seeds) in [(2000, 24), (8000, 12), (20_000, 8), (50_000, 4)] {
            let truth = times / f64::from(count);
            for seed in 0..seeds {
                let values = walking(truth, count as usize, 1000 * times as u64 + seed);
                let of = |values: &[f64], interval: f64| {
                    let time = even(values.len(), interval);
                    let found = estimate(&time, values, &Bounds { terms: vec![Term::Walk], ..Bounds::new(interval, &time) });
                    assert!(found.at_edge.is_empty() && found.standard_errors.white.is_some(), "{count} {seed}: {found:?}");
                    assert_eq!(found.terms.contains(&Term::Walk), found.standard_errors.walk.is_some(), "{count} {seed}");
                    found
                };
                let (fine, coarse) = (of(&values, 1.0), of(&means(&values, 20), 20.0));
                made += 1;
                coverage.add(fine.model.walk, truth, fine.standard_errors.walk);
                if let (Some(error), Some(_)) = (fine.standard_errors.walk, coarse.standard_errors.walk) {
                    let apart = (fine.model.walk / coarse.model.walk).ln().abs() / error;
                    assert!(apart < 1.0, "{count} {seed}: means of 20 rows differ by {apart} errors");
                }
            }
        }
        let found = coverage.0.len() as f64 / f64::from(made);
        println!("{times} over the length: found in {found}, 90 % intervals cover {}", coverage.share());
        assert!(found >= least, "{times}: {found}");
        assert!(coverage.share() >= 0.8, "{times}: {}", coverage.share());
    }
}

#[test]
fn of_white_noise_alone_no_slow_term_is_invented() {
    let (mut invented, mut made) = (0, 0);
    for (count, seeds) in [(500, 60), (2000, 60), (20_000, 8)] {
        let time = even(count, 1.0);
        for seed in 0..seeds {
            let found = estimate(&time, &walking(0.0, count, 7000 + seed), &Bounds::new(1.0, &time));
            assert!(found.at_edge.is_empty() && found.standard_errors.white.is_some(), "{count} {seed}: {found:?}");
            invented += usize::from(!found.terms.is_empty());
            made += 1;
        }
    }
    println!("invented in {invented} of {made}");
    assert!(20 * invented <= made, "{invented} of {made}");
}

/// Of a record without white noise, and of a drift that is longer than the longest sought, the ends of the search are not told as found.
#[test]
fn what_stands_at_an_end_of_the_search_is_not_told() {
    let time = even(2000, 1.0);
    // means of a walk, given as momentary values: their steps go on, where white noise would turn them back
    let smooth: Vec<f64> = walking(1.0, 2000, 5).windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    let smooth = [&smooth[..1], &smooth[..]].concat();
    let found = estimate(&time, &smooth, &Bounds { terms: vec![Term::Walk], ..Bounds::new(0.0, &time) });
    assert_eq!((found.at_edge.as_slice(), found.standard_errors.white), ([Parameter::White].as_slice(), None));
    assert!(found.standard_errors.walk.expect("known") < 0.02, "{found:?}");
    let truth = NoiseModel { drift: 0.6, drift_time: 400.0, ..NoiseModel::white(1.0, 1.0) };
    let values = simulate(&truth, 2000, &mut Random::new(3));
    let bounds = Bounds { drift_time: [4.0, 100.0], terms: vec![Term::Drift], ..Bounds::new(1.0, &time) };
    let found = estimate(&time, &values, &bounds);
    assert_eq!(found.at_edge, [Parameter::Drift, Parameter::DriftTime]);
    assert_eq!((found.standard_errors.drift, found.standard_errors.drift_time), (None, None));
    let white = found.standard_errors.white.expect("known");
    assert!(found.model.white.ln().abs() < 3.0 * white, "{found:?}");
    // what follows from it within the record is told
    assert!(found.relative_error(|model| model.allan_deviation(20.0, 1.0)).expect("known") < 0.2);
}
