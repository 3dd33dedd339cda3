//! A number with its error.

use crate::statistics::normal_quantile;

/// A number and its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard deviation.
    pub sd: f64,
}

impl Estimate {
    /// The ends of the two-sided 90 % interval of a normal variable.
    pub fn ci90(&self) -> [f64; 2] {
        let half = normal_quantile(0.95) * self.sd;
        [self.value - half, self.value + half]
    }

    /// Number and standard deviation times a factor.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, sd: self.sd * factor.abs() }
    }
}

/// Standard deviations from which a difference counts: noise alone makes it in one record of a hundred.
const SIGNIFICANT: f64 = 2.576;

impl Estimate {
    /// Whether it differs from another by more than the errors of both.
    pub(super) fn differs(self, other: Self) -> bool {
        (self.value - other.value).abs() > SIGNIFICANT * self.sd.hypot(other.sd)
    }

    /// Of a mixture: probabilities that add up to 1, each with value and standard deviation.
    pub(super) fn mixed(each: &[(f64, f64, f64)]) -> Self {
        let value = each.iter().map(|(p, value, _)| p * value).sum::<f64>();
        // within the models and between them
        let variance: f64 = each.iter().map(|(p, v, sd)| p * (sd * sd + (v - value).powi(2))).sum();
        Self { value, sd: variance.sqrt() }
    }
}
