//! Small dense matrices: Cholesky factor, eigenvectors and products of the library that factorises sparse ones, some times as fast as
//! nalgebra's at a hundred unknowns.

use crate::Error;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Accum, MatMut, MatRef, Par, Side};
use nalgebra::DMatrix;

fn view(matrix: &DMatrix<f64>) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(matrix.as_slice(), matrix.nrows(), matrix.ncols())
}

fn view_mut(matrix: &mut DMatrix<f64>) -> MatMut<'_, f64> {
    let (rows, columns) = matrix.shape();
    MatMut::from_column_major_slice_mut(matrix.as_mut_slice(), rows, columns)
}

/// Eigenvalues, increasing, and orthonormal eigenvectors (columns) of a dense symmetric matrix, whose lower triangle counts.
///
/// # Errors
/// [`Error::NotPositiveDefinite`] if the iteration does not end, as when an entry is not finite.
pub fn symmetric_eigen(matrix: &DMatrix<f64>) -> Result<(Vec<f64>, DMatrix<f64>), Error> {
    let n = matrix.nrows();
    let failed = |e| Error::NotPositiveDefinite { unknowns: n, detail: format!("no eigenvectors: {e:?}") };
    let eigen = view(matrix).self_adjoint_eigen(Side::Lower).map_err(failed)?;
    let (values, vectors) = (eigen.S(), eigen.U());
    Ok(((0..n).map(|i| values[i]).collect(), DMatrix::from_fn(n, n, |i, j| vectors[(i, j)])))
}

/// `A B`.
///
/// # Panics
/// If `A` has another number of columns than `B` has rows.
pub fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut result = DMatrix::zeros(a.nrows(), b.ncols());
    matmul(view_mut(&mut result), Accum::Replace, view(a), view(b), 1.0, Par::Seq);
    result
}

/// `Aᵀ B`.
///
/// # Panics
/// If `A` has another number of rows than `B`.
pub fn transposed_product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut result = DMatrix::zeros(a.ncols(), b.ncols());
    matmul(view_mut(&mut result), Accum::Replace, view(a).transpose(), view(b), 1.0, Par::Seq);
    result
}

/// `L` of a dense symmetric positive definite matrix `L Lᵀ`.
#[derive(Debug, Clone)]
pub struct DenseFactor {
    /// its lower triangle counts
    lower: DMatrix<f64>,
}

impl DenseFactor {
    /// Factorises `matrix`, whose lower triangle counts.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`].
    ///
    /// # Panics
    /// If the matrix is not square.
    pub fn new(mut matrix: DMatrix<f64>) -> Result<Self, Error> {
        let n = matrix.nrows();
        let mut memory = MemBuffer::new(cholesky_in_place_scratch::<f64>(n, Par::Seq, Default::default()));
        let stack = MemStack::new(&mut memory);
        cholesky_in_place(view_mut(&mut matrix), Default::default(), Par::Seq, stack, Default::default())
            .map_err(|e| Error::NotPositiveDefinite { unknowns: n, detail: format!("{e:?}") })?;
        Ok(Self { lower: matrix })
    }

    /// `L⁻¹` times every column.
    ///
    /// # Panics
    /// If `columns` has another number of rows than the matrix.
    #[must_use]
    pub fn forward(&self, mut columns: DMatrix<f64>) -> DMatrix<f64> {
        solve_lower_triangular_in_place(view(&self.lower), view_mut(&mut columns), Par::Seq);
        columns
    }

    /// `L⁻ᵀ` times every column.
    ///
    /// # Panics
    /// As [`Self::forward`].
    #[must_use]
    pub fn backward(&self, mut columns: DMatrix<f64>) -> DMatrix<f64> {
        solve_upper_triangular_in_place(view(&self.lower).transpose(), view_mut(&mut columns), Par::Seq);
        columns
    }

    /// Solves for every column.
    ///
    /// # Panics
    /// As [`Self::forward`].
    #[must_use]
    pub fn solve(&self, columns: DMatrix<f64>) -> DMatrix<f64> {
        self.backward(self.forward(columns))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some matrix of a size without symmetry.
    fn some(rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| ((7 * i + 13 * j * j + 3) as f64).sin())
    }

    #[test]
    fn exact_products_and_solutions() {
        for n in [1, 2, 7, 40] {
            let (a, b) = (some(n, n), some(n, 3));
            assert!((product(&a, &b) - &a * &b).amax() < 1e-12);
            assert!((transposed_product(&a, &b) - a.transpose() * &b).amax() < 1e-12);
            let matrix = &a * a.transpose() + DMatrix::identity(n, n);
            // what lies above the diagonal does not count
            let mut lower = matrix.clone();
            lower.fill_upper_triangle(f64::NAN, 1);
            let factor = DenseFactor::new(lower).expect("positive definite");
            assert!((&matrix * factor.solve(b.clone()) - &b).amax() < 1e-10);
            let half = factor.forward(b.clone());
            assert!((half.tr_mul(&half) - b.tr_mul(&factor.solve(b.clone()))).amax() < 1e-10);
            let (values, vectors) = symmetric_eigen(&matrix).expect("finite");
            assert!((&matrix * &vectors - &vectors * DMatrix::from_diagonal(&values.into())).amax() < 1e-10);
        }
    }

    #[test]
    fn what_is_not_positive_definite_is_refused() {
        assert!(matches!(DenseFactor::new(-DMatrix::identity(3, 3)), Err(Error::NotPositiveDefinite { unknowns: 3, .. })));
        assert!(DenseFactor::new(DMatrix::from_element(2, 2, f64::NAN)).is_err());
    }
}
