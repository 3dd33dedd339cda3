//! One-dimensional matrices of the strips between the lines of a section, and of stretched strips.

use crate::Grid;
use fem_core::polynomial::{Lagrange, gauss};
use nalgebra::DMatrix;

/// Powers of 1/x that stand for 1/(the place of a stretched strip): the expansion ends after as many terms.
pub(super) const INVERSE: usize = 4;

/// An integral over a strip of two shape functions or their derivatives, times a power of the coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Op {
    /// ∫ N N xᵏ, k 0 or 1.
    Mass(usize),
    /// ∫ N′ N′ xᵏ, k 0 or 1.
    Stiffness(usize),
    /// ∫ N′ N xᵏ, k 0 or 1: the derivative of the row's function.
    RowSlope(usize),
    /// ∫ N N′ xᵏ, k 0 or 1: the derivative of the column's function.
    ColumnSlope(usize),
    /// ∫ (N′ N + N N′).
    Slopes,
    /// ∫ N N x⁻ᵏ, k 1 to [`INVERSE`].
    Inverse(usize),
}

/// The nodes of a lattice between two lines of a section, along one direction.
#[derive(Debug, Clone)]
pub(super) struct Strip {
    /// Number of the first node.
    pub(super) first: usize,
    mass: [DMatrix<f64>; 2],
    stiffness: [DMatrix<f64>; 2],
    row_slope: [DMatrix<f64>; 2],
    inverse: Vec<DMatrix<f64>>,
}

impl Strip {
    /// Strips between `breaks`, which are among the element lines of a direction (0: r, 1: y).
    pub(super) fn all(grid: &Grid, direction: usize, breaks: &[f64]) -> Vec<Self> {
        let (lines, order) = (grid.lines()[direction], grid.mesh().order());
        let index = |x: f64| lines.partition_point(|l| *l < x - crate::grid::COINCIDENT / 2.0);
        breaks.windows(2).map(|w| Self::new(lines, order, [index(w[0]), index(w[1])], direction == 0)).collect()
    }

    fn new(lines: &[f64], order: usize, [low, high]: [usize; 2], radial: bool) -> Self {
        let (basis, rule) = (Lagrange::gauss_lobatto(order), gauss(order + 1));
        let nodes = (high - low) * order + 1;
        let zeros = || DMatrix::zeros(nodes, nodes);
        let pair = || [zeros(), zeros()];
        let (mut mass, mut stiffness, mut row_slope) = (pair(), pair(), pair());
        let mut inverse: Vec<_> = (0..if radial { INVERSE } else { 0 }).map(|_| zeros()).collect();
        for e in low..high {
            let (start, width) = (lines[e], lines[e + 1] - lines[e]);
            for (xi, weight) in rule.points.iter().zip(&rule.weights) {
                let (value, slope) = basis.evaluate(*xi);
                let x = start + width * (1.0 + xi) / 2.0;
                let dx = weight * width / 2.0;
                for i in 0..=order {
                    for j in 0..=order {
                        let at = ((e - low) * order + i, (e - low) * order + j);
                        let (vv, sv) = (value[i] * value[j] * dx, slope[i] * value[j] * dx * 2.0 / width);
                        let ss = slope[i] * slope[j] * dx * (2.0 / width).powi(2);
                        for (k, power) in [1.0, x].into_iter().enumerate() {
                            mass[k][at] += vv * power;
                            stiffness[k][at] += ss * power;
                            row_slope[k][at] += sv * power;
                        }
                        inverse.iter_mut().enumerate().for_each(|(k, m)| m[at] += vv * x.powi(-(k as i32) - 1));
                    }
                }
            }
        }
        Self { first: low * order, mass, stiffness, row_slope, inverse }
    }

    /// Number of its nodes.
    pub(super) fn nodes(&self) -> usize {
        self.mass[0].nrows()
    }

    /// An integral over it, as it lies in the reference section.
    pub(super) fn matrix(&self, op: Op) -> DMatrix<f64> {
        match op {
            Op::Mass(k) => self.mass[k].clone(),
            Op::Stiffness(k) => self.stiffness[k].clone(),
            Op::RowSlope(k) => self.row_slope[k].clone(),
            Op::ColumnSlope(k) => self.row_slope[k].transpose(),
            Op::Slopes => &self.row_slope[0] + self.row_slope[0].transpose(),
            Op::Inverse(k) => self.inverse[k - 1].clone(),
        }
    }
}

/// Place of a strip in a changed section: `shift + stretch · x`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stretch {
    pub(super) shift: f64,
    pub(super) stretch: f64,
}

impl Stretch {
    /// The map from the present ends of a strip to its new ones.
    pub(super) fn between(from: [f64; 2], to: [f64; 2]) -> Self {
        if from == to {
            return Self { shift: 0.0, stretch: 1.0 };
        }
        let stretch = (to[1] - to[0]) / (from[1] - from[0]);
        Self { shift: to[0] - stretch * from[0], stretch }
    }

    /// Coefficients of x⁻¹ … x⁻ᴵᴺⱽᴱᴿˢᴱ in the expansion of 1/(shift + stretch · x) about 1/x.
    ///
    /// With x + δ, δ = shift + (stretch − 1) x, the series is Σ (−δ)ᵏ/xᵏ⁺¹; what is left is (δ/x)⁴: 1e-9 where a radius moves by 0.5 %.
    pub(super) fn inverse(self) -> [f64; INVERSE] {
        let (d, s) = (self.shift, self.stretch - 1.0);
        let mut coefficients = [0.0; INVERSE];
        for k in 0..INVERSE {
            let mut binomial = 1.0;
            for j in 0..=k {
                // the term d^(k−j) (s x)^j / x^(k+1)
                let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
                coefficients[k - j] += sign * binomial * d.powi((k - j) as i32) * s.powi(j as i32);
                binomial *= (k - j) as f64 / (j + 1) as f64;
            }
        }
        coefficients
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_the_expansion_of_one_over_a_stretched_radius() {
        let stretch = Stretch::between([0.0395, 0.0435], [0.0393, 0.0435]);
        for x in [0.0395f64, 0.041, 0.0435] {
            let sum: f64 = stretch.inverse().iter().enumerate().map(|(k, c)| c * x.powi(-(k as i32) - 1)).sum();
            let exact = 1.0 / (stretch.shift + stretch.stretch * x);
            assert!((sum / exact - 1.0).abs() < 1e-9, "{sum} against {exact}");
        }
    }
}
