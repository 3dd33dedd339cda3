//! How well records tell hypotheses apart: which alternative counts, under which noise, and what is refused. (Its size: `exact_evidence`.)

use crate::common::lines::{Lines, PRIOR_SD, WHITE, alone};
use diagnosis::{Active, Hypothesis, Observation, Plan, alternatives, separation};
use nalgebra::{DMatrix, DVector};
use recording::noise::NoiseModel;

const ROWS: usize = 200;

fn truth() -> [Active; 1] {
    [Active { mechanism: 0, values: vec![3.0], choice: None }]
}

fn instants(lines: &Lines) -> [Observation; 1] {
    [lines.observed(&[0.0; ROWS])]
}

#[test]
fn the_nearest_choice_counts() {
    let lines = Lines::with_either(ROWS);
    let plan = Plan { records: &[0], instants: &instants(&lines), noise: None };
    let found = separation(&lines, &plan, &truth(), &alternatives(&lines, 2)).expect("a separation");
    assert_eq!(found.rival.active[0].choice, Some(0.0));
    // it does the same, and pays no more for its size than the truth
    let own = (3.0 / PRIOR_SD).powi(2);
    assert!((found.own - own).abs() < 1e-9 && found.squared < own + 0.01 && found.log_odds() < 0.01, "{found:?}");
    // wherever it stands among the choices
    let other = [Active { mechanism: 1, ..truth()[0].clone() }];
    let found = separation(&lines, &plan, &other, &alternatives(&lines, 2)).expect("a separation");
    assert!(found.rival.active[0].choice == Some(1.0) && found.squared < own + 0.01, "{found:?}");
}

#[test]
fn noise_can_be_given() {
    // its offset known to be 0, the nominal model has nothing to fit: a sixteenth of the squared distance under four times the noise
    let lines = Lines::new(ROWS).without_offset();
    let instants = instants(&lines);
    let found = |noise| {
        let plan = Plan { records: &[0], instants: &instants, noise };
        separation(&lines, &plan, &truth(), &[Hypothesis::NOMINAL]).expect("a separation")
    };
    let squared = |noise| found(noise).squared;
    let distance: f64 = lines.column(0).iter().map(|x| (3.0 * x / WHITE).powi(2)).sum();
    assert!((squared(None) / distance - 1.0).abs() < 1e-3);
    assert!((found(None).sigma() / distance.sqrt() - 1.0).abs() < 1e-3);
    let louder = [NoiseModel::white(4.0 * WHITE, 0.0)].map(|noise| NoiseModel { drift: 1e-9, walk: 1e-9, ..noise });
    assert!((squared(None) / squared(Some(&louder)) - 16.0).abs() < 1e-3);
}

#[test]
fn nothing_to_compare_is_an_error() {
    let lines = Lines::new(ROWS);
    let plan = Plan { records: &[0], instants: &[], noise: None };
    assert!(separation(&lines, &plan, &[], &[Hypothesis::NOMINAL]).is_err());
    assert!(separation(&lines, &Plan { records: &[], ..plan }, &[], &[Hypothesis::NOMINAL]).is_err());
    let instants = instants(&lines);
    let plan = Plan { records: &[0], instants: &instants, noise: None };
    assert!(separation(&lines, &plan, &[], &[]).is_err());
    assert!(separation(&lines, &Plan { noise: Some(&[]), ..plan }, &[], &[Hypothesis::NOMINAL]).is_err());
}

/// By the covariance of all that constants may do: they go together, so that two of opposite sign are unlikely.
#[test]
fn constants_that_go_together_make_up_for_less() {
    let lines = Lines::with_constants(ROWS, 0.9).without_offset();
    let plan = Plan { records: &[0], instants: &instants(&lines), noise: None };
    let found = separation(&lines, &plan, &truth(), &[Hypothesis::RECALIBRATED]).expect("a separation").squared;
    let columns = DMatrix::from_vec(ROWS, 2, [lines.column(0), lines.column(1)].concat());
    let response = columns.column(0) * 3.0;
    let squared = |correlation: f64| {
        let prior = DMatrix::from_row_slice(2, 2, &[1.0, correlation, correlation, 1.0]) * PRIOR_SD.powi(2);
        let covariance = &columns * prior * columns.transpose() + DMatrix::identity(ROWS, ROWS) * WHITE.powi(2);
        response.dot(&covariance.cholesky().expect("positive definite").solve(&DVector::from(response.clone())))
    };
    assert!((found / squared(0.9) - 1.0).abs() < 1e-3 && squared(0.9) > 2.0 * squared(0.0), "{found} {}", squared(0.9));
}

#[test]
fn a_constant_that_a_rival_stands_for_is_no_number_of_its_own() {
    let lines = Lines::with_constants(ROWS, 0.5);
    let plan = Plan { records: &[0], instants: &instants(&lines), noise: None };
    let names = |rival: usize| -> Vec<String> {
        let found = separation(&lines, &plan, &truth(), &[alone(rival)]).expect("a separation");
        found.rival.posteriors(&lines).into_iter().map(|number| number.name).collect()
    };
    assert_eq!((names(0), names(1)), (vec!["b".to_owned(), "size".to_owned()], ["a", "b", "size"].map(str::to_owned).to_vec()));
}

/// By the twelfth power of a size each step of Gauss and Newton takes a twelfth of the way from 14 to 1: thirty of them, where a descent has sixteen.
#[test]
fn a_rival_is_followed_to_its_end() {
    let lines = Lines::with_either(ROWS).with_power(12).starting_at(7.0 * PRIOR_SD);
    let plan = Plan { records: &[0], instants: &instants(&lines), noise: None };
    let one = [Active { mechanism: 0, values: vec![1.0], choice: None }];
    let found = separation(&lines, &plan, &one, &alternatives(&lines, 2)).expect("a separation");
    assert!(found.squared < found.own + 0.1, "{} {}", found.squared, found.own);
}

/// What `times` records of one unit tell is what one record tells whose noise is smaller by the root of that: its constants are one.
#[test]
fn records_of_one_unit_tell_what_one_of_less_noise_tells() {
    let lines = Lines::with_constants(ROWS, 0.0).without_offset();
    let once = instants(&lines);
    let squared = |times: usize, noise: f64| {
        let white = [NoiseModel::white(noise, 0.0)].map(|noise| NoiseModel { drift: 1e-9, walk: 1e-9, ..noise });
        let (records, instants) = (vec![0; times], vec![once[0].clone(); times]);
        let plan = Plan { records: &records, instants: &instants, noise: Some(&white) };
        separation(&lines, &plan, &truth(), &[Hypothesis::RECALIBRATED]).expect("a separation").squared
    };
    let (alone, four, quieter) = (squared(1, WHITE), squared(4, WHITE), squared(1, WHITE / 2.0));
    assert!((four / quieter - 1.0).abs() < 1e-4, "{four} {quieter}");
    // a constant within its tolerance does the same as the truth: four records tell hardly more than one
    assert!(four < 1.1 * alone, "{four} {alone}");
}
