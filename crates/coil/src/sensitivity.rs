//! Steady-ramp sensitivity with its own numerical error.

use crate::{Design, Error, Model, Resolution};
use bias::Sensitivity;

/// The mesh behind the reported value.
pub const COARSE: Resolution = Resolution { order: 6, layers: 3, ratio: 0.2 };
/// The mesh that measures its error: two orders and one layer finer, with about a fifteenth of the error.
pub const FINE: Resolution = Resolution { order: 8, layers: 4, ratio: 0.2 };
/// The distance between the two meshes is nearly all of the coarse one's error; the factor covers the rest.
pub const SAFETY: f64 = 2.0;

/// Bias of a coil whose temperature rises everywhere at the same rate, per unit rate.
///
/// In such a ramp the temperature rate is uniform, so no thermal property matters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadySensitivity {
    /// By part, in (°/h)/(°C/min).
    pub sensitivity: Sensitivity,
    /// Estimated error of each part's value, in the same unit.
    pub part_errors: Sensitivity,
    /// Estimated error of the total, in the same unit.
    pub error_estimate: f64,
    /// Fibre length with tails \[m\].
    pub length: f64,
    /// Unknowns of the mesh behind the value.
    pub unknowns: usize,
    /// Unknowns of the mesh behind the error estimate.
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

/// Steady-ramp sensitivity of `design` on [`COARSE`], its error measured on [`FINE`].
///
/// # Errors
/// [`Error`] names the dimension, property, winding or optical constant at fault, or the solve that failed.
pub fn steady_sensitivity(design: &Design) -> Result<SteadySensitivity, Error> {
    let (coarse, fine) = (Model::new(design, &COARSE)?, Model::new(design, &FINE)?);
    let (value, finer) = (coarse.sensitivity()?, fine.sensitivity()?);
    let error = |a: f64, b: f64| SAFETY * (a - b).abs();
    Ok(SteadySensitivity {
        sensitivity: value,
        part_errors: Sensitivity {
            shupe: error(value.shupe, finer.shupe),
            eo_axial: error(value.eo_axial, finer.eo_axial),
            eo_radial: error(value.eo_radial, finer.eo_radial),
        },
        error_estimate: error(value.total(), finer.total()),
        length: coarse.winding().length(),
        unknowns: coarse.unknowns(),
        unknowns_of_estimate: fine.unknowns(),
    })
}
