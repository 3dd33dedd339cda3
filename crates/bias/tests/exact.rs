//! Against integrals done by hand.

use crate::common::{SILICA, any_partition, still};
use approx::assert_relative_eq;
use bias::{Bias, Error, LENGTH_SLACK, Optics, Slice, StrainConvention, bias};
use proptest::prelude::*;

const LENGTH: f64 = 1000.0;

#[test]
fn exact_one_heated_slice() {
    let slice = Slice { temperature_rate: 2e-2, axial_strain_rate: 3e-8, radial_strain_rate: -5e-8, ..still(100.0, 103.0) };
    let bias = bias(&SILICA, LENGTH, &[slice]).unwrap();
    // ∫ (1000 − 2z) dz from 100 to 103 m
    let weight = 3.0 * 1000.0 - (103.0 * 103.0 - 100.0 * 100.0);
    let scale = 1.45 / (1000.0 * 92.325e-3) * weight;
    assert_relative_eq!(bias.shupe, scale * (1.0e-5 + 1.45 * 0.55e-6) * 2e-2, max_relative = 1e-13);
    assert_relative_eq!(bias.eo_axial, scale * 1.038_435_625 * 3e-8, max_relative = 1e-13);
    assert_relative_eq!(bias.eo_radial, scale * 0.596_006_187_5 * 5e-8, max_relative = 1e-13);
}

#[test]
fn exact_mechanical_strain_takes_the_expansion_off_both_strains() {
    let slice = Slice { temperature_rate: 2e-2, axial_strain_rate: 3e-8, radial_strain_rate: -5e-8, ..still(100.0, 103.0) };
    let mechanical = bias(&Optics { strain: StrainConvention::Mechanical, ..SILICA }, LENGTH, &[slice]).unwrap();
    let less = 0.55e-6 * 2e-2;
    let reduced = Slice { axial_strain_rate: 3e-8 - less, radial_strain_rate: -5e-8 - less, ..slice };
    let total = bias(&SILICA, LENGTH, &[reduced]).unwrap();
    assert_eq!(mechanical.shupe, total.shupe);
    assert_relative_eq!(mechanical.eo_axial, total.eo_axial, max_relative = 1e-13);
    assert_relative_eq!(mechanical.eo_radial, total.eo_radial, max_relative = 1e-13);
}

/// Rates f(z) sampled at the middle of each of `count` slices of equal length.
fn sampled(count: usize, rate: impl Fn(f64) -> f64) -> Vec<Slice> {
    let step = LENGTH / count as f64;
    let slice = |k: usize| {
        let (z_start, z_end) = (k as f64 * step, (k + 1) as f64 * step);
        let rate = rate(0.5 * (z_start + z_end));
        Slice { temperature_rate: rate, axial_strain_rate: rate, radial_strain_rate: rate, ..still(z_start, z_end) }
    };
    (0..count).map(slice).collect()
}

/// ∫ z (L − 2z) dz = −L³/6; the midpoint slices miss the part 1/count² of it.
#[test]
fn exact_linear_field_in_the_limit_of_fine_slices() {
    let limit = SILICA.coefficients(LENGTH).unwrap().bias(-LENGTH.powi(3) / 6.0, 1e-6, 1e-6, 1e-6);
    for count in [1_usize, 2, 10, 100, 10_000] {
        let bias = bias(&SILICA, LENGTH, &sampled(count, |z| 1e-6 * z)).unwrap();
        let h = 1.0 / count as f64;
        for (part, limit) in [(bias.shupe, limit.shupe), (bias.eo_axial, limit.eo_axial), (bias.eo_radial, limit.eo_radial)] {
            assert_relative_eq!(part, limit * (1.0 - h * h), max_relative = 1e-12, epsilon = 1e-12 * limit.abs());
        }
    }
}

