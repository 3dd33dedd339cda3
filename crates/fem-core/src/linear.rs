//! Sparse Cholesky factorisation with a residual check: the only module that names the factorisation library.

use crate::{Error, SparseMatrix};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::LltError;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Mat, Side};

/// Largest backward error `‖b − A x‖ / (‖ |A| |x| ‖ + ‖b‖)` (maximum norms) that a solve may leave, after one step of iterative
/// refinement.
///
/// A correct factor leaves a few units of rounding (1e-15), whatever the condition number; a wrong one leaves of order one.
pub const BACKWARD_ERROR_LIMIT: f64 = 1e-12;

/// Orderings and sizes of a Cholesky factor: computed once per sparsity pattern.
#[derive(Debug, Clone)]
pub struct SymbolicFactor(SymbolicLlt<usize>);

/// A Cholesky factor of a symmetric positive definite matrix, checked when it was made.
#[derive(Debug, Clone)]
pub struct Factor {
    matrix: SparseMatrix,
    cholesky: Llt<usize, f64>,
}

fn structure(matrix: &SparseMatrix) -> SymbolicSparseColMatRef<'_, usize> {
    let (starts, indices, _) = matrix.parts();
    SymbolicSparseColMatRef::new_checked(matrix.rows(), matrix.columns(), starts, None, indices)
}

fn not_positive_definite(matrix: &SparseMatrix, detail: impl std::fmt::Display) -> Error {
    Error::NotPositiveDefinite { unknowns: matrix.rows(), detail: detail.to_string() }
}

impl SymbolicFactor {
    /// Orders the unknowns of `matrix`.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] if the ordering runs out of memory.
    pub fn new(matrix: &SparseMatrix) -> Result<Self, Error> {
        let symbolic = SymbolicLlt::try_new(structure(matrix), Side::Lower);
        Ok(Self(symbolic.map_err(|e| not_positive_definite(matrix, format!("{e:?}")))?))
    }

    /// Factorises a matrix of the same pattern and checks the factor on one right-hand side.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`]; [`Error::Residual`] if the factor does not solve.
    pub fn factor(&self, matrix: SparseMatrix) -> Result<Factor, Error> {
        let numeric = SparseColMatRef::new(structure(&matrix), matrix.parts().2);
        let cholesky = Llt::try_new_with_symbolic(self.0.clone(), numeric, Side::Lower).map_err(|e| match e {
            LltError::Numeric(e) => not_positive_definite(&matrix, format!("{e:?}")),
            LltError::Generic(e) => not_positive_definite(&matrix, format!("{e:?}")),
        })?;
        let factor = Factor { matrix, cholesky };
        let probe = factor.matrix.multiply(&vec![1.0; factor.matrix.columns()]);
        factor.solve(&[probe])?;
        Ok(factor)
    }
}

impl Factor {
    /// Orders and factorises `matrix` (symmetric positive definite, both triangles stored).
    ///
    /// # Errors
    /// As [`SymbolicFactor::factor`].
    pub fn new(matrix: SparseMatrix) -> Result<Self, Error> {
        SymbolicFactor::new(&matrix)?.factor(matrix)
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.matrix.rows()
    }

    /// The matrix that was factorised.
    pub fn matrix(&self) -> &SparseMatrix {
        &self.matrix
    }

    fn substitute(&self, columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let n = self.unknowns();
        let rhs = Mat::from_fn(n, columns.len(), |i, j| columns[j][i]);
        let x = self.cholesky.solve(&rhs);
        (0..columns.len()).map(|j| (0..n).map(|i| x[(i, j)]).collect()).collect()
    }

    /// Solves for all right-hand sides together, refines once, checks each residual.
    ///
    /// # Errors
    /// [`Error::Residual`] if a backward error exceeds [`BACKWARD_ERROR_LIMIT`].
    pub fn solve(&self, rhs: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Error> {
        let residual =
            |x: &[f64], b: &[f64]| -> Vec<f64> { self.matrix.multiply(x).iter().zip(b).map(|(ax, b)| b - ax).collect() };
        let mut x = self.substitute(rhs);
        let left: Vec<_> = x.iter().zip(rhs).map(|(x, b)| residual(x, b)).collect();
        for (x, step) in x.iter_mut().zip(self.substitute(&left)) {
            x.iter_mut().zip(step).for_each(|(x, step)| *x += step);
        }
        for (x, b) in x.iter().zip(rhs) {
            let size = largest(&self.matrix.multiply_magnitudes(x)) + largest(b);
            let backward_error = largest(&residual(x, b)) / size;
            // not `>`: a NaN must not pass
            if size != 0.0 && !(backward_error <= BACKWARD_ERROR_LIMIT) {
                return Err(Error::Residual { backward_error, limit: BACKWARD_ERROR_LIMIT, unknowns: self.unknowns() });
            }
        }
        Ok(x)
    }
}

/// Maximum norm; NaN if any entry is.
fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m: f64, v| if v.is_nan() || m.is_nan() { f64::NAN } else { m.max(v.abs()) })
}
