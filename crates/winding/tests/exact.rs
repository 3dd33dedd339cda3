//! Against closed formulas.

use crate::common::{ALL, REFERENCE, any_spec};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use proptest::prelude::*;
use std::f64::consts::PI;
use winding::{ClimbSide, Half, LayerDefect, Pattern, Spec, Tails, TurnLength, wind};

/// Radial moment over ℓ² h, for turns all of length ℓ in layers a step h apart.
fn scaled_moment(pattern: Pattern, layers: usize, odd: usize, even: usize) -> f64 {
    let spec =
        Spec { pattern, layers, turns_odd_layers: odd, turns_even_layers: even, turn_length: TurnLength::Equal, ..REFERENCE };
    let coil = wind(&spec).expect("a valid coil");
    let turn = coil.turns()[0].length();
    coil.moment(1, 0) / (turn * turn * spec.pitch * 3_f64.sqrt() / 2.0)
}

#[test]
fn exact_length_is_the_sum_of_two_arithmetic_series() {
    let step = 0.170e-3 * 3_f64.sqrt() / 2.0;
    let first = 43.5e-3 + 0.085e-3;
    // 18 odd layers 0, 2, …, 34 and 18 even layers 1, 3, …, 35 steps out
    let radii = 106.0 * (18.0 * first + 306.0 * step) + 105.0 * (18.0 * first + 324.0 * step);
    assert_relative_eq!(wind(&REFERENCE).unwrap().length(), 2.0 * PI * radii, max_relative = 1e-13);
}

#[test]
fn exact_radial_moments_of_layers_of_equal_length() {
    for (layers, turns) in [(8, 20), (16, 7), (40, 33)] {
        let (m, n) = (layers as f64, turns as f64);
        let moment = |pattern| scaled_moment(pattern, layers, turns, turns) / (n * n);
        assert_relative_eq!(moment(Pattern::Cylindrical), -m * (m * m - 1.0) / 6.0, max_relative = 1e-9);
        assert_relative_eq!(moment(Pattern::Dipole), m * m / 4.0, max_relative = 1e-9);
        assert_relative_eq!(moment(Pattern::Quadrupole), -m / 2.0, max_relative = 1e-9);
        assert_abs_diff_eq!(moment(Pattern::Octupole), 0.0, epsilon = 1e-9 * m);
    }
}

/// With one turn less in the even layers the quadrupole's radial moment changes sign at about 2 N − 1 layers of N turns: the
/// lengths of the layers then alternate, and that adds a term of the opposite sign that grows with the square of the layers.
#[test]
fn exact_radial_moment_of_the_grooved_quadrupole() {
    for (periods, turns) in [(2_usize, 20_usize), (9, 20), (10, 20), (25, 20), (9, 106)] {
        let (q, n) = (periods as f64, turns as f64);
        let expected = 2.0 * q * ((2.0 * n - 1.0) * q - n * (n - 1.0));
        assert_relative_eq!(
            scaled_moment(Pattern::Quadrupole, 4 * periods, turns, turns - 1),
            expected,
            max_relative = 1e-9,
            epsilon = 1e-9 * q * n * n
        );
    }
}

/// Ten equal turns of a bobbin, five to a half; a long tail moves the middle of the fibre.
#[test]
fn exact_a_bobbin_is_divided_at_the_middle_of_its_fibre() {
    let bobbin = Spec {
        pattern: Pattern::Cylindrical,
        layers: 2,
        turns_odd_layers: 5,
        turns_even_layers: 5,
        turn_length: TurnLength::Equal,
        ..REFERENCE
    };
    let turn = wind(&bobbin).unwrap().turns()[0].length();
    for (cw_tail_in_turns, ccw_turns) in [(0.0, 5), (4.2, 7), (20.0, 10)] {
        let coil = wind(&Spec { tails: Tails { cw: cw_tail_in_turns * turn, ccw: 0.0 }, ..bobbin }).unwrap();
        assert!(coil.turns()[..ccw_turns].iter().all(|turn| turn.half == Half::Ccw));
        assert_eq!((coil.count(Half::Ccw), coil.count(Half::Cw)), (ccw_turns, 10 - ccw_turns));
    }
}

#[test]
fn exact_outline_of_small_coils() {
    let (r, p) = (REFERENCE.inner_radius, REFERENCE.pitch);
    let outline = |layers, odd, even| {
        let coil = wind(&Spec { layers, turns_odd_layers: odd, turns_even_layers: even, ..REFERENCE }).unwrap();
        (coil.outer_radius() - r, coil.height())
    };
    for ((layers, odd, even), expected) in
        [((1, 3, 3), (1.0, 3.0)), ((2, 3, 2), (1.0 + 0.75_f64.sqrt(), 3.0)), ((3, 3, 3), (1.0 + 3_f64.sqrt(), 3.5))]
    {
        let (build, height) = outline(layers, odd, even);
        assert_abs_diff_eq!(build, expected.0 * p, epsilon = 1e-15);
        assert_abs_diff_eq!(height, expected.1 * p, epsilon = 1e-15);
    }
}

