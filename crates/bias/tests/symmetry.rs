//! Linearity, exchange of the fibre's ends, and what the strain convention leaves unchanged.

use crate::common::{SILICA, any_partition, still};
use bias::{Bias, Optics, Slice, StrainConvention, bias};
use proptest::prelude::*;

const LENGTH: f64 = 1000.0;

fn parts(bias: Bias) -> [f64; 3] {
    [bias.shupe, bias.eo_axial, bias.eo_radial]
}

fn solve(strain: StrainConvention, slices: &[Slice]) -> [f64; 3] {
    parts(bias(&Optics { strain, ..SILICA }, LENGTH, slices).expect("slices on the fibre"))
}

/// Sum of the sizes of all contributions, a scale for rounding, with one contribution per rate.
fn sizes(slices: &[Slice]) -> [f64; 3] {
    let mut sizes = [0.0; 3];
    for slice in slices {
        for strain in [StrainConvention::Total, StrainConvention::Mechanical] {
            let part = solve(strain, &[*slice]);
            (0..3).for_each(|k| sizes[k] += part[k].abs());
        }
    }
    sizes
}

/// 1 to 60 slices anywhere on the fibre, with any rates.
fn any_slices() -> impl Strategy<Value = Vec<Slice>> {
    let slice = (0.0..900.0_f64, 0.0..100.0_f64, -1e-2..1e-2_f64, -1e-7..1e-7_f64, -1e-7..1e-7_f64).prop_map(
        |(z_start, span, temperature_rate, axial_strain_rate, radial_strain_rate)| Slice {
            z_start,
            z_end: z_start + span,
            temperature_rate,
            axial_strain_rate,
            radial_strain_rate,
        },
    );
    prop::collection::vec(slice, 1..60)
}

fn any_convention() -> impl Strategy<Value = StrainConvention> {
    prop::sample::select(&[StrainConvention::Total, StrainConvention::Mechanical][..])
}

fn scaled(slice: &Slice, factor: f64) -> Slice {
    Slice {
        temperature_rate: factor * slice.temperature_rate,
        axial_strain_rate: factor * slice.axial_strain_rate,
        radial_strain_rate: factor * slice.radial_strain_rate,
        ..*slice
    }
}

proptest! {
    #[test]
    fn symmetry_bias_is_linear_in_the_rates(
        strain in any_convention(), a in any_slices(), b in any_slices(), factor in -10.0..10.0_f64
    ) {
        let both: Vec<Slice> = a.iter().map(|slice| scaled(slice, factor)).chain(b.iter().copied()).collect();
        let [together, first, second, size] = [solve(strain, &both), solve(strain, &a), solve(strain, &b), sizes(&both)];
        for k in 0..3 {
            prop_assert!((together[k] - (factor * first[k] + second[k])).abs() <= 16.0 * f64::EPSILON * (size[k] + second[k].abs()));
        }
    }

    /// z → L − z.
    #[test]
    fn symmetry_exchanging_the_fibre_ends_flips_the_sign(strain in any_convention(), slices in any_slices()) {
        let exchange = |slice: &Slice| Slice { z_start: LENGTH - slice.z_end, z_end: LENGTH - slice.z_start, ..*slice };
        let exchanged: Vec<Slice> = slices.iter().map(exchange).collect();
        let (forward, backward) = (solve(strain, &slices), solve(strain, &exchanged));
        // L − z is off by u L, so a weight by 6u L² at most; no rate is above its bound
        let weight = 6.0 * f64::EPSILON * LENGTH * LENGTH * slices.len() as f64;
        let bound = parts(SILICA.coefficients(LENGTH).unwrap().bias(weight, 1e-2, 1e-7, -1e-7));
        for k in 0..3 {
            prop_assert!((forward[k] + backward[k]).abs() <= bound[k], "{:?} {:?}", forward, backward);
        }
    }

    /// Where Ṫ is uniform the expansion counted twice integrates to nothing, whatever the strains.
    #[test]
    fn symmetry_conventions_agree_in_a_uniform_ramp(
        cuts in any_partition(LENGTH), rate in -1e-2..1e-2_f64, (along, across) in (-1e-7..1e-7_f64, -1e-7..1e-7_f64)
    ) {
        let strained = |cut: &[f64]| Slice {
            temperature_rate: rate,
            axial_strain_rate: along * (cut[0] / LENGTH).sin(),
            radial_strain_rate: across * cut[1] / LENGTH,
            ..still(cut[0], cut[1])
        };
        let slices: Vec<Slice> = cuts.windows(2).map(strained).collect();
        let (total, mechanical) = (solve(StrainConvention::Total, &slices), solve(StrainConvention::Mechanical, &slices));
        let size = sizes(&slices);
        for k in 0..3 {
            prop_assert!((total[k] - mechanical[k]).abs() <= 16.0 * f64::EPSILON * size[k]);
        }
    }

    /// … and differ by the expansion's own bias where it is not.
    #[test]
    fn symmetry_conventions_differ_by_the_free_expansion(slices in any_slices()) {
        let expansion = |slice: &Slice| {
            let free = SILICA.thermal_expansion * slice.temperature_rate;
            Slice { axial_strain_rate: free, radial_strain_rate: free, ..*slice }
        };
        let free: Vec<Slice> = slices.iter().map(expansion).collect();
        let [total, mechanical] = [StrainConvention::Total, StrainConvention::Mechanical].map(|strain| solve(strain, &slices));
        let (free, size, free_size) = (solve(StrainConvention::Total, &free), sizes(&slices), sizes(&free));
        prop_assert_eq!(total[0], mechanical[0]);
        for k in 1..3 {
            prop_assert!((total[k] - mechanical[k] - free[k]).abs() <= 16.0 * f64::EPSILON * (size[k] + free_size[k]));
        }
    }
}
