//! Against the paper: Osunluk, Ogut and Ozbay, *Thermally Induced Bias Errors for a Fiber Coil with Practical Quadrupole Winding*.

use crate::common::{ALL, REFERENCE, any_spec};
use proptest::prelude::*;
use winding::{ClimbSide, Half, Pattern, Spec, wind};

#[test]
fn paper_table_iii_length_and_dimensions() {
    let coil = wind(&REFERENCE).unwrap();
    // printed: 1101.57 m; the four digits more follow from 106 turns in odd and 105 in even layers
    assert!((coil.length() - 1101.5666).abs() < 5e-5, "{}", coil.length());
    assert_eq!(coil.wound_length(), coil.length());
    assert_eq!(coil.turns().len(), 3798);
    assert_eq!((coil.count(Half::Cw), coil.count(Half::Ccw)), (1899, 1899));
    // printed as a radius, but it is the diameter
    assert_eq!(format!("{:.2}", 2e3 * coil.outer_radius()), "97.65");
    assert_eq!(format!("{:.2}", 1e3 * coil.mean_diameter()), "92.32");
    assert_eq!(format!("{:.2}", 1e3 * coil.height()), "18.02");
}

#[test]
fn paper_practical_pattern_is_axially_asymmetric() {
    let axial_moment = |pattern| wind(&Spec { pattern, ..REFERENCE }).unwrap().moment(0, 1).abs();
    let ratio = axial_moment(Pattern::PracticalQuadrupole) / axial_moment(Pattern::Quadrupole);
    assert!((90.0..95.0).contains(&ratio), "{ratio}");
}

proptest! {
    /// Sec. III.D: "first turn of each layer is wound either CW or CCW and last turn vice versa".
    #[test]
    fn paper_fig_3_layers_begin_in_one_half_and_end_in_the_other(spec in any_spec(&[Pattern::PracticalQuadrupole])) {
        let coil = wind(&spec).unwrap();
        let (first, last) = match spec.cw_climbs {
            ClimbSide::Right => (Half::Ccw, Half::Cw),
            ClimbSide::Left => (Half::Cw, Half::Ccw),
        };
        for layer in 1..=spec.layers {
            let in_layer = || coil.turns().iter().filter(|turn| turn.layer == layer);
            prop_assert_eq!(in_layer().min_by_key(|turn| turn.turn).map(|turn| turn.half), Some(first));
            prop_assert_eq!(in_layer().max_by_key(|turn| turn.turn).map(|turn| turn.half), Some(last));
        }
    }

    /// The fibre climbs without a jump, in the practical pattern and in a plain bobbin.
    #[test]
    fn paper_fig_3_consecutive_turns_touch(spec in any_spec(&[Pattern::PracticalQuadrupole, Pattern::Cylindrical])) {
        let coil = wind(&spec).unwrap();
        // each coordinate is off by a few units in its last place
        let rounding = 8.0 * f64::EPSILON * (coil.outer_radius() + coil.height());
        for pair in coil.turns().windows(2) {
            let distance = (pair[1].r - pair[0].r).hypot(pair[1].y - pair[0].y);
            prop_assert!((distance - spec.pitch).abs() < rounding, "{:?} {:?}", pair[0], pair[1]);
        }
    }

    #[test]
    fn paper_fig_3_each_place_is_taken_once(spec in any_spec(ALL)) {
        let coil = wind(&spec).unwrap();
        let mut places: Vec<_> = coil.turns().iter().map(|turn| (turn.layer, turn.turn)).collect();
        places.sort_unstable();
        let turns_in = |layer| if layer % 2 == 1 { spec.turns_odd_layers } else { spec.turns_even_layers };
        let all: Vec<_> = (1..=spec.layers).flat_map(|layer| (1..=turns_in(layer)).map(move |turn| (layer, turn))).collect();
        prop_assert_eq!(places, all);
    }
}
