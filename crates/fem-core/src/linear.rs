//! Sparse Cholesky factorisation with a residual check: with [`crate::dense`] the only module that names the factorisation library.

use crate::{Error, SparseMatrix};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::solvers::Solve;
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::sparse::linalg::LltError;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Accum, Mat, MatMut, MatRef, Par, Side};
use nalgebra::DMatrix;

/// Largest backward error `‖b − A x‖ / (‖ |A| |x| ‖ + ‖b‖)` (maximum norms) that a solve may leave, after one step of iterative
/// refinement.
///
/// A correct factor leaves a few units of rounding (1e-15), whatever the condition number; a wrong one leaves of order one.
pub const BACKWARD_ERROR_LIMIT: f64 = 1e-12;

/// Largest relative error (maximum norm) with which a new factor may return a known solution.
///
/// The backward error of a singular system is small too: its solution only runs away along what nothing holds. A solution that
/// comes back this wrong belongs to a condition number above 1e13, where no digit of any result can be trusted.
pub const PROBE_ERROR_LIMIT: f64 = 1e-3;

/// Orderings and sizes of a Cholesky factor: computed once per sparsity pattern.
#[derive(Debug, Clone)]
pub struct SymbolicFactor {
    symbolic: SymbolicLlt<usize>,
    starts: Vec<usize>,
    indices: Vec<usize>,
}

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

/// A solution without symmetry, in \[1, 2): the fractional parts of multiples of the golden section.
pub(crate) fn probe(unknowns: usize) -> Vec<f64> {
    (0..unknowns).map(|i| 1.0 + (i as f64 * 0.618_033_988_749_894_9).fract()).collect()
}

/// Whether the known solution came back.
pub(crate) fn check_probe(found: &[f64], known: &[f64]) -> Result<(), Error> {
    let error = largest(&found.iter().zip(known).map(|(a, b)| a - b).collect::<Vec<_>>()) / 2.0;
    if error <= PROBE_ERROR_LIMIT {
        return Ok(());
    }
    let detail = format!("singular to rounding: a known solution came back with a relative error of {error:.1e}");
    Err(Error::NotPositiveDefinite { unknowns: known.len(), detail })
}

/// Whether a solve left no more than rounding explains; `size` is that of |A| |x| + |b|.
pub(crate) fn check_backward(residual: &[f64], size: f64) -> Result<(), Error> {
    let backward_error = largest(residual) / size;
    if size != 0.0 && (backward_error > BACKWARD_ERROR_LIMIT || backward_error.is_nan()) {
        return Err(Error::Residual { backward_error, limit: BACKWARD_ERROR_LIMIT, unknowns: residual.len() });
    }
    Ok(())
}

impl SymbolicFactor {
    /// Orders the unknowns of `matrix`.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`] if the matrix is not square or the ordering runs out of memory.
    pub fn new(matrix: &SparseMatrix) -> Result<Self, Error> {
        if matrix.rows() != matrix.columns() {
            return Err(not_positive_definite(matrix, format!("it has {} columns", matrix.columns())));
        }
        let symbolic = SymbolicLlt::try_new(structure(matrix), Side::Lower);
        let symbolic = symbolic.map_err(|e| not_positive_definite(matrix, format!("{e:?}")))?;
        let (starts, indices, _) = matrix.parts();
        Ok(Self { symbolic, starts: starts.to_vec(), indices: indices.to_vec() })
    }

