//! A small regression network, as papers recommend for what a model leaves: one hidden layer of tanh, trained by Adam (Kingma and Ba 2015), stopped where
//! a part of the fitted rows that it does not see is predicted best.

use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

const HIDDEN: usize = 10;
const EPOCHS: usize = 1500;
const STEP: f64 = 0.01;
/// Blocks into which the fitted rows are cut; every fifth is not trained on.
const BLOCKS: usize = 25;
const SPARED: usize = 5;
/// Rows that are trained on, at most: of more, every so many.
const ROWS: usize = 2000;

/// A trained network.
pub(crate) struct Network {
    weights: Vec<f64>,
    inputs: usize,
    middles: Vec<(f64, f64)>,
    output: (f64, f64),
}

fn scale(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.clone().count().max(1) as f64;
    let mean = values.clone().sum::<f64>() / n;
    let sd = (values.map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt();
    (mean, if sd > 1e-12 { sd } else { 1.0 })
}

impl Network {
    /// Trained on rows of features and what they shall give; a seed draws the first weights.
    pub(crate) fn trained(features: &[Vec<f64>], wanted: &[f64], seed: u64) -> Self {
        let inputs = features.first().map_or(0, Vec::len);
        let middles = (0..inputs).map(|i| scale(features.iter().map(move |f| f[i]))).collect();
        let output = scale(wanted.iter().copied());
        let mut random = SmallRng::seed_from_u64(seed);
        let count = HIDDEN * (inputs + 2) + 1;
        let weights = (0..count).map(|_| (random.random::<f64>() - 0.5) / (inputs.max(1) as f64).sqrt()).collect();
        let mut net = Self { weights, inputs, middles, output };
        let every = features.len().div_ceil(ROWS).max(1);
        let rows: Vec<(Vec<f64>, f64, bool)> = (0..features.len())
            .step_by(every)
            .map(|n| (net.scaled(&features[n]), (wanted[n] - output.0) / output.1, (n * BLOCKS / features.len()) % SPARED == 2))
            .collect();
        net.train(&rows);
        net
    }

    fn scaled(&self, features: &[f64]) -> Vec<f64> {
        features.iter().zip(&self.middles).map(|(x, (mean, sd))| (x - mean) / sd).collect()
    }

    fn train(&mut self, rows: &[(Vec<f64>, f64, bool)]) {
        let count = self.weights.len();
        let (mut first, mut second) = (vec![0.0; count], vec![0.0; count]);
        let mut best = (f64::INFINITY, self.weights.clone());
        for epoch in 1..=EPOCHS {
            let mut gradient = vec![0.0; count];
            let mut spared = 0.0;
            for (x, y, is_spared) in rows {
                let error = self.forward(x).1 - y;
                if *is_spared {
                    spared += error * error;
                } else {
                    self.backward(x, error, &mut gradient);
                }
            }
            if spared < best.0 {
                best = (spared, self.weights.clone());
            }
            let fade = |beta: f64| 1.0 - beta.powi(i32::try_from(epoch).unwrap_or(i32::MAX));
            for i in 0..count {
                let g = gradient[i] / rows.len() as f64;
                first[i] += 0.1 * (g - first[i]);
                second[i] += 1e-3 * (g * g - second[i]);
                self.weights[i] -= STEP * first[i] / fade(0.9) / ((second[i] / fade(0.999)).sqrt() + 1e-8);
            }
        }
        self.weights = best.1;
    }

    fn forward(&self, x: &[f64]) -> ([f64; HIDDEN], f64) {
        let width = self.inputs + 2;
        let mut hidden = [0.0; HIDDEN];
        let mut sum = self.weights[HIDDEN * width];
        for (h, value) in hidden.iter_mut().enumerate() {
            let w = &self.weights[h * width..(h + 1) * width];
            *value = (w[0] + w[2..].iter().zip(x).map(|(w, x)| w * x).sum::<f64>()).tanh();
            sum += w[1] * *value;
        }
        (hidden, sum)
    }

    fn backward(&self, x: &[f64], error: f64, gradient: &mut [f64]) {
        let width = self.inputs + 2;
        let (hidden, _) = self.forward(x);
        gradient[HIDDEN * width] += error;
        for (h, value) in hidden.iter().enumerate() {
            let at = h * width;
            gradient[at + 1] += error * value;
            let inner = error * self.weights[at + 1] * (1.0 - value * value);
            gradient[at] += inner;
            gradient[at + 2..at + width].iter_mut().zip(x).for_each(|(g, x)| *g += inner * x);
        }
    }

    /// Output of the network for features.
    pub(crate) fn of(&self, features: &[f64]) -> f64 {
        self.output.0 + self.output.1 * self.forward(&self.scaled(features)).1
    }
}
