//! Trimming: the null is a null of the whole model, and its uncertainty is what the constants leave.

use crate::common::{changed, reference};
use coil::{Number, Parameter, Tolerances, sensitivity_band, steady_sensitivity, trim_tails, trim_turns};
use winding::Half;

#[test]
fn exact_the_trimmed_coil_has_no_sensitivity() {
    let trim = trim_tails(&reference(), &Tolerances::default()).expect("trim");
    assert!((trim.before + 2.7335).abs() < 1e-3 && (trim.slope - 1.82).abs() < 0.02, "{trim:?}");
    let trimmed = changed(|d| d.winding.tails.cw = trim.cw_minus_ccw);
    let left = steady_sensitivity(&trimmed).expect("solve").sensitivity.total();
    assert!(left.abs() < 1e-5, "{left} at {} m", trim.cw_minus_ccw);
}

#[test]
fn exact_uncertainty_is_that_of_the_sensitivity_over_the_slope() {
    let trim = trim_tails(&reference(), &Tolerances::default()).expect("trim");
    let of = |parameter: Parameter| {
        trim.band.changes.iter().find(|(number, _)| *number == Number::Constant(parameter)).expect("a change").1
    };
    // E_r 5 % changes S by 3 %, so 10 % by about 6 %
    let er = of(Parameter::TransverseModulus) / trim.before;
    assert!((0.04..0.09).contains(&er.abs()), "{er}");
    let trimmed = changed(|d| d.winding.tails.cw = trim.cw_minus_ccw);
    let left = sensitivity_band(&trimmed, &Tolerances::default()).expect("a band");
    assert!((trim.uncertainty() - left.sd / trim.slope.abs()).abs() < 1e-12, "{}", trim.uncertainty());
    assert!((0.05..1.0).contains(&trim.uncertainty()), "{} m", trim.uncertainty());
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
