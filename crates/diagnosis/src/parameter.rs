//! Parameters and their priors.

use statrs::distribution::{Continuous, ContinuousCDF, Normal};

/// Prior distribution of a parameter, before a recording is seen. Each is the image of a standard normal variable u, so that every
/// parameter is fitted on one scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Prior {
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation, > 0.
        sd: f64,
    },
    /// A size of either sign whose order of magnitude is uncertain, scale · sinh(u)/sinh(1): near 0 as a normal one, far out as one whose logarithm is
    /// normal (Johnson, *Biometrika* 36, 149 (1949), system S_U). Ten times the scale costs five of ln evidence, where a normal prior would take fifty.
    Size {
        /// Value at u = 1, > 0.
        scale: f64,
    },
    /// Its logarithm is normal.
    LogNormal {
        /// Median, > 0.
        median: f64,
        /// Standard deviation of the logarithm, > 0.
        spread: f64,
    },
    /// Uniform.
    Uniform {
        /// Lower end.
        low: f64,
        /// Upper end, > `low`.
        high: f64,
    },
}

/// sinh(1).
const SINH_1: f64 = 1.175_201_193_643_801_4;

/// Largest |u| that is considered: 1 in 10¹⁵ of a prior lies beyond.
const MOST: f64 = 8.0;

impl Prior {
    /// The problem of a prior that is no distribution.
    pub(crate) fn problem(&self) -> Option<String> {
        let size = |name: &str, value: f64| {
            let is_size = value.is_finite() && value > 0.0;
            (!is_size).then(|| format!("the {name} of its prior is {value}; it has to be finite and above 0"))
        };
        let number = |name: &str, value: f64| {
            (!value.is_finite()).then(|| format!("the {name} of its prior is {value}; it has to be finite"))
        };
        match *self {
            Prior::Normal { mean, sd } => number("mean", mean).or_else(|| size("sd", sd)),
            Prior::Size { scale } => size("scale", scale),
            Prior::LogNormal { median, spread } => size("median", median).or_else(|| size("spread", spread)),
            Prior::Uniform { low, high } => number("lower end", low).or_else(|| number("upper end", high)).or_else(|| {
                (low >= high).then(|| format!("its prior reaches from {low} to {high}; the upper end has to be above the lower"))
            }),
        }
    }

    /// Whether a value is possible under it.
    pub(crate) fn allows(&self, value: f64) -> bool {
        value.is_finite()
            && match *self {
                Prior::Normal { .. } | Prior::Size { .. } => true,
                Prior::LogNormal { .. } => value > 0.0,
                Prior::Uniform { low, high } => (low..=high).contains(&value),
            }
    }

    /// The value at u.
    pub fn value(&self, u: f64) -> f64 {
        let u = u.clamp(-MOST, MOST);
        match *self {
            Prior::Normal { mean, sd } => mean + sd * u,
            Prior::Size { scale } => scale * u.sinh() / SINH_1,
            Prior::LogNormal { median, spread } => median * (spread * u).exp(),
            Prior::Uniform { low, high } => low + (high - low) * Normal::standard().cdf(u),
        }
    }

    /// Change of the value by one of u, at u.
    pub(crate) fn slope(&self, u: f64) -> f64 {
        match *self {
            _ if u.abs() > MOST => 0.0,
            Prior::Normal { sd, .. } => sd,
            Prior::Size { scale } => scale * u.cosh() / SINH_1,
            Prior::LogNormal { spread, .. } => spread * self.value(u),
            Prior::Uniform { low, high } => (high - low) * Normal::standard().pdf(u),
        }
    }

    /// Standard deviation where it is normal; else half of the range that u from −1 to 1 spans.
    pub fn sd(&self) -> f64 {
        (self.value(1.0) - self.value(-1.0)).abs() / 2.0
    }

