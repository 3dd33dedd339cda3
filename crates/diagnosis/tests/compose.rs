//! A law that is composed is the one that made the record, and none is composed of noise.

use crate::common::lines::{Lines, WHITE, alone};
use diagnosis::{Fit, Hypothesis, compose, fitted};
use rand::SeedableRng;
use rand::rngs::SmallRng;
use rand_distr::{Distribution, Normal};

const ROWS: usize = 400;

/// The second mechanism's column times a size in noise, and a fit of nothing to it.
fn record(size: f64, seed: u64) -> (Lines, diagnosis::Observation, Fit) {
    let lines = Lines::new(ROWS).starting_at(1.0);
    let mut random = SmallRng::seed_from_u64(seed);
    let noise = Normal::new(0.0, WHITE).expect("a density");
    let y: Vec<f64> = lines.column(1).iter().map(|x| size * x + noise.sample(&mut random)).collect();
    let observed = lines.observed(&y);
    let nothing = fitted(&lines, &[0], std::slice::from_ref(&observed), &[Hypothesis::NOMINAL]).expect("a fit");
    (lines, observed, nothing)
}

#[test]
fn the_law_that_made_a_record_is_composed_with_its_size() {
    let (lines, observed, nothing) = record(1.5, 3);
    let found =
        compose(&lines, 0..2, &[0], std::slice::from_ref(&observed), &nothing, &|_| ()).expect("composed").expect("a law");
    assert_eq!((found.laws, found.fit.hypothesis.mechanisms.as_slice()), (1, &[(1, None)][..]));
    let estimate = &found.fit.estimates(&lines, 0)[0];
    assert!(estimate.ci90[0] < 1.5 && 1.5 < estimate.ci90[1], "{estimate:?}");
    // the choice between two is paid for: exact evidence of the fit alone, less ln 2
    let single = fitted(&lines, &[0], std::slice::from_ref(&observed), &[alone(1)]).expect("a fit");
    let gain = single.log_evidence - nothing.log_evidence - 2.0_f64.ln();
    assert!((found.gain - gain).abs() < 0.05, "{} and {gain}", found.gain);
}

#[test]
fn of_noise_nothing_is_composed() {
    for seed in 0..20 {
        let (lines, observed, nothing) = record(0.0, seed);
        let found = compose(&lines, 0..2, &[0], std::slice::from_ref(&observed), &nothing, &|_| ()).expect("composed");
        assert!(found.is_none(), "seed {seed}");
    }
}
