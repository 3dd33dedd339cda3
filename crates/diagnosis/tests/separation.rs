//! How well records tell hypotheses apart: which alternative counts, under which noise, and what is refused. (Its size: `exact_evidence`.)

use crate::common::lines::{Lines, PRIOR_SD, WHITE};
use diagnosis::{Active, Hypothesis, Observation, Plan, alternatives, separation};
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
}

#[test]
fn noise_can_be_given() {
    // its offset known to be 0, the nominal model has nothing to fit: a sixteenth of the squared distance under four times the noise
    let lines = Lines::new(ROWS).without_offset();
    let instants = instants(&lines);
    let squared = |noise| {
        let plan = Plan { records: &[0], instants: &instants, noise };
        separation(&lines, &plan, &truth(), &[Hypothesis::NOMINAL]).expect("a separation").squared
    };
    let distance: f64 = lines.column(0).iter().map(|x| (3.0 * x / WHITE).powi(2)).sum();
    assert!((squared(None) / distance - 1.0).abs() < 1e-3);
    let louder = [NoiseModel::white(4.0 * WHITE, 0.0)].map(|noise| NoiseModel { drift: 1e-9, walk: 1e-9, ..noise });
    assert!((squared(None) / squared(Some(&louder)) - 16.0).abs() < 1e-3);
}

#[test]
fn nothing_to_compare_is_an_error() {
    let lines = Lines::new(ROWS);
    let plan = Plan { records: &[0], instants: &[], noise: None };
    assert!(separation(&lines, &plan, &[], &[Hypothesis::NOMINAL]).is_err());
    let instants = instants(&lines);
    let plan = Plan { records: &[0], instants: &instants, noise: None };
    assert!(separation(&lines, &plan, &[], &[]).is_err());
    assert!(separation(&lines, &Plan { noise: Some(&[]), ..plan }, &[], &[Hypothesis::NOMINAL]).is_err());
}
