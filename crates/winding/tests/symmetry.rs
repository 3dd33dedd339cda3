//! The two symmetries of a winding: exchanging the fibre's ends, and turning the coil round.

use crate::common::{ALL, any_spec};
use bias::{Bias, Optics, Slice, StrainConvention, bias};
use proptest::prelude::*;
use winding::{Spec, Turn, wind};

const SILICA: Optics = Optics {
    refractive_index: 1.45,
    thermo_optic: 1.0e-5,
    thermal_expansion: 0.55e-6,
    p11: 0.121,
    p12: 0.270,
    sagnac_diameter: 92.325e-3,
    strain: StrainConvention::Mechanical,
};

/// A field without any symmetry, at a turn.
fn slice(turn: &Turn) -> Slice {
    let (layer, place) = (turn.layer as f64, turn.turn as f64);
    Slice {
        z_start: turn.z_start,
        z_end: turn.z_end,
        temperature_rate: 1e-3 * (1.0 + layer + 0.1 * place),
        axial_strain_rate: 1e-8 * (layer * layer - place),
        radial_strain_rate: -1e-8 * (3.0 + layer * place),
    }
}

/// Sizes, summed, of what an error of `weight` [m²] in every turn's weight does.
fn rounding(turns: &[Turn], length: f64, weight: f64) -> [f64; 3] {
    let coefficients = SILICA.coefficients(length).expect("valid optics");
    let part = |turn| {
        let Slice { temperature_rate, axial_strain_rate, radial_strain_rate, .. } = slice(turn);
        parts(coefficients.bias(weight, temperature_rate, axial_strain_rate, radial_strain_rate)).map(f64::abs)
    };
    turns.iter().map(part).fold([0.0; 3], |sum, part| [0, 1, 2].map(|k| sum[k] + part[k]))
}

fn parts(bias: Bias) -> [f64; 3] {
    [bias.shupe, bias.eo_axial, bias.eo_radial]
}

fn bias_of(turns: &[Turn], length: f64) -> Bias {
    let slices: Vec<Slice> = turns.iter().map(slice).collect();
    bias(&SILICA, length, &slices).expect("turns on the fibre")
}

proptest! {
    /// z → L − z.
    #[test]
    fn symmetry_reading_from_the_other_end_flips_weights_and_bias(spec in any_spec(ALL)) {
        let coil = wind(&spec).unwrap();
        let length = coil.length();
        let from_the_other_end = |turn: &Turn| Turn {
            half: turn.half.other(),
            z_start: length - turn.z_end,
            z_end: length - turn.z_start,
            ..*turn
        };
        let reversed: Vec<Turn> = coil.turns().iter().rev().map(from_the_other_end).collect();
        // L − z is off by ε L / 2 at either end of a turn, and what it multiplies is at most L
        let weight_error = 4.0 * f64::EPSILON * length * length;
        for (turn, weight) in reversed.iter().rev().zip(coil.weights()) {
            prop_assert!((turn.weight(length) + weight).abs() < weight_error, "{:?}", turn);
        }
        let (forward, backward) = (bias_of(coil.turns(), length), bias_of(&reversed, length));
        let rounding = rounding(coil.turns(), length, weight_error);
        for (sum, rounding) in parts(forward + backward).into_iter().zip(rounding) {
            prop_assert!(sum.abs() < rounding, "{:?} {:?} {}", forward, backward, rounding);
        }
    }

    /// A winding between other edges is the same fibre, every turn where the axis is shifted and stretched to.
    #[test]
    fn exact_start_and_end_take_every_turn_along_and_nothing_else(
        spec in any_spec(ALL), start in -1e-3..1e-3_f64, wider in prop::option::of(0.5..2.0_f64),
    ) {
        let from = wind(&spec).unwrap();
        let to = wind(&Spec { start, end: wider.map(|wider| start + wider * from.height()), ..spec }).unwrap();
        let stretch = wider.unwrap_or(1.0);
        let rounding = 8.0 * f64::EPSILON * (from.height() * stretch + start.abs());
        for (a, b) in from.turns().iter().zip(to.turns()) {
            prop_assert!((start + stretch * a.y - b.y).abs() <= rounding);
            prop_assert_eq!(Turn { y: b.y, ..*a }, *b);
        }
        prop_assert!((stretch * from.height() - to.height()).abs() <= rounding);
        let ends = |turns: &[Turn]| turns.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], t| [l.min(t.y), h.max(t.y)]);
        prop_assert_eq!(to.spec().reach(), ends(to.turns()));
    }

    /// The same fibre, every turn at the mirrored place of its layer. Where the even layers have one turn less, the lattice has
    /// a mirror plane and y itself is mirrored; with equal counts the even layers are half a pitch off it.
    #[test]
    fn symmetry_mirroring_y_swaps_the_climb_ends(spec in any_spec(ALL)) {
        let right = wind(&spec).unwrap();
        let left = wind(&Spec { cw_climbs: spec.cw_climbs.other(), ..spec }).unwrap();
        let turns_in = |layer| if layer % 2 == 1 { spec.turns_odd_layers } else { spec.turns_even_layers };
        prop_assert_eq!(right.turns().len(), left.turns().len());
        for (a, b) in right.turns().iter().zip(left.turns()) {
            let mirrored = Turn { turn: turns_in(b.layer) + 1 - b.turn, y: a.y, ..*b };
            prop_assert_eq!(*a, mirrored);
            if spec.turns_even_layers < spec.turns_odd_layers {
                prop_assert!((a.y + b.y - right.height()).abs() < 8.0 * f64::EPSILON * right.height());
            }
        }
        if spec.turns_even_layers < spec.turns_odd_layers {
            let scale: f64 = right.weights().iter().map(|weight| weight.abs()).sum::<f64>() * right.height();
            prop_assert!((right.moment(0, 1) + left.moment(0, 1)).abs() < 1e-12 * scale);
        }
    }
}
