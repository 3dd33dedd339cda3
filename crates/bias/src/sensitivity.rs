//! Bias per temperature rate [(deg/h)/(degC/min)], the quantity of Table IV.

use crate::units::DEG_PER_H_PER_K_PER_MIN_PER_RAD_PER_K;
use crate::{Bias, Error};

/// Bias in a temperature ramp over the ramp's rate, (deg/h)/(degC/min), by cause. Osunluk et al., Table IV.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sensitivity {
    /// Thermal phase, eq. (1).
    pub shupe: f64,
    /// Axial strain, the A term of eq. (2).
    pub eo_axial: f64,
    /// Radial strain, the B term of eq. (2).
    pub eo_radial: f64,
}

impl Sensitivity {
    /// Sensitivity from the bias in a ramp of `temperature_rate` [K/s], finite and not 0.
    ///
    /// # Errors
    /// [`Error::Ramp`] if the rate is 0 or not finite.
    pub fn from_ramp(bias: &Bias, temperature_rate: f64) -> Result<Self, Error> {
        if !temperature_rate.is_finite() || temperature_rate == 0.0 {
            return Err(Error::Ramp { value: temperature_rate });
        }
        let per_rate = |part: f64| part / temperature_rate * DEG_PER_H_PER_K_PER_MIN_PER_RAD_PER_K;
        Ok(Self { shupe: per_rate(bias.shupe), eo_axial: per_rate(bias.eo_axial), eo_radial: per_rate(bias.eo_radial) })
    }

    /// The whole sensitivity, (deg/h)/(degC/min).
    pub fn total(&self) -> f64 {
        self.shupe + self.eo_axial + self.eo_radial
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::RAD_PER_S_PER_DEG_PER_H;

    #[test]
    fn three_degrees_an_hour_in_half_a_degree_a_minute() {
        let bias = Bias { shupe: 1.0, eo_axial: -2.0, eo_radial: 4.0 } * RAD_PER_S_PER_DEG_PER_H;
        let sensitivity = Sensitivity::from_ramp(&bias, 0.5 / 60.0).unwrap();
        approx::assert_relative_eq!(sensitivity.shupe, 2.0, max_relative = 1e-14);
        approx::assert_relative_eq!(sensitivity.eo_axial, -4.0, max_relative = 1e-14);
        approx::assert_relative_eq!(sensitivity.eo_radial, 8.0, max_relative = 1e-14);
        approx::assert_relative_eq!(sensitivity.total(), 6.0, max_relative = 1e-14);
    }

    #[test]
    fn no_ramp_no_sensitivity() {
        for rate in [0.0, -0.0, f64::NAN, f64::NEG_INFINITY] {
            assert!(matches!(Sensitivity::from_ramp(&Bias::ZERO, rate), Err(Error::Ramp { .. })), "{rate}");
        }
    }
}
