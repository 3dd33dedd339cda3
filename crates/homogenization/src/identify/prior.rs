//! Prior distribution of a constant, before the measurement.

/// Standard deviations between a normal distribution's median and its 95 % quantile.
pub const Z95: f64 = 1.644_853_626_951_472_7;

/// A range that holds 90 % of what is expected, 5 % below and 5 % above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// Distribution within and beyond the range.
    pub scale: Scale,
    /// 5 % quantile; positive on a logarithmic scale.
    pub low: f64,
    /// 95 % quantile, greater than `low`.
    pub high: f64,
}

/// Scale on which a prior is normal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Log-normal.
    Logarithmic,
    /// Normal.
    Linear,
}

impl Prior {
    /// Log-normal with 90 % between `low` and `high`.
    pub const fn log(low: f64, high: f64) -> Self {
        Self { scale: Scale::Logarithmic, low, high }
    }

    /// Normal with 90 % between `low` and `high`.
    pub const fn linear(low: f64, high: f64) -> Self {
        Self { scale: Scale::Linear, low, high }
    }

    /// The value `u` standard deviations from the median.
    pub fn value(&self, u: f64) -> f64 {
        let between = |low: f64, high: f64| (low + high) / 2.0 + u * (high - low) / (2.0 * Z95);
        match self.scale {
            Scale::Logarithmic => between(self.low.ln(), self.high.ln()).exp(),
            Scale::Linear => between(self.low, self.high),
        }
    }

    /// Standard deviations of `value` from the median.
    pub fn standard(&self, value: f64) -> f64 {
        let within = |low: f64, high: f64, value: f64| (2.0 * value - low - high) / (high - low) * Z95;
        match self.scale {
            Scale::Logarithmic => within(self.low.ln(), self.high.ln(), value.ln()),
            Scale::Linear => within(self.low, self.high, value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{ContinuousCDF, Normal};

    #[test]
    fn exact_a_twentieth_lies_beyond_each_end() {
        assert!((Normal::standard().inverse_cdf(0.95) / Z95 - 1.0).abs() < 1e-14);
        for prior in [Prior::log(1e6, 4e6), Prior::linear(-1.0, 3.0)] {
            let [low, high] = [-Z95, Z95].map(|u| prior.value(u));
            assert!((low / prior.low - 1.0).abs() < 1e-12 && (high / prior.high - 1.0).abs() < 1e-12, "{prior:?}");
            assert!((prior.standard(prior.low) + Z95).abs() < 1e-12);
        }
    }
}
