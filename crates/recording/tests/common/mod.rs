//! Noise made by another route than the crate's: fine steps, summed.

#![allow(dead_code, reason = "each test binary uses its part")]

pub(crate) mod figures;

use recording::noise::NoiseModel;

/// xorshift64* (Vigna 2016).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        for _ in 0..20 {
            random.uniform();
        }
        random
    }

    /// In [0, 1).
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Standard normal (Box and Muller).
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }

    pub(crate) fn normals(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.normal()).collect()
    }
}

/// Instants `interval` apart.
pub(crate) fn even(count: usize, interval: f64) -> Vec<f64> {
    (1..=count).map(|i| i as f64 * interval).collect()
}

/// Sub-steps of a sample.
const FINE: usize = 20;

/// Noise of `model` at evenly spaced contiguous instants: each sample the mean of fine steps.
pub(crate) fn simulate(model: &NoiseModel, count: usize, random: &mut Random) -> Vec<f64> {
    let step = model.averaging / FINE as f64;
    let kept = (-step / model.drift_time).exp();
    let mut drift = model.drift * random.normal();
    let (mut walk, mut rounding) = (0.0, model.quantisation * random.normal());
    let sample = |_| {
        let mut sum = 0.0;
        for _ in 0..FINE {
            let before = drift + walk;
            drift = kept * drift + model.drift * (1.0 - kept * kept).sqrt() * random.normal();
            walk += model.walk * step.sqrt() * random.normal();
            sum += (before + drift + walk) / 2.0;
        }
        let last = rounding;
        rounding = model.quantisation * random.normal();
        sum / FINE as f64 + model.white * random.normal() + (rounding - last) / model.averaging
    };
    (0..count).map(sample).collect()
}

/// Lower Cholesky factor, by the textbook.
pub(crate) fn cholesky(matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = matrix.len();
    let mut lower = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let rest = matrix[i][j] - (0..j).map(|k| lower[i][k] * lower[j][k]).sum::<f64>();
            lower[i][j] = if i == j { rest.sqrt() } else { rest / lower[j][j] };
        }
    }
    lower
}