/// ∫ cos(π z/L) (L − 2z) dz = 4 L²/π²; halving the slices quarters the error.
#[test]
fn exact_smooth_field_with_second_order() {
    use std::f64::consts::PI;
    let limit = SILICA.coefficients(LENGTH).unwrap().bias(4.0 * (LENGTH / PI).powi(2), 1.0, 0.0, 0.0).shupe;
    let error = |count| bias(&SILICA, LENGTH, &sampled(count, |z| (PI * z / LENGTH).cos())).unwrap().shupe - limit;
    for count in [16, 64, 256] {
        assert_relative_eq!(error(count) / error(2 * count), 4.0, max_relative = 1e-2);
    }
}

#[test]
fn exact_refusals_name_the_slice_and_the_field() {
    let with = |slice| bias(&SILICA, LENGTH, &[still(0.0, 1.0), slice]);
    for (z_start, z_end) in [(-1.0, 1.0), (2.0, 1.0), (999.0, 1000.1), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        let message = with(still(z_start, z_end)).expect_err("not on the fibre").to_string();
        assert!(message.contains(&format!("slice 1 spans z = {z_start} m to {z_end} m")), "{message}");
    }
    let fields = [
        ("temperature_rate", Slice { temperature_rate: f64::NAN, ..still(0.0, 1.0) }),
        ("axial_strain_rate", Slice { axial_strain_rate: f64::INFINITY, ..still(0.0, 1.0) }),
        ("radial_strain_rate", Slice { radial_strain_rate: f64::NAN, ..still(0.0, 1.0) }),
    ];
    for (expected, slice) in fields {
        assert!(matches!(with(slice), Err(Error::Rate { index: 1, field, .. }) if field == expected));
    }
    assert_eq!(with(still(999.0, LENGTH * (1.0 + 0.5 * LENGTH_SLACK))), Ok(Bias::ZERO));
}

proptest! {
    /// Ṫ the same all along the fibre gives no Shupe bias, however it is cut.
    ///
    /// With u = 2⁻⁵³: a weight Δz (L − z₀ − z₁) is off by at most Δz · 2uL + 2u|W|, so all by 2uL² + 2uΣ|W| ≤ 6uΣ|W|, because
    /// Σ|W| is about L²/2; two more factors add 2uΣ|Ω| and the compensated sum next to nothing: below 10u = 5ε.
    #[test]
    fn exact_uniform_temperature_rate_gives_no_shupe_bias(cuts in any_partition(LENGTH), rate in -1.0..1.0_f64) {
        let slices: Vec<Slice> =
            cuts.windows(2).map(|cut| Slice { temperature_rate: rate, ..still(cut[0], cut[1]) }).collect();
        let size: f64 = slices.iter().map(|slice| bias(&SILICA, LENGTH, &[*slice]).unwrap().shupe.abs()).sum();
        let bias = bias(&SILICA, LENGTH, &slices).unwrap();
        prop_assert!(bias.shupe.abs() <= 5.0 * f64::EPSILON * size, "{} of {}", bias.shupe, size);
    }

    /// A fibre that expands freely has no elasto-optic phase once the expansion is taken off.
    #[test]
    fn exact_free_fibre_has_no_mechanical_strain(start in 0.0..900.0_f64, rate in -1.0..1.0_f64) {
        let optics = Optics { strain: StrainConvention::Mechanical, ..SILICA };
        let expansion = optics.thermal_expansion * rate;
        let slice = Slice {
            temperature_rate: rate,
            axial_strain_rate: expansion,
            radial_strain_rate: expansion,
            ..still(start, start + 50.0)
        };
        let free = bias(&optics, LENGTH, &[slice]).unwrap();
        let counted_twice = bias(&SILICA, LENGTH, &[slice]).unwrap();
        // α Ṫ A and (α A) Ṫ round differently
        prop_assert!(free.eo_axial.abs() <= 4.0 * f64::EPSILON * counted_twice.eo_axial.abs());
        prop_assert!(free.eo_radial.abs() <= 4.0 * f64::EPSILON * counted_twice.eo_radial.abs());
        prop_assert_eq!(free.shupe, counted_twice.shupe);
    }
}
