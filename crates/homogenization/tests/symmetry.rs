//! Demands of the symmetry of the lattice and of the law.

use crate::common::{cells, solve};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use homogenization::Extent;

/// Hexagonal symmetry makes the plane isotropic: the shear modulus from a shear load of its own is (C11 − C12)/2.
#[test]
fn symmetry_the_plane_across_the_fibre_is_isotropic() {
    for cell in cells() {
        let (e, c) = solve(&cell, 10, Extent::Whole);
        let s = e.stiffness;
        assert_relative_eq!(s[(5, 5)], (s[(0, 0)] - s[(0, 1)]) / 2.0, max_relative = 5e-8);
        assert_relative_eq!(c.g_r, c.e_r / (2.0 * (1.0 + c.nu_r)), max_relative = 5e-8);
        assert_eq!((c.g_r, c.g_zr), (s[(5, 5)], s[(4, 4)]));
        for (i, j) in [((0, 0), (1, 1)), ((0, 2), (1, 2)), ((3, 3), (4, 4))] {
            assert_relative_eq!(s[i], s[j], max_relative = 1e-8);
        }
        assert_relative_eq!(e.conductivity[(0, 0)], e.conductivity[(1, 1)], max_relative = 1e-8);
        assert_relative_eq!(e.thermal_stress[0], e.thermal_stress[1], max_relative = 1e-8);
        assert_relative_eq!(c.m_rx, c.m_ry, max_relative = 1e-7);
        // normal and shear responses do not mix
        for i in 0..6 {
            for j in (0..6).filter(|j| (i.max(*j) > 2) && i != *j) {
                assert_abs_diff_eq!(s[(i, j)] / s[(5, 5)], 0.0, epsilon = 1e-8);
            }
        }
        assert_abs_diff_eq!(e.conductivity[(0, 1)], 0.0, epsilon = 1e-10);
    }
}

/// Betti: the stress of load i on strain j is that of load j on strain i.
#[test]
fn symmetry_reciprocity() {
    for extent in [Extent::Whole, Extent::Quarter] {
        for cell in cells() {
            let (e, c) = solve(&cell, 6, extent);
            assert!((e.stiffness - e.stiffness.transpose()).amax() < 1e-11 * e.stiffness.amax());
            assert!(e.stiffness.cholesky().is_some());
            assert_relative_eq!(c.nu_rz, c.nu_zr * c.e_r / c.e_z, max_relative = 1e-9);
            assert_relative_eq!(c.k_plane_strain, c.e_r / (2.0 * (1.0 - c.nu_r - 2.0 * c.nu_zr * c.nu_rz)), max_relative = 1e-7);
        }
    }
}

/// The quarter's mesh is the whole's, so the results agree far below their own error.
#[test]
fn symmetry_the_quarter_says_what_the_whole_says() {
    for cell in cells() {
        let [(whole, w), (quarter, q)] = [Extent::Whole, Extent::Quarter].map(|extent| solve(&cell, 5, extent));
        for ((name, w), (_, q)) in w.named().into_iter().zip(q.named()) {
            assert_relative_eq!(w, q, max_relative = 1e-8);
            assert!(w != 0.0, "{name}");
        }
        assert!((whole.stiffness - quarter.stiffness).amax() < 1e-10 * whole.stiffness.amax());
        assert!((whole.glass_strain - quarter.glass_strain).amax() < 1e-9);
        assert!(quarter.unknowns * 3 < whole.unknowns);
    }
}
