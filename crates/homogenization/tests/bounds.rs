//! Bounds of the constants and of their numerical error; what is refused.

use crate::common::{cells, glass, on, reference, solid, solve, two_phase};
use homogenization::{Constants, Constituent, Discretization, Error, Extent, FibreCell, Role, effective, homogenize};
use nalgebra::Matrix6;
use std::sync::OnceLock;

/// Relative accuracy that the standard discretisation owes to every constant, and the unknowns it may take for that.
const ACCURACY: f64 = 1e-4;
const UNKNOWNS: usize = 5000;

#[test]
fn exact_a_refined_mesh_has_two_orders_more_and_nothing_else() {
    let standard = Discretization::standard(&reference());
    assert_eq!(standard.refined(), Discretization { order: standard.order + 2, ..standard.clone() });
    assert_eq!((standard.order, standard.extent), (6, Extent::Quarter));
}

/// Each phase with its area fraction.
fn phases(cell: &FibreCell) -> Vec<(f64, Constituent)> {
    let area = |r: f64| std::f64::consts::PI * r * r / (cell.pitch * cell.pitch * 0.75_f64.sqrt());
    let mut inner = 0.0;
    let mut phases = Vec::new();
    for ring in &cell.rings {
        phases.push((area(ring.outer_radius) - inner, ring.constituent));
        inner = area(ring.outer_radius);
    }
    phases.push((1.0 - inner, cell.adhesive));
    phases
}

/// The effective energy lies between those of uniform stress (Reuss) and uniform strain (Voigt), for every strain.
#[test]
fn bounds_voigt_and_reuss() {
    for cell in cells() {
        let ((e, c), phases) = (solve(&cell, 6, Extent::Quarter), phases(&cell));
        let stiffness = |c: &Constituent| c.elastic.law().unwrap().stiffness;
        let voigt: Matrix6<f64> = phases.iter().map(|(f, c)| stiffness(c) * *f).sum();
        let reuss: Matrix6<f64> = phases.iter().map(|(f, c)| stiffness(c).try_inverse().unwrap() * *f).sum();
        let lowest = |m: Matrix6<f64>| ((m + m.transpose()) / 2.0).symmetric_eigenvalues().min();
        assert!(lowest(voigt - e.stiffness) > -1e-9 * voigt.amax());
        assert!(lowest(reuss - e.stiffness.try_inverse().unwrap()) > -1e-9 * reuss.amax());
        let (mean, harmonic) = (
            |value: &dyn Fn(&Constituent) -> f64| -> f64 { phases.iter().map(|(f, c)| f * value(c)).sum() },
            |value: &dyn Fn(&Constituent) -> f64| -> f64 { 1.0 / phases.iter().map(|(f, c)| f / value(c)).sum::<f64>() },
        );
        for (found, value) in [
            (c.g_zr, &(|c: &Constituent| c.elastic.shear_modulus()) as &dyn Fn(&Constituent) -> f64),
            (c.g_r, &|c| c.elastic.shear_modulus()),
            (c.k_r, &|c| c.conductivity),
        ] {
            assert!(harmonic(value) < found && found < mean(value), "{} < {found} < {}", harmonic(value), mean(value));
        }
        // Hill (1964): along the fibre the rule of mixtures is the lower bound
        assert!(c.e_z > mean(&|c| c.elastic.youngs_modulus));
        assert!((c.k_z / mean(&|c| c.conductivity) - 1.0).abs() < 1e-9);
    }
}

/// Constants of each cell at each of [`ORDERS`]; the last is as good as exact.
fn series() -> &'static [Vec<Constants>] {
    static SERIES: OnceLock<Vec<Vec<Constants>>> = OnceLock::new();
    let of_cell = |cell: &FibreCell| ORDERS.iter().map(|&order| solve(cell, order, Extent::Quarter).1).collect();
    SERIES.get_or_init(|| cells().map(|cell| of_cell(&cell)).collect())
}

const ORDERS: [usize; 4] = [4, 6, 8, 12];

/// Displacements in a finite space are too stiff, conductivities too large, and less so with every order.
#[test]
fn bounds_energies_converge_from_above() {
    type Energy = fn(&Constants) -> f64;
    let energies: [Energy; 4] = [|c| c.k_plane_strain, |c| c.g_r, |c| c.g_zr, |c| c.k_r];
    for constants in series() {
        for energy in energies {
            let excess: Vec<f64> = constants[..3].iter().map(|c| energy(c) / energy(&constants[3]) - 1.0).collect();
            assert!(excess.iter().all(|e| *e > -1e-8), "{excess:?}");
            assert!(excess.windows(2).all(|w| w[1] < w[0] / 2.0 || w[1] < 1e-8), "{excess:?}");
        }
    }
}

