//! The fibre's glass and the gyroscope's scale.

use crate::units::SPEED_OF_LIGHT;
use crate::{Coefficients, Error};
use std::f64::consts::TAU;

/// Strain in eq. (2).
///
/// Eq. (1) already holds the phase n α of a fibre that expands freely. Total strain contains that expansion too, so it is
/// counted twice; in a steady ramp, where Ṫ is uniform, the difference integrates to zero. Slices take total strain either way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum StrainConvention {
    /// Total strain, as the paper prints eq. (2): for its numbers.
    Total,
    /// Total strain minus α ΔT, with the α of eq. (1), along and across the fibre: for a fibre of one's own.
    Mechanical,
}

/// Optical constants of the fibre and the diameter of the Sagnac loop.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Optics {
    /// Refractive index n of the core, ≥ 1.
    pub refractive_index: f64,
    /// ∂n/∂T [1/K].
    pub thermo_optic: f64,
    /// Thermal expansion α of the core [1/K].
    pub thermal_expansion: f64,
    /// Photoelastic coefficient p11 of the glass.
    pub p11: f64,
    /// Photoelastic coefficient p12 of the glass.
    pub p12: f64,
    /// Mean diameter D of the coil \[m\], > 0: the mean of its inner and outer diameter, unless it was measured.
    pub sagnac_diameter: f64,
    /// Strain in eq. (2).
    pub strain: StrainConvention,
}

impl Optics {
    /// Checks every constant.
    ///
    /// # Errors
    /// [`Error::Range`] names the first one outside its range.
    pub fn validate(&self) -> Result<(), Error> {
        let n = self.refractive_index;
        if !(n.is_finite() && n >= 1.0) {
            return Err(Error::Range { field: "refractive_index", value: n, range: "a finite number of 1 or more" });
        }
        let finite = [
            ("thermo_optic", self.thermo_optic),
            ("thermal_expansion", self.thermal_expansion),
            ("p11", self.p11),
            ("p12", self.p12),
        ];
        if let Some((field, value)) = finite.into_iter().find(|(_, value)| !value.is_finite()) {
            return Err(Error::Range { field, value, range: "a finite number" });
        }
        positive("sagnac_diameter", self.sagnac_diameter)
    }

    /// A = n (1 − n² p12 / 2): optical path gained per length and axial strain, eq. (2); of an arm of an interferometer, too.
    pub fn a(&self) -> f64 {
        let n = self.refractive_index;
        n * (1.0 - n * n * self.p12 / 2.0)
    }

    /// B = n³ (p11 + p12) / 2: optical path lost per length and radial strain, eq. (2); of an arm of an interferometer, too.
    pub fn b(&self) -> f64 {
        self.refractive_index.powi(3) * (self.p11 + self.p12) / 2.0
    }

    /// Sagnac phase \[rad\] of a rotation `rate` Ω \[rad/s\], `Ω 2π L D/(λ c)`, for a fibre of `length` L \[m\] and light of vacuum `wavelength` λ \[m\].
    ///
    /// With the sign of eqs. (1) and (2) it is the phase that the wave which enters at z = L has gathered, less that of the wave which enters at z = 0: fibre near
    /// z = 0 that warms up meets the first of them later, and gives it more. Nothing is checked: no wavelength gives no finite phase.
    pub fn phase(&self, rate: f64, length: f64, wavelength: f64) -> f64 {
        rate * TAU * length * self.sagnac_diameter / (wavelength * SPEED_OF_LIGHT)
    }

    /// The factors of eqs. (1) and (2) for a fibre of `length` L \[m\], > 0, tails included.
    ///
    /// # Errors
    /// A constant or the length outside its range.
    pub fn coefficients(&self, length: f64) -> Result<Coefficients, Error> {
        self.validate()?;
        positive("length", length)?;
        let scale = self.refractive_index / (length * self.sagnac_diameter);
        let (axial, radial) = (scale * self.a(), -scale * self.b());
        let counted_twice = match self.strain {
            StrainConvention::Total => 0.0,
            StrainConvention::Mechanical => self.thermal_expansion,
        };
        Ok(Coefficients {
            shupe: scale * (self.thermo_optic + self.refractive_index * self.thermal_expansion),
            axial,
            radial,
            axial_per_temperature_rate: -axial * counted_twice,
            radial_per_temperature_rate: -radial * counted_twice,
        })
    }
}

fn positive(field: &'static str, value: f64) -> Result<(), Error> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(Error::Range { field, value, range: "a finite length above 0 m" }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SILICA: Optics = Optics {
        refractive_index: 1.45,
        thermo_optic: 1.0e-5,
        thermal_expansion: 0.55e-6,
        p11: 0.121,
        p12: 0.270,
        sagnac_diameter: 92.325e-3,
        strain: StrainConvention::Total,
    };

    #[test]
    fn photoelastic_factors_of_silica() {
        // 1.45 · (1 − 2.1025 · 0.135) and 3.048625 · 0.1955, by hand
        approx::assert_relative_eq!(SILICA.a(), 1.038_435_625, max_relative = 1e-14);
        approx::assert_relative_eq!(SILICA.b(), 0.596_006_187_5, max_relative = 1e-14);
    }

    /// Earth's rate in a kilometre on 0.1 m at 1550 nm, by hand. The phase of a bias does not depend on the diameter: the optical path of a metre
    /// grows at the rate ṡ for the time n (L − 2z)/c by which one wave is later there than the other.
    #[test]
    fn sagnac_phase() {
        let coil = Optics { sagnac_diameter: 0.1, ..SILICA };
        approx::assert_relative_eq!(coil.phase(7.292115e-5, 1000.0, 1.55e-6), 9.860_09e-5, max_relative = 1e-5);
        let (length, weight, rate, wavelength) = (1000.0, 999.0, 1.0 / 60.0, 1.55e-6);
        for optics in [SILICA, coil] {
            let bias = optics.coefficients(length).unwrap().shupe * weight * rate;
            let (n, path) = (1.45, (1.0e-5 + 1.45 * 0.55e-6) * rate);
            let phase = TAU / wavelength * path * n / SPEED_OF_LIGHT * weight;
            approx::assert_relative_eq!(optics.phase(bias, length, wavelength), phase, max_relative = 1e-12);
        }
    }

    #[test]
    fn a_message_names_field_and_value() {
        let cases = [
            (Optics { refractive_index: 0.9, ..SILICA }, "refractive_index = 0.9"),
            (Optics { thermo_optic: f64::NAN, ..SILICA }, "thermo_optic = NaN"),
            (Optics { thermal_expansion: f64::INFINITY, ..SILICA }, "thermal_expansion = inf"),
            (Optics { p11: f64::NAN, ..SILICA }, "p11 = NaN"),
            (Optics { p12: f64::NAN, ..SILICA }, "p12 = NaN"),
            (Optics { sagnac_diameter: 0.0, ..SILICA }, "sagnac_diameter = 0, but it must be a finite length above 0 m"),
        ];
        for (optics, expected) in cases {
            let message = optics.coefficients(1000.0).expect_err(expected).to_string();
            assert!(message.contains(expected), "{message}");
        }
        assert_eq!(
            SILICA.coefficients(-1.0),
            Err(Error::Range { field: "length", value: -1.0, range: "a finite length above 0 m" })
        );
    }
}
