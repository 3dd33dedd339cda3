//! Exact relations of composites.

use crate::common::{cells, glass, reference, solid, solve, two_phase};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use homogenization::{Constituent, Discretization, Extent, FibreCell, free_cell, homogenize};
use nalgebra::{Matrix6, Vector6};

/// Order of the tests that compare two numerical results with each other.
const ORDER: usize = 10;

fn law(c: &Constituent) -> fem_core::material::ThermoElastic {
    c.elastic.law().expect("a valid solid")
}

/// Area fractions of fibre and matrix of [`two_phase`].
fn fractions(cell: &FibreCell) -> [f64; 2] {
    let fibre = std::f64::consts::PI * cell.rings[0].outer_radius.powi(2) / (cell.pitch * cell.pitch * 0.75_f64.sqrt());
    [fibre, 1.0 - fibre]
}

fn pairs() -> [[Constituent; 2]; 3] {
    let epoxy = solid(3e9, 0.38, 60e-6, 0.2);
    [
        [glass(), epoxy],
        [glass(), solid(5.593e6, 0.49985, 250e-6, 0.45)],
        [solid(1e9, 0.1, 90e-6, 0.1), solid(40e9, 0.3, 5e-6, 30.0)],
    ]
}

#[test]
fn exact_cell_of_one_material_is_that_material() {
    let m = solid(870e6, 0.4118, 102.75e-6, 0.30);
    let mut cell = reference();
    cell.adhesive = m;
    cell.rings.iter_mut().for_each(|r| r.constituent = m);
    for extent in [Extent::Whole, Extent::Quarter] {
        let (effective, c) = solve(&cell, 6, extent);
        let expected = law(&m);
        assert!((effective.stiffness - expected.stiffness).amax() < 1e-10 * expected.stiffness.amax());
        assert!((effective.thermal_stress - expected.thermal_stress).amax() < 1e-10 * expected.thermal_stress.amax());
        let (e, nu, alpha, g) = (870e6, 0.4118, 102.75e-6, m.elastic.shear_modulus());
        let relations = [(c.e_z, e), (c.e_r, e), (c.g_zr, g), (c.g_r, g), (c.nu_zr, nu), (c.nu_r, nu), (c.nu_rz, nu)];
        for (found, exact) in relations.into_iter().chain([(c.alpha_z, alpha), (c.alpha_r, alpha), (c.k_z, 0.3), (c.k_r, 0.3)]) {
            assert_relative_eq!(found, exact, max_relative = 1e-10);
        }
        // the glass follows the whole; ε_r is the mean of xx and yy
        for (found, exact) in [(c.m_rx, 0.5), (c.m_ry, 0.5), (c.m_rz, 0.0)] {
            assert_abs_diff_eq!(found, exact, epsilon = 1e-10);
        }
        assert_abs_diff_eq!(c.m_rt / alpha, 0.0, epsilon = 1e-10);
    }
    // constants that vanish have no relative error to speak of
    let result = homogenize(&cell).unwrap();
    assert!(result.relative_error.named().iter().all(|(_, e)| *e < 1e-6), "{:?}", result.relative_error);
}

/// Hill (1964): with k the plane-strain bulk moduli and q = (ν₁ − ν₂)/(1/k₁ − 1/k₂), d = f₁/k₁ + f₂/k₂ − 1/k,
/// E_z = f₁E₁ + f₂E₂ + 4q²d and ν_zr = f₁ν₁ + f₂ν₂ − q d, whatever the shape of the fibre.
#[test]
fn exact_hill_relations_of_two_phases() {
    let mut corrections = Vec::new();
    for [one, two] in pairs() {
        let cell = two_phase(one, two);
        let (c, f) = (solve(&cell, ORDER, Extent::Quarter).1, fractions(&cell));
        let bulk = |c: &Constituent| c.elastic.lame_lambda() + c.elastic.shear_modulus();
        let (k, nu) = ([bulk(&one), bulk(&two)], [one.elastic.poisson_ratio, two.elastic.poisson_ratio]);
        let q = (nu[0] - nu[1]) / (1.0 / k[0] - 1.0 / k[1]);
        let d = f[0] / k[0] + f[1] / k[1] - 1.0 / c.k_plane_strain;
        let mixture = f[0] * one.elastic.youngs_modulus + f[1] * two.elastic.youngs_modulus;
        assert_relative_eq!(c.e_z, mixture + 4.0 * q * q * d, max_relative = 1e-8);
        assert_relative_eq!(c.nu_zr, f[0] * nu[0] + f[1] * nu[1] - q * d, max_relative = 1e-8);
        corrections.push(c.e_z / mixture - 1.0);
    }
    assert!(corrections.iter().filter(|c| **c > 1e-4).count() == 2, "the correction must be visible: {corrections:?}");
}

