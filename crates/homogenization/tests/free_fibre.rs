//! One coated fibre in air: against Lamé's cylinders written out, and where nothing is left to solve.

use crate::common::{glass, solid, varied};
use approx::assert_relative_eq;
use homogenization::{Constituent, Error, Ring, Role, free_fibre};
use nalgebra::{Matrix4, Vector4};

fn ring(outer_radius: f64, constituent: Constituent, role: Role) -> Ring {
    Ring { outer_radius, constituent, role }
}

/// Axial strain, u/r of the glass and u/r outside of two rings, under 1 K or a mean axial stress of 1 Pa: `u = A r` in the glass,
/// `C r + D/r` in the coating.
fn lame([inside, outside]: [Ring; 2], kelvin: f64, stress: f64) -> [f64; 3] {
    let constants = |r: &Ring| {
        let elastic = r.constituent.elastic;
        let (l, g) = (elastic.lame_lambda(), elastic.shear_modulus());
        (l, g, (3.0 * l + 2.0 * g) * elastic.thermal_expansion * kelvin)
    };
    let ((l1, g1, t1), (l2, g2, t2)) = (constants(&inside), constants(&outside));
    let (a, b) = (inside.outer_radius.powi(2), outside.outer_radius.powi(2));
    // unknowns A, C, D and the axial strain; D in units of a
    let rows = Matrix4::from_row_slice(
        &[
            [1.0, -1.0, -1.0, 0.0],
            [2.0 * (l1 + g1), -2.0 * (l2 + g2), 2.0 * g2, l1 - l2],
            [0.0, 2.0 * (l2 + g2), -2.0 * g2 * a / b, l2],
            [2.0 * l1 * a, 2.0 * l2 * (b - a), 0.0, (l1 + 2.0 * g1) * a + (l2 + 2.0 * g2) * (b - a)],
        ]
        .concat(),
    );
    let [at_glass, c, d, axial] =
        rows.lu().solve(&Vector4::new(0.0, t1 - t2, t2, t1 * a + t2 * (b - a) + stress * b)).expect("regular").into();
    [axial, at_glass, c + d * a / b]
}

#[test]
fn exact_two_rings_are_lames() {
    for coating in [solid(1.2e9, 0.40, 80e-6, 0.2), solid(2e6, 0.4998, 250e-6, 0.15), solid(200e9, 0.3, 12e-6, 15.0)] {
        let rings = [ring(62.5e-6, glass(), Role::Glass), ring(122.5e-6, coating, Role::Coating)];
        let found = free_fibre(&rings).unwrap();
        let ([axial, at_glass, outside], [pulled, glass_pulled, _]) = (lame(rings, 1.0, 0.0), lame(rings, 0.0, 1.0));
        assert_relative_eq!(found.expansion, axial, max_relative = 1e-9);
        assert_relative_eq!(found.glass_radial_strain, at_glass, max_relative = 1e-9);
        assert_relative_eq!(found.expansion_across, outside, max_relative = 1e-9);
        assert_relative_eq!(found.youngs_modulus, 1.0 / pulled, max_relative = 1e-9);
        assert_relative_eq!(found.glass_radial_strain_per_axial, glass_pulled / pulled, max_relative = 1e-9);
    }
}

#[test]
fn exact_one_solid_in_any_rings_is_a_rod_of_it() {
    let rings = [ring(4e-6, glass(), Role::Glass), ring(62.5e-6, glass(), Role::Glass), ring(80e-6, glass(), Role::Coating)];
    for rings in [&rings[..1], &rings[..2], &rings] {
        let found = free_fibre(rings).unwrap();
        assert_relative_eq!(found.youngs_modulus, 70.2e9, max_relative = 1e-12);
        for expansion in [found.expansion, found.expansion_across, found.glass_radial_strain] {
            assert_relative_eq!(expansion, 0.55e-6, max_relative = 1e-10);
        }
        assert_relative_eq!(found.glass_radial_strain_per_axial, -0.17, max_relative = 1e-12);
    }
}

/// A ring in two halves is the same ring.
#[test]
fn symmetry_a_ring_may_be_divided() {
    let rings = varied()[2].rings.clone();
    let mut divided = rings.clone();
    divided.insert(3, ring(200e-6 / 2.0, rings[3].constituent, Role::Coating));
    let (whole, divided) = (free_fibre(&rings).unwrap(), free_fibre(&divided).unwrap());
    assert_relative_eq!(whole.expansion, divided.expansion, max_relative = 1e-10);
    assert_relative_eq!(whole.glass_radial_strain, divided.glass_radial_strain, max_relative = 1e-10);
    assert_relative_eq!(whole.youngs_modulus, divided.youngs_modulus, max_relative = 1e-10);
}

#[test]
fn bounds_no_fibre_is_refused() {
    let said = |rings: &[Ring]| free_fibre(rings).unwrap_err().to_string();
    assert!(said(&[]).contains("at least one ring"));
    assert!(
        said(&[ring(62.5e-6, glass(), Role::Glass), ring(50e-6, glass(), Role::Coating)]).starts_with("ring 1: outer radius")
    );
    assert!(said(&[ring(f64::NAN, glass(), Role::Glass)]).starts_with("ring 0: outer radius NaN"));
    assert!(said(&[ring(1e-6, solid(-1.0, 0.2, 0.0, 1.0), Role::Glass)]).starts_with("ring 0 (glass): youngs_modulus = -1"));
    assert_eq!(free_fibre(&[ring(1e-6, glass(), Role::Coating)]), Err(Error::NoGlass));
}