    /// Factorises a matrix of the same pattern and checks the factor on a known solution.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`], also if the matrix is singular to rounding; [`Error::Residual`] if the factor does not
    /// solve, as when the matrix is not symmetric.
    ///
    /// # Panics
    /// If the pattern differs: a programming error, both matrices must come from the same [`crate::Pattern`].
    pub fn factor(&self, matrix: SparseMatrix) -> Result<Factor, Error> {
        let (starts, indices, values) = matrix.parts();
        assert!(starts == self.starts && indices == self.indices, "a matrix of the Pattern that was ordered");
        let numeric = SparseColMatRef::new(structure(&matrix), values);
        let cholesky = Llt::try_new_with_symbolic(self.symbolic.clone(), numeric, Side::Lower).map_err(|e| match e {
            LltError::Numeric(e) => not_positive_definite(&matrix, format!("{e:?}")),
            LltError::Generic(e) => not_positive_definite(&matrix, format!("{e:?}")),
        })?;
        let factor = Factor { matrix, cholesky };
        let known = probe(factor.unknowns());
        check_probe(&factor.solve(&[factor.matrix.multiply(&known)])?[0], &known)?;
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

    /// Solves for all right-hand sides without refinement and without a look at the residual: the factor was checked when it was made.
    pub(crate) fn substitute(&self, columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let n = self.unknowns();
        assert!(columns.iter().all(|c| c.len() == n), "right-hand sides of {n} entries");
        let rhs = Mat::from_fn(n, columns.len(), |i, j| columns[j][i]);
        let x = self.cholesky.solve(&rhs);
        (0..columns.len()).map(|j| (0..n).map(|i| x[(i, j)]).collect()).collect()
    }

    /// Solves for all right-hand sides (each of length [`Self::unknowns`]) together, refines once, checks each residual.
    ///
    /// # Errors
    /// [`Error::Residual`] if a backward error exceeds [`BACKWARD_ERROR_LIMIT`], as when a right-hand side is not finite.
    ///
    /// # Panics
    /// If a right-hand side has another length.
    pub fn solve(&self, rhs: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Error> {
        let residual =
            |x: &[f64], b: &[f64]| -> Vec<f64> { self.matrix.multiply(x).iter().zip(b).map(|(ax, b)| b - ax).collect() };
        let mut x = self.substitute(rhs);
        let left: Vec<_> = x.iter().zip(rhs).map(|(x, b)| residual(x, b)).collect();
        for (x, step) in x.iter_mut().zip(self.substitute(&left)) {
            x.iter_mut().zip(step).for_each(|(x, step)| *x += step);
        }
        for (x, b) in x.iter().zip(rhs) {
            check_backward(&residual(x, b), largest(&self.matrix.multiply_magnitudes(x)) + largest(b))?;
        }
        Ok(x)
    }
}

/// The first unknowns of a dense symmetric matrix, eliminated: `[L_ii; L_oi]` of `L Lᵀ`.
#[derive(Debug, Clone)]
pub(crate) struct PartialFactor {
    rows: usize,
    /// number of unknowns that are eliminated
    pub(crate) inner: usize,
    columns: Vec<f64>,
}

impl PartialFactor {
    /// Eliminates the first `inner` unknowns of `matrix`, whose lower triangle counts; returns the lower triangle of what is left,
    /// `K_oo − K_oi K_ii⁻¹ K_io`.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`].
    pub(crate) fn new(matrix: DMatrix<f64>, inner: usize) -> Result<(Self, DMatrix<f64>), Error> {
        let rows = matrix.nrows();
        let mut columns: Vec<f64> = matrix.data.into();
        let whole = MatMut::from_column_major_slice_mut(&mut columns, rows, rows);
        let (mut inside, _, mut across, mut outside) = whole.split_at_mut(inner, inner);
        let mut memory = MemBuffer::new(cholesky_in_place_scratch::<f64>(inner, Par::Seq, Default::default()));
        let stack = MemStack::new(&mut memory);
        cholesky_in_place(inside.as_mut(), Default::default(), Par::Seq, stack, Default::default())
            .map_err(|e| Error::NotPositiveDefinite { unknowns: rows, detail: format!("among elements: {e:?}") })?;
        solve_lower_triangular_in_place(inside.as_ref(), across.as_mut().transpose_mut(), Par::Seq);
        let (lower, full) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
        let (left, right) = (across.as_ref(), across.as_ref().transpose());
        triangular::matmul(outside.as_mut(), lower, Accum::Add, left, full, right, full, -1.0, Par::Seq);
        let left = DMatrix::from_fn(rows - inner, rows - inner, |i, j| outside[(i, j)]);
        columns.truncate(rows * inner);
        columns.shrink_to_fit();
        Ok((Self { rows, inner, columns }, left))
    }

    fn blocks(&self) -> (MatRef<'_, f64>, MatRef<'_, f64>) {
        MatRef::from_column_major_slice(&self.columns, self.rows, self.inner).split_at_row(self.inner)
    }

    /// `x_i ← L_ii⁻¹ x_i`, then `x_o ← x_o − L_oi x_i`, of every column of `x`.
    pub(crate) fn forward(&self, x: &mut DMatrix<f64>) {
        let (inside, across) = self.blocks();
        let (rows, columns) = x.shape();
        let whole = MatMut::from_column_major_slice_mut(x.as_mut_slice(), rows, columns);
        let (mut inner, outer) = whole.split_at_row_mut(self.inner);
        solve_lower_triangular_in_place(inside, inner.as_mut(), Par::Seq);
        matmul(outer, Accum::Add, across, inner.as_ref(), -1.0, Par::Seq);
    }

    /// `x_i ← L_ii⁻ᵀ (x_i − L_oiᵀ x_o)` of every column of `x`.
    pub(crate) fn backward(&self, x: &mut DMatrix<f64>) {
        let (inside, across) = self.blocks();
        let (rows, columns) = x.shape();
        let whole = MatMut::from_column_major_slice_mut(x.as_mut_slice(), rows, columns);
        let (mut inner, outer) = whole.split_at_row_mut(self.inner);
        matmul(inner.as_mut(), Accum::Add, across.transpose(), outer.as_ref(), -1.0, Par::Seq);
        solve_upper_triangular_in_place(inside.transpose(), inner, Par::Seq);
    }
}

/// Maximum norm; NaN if any entry is.
pub(crate) fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m: f64, v| if v.is_nan() || m.is_nan() { f64::NAN } else { m.max(v.abs()) })
}