#[test]
fn exact_a_fibre_too_long_to_square_is_refused() {
    let message = wind(&Spec { inner_radius: 1e155, ..REFERENCE }).expect_err("overflow").to_string();
    assert!(message.contains("lower inner_radius"), "{message}");
}

proptest! {
    /// The fibre is the CCW tail, the turns end to end, the CW tail.
    #[test]
    fn exact_turns_and_tails_make_up_the_fibre(spec in any_spec(ALL)) {
        let coil = wind(&spec).unwrap();
        let ((start, ccw_end), (cw_start, end)) = coil.tail_spans();
        prop_assert_eq!((start, ccw_end, end), (0.0, spec.tails.ccw, coil.length()));
        prop_assert_eq!(coil.turns()[0].z_start, ccw_end);
        prop_assert_eq!(coil.turns()[coil.turns().len() - 1].z_end, cw_start);
        prop_assert!(coil.turns().windows(2).all(|pair| pair[0].z_end == pair[1].z_start));
        prop_assert!(coil.turns().iter().all(|turn| turn.z_end > turn.z_start));
        let Tails { cw, ccw } = spec.tails;
        let rounding = (coil.turns().len() as f64 + 2.0) * f64::EPSILON * coil.length();
        let circumferences: f64 = coil.turns().iter().map(|turn| 2.0 * PI * turn.r).sum();
        prop_assert!((coil.wound_length() - circumferences).abs() < rounding);
        prop_assert!((coil.length() - (circumferences + cw + ccw)).abs() < rounding);
    }

    #[test]
    fn exact_each_turn_is_as_long_as_asked(spec in any_spec(ALL)) {
        let coil = wind(&spec).unwrap();
        let mean = coil.wound_length() / coil.turns().len() as f64;
        let rounding = (coil.turns().len() as f64 + 2.0) * f64::EPSILON * coil.length();
        for turn in coil.turns() {
            let expected = match spec.turn_length {
                TurnLength::True => 2.0 * PI * turn.r,
                TurnLength::Equal => mean,
            };
            prop_assert!((turn.length() - expected).abs() < rounding, "{:?}", turn);
        }
    }

    /// ∫ (L − 2z) dz over the whole fibre is 0, and it is ℓ (L − 2 z_mid) over each turn.
    #[test]
    fn exact_weights_add_up_to_nothing(spec in any_spec(ALL)) {
        let coil = wind(&spec).unwrap();
        let length = coil.length();
        let span = |(start, end): (f64, f64)| (end - start) * (length - 2.0 * (0.5 * (start + end)));
        let tails = span(coil.tail_spans().0) + span(coil.tail_spans().1);
        // a plain sum of n terms, none above L²
        let rounding = (coil.turns().len() as f64 + 6.0) * f64::EPSILON * length * length;
        let turns: f64 = coil.turns().iter().map(|turn| turn.length() * (length - 2.0 * turn.z_mid())).sum();
        prop_assert!((turns + tails).abs() < rounding);
        prop_assert!((coil.tail_weight() - tails).abs() < rounding);
        prop_assert!((coil.weights().iter().sum::<f64>() + tails).abs() < rounding);
        prop_assert!((coil.moment(0, 0) + tails).abs() < rounding);
    }
}

#[test]
fn a_defect_spreads_its_owners_turns_over_the_same_width_on_either_hand() {
    for cw_climbs in [ClimbSide::Right, ClimbSide::Left] {
        for (layer, turns) in [(1, 3), (2, -4), (24, -3), (35, 5), (36, 1)] {
            let sound = Spec { cw_climbs, ..REFERENCE };
            let (sound, defective) =
                (wind(&sound).unwrap(), wind(&Spec { defect: Some(LayerDefect { layer, turns }), ..sound }).unwrap());
            let of = |coil: &winding::Winding, half| -> Vec<f64> {
                let mut y: Vec<f64> = coil.turns().iter().filter(|t| t.layer == layer && t.half == half).map(|t| t.y).collect();
                y.sort_by(f64::total_cmp);
                y
            };
            let owner = if matches!(layer % 4, 0 | 1) { Half::Cw } else { Half::Ccw };
            let (before, after) = (of(&sound, owner), of(&defective, owner));
            assert_eq!(after.len() as i32 - before.len() as i32, turns);
            // the other half's passing turn stays
            assert_eq!(of(&sound, owner.other()), of(&defective, owner.other()));
            // even, and as wide as before: the cells of the turns fill the same stretch
            let steps: Vec<f64> = after.windows(2).map(|w| w[1] - w[0]).collect();
            let step = before.len() as f64 * REFERENCE.pitch / after.len() as f64;
            assert!(steps.iter().all(|s| (s - step).abs() < 1e-12));
            assert!((after[0] - step / 2.0 - (before[0] - REFERENCE.pitch / 2.0)).abs() < 1e-12);
            // every other layer is as designed, and the fibre grows by the turns
            let others = |coil: &winding::Winding| -> Vec<(usize, usize, f64)> {
                coil.turns().iter().filter(|t| t.layer != layer).map(|t| (t.layer, t.turn, t.y)).collect()
            };
            assert_eq!(others(&sound), others(&defective));
            let turn = sound.turns().iter().find(|t| t.layer == layer).unwrap().length();
            assert!((defective.length() - sound.length() - f64::from(turns) * turn).abs() < 1e-9);
            // numbered from −y without holes
            let mut numbers: Vec<(usize, f64)> =
                defective.turns().iter().filter(|t| t.layer == layer).map(|t| (t.turn, t.y)).collect();
            numbers.sort_by_key(|(turn, _)| *turn);
            assert!(numbers.iter().enumerate().all(|(i, (turn, _))| *turn == i + 1));
            assert!(numbers.windows(2).all(|w| w[0].1 < w[1].1));
        }
    }
}

