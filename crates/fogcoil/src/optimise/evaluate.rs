//! One design: its numbers, and by how much it leaves the limits.

use coil::{Design, STEADY, sensitivity_band, sensitivity_on};
use winding::wind;

use super::measure::{Measure, Measures};
use super::plan::Plan;
use crate::sweep::mass;
use crate::variants::Value;

/// A design that was tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    /// Coordinates from 0 to 1.
    pub point: Vec<f64>,
    /// Values of the varied keys, in the units of the keys.
    pub values: Vec<Option<Value>>,
    /// Its numbers.
    pub measures: Measures,
    /// Sum of the relative excesses over the limits; 0 where it keeps them.
    pub violation: f64,
}

impl Plan {
    /// The design at a point of the unit cube.
    ///
    /// # Errors
    /// Why there is none, or why it cannot be computed.
    pub(super) fn tried(&self, point: &[f64]) -> Result<Tried, String> {
        let variant = self.variants.at(point)?;
        let measures = self.measures(&variant.design).map_err(|error| error.to_string())?;
        Ok(Tried { point: point.to_vec(), values: variant.values, measures, violation: self.violation(&measures) })
    }

    /// The numbers of a design.
    ///
    /// # Errors
    /// [`coil::Error`] names what keeps it from being computed.
    pub(super) fn measures(&self, design: &Design) -> Result<Measures, coil::Error> {
        let spread =
            if self.asks(Measure::needs_tolerances) { sensitivity_band(design, &self.variants.case.tolerances)?.sd } else { 0.0 };
        let sensitivity = sensitivity_on(design, &STEADY)?.total();
        Ok(Measures { sensitivity, spread, mass: mass(design)?, length: wind(&design.winding)?.length() })
    }

    fn violation(&self, measures: &Measures) -> f64 {
        let beyond = |(measure, [low, high]): &(Measure, [f64; 2])| {
            let value = measure.of(measures);
            let scale =
                if low.is_finite() && high.is_finite() { high - low } else { 0.0 }.max(value.abs()).max(f64::MIN_POSITIVE);
            (low - value).max(value - high).max(0.0) / scale
        };
        self.limits.iter().map(beyond).sum()
    }
}
