//! What a cell is like from outside.

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
    /// How far the stiffness is from transversely isotropic about z: the largest relative difference of strain energy, over all strains,
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
}

/// Mean of a law over all turns about z: the nearest law that is transversely isotropic (exact: eight turns integrate its harmonics).
pub(super) fn mean_over_turns(law: &ThermoElastic) -> ThermoElastic {
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
