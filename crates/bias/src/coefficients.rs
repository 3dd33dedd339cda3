//! The factors of eqs. (1) and (2): bias [rad/s] per weight \[m²\] and rate.

use crate::Bias;

/// Factors on the weight W = ∫ (L − 2z) dz \[m²\] times a rate, for one gyroscope and one fibre length.
///
/// Made by [`Optics::coefficients`](crate::Optics::coefficients). Rates are of total strain in either convention.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    /// n/(L D) (∂n/∂T + n α): Ω_S = `shupe` · W · Ṫ [rad/(m² K)].
    pub shupe: f64,
    /// n/(L D) A: Ω_EO,z = `axial` · W · ε̇_z [rad/m²].
    pub axial: f64,
    /// −n/(L D) B, sign included: Ω_EO,r = `radial` · W · ε̇_r [rad/m²].
    pub radial: f64,
    /// −α · `axial` in the mechanical convention, 0 in the total one; adds · W · Ṫ to Ω_EO,z [rad/(m² K)].
    pub axial_per_temperature_rate: f64,
    /// −α · `radial` in the mechanical convention, 0 in the total one; adds · W · Ṫ to Ω_EO,r [rad/(m² K)].
    pub radial_per_temperature_rate: f64,
}

impl Coefficients {
    /// Bias of a piece of fibre of `weight` W \[m²\] that changes uniformly: `temperature_rate` Ṫ [K/s], rates of total strain of
    /// the glass along (`axial_strain_rate`) and across (`radial_strain_rate`) the fibre [1/s].
    pub fn bias(&self, weight: f64, temperature_rate: f64, axial_strain_rate: f64, radial_strain_rate: f64) -> Bias {
        let axial = self.axial * axial_strain_rate + self.axial_per_temperature_rate * temperature_rate;
        let radial = self.radial * radial_strain_rate + self.radial_per_temperature_rate * temperature_rate;
        Bias { shupe: self.shupe * temperature_rate * weight, eo_axial: axial * weight, eo_radial: radial * weight }
    }
}