/// Levin (1967) for two isotropic phases: α = ⟨α⟩ + (α₁ − α₂)/(1/3K₁ − 1/3K₂) (S̄ − ⟨S⟩) 1 with the compliances S, S_i 1 = 1/3K_i.
#[test]
fn exact_levin_relation_of_two_phases() {
    for [one, two] in pairs() {
        let cell = two_phase(one, two);
        let ((effective, c), f) = (solve(&cell, ORDER, Extent::Quarter), fractions(&cell));
        let pressure = Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0);
        let shrinkage = |c: &Constituent| (1.0 - 2.0 * c.elastic.poisson_ratio) / c.elastic.youngs_modulus; // 1/3K
        let (s, alpha) = ([shrinkage(&one), shrinkage(&two)], [one.elastic.thermal_expansion, two.elastic.thermal_expansion]);
        let whole = effective.stiffness.try_inverse().unwrap() * pressure;
        let mean = |v: [f64; 2]| f[0] * v[0] + f[1] * v[1];
        let levin = |row: usize| mean(alpha) + (alpha[0] - alpha[1]) / (s[0] - s[1]) * (whole[row] - mean(s));
        assert_relative_eq!(c.alpha_r, levin(0), max_relative = 1e-8);
        assert_relative_eq!(c.alpha_z, levin(2), max_relative = 1e-8);
    }
}

/// With two phases the means of stress and strain are two equations for the two phase strains:
/// f₁ (C₁ − C₂) ⟨ε⟩₁ = (C̄ − C₂) ε̄ under strain and (⟨β⟩ − β̄) ΔT under heat.
#[test]
fn exact_strain_of_the_glass_in_two_phases() {
    for [one, two] in pairs() {
        let cell = two_phase(one, two);
        let ((effective, c), f) = (solve(&cell, ORDER, Extent::Quarter), fractions(&cell));
        let (c1, c2) = (law(&one), law(&two));
        let inverse: Matrix6<f64> = (c1.stiffness - c2.stiffness).try_inverse().unwrap() / f[0];
        let strain = inverse * (effective.stiffness - c2.stiffness);
        let heat = inverse * (c1.thermal_stress * f[0] + c2.thermal_stress * f[1] - effective.thermal_stress);
        let radial = |column: usize| (strain[(0, column)] + strain[(1, column)]) / 2.0;
        assert_relative_eq!(c.m_rx, radial(0), max_relative = 1e-7);
        assert_relative_eq!(c.m_ry, radial(1), max_relative = 1e-7);
        assert_relative_eq!(c.m_rz, radial(2), max_relative = 1e-7);
        assert_relative_eq!(c.m_rt, (heat[0] + heat[1]) / 2.0, max_relative = 1e-7);
        for (row, voigt) in [(0, 0), (1, 1), (2, 5)] {
            for (load, column) in [(0, 0), (1, 1), (2, 2), (3, 5)] {
                assert_abs_diff_eq!(effective.glass_strain[(row, load)], strain[(voigt, column)], epsilon = 1e-7);
            }
        }
    }
}

/// Keller (1964): interchanging the phases of a plane composite turns k_r/k₁ into k₂/k_r. So it is for shear along the fibre.
#[test]
fn exact_keller_duality_of_conduction_and_of_shear() {
    for [one, two] in pairs() {
        let [there, back] = [two_phase(one, two), two_phase(two, one)].map(|cell| solve(&cell, ORDER, Extent::Quarter).1);
        assert_relative_eq!(there.k_r * back.k_r, one.conductivity * two.conductivity, max_relative = 1e-8);
        let shear = one.elastic.shear_modulus() * two.elastic.shear_modulus();
        assert_relative_eq!(there.g_zr * back.g_zr, shear, max_relative = 1e-8);
    }
}

/// Perrins, McKenzie and McPhedran, Proc. R. Soc. A 369, 207 (1979), eq. for the hexagonal array, coefficients of six digits.
#[test]
fn exact_conductivity_of_a_hexagonal_array_as_published() {
    for ratio in [0.1, 5.0, 100.0] {
        let cell = two_phase(solid(1e9, 0.3, 0.0, ratio), solid(1e9, 0.3, 0.0, 1.0));
        let (f, t) = (fractions(&cell)[0], (1.0 + ratio) / (1.0 - ratio));
        let published =
            1.0 - 2.0 * f / (t + f - 0.075422 * f.powi(6) * t / (t * t - 1.060283 * f.powi(12)) - 0.000076 * f.powi(12) / t);
        assert_relative_eq!(solve(&cell, ORDER, Extent::Quarter).1.k_r, published, max_relative = 2e-6);
    }
}

/// In the traction-free cell the macroscopic strain is ᾱ, so the row M applied to it must give the strain of the glass there.
#[test]
fn exact_free_cell_closes_the_row_of_the_glass() {
    for cell in cells() {
        for extent in [Extent::Quarter, Extent::Whole] {
            let d = Discretization { extent, ..Discretization::standard(&cell) };
            let c = homogenization::effective(&cell, &d).unwrap().constants().unwrap();
            let free = free_cell(&cell, &d, &c).unwrap();
            assert!(free.relative_stress < 1e-9, "residual stress {:e}", free.relative_stress);
            let held = free.glass_strain - (c.m_rx + c.m_ry) * c.alpha_r - c.m_rz * c.alpha_z;
            assert_relative_eq!(c.m_rt, held, max_relative = 1e-8);
        }
    }
}

/// ... and with other expansions the free cell is not free.
#[test]
fn exact_free_cell_of_wrong_expansion_keeps_a_stress() {
    let (cell, c) = (reference(), solve(&reference(), 6, Extent::Quarter).1);
    let wrong = homogenization::Constants { alpha_r: c.alpha_r * 1.001, ..c };
    let free = free_cell(&cell, &Discretization::standard(&cell), &wrong).unwrap();
    assert!(free.relative_stress > 1e-4, "{:e}", free.relative_stress);
}
