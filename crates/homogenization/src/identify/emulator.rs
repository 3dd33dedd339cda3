//! The cell's response, predicted: composite cylinders plus a Gaussian process through the differences seen so far.

use super::Family;
use super::response::{RESPONSES, Response, estimated};
use nalgebra::{Cholesky, DMatrix, DVector};

/// Kernel `CONSTANT + u·v + exp(−|u − v|²/(2 ℓ²))`, relative to the smooth part.
const CONSTANT: f64 = 10.0;
/// On the kernel's diagonal.
const NUGGET: f64 = 1e-7;
/// Candidates for ℓ² per dimension; leave-one-out errors choose.
const SQUARED_LENGTHS: [f64; 4] = [1.0, 3.0, 9.0, 27.0];

#[derive(Debug, Clone)]
pub(crate) struct Emulator<'a> {
    pub(crate) family: &'a Family,
    points: Vec<Vec<f64>>,
    differences: Vec<Response>,
    squared_length: f64,
    weights: DMatrix<f64>,
}

impl<'a> Emulator<'a> {
    pub(crate) fn new(family: &'a Family) -> Self {
        Self { family, points: vec![], differences: vec![], squared_length: 1.0, weights: DMatrix::zeros(0, RESPONSES) }
    }

    /// The response at `u`; `None` where there is no cell.
    pub(crate) fn predict(&self, u: &[f64]) -> Option<Response> {
        let mut y = estimated(&self.family.cell(u)?)?;
        for (point, weights) in self.points.iter().zip(self.weights.row_iter()) {
            let kernel = kernel(u, point, self.squared_length);
            y.iter_mut().zip(weights.iter()).for_each(|(y, w)| *y += kernel * w);
        }
        Some(y)
    }

    /// Learns what cells answered when they were solved; those without an answer are left out.
    pub(crate) fn learn(&mut self, solved: impl IntoIterator<Item = (Vec<f64>, Option<Response>)>) {
        for (u, y) in solved {
            let Some((y, estimate)) = y.zip(self.family.cell(&u).as_ref().and_then(estimated)) else { continue };
            if !self.points.contains(&u) {
                self.differences.push(std::array::from_fn(|i| y[i] - estimate[i]));
                self.points.push(u);
            }
        }
        let dimensions = self.points.first().map_or(1, Vec::len) as f64;
        let trained = SQUARED_LENGTHS.iter().filter_map(|length| self.trained(length * dimensions));
        if let Some((_, length, weights)) = trained.min_by(|a, b| a.0.total_cmp(&b.0)) {
            (self.squared_length, self.weights) = (length, weights);
        }
    }

    /// Mean squared leave-one-out error, ℓ² and weights.
    fn trained(&self, squared_length: f64) -> Option<(f64, f64, DMatrix<f64>)> {
        let n = self.points.len();
        let k = DMatrix::from_fn(n, n, |i, j| {
            kernel(&self.points[i], &self.points[j], squared_length) + if i == j { NUGGET } else { 0.0 }
        });
        let inverse = Cholesky::new(k)?.inverse();
        let weights = &inverse * DMatrix::from_fn(n, RESPONSES, |i, j| self.differences[i][j]);
        let left_out = DVector::from_fn(n, |i, _| weights.row(i).norm_squared() / inverse[(i, i)].powi(2));
        Some((left_out.mean(), squared_length, weights))
    }
}

fn kernel(u: &[f64], v: &[f64], squared_length: f64) -> f64 {
    let (mut dot, mut squared) = (0.0, 0.0);
    for (a, b) in u.iter().zip(v) {
        dot += a * b;
        squared += (a - b) * (a - b);
    }
    CONSTANT + dot + (-squared / (2.0 * squared_length)).exp()
}
