//! Laplace's intervals against the sampler, where the posterior is known.

use crate::common::lines::{Lines, WHITE, alone};
use crate::common::normal;
use diagnosis::{Samples, Settings, diagnose, sampled};

const ROWS: usize = 80;
const STEPS: usize = 4000;
const SIZE: f64 = 1.5;

/// Samples for a record in which the first mechanism adds `size` times its column.
fn samples(lines: &Lines, size: f64) -> Samples {
    let mut normal = normal(4);
    let y: Vec<f64> = lines.column(0).iter().map(|c| size * c + WHITE * normal()).collect();
    let records = [lines.observed(&y)];
    let found = diagnose(lines, &[0], &records, &Settings::default(), &|_| ()).expect("a diagnosis");
    let with = found.candidates.iter().find(|candidate| candidate.fit.hypothesis == alone(0)).expect("a candidate");
    sampled(lines, &[0], &records, &with.fit, STEPS, 1).expect("samples")
}

#[test]
fn exact_where_the_posterior_is_normal_every_step_is_taken_and_intervals_agree() {
    let samples = samples(&Lines::new(ROWS), SIZE);
    assert!((0.999..=1.0).contains(&samples.taken), "{}", samples.taken);
    let [size] = &samples.unknowns[..] else { panic!("one unknown") };
    assert!((size.inside - 0.9).abs() < 0.02, "{}", size.inside);
    let (sampled, laplace) = (size.ci90, size.laplace.ci90());
    let width = laplace[1] - laplace[0];
    assert!((0..2).all(|k| (sampled[k] - laplace[k]).abs() < 0.05 * width), "{sampled:?} {laplace:?}");
    assert!(size.disagreement < 1.01 && size.effective > 1000.0, "{size:?}");
}

/// A size and its opposite act alike: Laplace's interval is about one of them and holds half of what is likely.
#[test]
fn a_second_minimum_is_found_and_walked_to() {
    let samples = samples(&Lines::squared(ROWS), SIZE * SIZE);
    assert_eq!(samples.minima, 2);
    let [size] = &samples.unknowns[..] else { panic!("one unknown") };
    assert!((size.inside - 0.45).abs() < 0.03, "{}", size.inside);
    assert!(size.ci90[0] < -1.4 && size.ci90[1] > 1.4, "{:?}", size.ci90);
    assert!(size.disagreement < 1.05, "{size:?}");
}
