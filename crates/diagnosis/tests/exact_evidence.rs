//! Evidence, posterior and separation of linear models under white noise, against the Gaussian integrals in closed form.

use crate::common::lines::{Lines, PRIOR_SD, WHITE, alone};
use crate::common::normal;
use diagnosis::{Fit, Hypothesis, Observation, Plan, Settings, Verdict, diagnose, fitted, separation};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

/// Exact results of a linear Gaussian model y = A x + e, with x ~ N(0, P) and e ~ N(0, WHITE²).
struct Exact {
    /// ln N(y; 0, A P Aᵀ + WHITE² I) + n/2 ln 2π
    log_evidence: f64,
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
}

/// By the dense covariance matrix of the data: another route than the engine's.
fn exact(columns: &[Vec<f64>], prior_sds: &[f64], y: &[f64]) -> Exact {
    let prior = DMatrix::from_diagonal(&DVector::from_iterator(prior_sds.len(), prior_sds.iter().map(|sd| sd * sd)));
    exact_of(columns, prior, y)
}

/// The same where unknowns go together.
fn exact_of(columns: &[Vec<f64>], prior: DMatrix<f64>, y: &[f64]) -> Exact {
    let a = DMatrix::from_vec(y.len(), columns.len(), columns.concat());
    let covariance = &a * &prior * a.transpose() + DMatrix::identity(y.len(), y.len()) * WHITE.powi(2);
    let factor = covariance.cholesky().expect("positive definite");
    let y = DVector::from_column_slice(y);
    let solved = factor.solve(&y);
    let half_log_det: f64 = factor.l().diagonal().iter().map(|d| d.ln()).sum();
    let gain = &prior * a.transpose();
    Exact {
        log_evidence: -y.dot(&solved) / 2.0 - half_log_det,
        mean: &gain * solved,
        covariance: &prior - &gain * factor.solve(&(&a * &prior)),
    }
}

/// Covariance beforehand of two constants that go together, and of an offset.
fn prior_of(lines: &Lines, correlation: f64) -> DMatrix<f64> {
    let mut prior =
        DMatrix::from_diagonal(&DVector::from_column_slice(&[PRIOR_SD, PRIOR_SD, lines.offset_sd()].map(|sd| sd * sd)));
    (prior[(0, 1)], prior[(1, 0)]) = (correlation * PRIOR_SD.powi(2), correlation * PRIOR_SD.powi(2));
    prior
}

fn fit(lines: &Lines, y: &[f64], hypothesis: &Hypothesis) -> Fit {
    fitted(lines, &[0], &[lines.observed(y)], std::slice::from_ref(hypothesis)).expect("a fit")
}

