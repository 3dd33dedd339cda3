//! Macroscopic response of a cell; its engineering constants, which need not be isotropic across the fibre.

use crate::{Constants, NEGLIGIBLE, SAFETY};
use fem_core::material::ThermoElastic;
use nalgebra::{Matrix2, Matrix6, SMatrix, Vector6};
use std::f64::consts::TAU;

/// Loads of a cell: the macroscopic strains xx, yy, zz, yz, xz, xy, and one kelvin.
pub const LOADS: usize = 7;
/// The load of one kelvin at no macroscopic strain.
pub const TEMPERATURE: usize = 6;

/// Effective response of a cell: macroscopic stress `C ε − β ΔT`, heat flux `−k ∇T`, and the mean strain of each phase.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// Stiffness \[Pa\], Voigt order xx, yy, zz, yz, xz, xy, z = fibre.
    pub stiffness: Matrix6<f64>,
    /// Thermal stress vector \[Pa/K\].
    pub thermal_stress: Vector6<f64>,
    /// Conductivity across the fibre \[W/(m K)\].
    pub conductivity: Matrix2<f64>,
    /// Conductivity along the fibre \[W/(m K)\].
    pub conductivity_z: f64,
    /// Mean strain of each phase (rows in Voigt order) per unit macroscopic strain, and per K at zero macroscopic strain.
    pub phase_strain: Vec<SMatrix<f64, 6, LOADS>>,
    /// Mean strain of all glass.
    pub glass_strain: SMatrix<f64, 6, LOADS>,
    /// Share of each phase in the cell's area; what is missing to 1 is void.
    pub fractions: Vec<f64>,
    /// Distance of the stiffness from transverse isotropy about z: the largest relative difference of strain energy, over all strains,
    /// from the mean of the stiffness over all turns about z. The same in any units and for any choice of x.
    pub anisotropy: f64,
    /// Largest relative difference of a phase's meshed and exact area.
    pub area_error: f64,
    /// Unknowns of the in-plane problem (its largest system).
    pub unknowns: usize,
}

impl Response {
    /// Effective law.
    pub fn law(&self) -> ThermoElastic {
        ThermoElastic { stiffness: self.stiffness, thermal_stress: self.thermal_stress }
    }

    /// Engineering constants; `None` if the stiffness is singular.
    pub fn constants(&self) -> Option<Directional> {
        let compliance = self.stiffness.try_inverse()?;
        let alpha = compliance * self.thermal_stress;
        let contraction = |of: usize, per: usize| -compliance[(of, per)] / compliance[(per, per)];
        let c = &self.stiffness;
        Some(Directional {
            e: [0, 1, 2].map(|i| 1.0 / compliance[(i, i)]),
            g: [3, 4, 5].map(|i| 1.0 / compliance[(i, i)]),
            nu: [contraction(0, 2), contraction(1, 2), contraction(1, 0)],
            alpha: [alpha[0], alpha[1], alpha[2], alpha[5]],
            k: [self.conductivity[(0, 0)], self.conductivity[(1, 1)], self.conductivity_z, self.conductivity[(0, 1)]],
            k_plane_strain: (c[(0, 0)] + c[(1, 1)] + 2.0 * c[(0, 1)]) / 4.0,
            m: [0, 1, 2, 5, TEMPERATURE].map(|load| self.glass_radial(load)),
        })
    }

    /// The nearest transversely isotropic constants and row M, for a coil: those of the mean over all turns about z. `None` if that is
    /// singular.
    pub fn transversely_isotropic(&self) -> Option<Constants> {
        // (xx + yy)/2 is the same in any axes: turning the cell only mixes what xx and yy do to it
        let [m_x, m_y, m_rz, m_rt] = [0, 1, 2, TEMPERATURE].map(|load| self.glass_radial(load));
        let m_r = f64::midpoint(m_x, m_y);
        let conductivities = [self.conductivity_z, self.conductivity.trace() / 2.0];
        Constants::read(&mean_over_turns(&self.law()), conductivities, [m_r, m_r, m_rz, m_rt])
    }

    /// Mean radial strain (xx + yy)/2 of the glass under a unit load.
    fn glass_radial(&self, load: usize) -> f64 {
        f64::midpoint(self.glass_strain[(0, load)], self.glass_strain[(1, load)])
    }
}