#[test]
fn a_defect_that_cannot_be_wound_is_refused() {
    for (layer, turns, says) in
        [(0, 1, "layers 1 to 36"), (37, 1, "layers 1 to 36"), (4, -105, "at least one turn"), (4, i32::MAX, "twice")]
    {
        let error = wind(&Spec { defect: Some(LayerDefect { layer, turns }), ..REFERENCE }).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}

#[test]
fn a_defect_leaves_its_owner_one_turn_at_least_and_twice_as_many_at_most() {
    for cw_climbs in [ClimbSide::Right, ClimbSide::Left] {
        for pattern in ALL {
            let sound =
                Spec { pattern: *pattern, cw_climbs, layers: 8, turns_odd_layers: 12, turns_even_layers: 11, ..REFERENCE };
            let coil = wind(&sound).unwrap();
            for layer in 1..=sound.layers {
                // in a cylinder one winder lays the whole layer, whichever half its turns belong to
                let of_half = |half| coil.turns().iter().filter(|t| t.layer == layer && t.half == half).count();
                let all = of_half(Half::Cw) + of_half(Half::Ccw);
                let owned = if *pattern == Pattern::Cylindrical { all } else { of_half(Half::Cw).max(of_half(Half::Ccw)) };
                let owned = i32::try_from(owned).unwrap();
                let wound = |turns| wind(&Spec { defect: Some(LayerDefect { layer, turns }), ..sound }).is_ok();
                let least_and_most = [-owned, 1 - owned, owned, owned + 1].map(wound);
                assert_eq!(least_and_most, [false, true, true, false], "{pattern:?} {cw_climbs:?} layer {layer}");
            }
        }
    }
}

#[test]
fn a_coil_of_no_radius_or_pitch_is_refused() {
    for (spec, field) in [(Spec { inner_radius: 0.0, ..REFERENCE }, "inner_radius"), (Spec { pitch: 0.0, ..REFERENCE }, "pitch")]
    {
        let error = wind(&spec).unwrap_err().to_string();
        assert!(error.contains(field), "{error}");
    }
}

/// Whatever lies beyond the middle is of the CW half, and so is what has it within.
#[test]
fn exact_a_turn_about_the_middle_of_a_bobbin_is_of_the_cw_half() {
    let one = Spec { pattern: Pattern::Cylindrical, layers: 1, turns_odd_layers: 1, turns_even_layers: 1, ..REFERENCE };
    let coil = wind(&one).unwrap();
    assert_eq!((coil.turns().len(), coil.turns()[0].half), (1, Half::Cw));
}

/// Two turns, one on the other, are equally far from their mean, and their weights are opposite: the second radial moment is nothing about the mean, and
/// about any other radius it is not.
#[test]
fn exact_second_moment_of_two_layers_is_nothing_about_their_mean() {
    let two = Spec {
        pattern: Pattern::Cylindrical,
        layers: 2,
        turns_odd_layers: 1,
        turns_even_layers: 1,
        turn_length: TurnLength::Equal,
        ..REFERENCE
    };
    let coil = wind(&two).unwrap();
    let (turn, step) = (coil.turns()[0].length(), two.pitch * 3_f64.sqrt() / 2.0);
    assert_relative_eq!(coil.moment(1, 0), -turn * turn * step, max_relative = 1e-9);
    assert_abs_diff_eq!(coil.moment(2, 0), 0.0, epsilon = 1e-9 * (turn * step).powi(2));
}

/// One layer has no even one, whatever is said of those; counts are said with their nouns.
#[test]
fn bounds_only_the_layers_that_there_are_count() {
    let one = Spec { pattern: Pattern::Cylindrical, layers: 1, turns_odd_layers: 5, turns_even_layers: 0, ..REFERENCE };
    assert_eq!(wind(&one).unwrap().turns().len(), 5);
    let said = |spec: &Spec| wind(spec).unwrap_err().to_string();
    assert!(said(&Spec { layers: 2, ..one }).starts_with("turns_even_layers = 0 does not fit"));
    let few = Spec { layers: 2, turns_odd_layers: 2, turns_even_layers: 1, ..REFERENCE };
    assert!(said(&few).starts_with("layer 2 has 1 turn, but"), "{}", said(&few));
    let defect = Spec { defect: Some(LayerDefect { layer: 2, turns: -1 }), turns_odd_layers: 2, turns_even_layers: 2, ..few };
    assert!(said(&defect).starts_with("a defect of -1 turn in layer 2"), "{}", said(&defect));
}
