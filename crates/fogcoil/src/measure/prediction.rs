//! The design's own sensitivity beside the measured one.

use coil::{Band, SteadySensitivity};
use files::{Note, Remark};
use recording::statistics::normal_quantile;

use super::{Figure, Measurement};
use crate::input::RATE;
use crate::rate_unit::{how_far, suspected};
use crate::table::significant;

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

    /// The warning that a sensitivity which is not the predicted one is, in another unit of the rate.
    pub fn other_unit(&self, measured: &Measurement) -> Option<Note> {
        let Figure { value, ci90: [low, high] } = *measured.sensitivity.as_ref().ok()?;
        let sd = (high - low) / (2.0 * normal_quantile(0.95));
        let off = |scale: f64| (scale * value - self.sensitivity.value).abs() / (scale * sd).hypot(self.sd);
        // neither is told from none, of which any unit makes the other
        let is_told = value.abs() > MOST * sd && self.sensitivity.value.abs() > MOST * self.sd;
        let is_alike = |scale: f64| ALIKE.contains(&(scale * value / self.sensitivity.value));
        let agrees = |scale: f64| is_alike(scale) && off(scale) < MOST;
        let unit = suspected(&measured.rate_units, agrees).filter(|_| is_told && off(1.0) > MOST)?;
        let (name, how) = (&unit.name, how_far(unit.scale));
        let text = format!(
            "{RATE} seems to be in {name}: its sensitivity is {how} for {}, and in {name} {}; give --unit rate={name}, or unit in the map file",
            self.design,
            significant(unit.scale * value, 3)
        );
        Some(Remark::RateUnit.warning(text).at(&measured.fingerprint.file))
    }
}

/// Ratios of a measured sensitivity in another unit to the predicted one at which that unit may be the right one: a wide prediction agrees with much.
const ALIKE: std::ops::Range<f64> = 0.5..2.0;
/// Standard deviations from which a measured sensitivity is not the predicted one.
const MOST: f64 = 3.0;
