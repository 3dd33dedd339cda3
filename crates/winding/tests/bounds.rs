//! How much each pattern gains on the one before.

use crate::common::REFERENCE;
use proptest::prelude::*;
use winding::{Pattern, Spec, TurnLength, wind};

/// |radial first moment|, cylinder to octupole, of a coil whose inner radius is `builds` times its radial build.
fn radial_moments(layers: usize, odd: usize, even: usize, builds: f64) -> [f64; 4] {
    let build = REFERENCE.pitch * (1.0 + (layers - 1) as f64 * 3_f64.sqrt() / 2.0);
    [Pattern::Cylindrical, Pattern::Dipole, Pattern::Quadrupole, Pattern::Octupole].map(|pattern| {
        let spec = Spec {
            pattern,
            layers,
            turns_odd_layers: odd,
            turns_even_layers: even,
            inner_radius: builds * build,
            turn_length: TurnLength::True,
            ..REFERENCE
        };
        wind(&spec).expect("a valid coil").moment(1, 0).abs()
    })
}

fn each_halves(moments: [f64; 4]) -> bool {
    moments.windows(2).all(|pair| pair[1] <= 0.5 * pair[0])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    /// Any number of octupole periods, where all layers have the same number of turns.
    #[test]
    fn bounds_radial_moment_halves_from_pattern_to_pattern(
        periods in 1_usize..=12, turns in 20_usize..=120, builds in 5.0..50.0_f64
    ) {
        let moments = radial_moments(8 * periods, turns, turns, builds);
        prop_assert!(each_halves(moments), "{:?}", moments);
    }

    /// With one turn less in the even layers, as long as there are not more layers than turns: beyond, the alternating layer
    /// lengths take the quadrupole's moment (and later the dipole's) through zero.
    #[test]
    fn bounds_radial_moment_halves_in_grooved_coils(
        (periods, turns) in (1_usize..=12).prop_flat_map(|k| (Just(k), (8 * k).max(20)..=120)), builds in 5.0..50.0_f64
    ) {
        let moments = radial_moments(8 * periods, turns, turns - 1, builds);
        prop_assert!(each_halves(moments), "{:?}", moments);
    }
}

/// Why the bound above needs the limit on the layers: 40 layers of 20 and 19 turns.
#[test]
fn bounds_octupole_gains_nothing_where_the_grooved_quadrupole_cancels_by_chance() {
    let [_, _, quadrupole, octupole] = radial_moments(40, 20, 19, 20.0);
    assert!(octupole > 10.0 * quadrupole, "{octupole} {quadrupole}");
}
