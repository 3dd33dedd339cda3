//! Bounds and composite cylinders against the finite elements and against what is known exactly.

#![allow(clippy::unwrap_used)]

use crate::common::{cells, on, reference, solid, solve, two_phase};
use fem_core::material::Isotropic;
use homogenization::bounds::{Range, bounds, cylinders};
use homogenization::{
    Constants, Constituent, Extent, FibreCell, Homogenized, Packing, Ring, Role, homogenize, homogenize_on, homogenize_to,
};
use proptest::prelude::*;

/// Effect of rounding on closed forms, relative: they take differences of phases that may be a million times stiffer, and far stiffer
/// still against compression; bounds that are attained lie at the root of a difference that should vanish.
fn rounding(cell: &FibreCell) -> f64 {
    let all = || cell.constituents().map(|c| c.elastic);
    let moduli = || all().map(|c| c.youngs_modulus);
    let contrast = moduli().fold(0.0, f64::max) / moduli().fold(f64::INFINITY, f64::min);
    let volume = all().map(|c| 1.0 - 2.0 * c.poisson_ratio).fold(1.0, f64::min);
    // of 300 000 cells none needed more than 3e-6
    (10.0 * f64::EPSILON * contrast / volume).sqrt().min(1e-5)
}

/// `value` inside, but for its own `error` and rounding, that of expansions relative to the largest of a constituent.
fn inside(range: &Range, value: &Constants, error: &Constants, rounding: f64) -> Result<(), String> {
    for (((name, [lower, upper]), (_, value)), (_, error)) in range.named().into_iter().zip(value.named()).zip(error.named()) {
        let scale = if name.starts_with("alpha") { 300e-6 } else { value.abs() };
        let slack = error + rounding * scale;
        if !(lower - slack <= value && value <= upper + slack) {
            return Err(format!("{name}: {value} outside [{lower}, {upper}]"));
        }
    }
    Ok(())
}

/// The cell's constants, as far as their numerical errors go, and the composite cylinders inside both pairs, the narrower pair inside the wider.
fn check(cell: &FibreCell, result: &Homogenized) -> Result<(), String> {
    let (found, error, rounding) = (bounds(cell).unwrap(), result.error(), rounding(cell));
    inside(&found.hashin_shtrikman, &result.constants, &error, rounding).map_err(|e| format!("Hashin-Shtrikman: {e}"))?;
    inside(&found.reuss_voigt, &result.constants, &error, rounding).map_err(|e| format!("Reuss-Voigt: {e}"))?;
    let exact = error.combine(&error, |_, _| 0.0);
    inside(&found.hashin_shtrikman, &found.cylinders, &exact, rounding).map_err(|e| format!("cylinders: {e}"))?;
    for (narrow, wide) in
        [(&found.hashin_shtrikman.lower, &found.reuss_voigt), (&found.hashin_shtrikman.upper, &found.reuss_voigt)]
    {
        for key in ["k_plane_strain", "g_r", "g_zr", "k_r", "e_z", "e_r"] {
            let of = |c: &Constants| c.named().into_iter().find(|(name, _)| *name == key).unwrap().1;
            let (low, high, value) = (of(&wide.lower), of(&wide.upper), of(narrow));
            if !(low * (1.0 - 1e-9) <= value && value <= high * (1.0 + 1e-9)) {
                return Err(format!("{key}: {value} outside {low}, {high}"));
            }
        }
    }
    Ok(())
}

fn constituent() -> impl Strategy<Value = Constituent> {
    (5.0..11.0, -0.3..5.0, -20e-6..300e-6, -1.5..1.5).prop_map(|(e, p, alpha, k): (f64, f64, f64, f64)| {
        // Poisson's ratio from −0.5 to 0.499995
        solid(10_f64.powf(e), 0.5 - 10_f64.powf(-p) / 2.0, alpha, 10_f64.powf(k))
    })
}

