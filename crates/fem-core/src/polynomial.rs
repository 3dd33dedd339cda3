//! One-dimensional polynomials on [−1, 1]: Gauss and Gauss–Lobatto points, Lagrange bases.

use std::f64::consts::PI;

/// Points and weights of a quadrature on [−1, 1].
#[derive(Debug, Clone, PartialEq)]
pub struct Quadrature {
    /// Points, increasing.
    pub points: Vec<f64>,
    /// Weights; they sum to 2.
    pub weights: Vec<f64>,
}

/// Legendre polynomial of degree `n` and its derivative at `x` in (−1, 1).
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut p0, mut p1) = (1.0, x);
    if n == 0 {
        return (1.0, 0.0);
    }
    for k in 2..=n {
        let k = k as f64;
        (p0, p1) = (p1, ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k);
    }
    (p1, n as f64 * (x * p1 - p0) / (x * x - 1.0))
}

/// Newton's method from `x`, whose next step `step` says.
fn newton(mut x: f64, step: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..50 {
        let step = step(x);
        x -= step;
        if step.abs() < 1e-16 {
            break;
        }
    }
    x
}

/// Gauss–Legendre quadrature with `n ≥ 1` points (0 counts as 1), exact to degree 2n − 1.
pub fn gauss(n: usize) -> Quadrature {
    let n = n.max(1);
    let root = |i: usize| {
        newton(-(PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos(), |x| {
            let (p, d) = legendre(n, x);
            p / d
        })
    };
    let weight = |x: &f64| {
        let (_, d) = legendre(n, *x);
        2.0 / ((1.0 - x * x) * d * d)
    };
    let points: Vec<f64> = (0..n).map(root).collect();
    let weights = points.iter().map(weight).collect();
    Quadrature { points, weights }
}

/// The `order + 1` Gauss–Lobatto points, `order ≥ 1` (0 counts as 1; [`crate::Mesh::new`] refuses it): the end points and the extrema of the Legendre polynomial.
pub fn gauss_lobatto(order: usize) -> Vec<f64> {
    let n = order.max(1);
    let inner = |i: usize| {
        newton(-(PI * i as f64 / n as f64).cos(), |x| {
            // P''_n from Legendre's equation
            let (p, d) = legendre(n, x);
            d / ((2.0 * x * d - (n * (n + 1)) as f64 * p) / (1.0 - x * x))
        })
    };
    std::iter::once(-1.0).chain((1..n).map(inner)).chain([1.0]).collect()
}

/// Lagrange polynomials through given points.
#[derive(Debug, Clone, PartialEq)]
pub struct Lagrange {
    points: Vec<f64>,
}

impl Lagrange {
    /// The basis through the Gauss–Lobatto points of `order`.
    pub fn gauss_lobatto(order: usize) -> Self {
        Self { points: gauss_lobatto(order) }
    }

    /// The points.
    pub fn points(&self) -> &[f64] {
        &self.points
    }

    /// Values and derivatives of all polynomials at `x`.
    pub fn evaluate(&self, x: f64) -> (Vec<f64>, Vec<f64>) {
        let n = self.points.len();
        let (mut value, mut derivative) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n {
            let (mut v, mut d) = (1.0, 0.0);
            for (j, &xj) in self.points.iter().enumerate() {
                if j != i {
                    let scale = 1.0 / (self.points[i] - xj);
                    d = (d * (x - xj) + v) * scale;
                    v *= (x - xj) * scale;
                }
            }
            value[i] = v;
            derivative[i] = d;
        }
        (value, derivative)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_gauss_integrates_monomials_to_twice_its_points_minus_one() {
        for n in 1..=14 {
            let q = gauss(n);
            for degree in 0..2 * n {
                let sum: f64 = q.points.iter().zip(&q.weights).map(|(x, w)| w * x.powi(degree as i32)).sum();
                let exact = if degree % 2 == 0 { 2.0 / (degree as f64 + 1.0) } else { 0.0 };
                assert!((sum - exact).abs() < 2e-14, "{n} points, degree {degree}: {sum} against {exact}");
            }
            let beyond: f64 = q.points.iter().zip(&q.weights).map(|(x, w)| w * x.powi(2 * n as i32)).sum();
            assert!((beyond - 2.0 / (2.0 * n as f64 + 1.0)).abs() > 1e-9, "exactness must end at degree {}", 2 * n);
        }
    }

    #[test]
    fn exact_lagrange_reproduces_a_polynomial_and_its_derivative() {
        for order in 1..=12 {
            let basis = Lagrange::gauss_lobatto(order);
            let f = |x: f64| x.powi(order as i32) - 0.5 * x;
            let df = |x: f64| order as f64 * x.powi(order as i32 - 1) - 0.5;
            for x in [-1.0, -0.37, 0.2, 0.999, 1.0] {
                let (v, d) = basis.evaluate(x);
                let value: f64 = v.iter().zip(basis.points()).map(|(v, &x)| v * f(x)).sum();
                let slope: f64 = d.iter().zip(basis.points()).map(|(d, &x)| d * f(x)).sum();
                assert!((value - f(x)).abs() < 1e-12 && (slope - df(x)).abs() < 1e-11, "order {order} at {x}");
            }
        }
    }
}
