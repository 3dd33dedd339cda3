//! The design's own sensitivity beside the measured one.

use coil::{Band, SteadySensitivity};
use recording::statistics::normal_quantile;

use super::{Figure, Measurement};

/// Prediction of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Name of the design.
    pub design: String,
    /// Its steady sensitivity, with what its tolerances and the numerical error make of it \[(deg/h)/(degC/min)\].
    pub sensitivity: Figure,
    sd: f64,
}

impl Prediction {
    /// Prediction of a design.
    pub fn of(design: &str, steady: &SteadySensitivity, band: &Band) -> Self {
        let (value, sd) = (steady.sensitivity.total(), band.sd.hypot(steady.error_estimate));
        let half = normal_quantile(0.95) * sd;
        Self { design: design.to_owned(), sensitivity: Figure { value, ci90: [value - half, value + half] }, sd }
    }

    /// Measured less predicted, in standard deviations of both together; `None` where nothing was measured.
    pub fn sigmas(&self, measured: &Measurement) -> Option<f64> {
        let Figure { value, ci90: [low, high] } = *measured.sensitivity.as_ref().ok()?;
        let sd = (high - low) / (2.0 * normal_quantile(0.95));
        Some((value - self.sensitivity.value) / sd.hypot(self.sd))
    }
}
