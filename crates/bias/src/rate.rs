//! Bias [rad/s] by cause.

use std::ops::{Add, Mul, Neg, Sub};

/// Apparent rotation rate [rad/s], by the term of eqs. (1) and (2) that causes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bias {
    /// Thermal phase, eq. (1) [rad/s].
    pub shupe: f64,
    /// Axial strain of the glass, the A term of eq. (2) [rad/s].
    pub eo_axial: f64,
    /// Radial strain of the glass, the B term of eq. (2) with its sign [rad/s].
    pub eo_radial: f64,
}

impl Bias {
    /// No bias.
    pub const ZERO: Bias = Bias { shupe: 0.0, eo_axial: 0.0, eo_radial: 0.0 };

    /// Their sum, eq. (3) [rad/s].
    pub fn total(&self) -> f64 {
        self.shupe + self.eo_axial + self.eo_radial
    }

    fn zip(self, other: Bias, combine: impl Fn(f64, f64) -> f64) -> Bias {
        Bias {
            shupe: combine(self.shupe, other.shupe),
            eo_axial: combine(self.eo_axial, other.eo_axial),
            eo_radial: combine(self.eo_radial, other.eo_radial),
        }
    }
}

impl Add for Bias {
    type Output = Bias;
    fn add(self, other: Bias) -> Bias {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Bias {
    type Output = Bias;
    fn sub(self, other: Bias) -> Bias {
        self.zip(other, |a, b| a - b)
    }
}

impl Neg for Bias {
    type Output = Bias;
    fn neg(self) -> Bias {
        self * -1.0
    }
}

impl Mul<f64> for Bias {
    type Output = Bias;
    fn mul(self, factor: f64) -> Bias {
        self.zip(self, |a, _| a * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bias_is_a_vector() {
        let (a, b) = (Bias { shupe: 1.0, eo_axial: -2.0, eo_radial: 4.0 }, Bias { shupe: 0.5, eo_axial: 8.0, eo_radial: -16.0 });
        assert_eq!(a + b, Bias { shupe: 1.5, eo_axial: 6.0, eo_radial: -12.0 });
        assert_eq!(a - b, a + -b);
        assert_eq!(a * 2.0, a + a);
        assert_eq!(a + Bias::ZERO, a);
        assert_eq!((a.total(), b.total()), (3.0, -7.5));
    }
}
