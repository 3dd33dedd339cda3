//! Steady-ramp sensitivity with its own numerical error.

use crate::grid::Grading;
use crate::{Design, Error, MechanicalState, MeshFineness, Model};
use bias::Sensitivity;

/// The mesh behind trims, comparisons of designs and [`crate::STANDARD`].
pub const COARSE: MeshFineness = MeshFineness { order: 6, layers: 3, ratio: 0.2 };
/// A mesh two orders and one layer finer, with about a fifteenth of the error.
pub const FINE: MeshFineness = MeshFineness { order: 8, layers: 4, ratio: 0.2 };
/// The distance between the two meshes is nearly all of the coarse one's error; the factor covers the rest.
pub const SAFETY: f64 = 2.0;
/// The mesh behind a [`SteadySensitivity`], graded as the coil's strain needs it.
pub const STEADY: MeshFineness = MeshFineness { order: 7, layers: 2, ratio: 0.15 };
/// The meshes that measure its error: of lower orders, and graded in other steps.
pub const CHECKS: [MeshFineness; 3] = [
    MeshFineness { order: 5, ..STEADY },
    MeshFineness { order: 5, layers: 3, ratio: 0.2 },
    MeshFineness { order: 6, layers: 3, ratio: 0.2 },
];
/// Factor on the largest distance to the [`CHECKS`], both elasto-optic parts together, that is stated as the error. It covers the total and the parts of 1070
/// designs of `cargo xtask survey` (seeds 1, 2, 3, 5, 7 and 8) with a margin of 1.3 in the worst ones; in the median it is eleven times the error.
pub const FACTOR: f64 = 1.75;
/// Least error that is stated, relative to the sum of the parts' magnitudes: rounding. Up to 2.5e-5 in those designs, in coils of a layer or a few,
/// whose meshes of any order agree less well than they converge.
const LEAST: f64 = 4e-5;

/// Bias of a coil whose temperature rises everywhere at the same rate, per unit rate.
///
/// In such a ramp the temperature rate is uniform, so no thermal property matters.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SteadySensitivity {
    /// By part, in (°/h)/(°C/min).
    pub sensitivity: Sensitivity,
    /// Estimated error of each part's value, in the same unit; one bound stands for both elasto-optic parts.
    pub part_errors: Sensitivity,
    /// Estimated error of the total, in the same unit.
    pub error_estimate: f64,
    /// Fibre length with tails \[m\].
    pub length: f64,
    /// Unknowns of the mesh behind the value.
    pub unknowns: usize,
    /// Unknowns of the meshes behind the error estimate, together.
    pub unknowns_of_estimate: usize,
}

impl Model {
    /// Steady-ramp sensitivity on this model's mesh, by adjoint.
    ///
    /// # Errors
    /// [`Error::Solve`] if a solve leaves a residual.
    pub fn sensitivity(&self) -> Result<Sensitivity, Error> {
        Ok(Sensitivity::from_ramp(&self.bias_in_ramp()?, 1.0)?)
    }
}

/// Steady-ramp sensitivity of `design` in a mechanical state, on the mesh of [`steady_sensitivity`], whose error is of this value too.
///
/// # Errors
/// As [`steady_sensitivity`].
pub fn sensitivity_in(design: &Design, state: &MechanicalState) -> Result<Sensitivity, Error> {
    Model::graded(design, &STEADY, Grading::Strain, state)?.sensitivity()
}

/// Steady-ramp sensitivity of `design` on a mesh that is graded like [`STEADY`]: to see how far a finer one leads.
///
/// # Errors
/// As [`steady_sensitivity`].
pub fn sensitivity_on(design: &Design, mesh: &MeshFineness) -> Result<Sensitivity, Error> {
    Model::graded(design, mesh, Grading::Strain, &MechanicalState::NOMINAL)?.sensitivity()
}

/// Steady-ramp sensitivity of `design` on [`STEADY`], its error measured by [`CHECKS`].
///
/// # Errors
/// [`Error`] names the dimension, property, winding or optical constant at fault, or the solve that failed.
pub fn steady_sensitivity(design: &Design) -> Result<SteadySensitivity, Error> {
    let model = |resolution| Model::graded(design, resolution, Grading::Strain, &MechanicalState::NOMINAL);
    let steady = model(&STEADY)?;
    let value = steady.sensitivity()?;
    let (mut distance, mut shupe, mut unknowns_of_estimate) = (0.0_f64, 0.0_f64, 0);
    for resolution in &CHECKS {
        let check = model(resolution)?;
        let other = check.sensitivity()?;
        // part by part: their errors may cancel in the total of one mesh and not of another
        let apart = (value.eo_axial - other.eo_axial).abs() + (value.eo_radial - other.eo_radial).abs();
        (distance, shupe) = (apart.max(distance), (value.shupe - other.shupe).abs().max(shupe));
        unknowns_of_estimate += check.unknowns();
    }
    let error = FACTOR * distance + LEAST * (value.eo_axial.abs() + value.eo_radial.abs());
    Ok(SteadySensitivity {
        sensitivity: value,
        part_errors: Sensitivity { shupe: FACTOR * shupe, eo_axial: error, eo_radial: error },
        error_estimate: error,
        length: steady.winding().length(),
        unknowns: steady.unknowns(),
        unknowns_of_estimate,
    })
}
