//! From a cell to its effective constants with an error beside each.

use crate::solve::CellProblem;
use crate::{Constants, Discretization, Effective, Error, FibreCell};
use rve_mesh::{Extent, Resolution};

/// A constant below this fraction of its natural scale (1 for Poisson's ratios and strains of the glass per strain, the larger
/// effective expansion for expansions and strains of the glass per K) is as good as zero, and so is its relative error.
pub const NEGLIGIBLE: f64 = 1e-6;

/// Factor on the distance to two orders higher: it covers the true error as long as two orders halve it at least.
pub const SAFETY: f64 = 2.0;

/// Effective constants with their numerical error.
#[derive(Debug, Clone, PartialEq)]
pub struct Homogenized {
    /// The constants.
    pub constants: Constants,
    /// Estimated relative error of each: [`SAFETY`] times its distance from its own value two polynomial orders higher. A constant
    /// that is nearly zero is compared with [`NEGLIGIBLE`] of its natural scale instead.
    pub relative_error: Constants,
    /// Stiffness, thermal stress, conductivity and glass strain behind the constants.
    pub effective: Effective,
    /// Unknowns of the largest system behind the constants (not of the error estimate).
    pub unknowns: usize,
}

impl Discretization {
    /// The quarter cell at order 6 with two sectors per 30° and one element across each phase: every constant of the reference
    /// cell to 1e-6.
    pub fn standard(cell: &FibreCell) -> Self {
        Self {
            order: 6,
            resolution: Resolution { sectors: 2, grading: 1.0, across: vec![1; cell.rings.len() + 1] },
            extent: Extent::Quarter,
        }
    }

    /// The same mesh two polynomial orders higher.
    pub fn refined(&self) -> Self {
        Self { order: self.order + 2, ..self.clone() }
    }
}

/// Effective response of `cell` on one discretisation.
///
/// # Errors
/// [`Error`] names the constituent or the geometry at fault, or the solve that failed.
pub fn effective(cell: &FibreCell, discretization: &Discretization) -> Result<Effective, Error> {
    CellProblem::new(cell, discretization)?.effective()
}

/// Effective constants on `discretization`, each with its estimated relative error.
///
/// # Errors
/// As [`effective`].
pub fn homogenize_on(cell: &FibreCell, discretization: &Discretization) -> Result<Homogenized, Error> {
    let effective = effective(cell, discretization)?;
    let finer = crate::effective(cell, &discretization.refined())?;
    let singular = || Error::Solve(fem_core::Error::NotPositiveDefinite { unknowns: 6, detail: "effective stiffness".into() });
    let constants = effective.constants().ok_or_else(singular)?;
    let relative_error = relative_difference(&constants, &finer.constants().ok_or_else(singular)?);
    Ok(Homogenized { constants, relative_error, unknowns: effective.unknowns, effective })
}

/// [`SAFETY`] |a − b| of each constant over |b|, or over [`NEGLIGIBLE`] of its natural scale if that is larger.
fn relative_difference(a: &Constants, b: &Constants) -> Constants {
    let expansion = b.alpha_z.abs().max(b.alpha_r.abs());
    let scale = Constants {
        nu_zr: 1.0,
        nu_r: 1.0,
        nu_rz: 1.0,
        alpha_z: expansion,
        alpha_r: expansion,
        m_rx: 1.0,
        m_ry: 1.0,
        m_rz: 1.0,
        m_rt: expansion,
        ..*b
    };
    let size = b.combine(&scale, |b, scale| b.abs().max(NEGLIGIBLE * scale.abs()));
    let difference = a.combine(b, |a, b| SAFETY * (a - b).abs());
    // 0/0 where nothing expands
    difference.combine(&size, |difference, size| if difference == 0.0 { 0.0 } else { difference / size })
}

/// Effective constants of `cell` on the standard discretisation.
///
/// # Errors
/// As [`effective`].
pub fn homogenize(cell: &FibreCell) -> Result<Homogenized, Error> {
    homogenize_on(cell, &Discretization::standard(cell))
}

/// The traction-free cell one kelvin warmer, solved on its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeCell {
    /// Mean radial strain of the glass \[1/K\].
    pub glass_strain: f64,
    /// What is left of the mean stress (xx, yy, zz), relative to the stress of the fully held cell.
    pub relative_stress: f64,
}

/// Solves the cell under `ΔT = 1 K` and the macroscopic strain that leaves no mean stress.
///
/// # Errors
/// As [`effective`].
pub fn free_cell(cell: &FibreCell, discretization: &Discretization, constants: &Constants) -> Result<FreeCell, Error> {
    let problem = CellProblem::new(cell, discretization)?;
    let (glass, stress) = problem.combined([constants.alpha_r, constants.alpha_r, constants.alpha_z])?;
    let (_, held) = problem.combined([0.0; 3])?;
    let largest = |s: [f64; 3]| s.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
    Ok(FreeCell { glass_strain: (glass[0] + glass[1]) / 2.0, relative_stress: largest(stress) / largest(held) })
}
