//! Trimming: the null is a null of the whole model, and its uncertainty is what the constants leave.

mod common;

use coil::{PRIORS, steady_sensitivity, trim_tails, trim_turns};
use common::{changed, reference};
use winding::Half;

#[test]
fn exact_the_trimmed_coil_has_no_sensitivity() {
    let trim = trim_tails(&reference()).expect("trim");
    assert!((trim.before + 2.7335).abs() < 1e-3 && (trim.slope - 1.82).abs() < 0.02, "{trim:?}");
    let trimmed = changed(|d| d.winding.tails.cw = trim.cw_minus_ccw);
    let left = steady_sensitivity(&trimmed).expect("solve").sensitivity.total();
    assert!(left.abs() < 1e-5, "{left} at {} m", trim.cw_minus_ccw);
}

#[test]
fn exact_uncertainty_is_that_of_the_sensitivity_over_the_slope() {
    let trim = trim_tails(&reference()).expect("trim");
    assert_eq!(trim.contributions.len(), PRIORS.len());
    // E_r 5 % changes S by 3 %, so 10 % by about 6 %
    let er = trim.contributions[0] * trim.slope / trim.before.abs();
    assert!((0.04..0.09).contains(&er), "{er}");
    assert!(trim.contributions[5] < 1e-9, "the thermo-optic coefficient has no part in a steady ramp");
    let square: f64 = trim.contributions.iter().map(|c| c * c).sum();
    assert!((trim.uncertainty - square.sqrt()).abs() < 1e-15);
}

#[test]
fn symmetry_cutting_turns_moves_the_sensitivity_opposite_ways_at_the_two_ends() {
    let trims = trim_turns(&reference(), 3).expect("trim");
    assert_eq!(trims.len(), 6);
    let by =
        |half: Half, turns: usize| trims.iter().find(|t| t.half == half && t.turns == turns).expect("row").sensitivity + 2.7335;
    for turns in 1..=3 {
        assert!(
            by(Half::Ccw, turns) * by(Half::Cw, turns) < 0.0,
            "{turns}: {} and {}",
            by(Half::Ccw, turns),
            by(Half::Cw, turns)
        );
        assert!(turns == 1 || by(Half::Cw, turns).abs() > by(Half::Cw, turns - 1).abs(), "each turn adds to it");
    }
}
