//! One turn: where it lies \[m\] and which stretch of the fibre it is \[m\].

use crate::Half;

/// One turn of the coil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// The half of the fibre it belongs to.
    pub half: Half,
    /// Layer, 1 = innermost.
    pub layer: usize,
    /// Turn within the layer, 1 = nearest to y = 0.
    pub turn: usize,
    /// Radius of its centre \[m\].
    pub r: f64,
    /// Axial position of its centre above the coil's left face \[m\].
    pub y: f64,
    /// Its beginning along the fibre \[m\].
    pub z_start: f64,
    /// Its end along the fibre \[m\], > `z_start`.
    pub z_end: f64,
}

impl Turn {
    /// Length of its fibre \[m\].
    pub fn length(&self) -> f64 {
        self.z_end - self.z_start
    }

    /// Middle of its stretch of the fibre \[m\].
    pub fn z_mid(&self) -> f64 {
        0.5 * (self.z_start + self.z_end)
    }

    /// Its weight in the bias, W = ∫ (L − 2z) dz over the turn \[m²\], for a fibre of `total_length` L \[m\].
    ///
    /// Positive in the half nearer z = 0. Shupe (1980); eqs. (1) and (2) of Osunluk et al.
    pub fn weight(&self, total_length: f64) -> f64 {
        (self.z_end - self.z_start) * (total_length - self.z_start - self.z_end)
    }
}