    /// The u of a value; of one outside the prior's range, the nearest that is considered.
    pub fn standard(&self, value: f64) -> f64 {
        let u = match *self {
            Prior::Normal { mean, sd } => (value - mean) / sd,
            Prior::Size { scale } => (value / scale * SINH_1).asinh(),
            Prior::LogNormal { median, spread } => (value.max(f64::MIN_POSITIVE) / median).ln() / spread,
            Prior::Uniform { low, high } => {
                Normal::standard().inverse_cdf(((value - low) / (high - low)).clamp(1e-15, 1.0 - 1e-15))
            }
        };
        u.clamp(-MOST, MOST)
    }
}

/// A parameter of a forward model.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name with its unit, as it is reported.
    pub name: String,
    /// Its prior distribution.
    pub prior: Prior,
    /// Step for differences, in units of u: large where the response has kinks.
    pub step: f64,
    /// Distances at which a better value is sought around a fitted one, where kinks make local minima; none where the response is smooth.
    pub around: Vec<f64>,
}

impl Parameter {
    /// A parameter on which the response depends smoothly.
    pub fn new(name: impl Into<String>, prior: Prior) -> Self {
        Self { name: name.into(), prior, step: 1e-3, around: Vec::new() }
    }

    /// The same with another step for differences.
    pub fn with_step(self, step: f64) -> Self {
        Self { step, ..self }
    }

    /// The same, sought also at these distances from where a fit has settled.
    pub fn with_search(self, around: &[f64]) -> Self {
        Self { around: around.to_vec(), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn value_and_standard_are_each_other_s_inverse() {
        for prior in [
            Prior::Normal { mean: 3.0, sd: 0.2 },
            Prior::Size { scale: 0.7 },
            Prior::LogNormal { median: 5e-4, spread: 1.3 },
            Prior::Uniform { low: -40.0, high: 60.0 },
        ] {
            for u in [-4.0, -1.0, 0.0, 0.3, 2.5] {
                assert!((prior.standard(prior.value(u)) - u).abs() < 1e-6, "{prior:?} at {u}");
            }
        }
    }

    #[test]
    fn a_size_is_as_likely_to_either_side_and_may_be_large() {
        let (size, normal) = (Prior::Size { scale: 2.0 }, Prior::Normal { mean: 0.0, sd: 2.0 });
        assert!((size.value(1.0) - 2.0).abs() < 1e-12 && (size.sd() - 2.0).abs() < 1e-12 && size.value(-1.5) == -size.value(1.5));
        let cost = |prior: Prior| prior.standard(20.0).min(10.0).powi(2) / 2.0;
        assert!((4.9..5.1).contains(&cost(size)) && cost(normal) > 30.0, "{}", cost(size));
    }

    #[test]
    fn values_outside_a_range_stay_finite() {
        let prior = Prior::Uniform { low: 0.0, high: 1.0 };
        assert!(prior.value(prior.standard(7.0)) <= 1.0 && prior.value(prior.standard(-7.0)) >= 0.0);
        assert!(Prior::LogNormal { median: 1.0, spread: 1.0 }.standard(-1.0).is_finite());
    }

    #[test]
    fn a_slope_is_that_of_the_value_as_far_as_it_is_considered_and_none_beyond() {
        for prior in [
            Prior::Normal { mean: 3.0, sd: 0.2 },
            Prior::Size { scale: 0.7 },
            Prior::LogNormal { median: 5e-4, spread: 1.3 },
            Prior::Uniform { low: -40.0, high: 60.0 },
        ] {
            for u in [-7.0, -1.0, 0.0, 0.3, 2.5, 7.0] {
                let by = 1e-4;
                let slope = (prior.value(u + by) - prior.value(u - by)) / (2.0 * by);
                assert!((prior.slope(u) - slope).abs() < 1e-6 * (1.0 + slope.abs()), "{prior:?} at {u}");
            }
            assert!([-MOST, MOST].iter().all(|u| prior.slope(*u) > 0.0), "{prior:?} at the ends");
            assert!([-9.0, 8.1, 20.0].iter().all(|u| prior.slope(*u) == 0.0), "{prior:?} beyond");
        }
    }
}
