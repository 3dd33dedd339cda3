//! Measured effective constants.

use super::response::{KNOWN, Known, Response, known};

/// Accuracy to which a constant is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Uncertainty {
    /// Anything within this half width is the same printed number.
    Rounded(f64),
    /// A standard deviation.
    Normal(f64),
}

/// A measured effective constant, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Its place in [`crate::Constants::named`].
    index: usize,
    /// Its value.
    pub value: f64,
    /// Accuracy to which it is known.
    pub uncertainty: Uncertainty,
}

/// A normal entry is met within this many standard deviations.
const MET: f64 = 3.0;
/// Fits keep within this share of a rounding interval, and are pulled back beyond it by the edge's width, relative to half the interval.
const INNER: f64 = 0.8;
const EDGE: f64 = 0.05;

impl Target {
    /// The constant `name` of [`crate::Constants::named`]; `None` for one that cannot be measured (the dehomogenisation row).
    pub fn new(name: &str, value: f64, uncertainty: Uncertainty) -> Option<Self> {
        let index = KNOWN.iter().position(|known| *known == name)?;
        Some(Self { index, value, uncertainty })
    }

    /// Name of the constant.
    pub fn name(&self) -> &'static str {
        KNOWN[self.index]
    }

    /// The constant among all that are known.
    pub fn of(&self, known: &Known) -> f64 {
        known[self.index]
    }

    /// Standard deviation; that of a uniform distribution for a rounded entry.
    pub fn sd(&self) -> f64 {
        match self.uncertainty {
            Uncertainty::Rounded(half) => half / 3.0_f64.sqrt(),
            Uncertainty::Normal(sd) => sd,
        }
    }

    /// Whether `value` rounds to the printed digits, or lies within three standard deviations.
    pub fn is_met(&self, value: f64) -> bool {
        let limit = match self.uncertainty {
            Uncertainty::Rounded(half) => half,
            Uncertainty::Normal(sd) => MET * sd,
        };
        (value - self.value).abs() <= limit
    }

    /// Distance in standard deviations; what is used where a normal likelihood stands for a rounding interval.
    pub(crate) fn distance(&self, value: f64) -> f64 {
        (value - self.value) / self.sd()
    }

    /// Residual of a fit: nothing inside most of the rounding interval.
    pub(crate) fn residual(&self, value: f64) -> f64 {
        match self.uncertainty {
            Uncertainty::Rounded(half) => beyond(value - self.value, INNER * half) / (EDGE * half),
            Uncertainty::Normal(sd) => (value - self.value) / sd,
        }
    }
}

pub(crate) fn distances(targets: &[Target], response: &Response) -> Vec<f64> {
    let known = known(response);
    targets.iter().map(|t| t.distance(t.of(&known))).collect()
}

/// Excess of `x` over `limit` either way, with sign.
pub(crate) fn beyond(x: f64, limit: f64) -> f64 {
    (x.abs() - limit).max(0.0).copysign(x)
}
