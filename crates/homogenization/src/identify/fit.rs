//! Least squares (K. Levenberg 1944, D. W. Marquardt 1963).

use nalgebra::{Cholesky, DMatrix, DVector};

/// Step of the one-sided differences, in prior standard deviations.
const STEP: f64 = 1e-5;
const MOST_ITERATIONS: usize = 60;
/// Relative decrease of the cost below which a fit has converged.
const CONVERGED: f64 = 1e-8;

/// Derivatives of `f` at `u` by differences; `None` where `f` is undefined on both sides.
pub(crate) fn jacobian(f: impl Fn(&[f64]) -> Option<Vec<f64>>, u: &[f64], at: &[f64]) -> Option<DMatrix<f64>> {
    let mut jacobian = DMatrix::zeros(at.len(), u.len());
    let mut moved = u.to_vec();
    for j in 0..u.len() {
        let (y, step) = [STEP, -STEP].into_iter().find_map(|step| {
            moved[j] = u[j] + step;
            Some((f(&moved)?, step))
        })?;
        moved[j] = u[j];
        jacobian.column_mut(j).iter_mut().zip(y.iter().zip(at)).for_each(|(d, (y, at))| *d = (y - at) / step);
    }
    Some(jacobian)
}

/// A local minimum of half the squared residuals from `start` on, and the cost there; `None` if `start` is no cell.
pub(crate) fn minimise(residuals: impl Fn(&[f64]) -> Option<Vec<f64>>, start: &[f64]) -> Option<(Vec<f64>, f64)> {
    let cost = |r: &[f64]| r.iter().map(|r| r * r).sum::<f64>() / 2.0;
    let mut u = start.to_vec();
    let mut r = residuals(&u)?;
    let mut damping = 1e-2;
    for _ in 0..MOST_ITERATIONS {
        let j = jacobian(&residuals, &u, &r)?;
        let (normal, gradient) = (j.transpose() * &j, j.transpose() * DVector::from_column_slice(&r));
        let before = cost(&r);
        let mut improved = false;
        while damping < 1e10 {
            let damped = &normal + DMatrix::identity(u.len(), u.len()) * damping;
            let step = Cholesky::new(damped)?.solve(&gradient);
            let next: Vec<f64> = u.iter().zip(step.iter()).map(|(u, s)| u - s).collect();
            match residuals(&next) {
                Some(better) if cost(&better) < before => {
                    (u, r, improved) = (next, better, true);
                    damping = (damping / 5.0).max(1e-9);
                    break;
                }
                _ => damping *= 4.0,
            }
        }
        if !improved || before - cost(&r) < CONVERGED * before {
            break;
        }
    }
    Some((u, cost(&r)))
}