/// Engineering constants along x, y, z (z = fibre). SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Directional {
    /// Young's moduli along x, y, z \[Pa\].
    pub e: [f64; 3],
    /// Shear moduli of the planes yz, xz, xy \[Pa\].
    pub g: [f64; 3],
    /// Poisson's ratios zx, zy, xy: contraction along the second per extension along the first.
    pub nu: [f64; 3],
    /// Expansions along x, y, z and the shear xy \[1/K\].
    pub alpha: [f64; 4],
    /// Conductivities xx, yy, zz, xy \[W/(m K)\].
    pub k: [f64; 4],
    /// Plane-strain bulk modulus, mean of C11, C22 and 2 C12 over two \[Pa\].
    pub k_plane_strain: f64,
    /// Mean radial strain (xx + yy)/2 of the glass per macroscopic xx, yy, zz, xy, and per K \[1/K\].
    pub m: [f64; 5],
}

#[rustfmt::skip]
const NAMES: [&str; 23] = [
    "e_x", "e_y", "e_z", "g_yz", "g_xz", "g_xy", "nu_zx", "nu_zy", "nu_xy", "alpha_x", "alpha_y", "alpha_z", "alpha_xy",
    "k_x", "k_y", "k_z", "k_xy", "k_plane_strain", "m_rx", "m_ry", "m_rz", "m_rxy", "m_rt",
];

impl Directional {
    /// Names (as in the JSON output) and values.
    pub fn named(&self) -> Vec<(&'static str, f64)> {
        NAMES.into_iter().zip(self.values()).collect()
    }

    /// [`SAFETY`] times the distance of each constant from its value `before`, over itself, or over its floor if that is larger.
    pub(super) fn differences(&self, before: &Self) -> Vec<(&'static str, f64)> {
        let error = |((a, b), floor): ((f64, f64), f64)| match SAFETY * (a - b).abs() {
            0.0 => 0.0,
            difference => difference / a.abs().max(floor),
        };
        NAMES.into_iter().zip(self.values().into_iter().zip(before.values()).zip(self.floors()).map(error)).collect()
    }

    fn values(&self) -> Vec<f64> {
        let Self { e, g, nu, alpha, k, k_plane_strain, m } = self;
        [&e[..], g, nu, alpha, k, &[*k_plane_strain], m].concat()
    }

    /// Least reference of each relative error: [`NEGLIGIBLE`] of the natural size of its kind, all of it for those that vanish in
    /// cells of some symmetry.
    fn floors(&self) -> Vec<f64> {
        let largest = |v: &[f64]| v.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let (alpha, k) = (largest(&self.alpha), largest(&self.k));
        let size = |(name, value): (&str, f64)| match name {
            "alpha_xy" => alpha,
            "k_xy" => k,
            "m_rxy" => 1.0,
            _ if name.starts_with("alpha") || name == "m_rt" => NEGLIGIBLE * alpha,
            _ if name.starts_with("nu") || name.starts_with("m_") => NEGLIGIBLE,
            _ => NEGLIGIBLE * value.abs(),
        };
        self.named().into_iter().map(size).collect()
    }
}

/// Mean of a law over all turns about z: the nearest law that is transversely isotropic (exact: eight turns integrate its harmonics).
fn mean_over_turns(law: &ThermoElastic) -> ThermoElastic {
    let turns = (0..8).map(|k| law.turned(TAU * f64::from(k) / 8.0));
    let zero = ThermoElastic { stiffness: Matrix6::zeros(), thermal_stress: Vector6::zeros() };
    turns.fold(zero, |sum, law| ThermoElastic {
        stiffness: sum.stiffness + law.stiffness / 8.0,
        thermal_stress: sum.thermal_stress + law.thermal_stress / 8.0,
    })
}

/// Largest |λ − 1| of `C x = λ C̄ x` with C̄ the mean over all turns; 1 if that is not positive definite.
pub(super) fn anisotropy(stiffness: &Matrix6<f64>) -> f64 {
    let mean = mean_over_turns(&ThermoElastic { stiffness: *stiffness, thermal_stress: Vector6::zeros() }).stiffness;
    let Some(lower) = mean.cholesky().map(|c| c.l()) else { return 1.0 };
    let Some(inverse) = lower.try_inverse() else { return 1.0 };
    let relative = inverse * (stiffness - mean) * inverse.transpose();
    ((relative + relative.transpose()) / 2.0).symmetric_eigenvalues().amax()
}
