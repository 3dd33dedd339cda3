//! States of a reduced model and the intervals between them, with the two small functions that everything on modes is made of.

use nalgebra::DVector;

/// State of a [`super::Reduced`] at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct ThermalState {
    /// Drives: temperatures \[K or °C\], heaters in parts of their power.
    pub drives: Vec<f64>,
    /// Amplitude of each mode.
    pub amplitudes: Vec<f64>,
}

impl ThermalState {
    /// Drives, then amplitudes.
    pub fn vector(&self) -> DVector<f64> {
        let (drives, amplitudes) = (&self.drives, &self.amplitudes);
        DVector::from_iterator(drives.len() + amplitudes.len(), drives.iter().chain(amplitudes).copied())
    }
}

/// An interval between two instants, over which the drives are linear.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// State at its start.
    pub from: ThermalState,
    /// Change of each drive per second.
    pub slope: Vec<f64>,
    /// Its length \[s\], > 0.
    pub dt: f64,
}

/// Σ aᵢ bᵢ, in eight sums side by side: one would wait for itself.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (a_blocks, b_blocks) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a_blocks.remainder().iter().zip(b_blocks.remainder()).map(|(a, b)| a * b).sum();
    let mut sums = [0.0; LANES];
    for (a, b) in a_blocks.zip(b_blocks) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += a * b);
    }
    sums.iter().sum::<f64>() + rest
}

/// (1 − e^−x)/x, smooth at 0.
pub(super) fn settled(x: f64) -> f64 {
    if x.abs() < 1e-8 { 1.0 - x / 2.0 } else { -(-x).exp_m1() / x }
}