fn cell() -> impl Strategy<Value = FibreCell> {
    (prop::collection::vec((constituent(), 0.2..1.0_f64), 1..4), constituent(), 0.15..0.485_f64).prop_map(
        |(rings, adhesive, outer)| {
            let total: f64 = rings.iter().map(|r| r.1).sum();
            let mut radius = 0.0;
            let rings = rings.into_iter().map(|(constituent, width)| {
                radius += outer * width / total;
                Ring { outer_radius: radius, constituent, role: Role::Glass }
            });
            FibreCell { packing: homogenization::Packing::Hexagonal, pitch: 1.0, rings: rings.collect(), adhesive }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn random_cells_lie_inside(cell in cell()) {
        // rounding stands in the way of much in the extremes
        let result = [1e-6, 1e-4, 1e-2].into_iter().find_map(|tolerance| homogenize_to(&cell, tolerance).ok()).unwrap();
        if let Err(e) = check(&cell, &result) {
            return Err(TestCaseError::fail(e));
        }
    }
}

#[test]
fn known_cells_lie_inside() {
    for cell in cells() {
        check(&cell, &homogenize_on(&cell, &on(&cell, 8, Extent::Quarter)).unwrap()).unwrap();
        let square = FibreCell { packing: Packing::Square, ..cell };
        check(&square, &homogenize(&square).unwrap()).unwrap();
    }
}

/// A constant added to every expansion is added to the bounds, and no more: also where the energies that temperature stores are
/// large and nearly the same in both, in nearly incompressible polymers.
#[test]
fn a_common_expansion_only_shifts_the_bounds() {
    const COMMON: f64 = 300e-6;
    let mut cell = reference();
    let polymers = cell.rings[1..].iter_mut().map(|ring| &mut ring.constituent).chain([&mut cell.adhesive]);
    polymers.for_each(|c| c.elastic.poisson_ratio = 0.499_999);
    let mut shifted = cell.clone();
    let constituents = shifted.rings.iter_mut().map(|ring| &mut ring.constituent).chain([&mut shifted.adhesive]);
    constituents.for_each(|c| c.elastic.thermal_expansion += COMMON);
    let [plain, shifted] = [cell, shifted].map(|cell| bounds(&cell).unwrap());
    for (plain, shifted) in [(&plain.reuss_voigt, &shifted.reuss_voigt), (&plain.hashin_shtrikman, &shifted.hashin_shtrikman)] {
        for ((name, plain), (_, shifted)) in plain.named().into_iter().zip(shifted.named()) {
            let common = if name.starts_with("alpha") { COMMON } else { 0.0 };
            for (plain, shifted) in plain.into_iter().zip(shifted).filter(|(plain, _)| plain.is_finite()) {
                let scale = if name.starts_with("alpha") { COMMON } else { plain.abs() };
                assert!((shifted - common - plain).abs() <= 1e-12 * scale, "{name}: {plain} becomes {shifted}");
            }
        }
    }
}

/// One material everywhere: bounds, cylinders and material are one.
#[test]
fn homogeneous_cells_collapse_the_bounds() {
    let c = solid(3e9, 0.38, 60e-6, 0.2);
    let mut cell = reference();
    cell.rings.iter_mut().for_each(|r| r.constituent = c);
    cell.adhesive = c;
    let found = bounds(&cell).unwrap();
    let Isotropic { youngs_modulus: e, poisson_ratio: nu, .. } = c.elastic;
    for constants in [found.hashin_shtrikman.lower, found.hashin_shtrikman.upper, found.reuss_voigt.upper, found.cylinders] {
        for (value, exact) in [
            (constants.e_r, e),
            (constants.e_z, e),
            (constants.nu_r, nu),
            (constants.nu_rz, nu),
            (constants.g_r, e / 2.0 / (1.0 + nu)),
            (constants.g_zr, e / 2.0 / (1.0 + nu)),
            (constants.alpha_r, 60e-6),
            (constants.alpha_z, 60e-6),
            (constants.k_r, 0.2),
        ] {
            assert!((value / exact - 1.0).abs() < 1e-7, "{value} is not {exact}");
        }
    }
}

/// Bare fibres: the closed forms of Hashin and Rosen (1964) and of Christensen and Lo (1979) as printed for two phases.
#[test]
fn cylinders_of_two_phases_are_the_printed_formulas() {
    let (fibre, matrix) = (solid(72e9, 0.17, 0.5e-6, 1.38), solid(3e9, 0.38, 60e-6, 0.2));
    let found = cylinders(&two_phase(fibre, matrix)).unwrap().constants().unwrap();
    let f = std::f64::consts::PI * 0.38 * 0.38 / 0.75_f64.sqrt();
    let (gf, gm) = (fibre.elastic.shear_modulus(), matrix.elastic.shear_modulus());
    let (kf, km) = (fibre.elastic.lame_lambda() + gf, matrix.elastic.lame_lambda() + gm);
    let k = km + f / (1.0 / (kf - km) + (1.0 - f) / (km + gm));
    let g_zr = gm * (gf * (1.0 + f) + gm * (1.0 - f)) / (gf * (1.0 - f) + gm * (1.0 + f));
    let hill = 4.0 * f * (1.0 - f) * (0.17_f64 - 0.38).powi(2) / (f / km + (1.0 - f) / kf + 1.0 / gm);
    let e_z = f * 72e9 + (1.0 - f) * 3e9 + hill;
    let (ef, em) = (3.0 - 4.0 * 0.17, 3.0 - 4.0 * 0.38);
    let (q, f3) = (gf / gm, f.powi(3));
    let a = 3.0 * f * (1.0 - f).powi(2) * (q - 1.0) * (q + ef)
        + (q * em + ef * em - (q * em - ef) * f3) * (f * em * (q - 1.0) - (q * em + 1.0));
    let b = -3.0 * f * (1.0 - f).powi(2) * (q - 1.0) * (q + ef)
        + 0.5 * (em * q + (q - 1.0) * f + 1.0) * ((em - 1.0) * (q + ef) - 2.0 * (q * em - ef) * f3)
        + f / 2.0 * (em + 1.0) * (q - 1.0) * (q + ef + (q * em - ef) * f3);
    let d = 3.0 * f * (1.0 - f).powi(2) * (q - 1.0) * (q + ef) + (em * q + (q - 1.0) * f + 1.0) * (q + ef + (q * em - ef) * f3);
    let g_r = gm * (-b - (b * b - a * d).sqrt()) / a;
    for (name, value, exact) in
        [("k", found.k_plane_strain, k), ("g_zr", found.g_zr, g_zr), ("e_z", found.e_z, e_z), ("g_r", found.g_r, g_r)]
    {
        assert!((value / exact - 1.0).abs() < 1e-9, "{name}: {value} is not {exact}");
    }
}

/// A ring cut in two of the same material changes nothing; a dilute fibre's cylinder is its hexagon's limit.
#[test]
fn cylinders_agree_with_finite_elements_where_fibres_are_far_apart() {
    let mut split = reference();
    split.rings.insert(2, Ring { outer_radius: 70e-6, ..split.rings[2] });
    let [whole, cut] = [reference(), split].map(|cell| cylinders(&cell).unwrap().constants().unwrap());
    for ((name, a), (_, b)) in whole.named().into_iter().zip(cut.named()) {
        assert!((a / b - 1.0).abs() < 1e-7, "{name}: {a} and {b}");
    }
    let matrix = solid(3e9, 0.38, 60e-6, 0.2);
    let coated =
        |pitch: f64| FibreCell { packing: homogenization::Packing::Hexagonal, pitch, adhesive: matrix, rings: reference().rings };
    let distance = |pitch: f64| {
        let cell = coated(pitch);
        let estimate = cylinders(&cell).unwrap().constants().unwrap();
        let relative = solve(&cell, 8, Extent::Quarter).1.combine(&estimate, |a, b| (a / b - 1.0).abs());
        relative.named().map(|(_, e)| e).into_iter().fold(0.0, f64::max)
    };
    let (near, far) = (distance(190e-6), distance(500e-6));
    assert!(far < 5e-3 && far < near / 40.0, "{far} far apart, {near} near");
}
