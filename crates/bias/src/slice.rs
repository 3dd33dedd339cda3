//! A stretch of fibre, and the bias integral over many.

use crate::sum::CompensatedSum;
use crate::{Bias, Error, Optics};

/// Largest overhang of a slice beyond the fibre's length, relative to that length.
///
/// A position summed from a million turn lengths is off by at most 10⁶ · 2⁻⁵³ ≈ 1.1e-10 of the length; ten times that is let pass.
pub const LENGTH_SLACK: f64 = 1e-9;

/// A stretch of fibre over which temperature and strain change at one rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slice {
    /// Its start \[m\], 0 = outer end of the CCW half, tail included.
    pub z_start: f64,
    /// Its end \[m\], ≥ `z_start`.
    pub z_end: f64,
    /// Ṫ [K/s].
    pub temperature_rate: f64,
    /// Rate of the glass's total strain along the fibre, ε̇_z [1/s].
    pub axial_strain_rate: f64,
    /// Rate of the glass's total strain across the fibre, ε̇_r [1/s].
    pub radial_strain_rate: f64,
}

impl Slice {
    /// W = ∫ (L − 2z) dz over the slice \[m²\], for a fibre of `length` L \[m\].
    pub fn weight(&self, length: f64) -> f64 {
        (self.z_end - self.z_start) * (length - self.z_start - self.z_end)
    }

    fn validate(&self, index: usize, length: f64) -> Result<(), Error> {
        let Slice { z_start, z_end, .. } = *self;
        // a NaN fails every comparison
        if !(0.0 <= z_start && z_start <= z_end && z_end <= length * (1.0 + LENGTH_SLACK)) {
            return Err(Error::Span { index, z_start, z_end, length });
        }
        let rates = [
            ("temperature_rate", self.temperature_rate),
            ("axial_strain_rate", self.axial_strain_rate),
            ("radial_strain_rate", self.radial_strain_rate),
        ];
        match rates.into_iter().find(|(_, value)| !value.is_finite()) {
            Some((field, value)) => Err(Error::Rate { index, field, value }),
            None => Ok(()),
        }
    }
}

/// Bias of a fibre of `length` L \[m\], tails included: eqs. (1) to (3) of Osunluk et al.
///
/// Slices may come in any order; fibre that none covers does not change; where slices overlap their rates add. The error from
/// rounding is below 5 ε Σ|contribution| (ε = 2⁻⁵²), however many slices there are.
///
/// # Errors
/// A constant, the length, or a slice outside its range; the message names the slice by its index.
pub fn bias(optics: &Optics, length: f64, slices: &[Slice]) -> Result<Bias, Error> {
    let coefficients = optics.coefficients(length)?;
    let mut sums = [CompensatedSum::default(); 3];
    for (index, slice) in slices.iter().enumerate() {
        slice.validate(index, length)?;
        let Slice { temperature_rate, axial_strain_rate, radial_strain_rate, .. } = *slice;
        let part = coefficients.bias(slice.weight(length), temperature_rate, axial_strain_rate, radial_strain_rate);
        sums[0].add(part.shupe);
        sums[1].add(part.eo_axial);
        sums[2].add(part.eo_radial);
    }
    let [shupe, eo_axial, eo_radial] = sums.map(CompensatedSum::value);
    Ok(Bias { shupe, eo_axial, eo_radial })
}