/// Noise of the model.
fn noise(rows: usize, seed: u64) -> Vec<f64> {
    let mut normal = normal(seed);
    (0..rows).map(|_| WHITE * normal()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn laplace_is_exact_for_a_linear_model(seed in any::<u64>(), sizes in prop::array::uniform2(-3.0..3.0_f64), both in any::<bool>()) {
        let lines = Lines::new(40);
        let y: Vec<f64> = noise(40, seed)
            .iter()
            .enumerate()
            .map(|(n, e)| e + sizes[0] * lines.column(0)[n] + if both { sizes[1] * lines.column(1)[n] } else { 0.0 })
            .collect();
        // ln evidence is up to a constant: that of the nominal model is taken off, whose offset is its only unknown
        let offset = vec![1.0; 40];
        let nominal = fit(&lines, &y, &Hypothesis::NOMINAL);
        let nothing = exact(std::slice::from_ref(&offset), &[lines.offset_sd()], &y);
        for mechanisms in [vec![0], vec![1], vec![0, 1]] {
            let hypothesis = Hypothesis { mechanisms: mechanisms.iter().map(|m| (*m, None)).collect(), constants_free: false };
            let found = fit(&lines, &y, &hypothesis);
            let columns: Vec<Vec<f64>> = mechanisms.iter().map(|m| lines.column(*m)).chain([offset.clone()]).collect();
            let sds: Vec<f64> = mechanisms.iter().map(|_| PRIOR_SD).chain([lines.offset_sd()]).collect();
            let closed = exact(&columns, &sds, &y);
            let (gain, expected) = (found.log_evidence - nominal.log_evidence, closed.log_evidence - nothing.log_evidence);
            prop_assert!((gain - expected).abs() < 1e-4 * (1.0 + expected.abs()), "{gain} {expected}");
            for (place, active) in found.active.iter().enumerate() {
                let sd = closed.covariance[(place, place)].sqrt();
                prop_assert!((active.values[0] - closed.mean[place]).abs() < 1e-3 * sd, "{} {}", active.values[0], closed.mean[place]);
                let [low, high] = found.estimates(&lines, place)[0].ci90;
                // 2 × 1.6449 standard deviations
                prop_assert!(((high - low) / sd - 3.289_707).abs() < 1e-3, "{low} {high} {sd}");
            }
        }
    }

    /// Neither the zero of time, nor the order of rows that are not used, nor the unit of the channel changes what is found.
    #[test]
    fn the_clock_s_zero_and_the_channel_s_unit_do_not_matter(seed in any::<u64>(), shift in -1e4..1e4_f64, unit in 0.1..50.0_f64) {
        let lines = Lines::new(40);
        let y: Vec<f64> = noise(40, seed).iter().zip(lines.column(0)).map(|(e, x)| e + 0.7 * x).collect();
        let plain = fit(&lines, &y, &alone(0));
        let scaled = Lines::in_unit(40, unit);
        let mut observed = scaled.observed(&y.iter().map(|y| unit * y).collect::<Vec<_>>());
        observed.time.iter_mut().for_each(|t| *t += shift);
        let other = fitted(&scaled, &[0], &[observed], &[alone(0)]).expect("a fit");
        prop_assert!((plain.active[0].values[0] - other.active[0].values[0]).abs() < 1e-6);
        // the density of the data changes with its unit
        let density = other.log_evidence + 40.0 * unit.ln();
        prop_assert!((plain.log_evidence - density).abs() < 1e-6 * (1.0 + density.abs()), "{} {density}", plain.log_evidence);
    }

    /// Two constants that go together, and a mechanism in the place of one of them: then the other is as it is alone.
    #[test]
    fn a_constant_that_is_stood_for_says_nothing_of_another(seed in any::<u64>(), correlation in -0.95..0.95_f64, size in -3.0..3.0_f64) {
        let lines = Lines::with_constants(40, correlation);
        let y: Vec<f64> = noise(40, seed).iter().zip(lines.column(1)).map(|(e, x)| e + size * x).collect();
        let columns = [lines.column(0), lines.column(1), vec![1.0; 40]];
        let [apart, together] = [0.0, correlation].map(|correlation| exact_of(&columns, prior_of(&lines, correlation), &y));
        let [constants, mechanism] = [Hypothesis::RECALIBRATED, alone(0)].map(|hypothesis| fit(&lines, &y, &hypothesis));
        let (gain, expected) = (mechanism.log_evidence - constants.log_evidence, apart.log_evidence - together.log_evidence);
        prop_assert!((gain - expected).abs() < 1e-4 * (1.0 + expected.abs()), "{gain} {expected}");
        for (fit, exact) in [(&constants, &together), (&mechanism, &apart)] {
            let sd = exact.covariance[(1, 1)].sqrt();
            prop_assert!((fit.nuisances[0][1] - exact.mean[1]).abs() < 1e-3 * sd, "{:?} {}", fit.nuisances, exact.mean);
        }
    }

    /// Constants as a fit leaves them, in standard deviations of their priors and in any order; those that were not fitted are as they were.
    #[test]
    fn what_is_believed_of_constants_is_the_exact_posterior(seed in any::<u64>(), correlation in -0.95..0.95_f64, size in -3.0..3.0_f64) {
        let lines = Lines::with_constants(40, correlation);
        let y: Vec<f64> = noise(40, seed).iter().zip(lines.column(1)).map(|(e, x)| e + size * x).collect();
        let columns = [lines.column(0), lines.column(1), vec![1.0; 40]];
        let (together, apart) = (exact_of(&columns, prior_of(&lines, correlation), &y), exact_of(&columns, prior_of(&lines, 0.0), &y));
        let believed = |hypothesis: &Hypothesis, numbers: [usize; 2]| {
            let believed = fit(&lines, &y, hypothesis).believed(&lines, &numbers).expect("constants of a unit");
            (believed.mean, believed.covariance)
        };
        for numbers in [[0, 1], [1, 0]] {
            let (mean, covariance) = believed(&Hypothesis::RECALIBRATED, numbers);
            for (i, a) in numbers.into_iter().enumerate() {
                let sd = together.covariance[(a, a)].sqrt();
                prop_assert!((PRIOR_SD * mean[i] - together.mean[a]).abs() < 1e-3 * sd, "{mean} {}", together.mean);
                for (j, b) in numbers.into_iter().enumerate() {
                    let exact = together.covariance[(a, b)] / PRIOR_SD.powi(2);
                    prop_assert!((covariance[(i, j)] - exact).abs() < 1e-4 * (sd / PRIOR_SD).powi(2), "{covariance} {exact}");
                }
            }
            // a mechanism stands for the first
            let (mean, covariance) = believed(&alone(0), numbers);
            let (first, second) = (numbers[0], numbers[1]);
            let exact = apart.covariance[(1, 1)] / PRIOR_SD.powi(2);
            prop_assert!((PRIOR_SD * mean[second] - apart.mean[1]).abs() < 1e-3 * PRIOR_SD * exact.sqrt() && mean[first] == 0.0);
            prop_assert!((covariance[(second, second)] / exact - 1.0).abs() < 1e-4, "{covariance} {exact}");
            prop_assert!(covariance[(first, first)] == 1.0 && covariance[(0, 1)] == 0.0 && covariance[(1, 0)] == 0.0, "{covariance}");
        }
        let (mean, covariance) = believed(&Hypothesis::NOMINAL, [0, 1]);
        prop_assert_eq!((mean, covariance), (DVector::zeros(2), DMatrix::identity(2, 2)));
    }

    /// An effect x stands out by xᵀ (A P Aᵀ + σ² I)⁻¹ x, whatever the records have made of all else, with what the constants A are known by beforehand or
    /// by a lot.
    #[test]
    fn an_effect_stands_out_of_the_covariance_of_all_else(seed in any::<u64>(), correlation in -0.95..0.95_f64, size in 0.1..3.0_f64) {
        let lines = Lines::with_constants(40, correlation);
        let y: Vec<f64> = noise(40, seed).iter().zip(lines.column(0)).map(|(e, x)| e + 2.5 * x).collect();
        let recalibrated = fit(&lines, &y, &Hypothesis::RECALIBRATED);
        let columns = [lines.column(0), lines.column(1), vec![1.0; 40]];
        let effect = diagnosis::Active { mechanism: 1, values: vec![size], choice: None };
        let exact = |prior: DMatrix<f64>| {
            let a = DMatrix::from_vec(40, 3, columns.concat());
            let x = DVector::from_vec(lines.column(1)) * size;
            let covariance = &a * prior * a.transpose() + DMatrix::identity(40, 40) * WHITE.powi(2);
            x.dot(&covariance.cholesky().expect("positive definite").solve(&x)).sqrt()
        };
        let by = |known| recalibrated.stands_out(&lines, &[0], &effect, known).expect("a size");
        let beforehand = exact(prior_of(&lines, correlation));
        prop_assert!((by(None) / beforehand - 1.0).abs() < 1e-4, "{} {beforehand}", by(None));
        // a lot knows the second constant to a tenth of its tolerance, the first one to a half of it, and how they go together
        let lot = DMatrix::from_row_slice(2, 2, &[0.01, 0.02, 0.02, 0.25]);
        let mut prior = prior_of(&lines, 0.0);
        for (i, a) in [1, 0].into_iter().enumerate() {
            [1, 0].into_iter().enumerate().for_each(|(j, b)| prior[(a, b)] = lot[(i, j)] * PRIOR_SD.powi(2));
        }
        let (found, by_lot) = (by(Some((&[1, 0], &lot))), exact(prior));
        prop_assert!((found / by_lot - 1.0).abs() < 1e-4 && by_lot > beforehand, "{found} {by_lot}");
    }

    #[test]
    fn separation_is_the_distance_of_least_squares(size in 0.5..3.0_f64, every in 1..4_usize) {
        let lines = Lines::new(60);
        let recorded: Vec<f64> = (0..60).map(|n| if n % every == 0 { 0.0 } else { f64::NAN }).collect();
        let instants = [lines.observed(&recorded)];
        let truth = [diagnosis::Active { mechanism: 0, values: vec![size], choice: None }];
        let plan = Plan { records: &[0], instants: &instants, noise: None };
        let found = separation(&lines, &plan, &truth, &[alone(1)]).expect("a separation");
        let rows = || (0..60).step_by(every);
        let pick = |m: usize| rows().map(|n| lines.column(m)[n]).collect::<Vec<_>>();
        let response: Vec<f64> = pick(0).iter().map(|x| size * x).collect();
        // least of ‖y − A x‖²/σ² + Σ (x/sd)² is yᵀ (A P Aᵀ + σ² I)⁻¹ y = −2 (ln evidence + ½ ln det)
        let sds = [PRIOR_SD, lines.offset_sd()];
        let columns = [pick(1), rows().map(|_| 1.0).collect()];
        let zero = exact(&columns, &sds, &vec![0.0; response.len()]).log_evidence;
        let squared = -2.0 * (exact(&columns, &sds, &response).log_evidence - zero);
        prop_assert!((found.squared / squared - 1.0).abs() < 1e-4, "{} {squared}", found.squared);
        prop_assert!((found.own - (size / PRIOR_SD).powi(2)).abs() < 1e-9);
    }
}

/// Two records with constants and offsets of their own share nothing.
#[test]
fn records_that_share_nothing_are_fitted_together_as_each_alone() {
    let lines = Lines::with_own_constants(40);
    let recorded = |(seed, size): (u64, f64)| -> Vec<f64> {
        noise(40, seed)
            .iter()
            .zip(lines.column(0))
            .zip(lines.column(1))
            .map(|((e, a), b)| e + size * a - 0.4 * size * b)
            .collect()
    };
    let records = [(1, 2.0), (2, -3.0)].map(|of| lines.observed(&recorded(of)));
    let fit =
        |records: &[Observation]| fitted(&lines, &vec![0; records.len()], records, &[Hypothesis::RECALIBRATED]).expect("a fit");
    let (both, each) = (fit(&records), [0, 1].map(|k| fit(&records[k..=k])));
    let sum = each[0].log_evidence + each[1].log_evidence;
    assert!((both.log_evidence - sum).abs() < 1e-4, "{} {sum}", both.log_evidence);
    for (together, alone) in both.nuisances.iter().zip(&each) {
        assert!(
            together.iter().zip(&alone.nuisances[0]).all(|(a, b)| (a - b).abs() < 1e-3),
            "{together:?} {:?}",
            alone.nuisances
        );
    }
    assert!((both.nuisances[0][0] - both.nuisances[1][0]).abs() > 3.0, "{:?}", both.nuisances);
}

#[test]
fn what_every_record_has_of_its_own_is_no_constant_of_a_unit() {
    let lines = Lines::with_own_constants(40);
    let said = fit(&lines, &noise(40, 1), &Hypothesis::RECALIBRATED).believed(&lines, &[1]).expect_err("no constant");
    assert_eq!(said.to_string(), "every record has its own b, which is no constant of a unit");
}

#[test]
fn a_channel_that_stands_still_is_the_same_in_any_unit() {
    let of = |unit: f64| {
        let lines = Lines::in_unit(40, unit).with_any_offset();
        fit(&lines, &[3.0 * unit; 40], &alone(0)).log_evidence + 40.0 * unit.ln()
    };
    assert!((of(1.0) - of(50.0)).abs() < 1e-6, "{} {}", of(1.0), of(50.0));
}

#[test]
fn nothing_to_fit_or_to_choose_is_an_error() {
    let lines = Lines::new(40);
    let nothing = |said: diagnosis::Error| assert!(said.to_string().contains("at least one"), "{said}");
    nothing(fitted(&lines, &[], &[], &[alone(0)]).expect_err("no record"));
    nothing(fitted(&lines, &[0, 0], &[lines.observed(&[0.0; 40])], &[alone(0)]).expect_err("no observation"));
    nothing(diagnose(&lines, &[], &[], &Settings::default(), &|_| ()).expect_err("no record"));
    nothing(diagnosis::settled(&lines, &[], &[], &|_| ()).err().expect("no record"));
    let lines = Lines::with_no_choice(40);
    let observed = [lines.observed(&noise(40, 1))];
    for said in [
        diagnose(&lines, &[0], &observed, &Settings::default(), &|_| ()).expect_err("no choice"),
        diagnosis::settled(&lines, &[0], &observed, &|_| ()).err().expect("no choice"),
    ] {
        assert!(said.to_string().contains("either: nothing to choose"), "{said}");
    }
}

#[test]
fn verdicts_and_probabilities_follow_the_exact_odds() {
    let lines = Lines::new(120);
    for (size, verdict) in [(0.0, Verdict::None), (0.6, Verdict::Explained)] {
        let y: Vec<f64> = noise(120, 3).iter().zip(lines.column(0)).map(|(e, x)| e + size * x).collect();
        let settings = Settings::default();
        let found = diagnose(&lines, &[0], &[lines.observed(&y)], &settings, &|_| ()).expect("a diagnosis");
        assert_eq!(found.verdict, verdict, "{:?}", found.verdicts());
        // odds of the first mechanism alone over the nominal model: the exact Bayes factor times the odds beforehand, each of two
        // mechanisms with half of what singles have; the nominal model has all of what is left out of nothing: it has no constants
        let of = |test: &dyn Fn(&Hypothesis) -> bool| {
            let plain = found.candidates.iter().filter(|c| c.rival.is_none() && test(&c.fit.hypothesis));
            plain.map(|c| c.log_weight).fold(f64::NEG_INFINITY, f64::max)
        };
        let odds = of(&|h| *h == alone(0)) - of(&|h| *h == Hypothesis::NOMINAL);
        let offset = || vec![1.0; 120];
        let bayes = exact(&[lines.column(0), offset()], &[PRIOR_SD, lines.offset_sd()], &y).log_evidence
            - exact(&[offset()], &[lines.offset_sd()], &y).log_evidence;
        let expected = bayes + (settings.single / 2.0 / (settings.none + settings.recalibrate)).ln();
        // the noise is fitted anew to each hypothesis, within a prior that hardly lets it
        assert!((odds - expected).abs() < 0.02 * (1.0 + expected.abs()), "{odds} {expected}");
    }
}

#[test]
fn a_record_of_nothing_is_refused() {
    let lines = Lines::new(40);
    let empty = Observation { time: lines.observed(&[0.0; 40]).time, channels: vec![vec![f64::NAN; 40]] };
    let said = diagnose(&lines, &[0], &[empty], &Settings::default(), &|_| ()).expect_err("nothing to compare");
    assert_eq!(said.to_string(), "record 0: no channel has a value, so that there is nothing to compare; leave the record out");
}