/// Four orders gain a factor of thirty in every constant, down to what rounding leaves of 1/(1 − 2ν).
#[test]
fn bounds_every_constant_converges_with_the_order() {
    for constants in series() {
        let [coarse, fine, exact] = [0, 2, 3].map(|i| constants[i].named());
        for (((name, coarse), (_, fine)), (_, exact)) in coarse.into_iter().zip(fine).zip(exact) {
            let [before, after] = [coarse, fine].map(|value| (value / exact - 1.0).abs());
            assert!(after < (before / 30.0).max(1e-8), "{name}: {before:e} at order 4, {after:e} at order 8");
        }
    }
}

/// The estimate of every constant's error against its error with respect to order 12.
#[test]
fn bounds_error_estimates_cover_the_error() {
    for (cell, constants) in cells().zip(series()) {
        let result = homogenize(&cell).unwrap();
        assert!(result.unknowns < UNKNOWNS, "{} unknowns", result.unknowns);
        let exact = constants[3];
        let estimates = result.relative_error.named();
        for (((name, value), (_, exact)), (_, estimate)) in result.constants.named().into_iter().zip(exact.named()).zip(estimates)
        {
            let error = (value / exact - 1.0).abs();
            assert!(estimate < ACCURACY, "{name}: {estimate:e}");
            assert!(error <= estimate + 1e-9, "{name}: {error:e} against an estimate of {estimate:e}");
        }
    }
}

fn fails(cell: &FibreCell) -> String {
    homogenize(cell).expect_err("a bad cell").to_string()
}

#[test]
fn bounds_bad_constituents_are_named() {
    let with = |ring: usize, bad: Constituent| {
        let mut cell = reference();
        match cell.rings.get_mut(ring) {
            Some(ring) => ring.constituent = bad,
            None => cell.adhesive = bad,
        }
        fails(&cell)
    };
    for (message, parts) in [
        (with(0, solid(-1.0, 0.2, 0.0, 1.0)), ["ring 0 (glass)", "youngs_modulus"]),
        (with(1, solid(1e6, 0.5, 0.0, 1.0)), ["ring 1 (coating)", "poisson_ratio"]),
        (with(2, solid(1e6, 0.3, f64::NAN, 1.0)), ["ring 2", "thermal_expansion"]),
        (with(3, solid(f64::INFINITY, 0.3, 0.0, 1.0)), ["adhesive", "youngs_modulus"]),
        (with(1, solid(1e6, 0.3, 0.0, 0.0)), ["ring 1", "conductivity"]),
        (with(3, solid(1e6, 0.3, 0.0, f64::NAN)), ["adhesive", "conductivity"]),
    ] {
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
}

#[test]
fn bounds_bad_cells_are_refused() {
    let mut no_glass = reference();
    no_glass.rings.iter_mut().for_each(|r| r.role = Role::Coating);
    assert_eq!(homogenize(&no_glass), Err(Error::NoGlass));
    assert!(matches!(homogenize(&FibreCell { pitch: 165e-6, ..reference() }), Err(Error::Geometry(_))));
    assert!(matches!(homogenize(&FibreCell { rings: vec![], ..reference() }), Err(Error::Geometry(_))));
    // straight edges: the areas are wrong
    let coarse = Discretization { order: 1, ..on(&reference(), 1, Extent::Quarter) };
    assert!(matches!(effective(&reference(), &coarse), Err(Error::Area { phase: 0, .. })));
    let mut few = on(&reference(), 4, Extent::Quarter);
    few.resolution.across.pop();
    assert!(matches!(effective(&reference(), &few), Err(Error::Geometry(_))));
    assert!(effective(&reference(), &Discretization { order: 0, ..few }).is_err());
}

/// Contrasts of stiffness, conductivity and compressibility far beyond any coil's.
#[test]
fn bounds_extreme_contrasts_are_solved() {
    let hard = solid(400e9, 0.2, 1e-6, 400.0);
    for soft in [solid(1e5, 0.49999, 300e-6, 0.02), solid(1e3, 0.0, 0.0, 0.02), solid(1e6, -0.5, -1e-6, 0.02)] {
        for cell in [two_phase(hard, soft), two_phase(soft, hard), two_phase(glass(), soft)] {
            let result = homogenize(&cell).unwrap();
            assert!(result.relative_error.named().iter().all(|(_, e)| e.is_finite()), "{:?}", result.relative_error);
        }
    }
}
