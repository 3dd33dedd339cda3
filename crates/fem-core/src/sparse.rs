//! Sparse matrices in compressed columns, assembled from element matrices on a pattern that is built once.

use crate::{DofMap, Mesh};
use nalgebra::DMatrix;
use sprs::CsMat;

/// A sparse matrix in compressed sparse columns.
#[derive(Debug, Clone, PartialEq)]
pub struct SparseMatrix(CsMat<f64>);

impl SparseMatrix {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.0.rows()
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.0.cols()
    }

    /// Number of stored entries.
    pub fn stored(&self) -> usize {
        self.0.nnz()
    }

    /// Column starts, row numbers and values.
    pub fn parts(&self) -> (&[usize], &[usize], &[f64]) {
        (self.0.indptr().into_raw_storage(), self.0.indices(), self.0.data())
    }

    /// A x.
    ///
    /// # Panics
    /// If `x` has not one entry for each column.
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.rows()];
        sprs::prod::mul_acc_mat_vec_csc(self.0.view(), x, &mut y);
        y
    }

    /// Aᵀ x.
    ///
    /// # Panics
    /// If `x` has not one entry for each row.
    pub fn multiply_transposed(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.columns()];
        sprs::prod::mul_acc_mat_vec_csr(self.0.transpose_view(), x, &mut y);
        y
    }

    /// |A| |x|: the scale of rounding in [`Self::multiply`].
    pub fn multiply_magnitudes(&self, x: &[f64]) -> Vec<f64> {
        let (starts, rows, values) = self.parts();
        let mut y = vec![0.0; self.rows()];
        for (range, x) in starts.windows(2).zip(x) {
            for k in range[0]..range[1] {
                y[rows[k]] += (values[k] * x).abs();
            }
        }
        y
    }

    /// Whether two matrices have their entries in the same places.
    pub(crate) fn has_pattern_of(&self, other: &Self) -> bool {
        let ((starts, indices, _), (of_starts, of_indices, _)) = (self.parts(), other.parts());
        self.rows() == other.rows() && starts == of_starts && indices == of_indices
    }

    /// α A + β B of two matrices on the same pattern.
    ///
    /// # Panics
    /// If the patterns differ: a programming error, both must come from the same [`Pattern`].
    pub fn combine(alpha: f64, a: &Self, beta: f64, b: &Self) -> Self {
        assert!(a.has_pattern_of(b), "matrices of one Pattern");
        let mut sum = a.clone();
        for (s, b) in sum.0.data_mut().iter_mut().zip(b.0.data()) {
            *s = alpha * *s + beta * b;
        }
        sum
    }
}

/// Reduced unknowns and factors of one element, component fastest.
pub(crate) type ElementDofs = Vec<Option<(usize, f64)>>;

pub(crate) fn element_dofs(mesh: &Mesh, map: &DofMap) -> Vec<ElementDofs> {
    let components = map.full() / mesh.nodes().len().max(1);
    let of_node = |node: &usize| (0..components).map(move |c| map.get(node * components + c)).collect::<Vec<_>>();
    mesh.elements().iter().map(|element| element.iter().flat_map(of_node).collect()).collect()
}

/// Pattern of the entries of the matrix that can be non-zero, with the places of each element's entries: symbolic once, numeric often.
#[derive(Debug, Clone)]
pub struct Pattern {
    rows: usize,
    row_dofs: Vec<ElementDofs>,
    /// for each column: (element, local column, factor)
    incidence: Vec<Vec<(usize, usize, f64)>>,
    starts: Vec<usize>,
    indices: Vec<usize>,
}

impl Pattern {
    /// Pattern of a square matrix on `mesh` with the unknowns of `map`, counting only elements for which `active` holds.
    pub fn new(mesh: &Mesh, map: &DofMap, active: impl Fn(usize) -> bool) -> Self {
        Self::rectangular(mesh, map, map, active)
    }

    /// Pattern of a matrix whose rows are the unknowns of one map and whose columns those of another.
    pub fn rectangular(mesh: &Mesh, rows: &DofMap, columns: &DofMap, active: impl Fn(usize) -> bool) -> Self {
        let row_dofs = element_dofs(mesh, rows);
        let mut incidence = vec![Vec::new(); columns.reduced()];
        for (e, dofs) in element_dofs(mesh, columns).iter().enumerate().filter(|(e, _)| active(*e)) {
            for (local, dof) in dofs.iter().enumerate() {
                if let Some((column, factor)) = dof {
                    incidence[*column].push((e, local, *factor));
                }
            }
        }
        let mut seen = vec![usize::MAX; rows.reduced()];
        let (mut starts, mut indices) = (vec![0], Vec::new());
        for (column, elements) in incidence.iter().enumerate() {
            let begin = indices.len();
            for (e, _, _) in elements {
                for (row, _) in row_dofs[*e].iter().flatten() {
                    if seen[*row] != column {
                        seen[*row] = column;
                        indices.push(*row);
                    }
                }
            }
            indices[begin..].sort_unstable();
            starts.push(indices.len());
        }
        Self { rows: rows.reduced(), row_dofs, incidence, starts, indices }
    }

    /// Sums the element matrices (one per element of the mesh; those of inactive elements are not read).
    pub fn assemble(&self, element_matrices: &[DMatrix<f64>]) -> SparseMatrix {
        let mut values = vec![0.0; self.indices.len()];
        let mut position = vec![0; self.rows];
        for (column, elements) in self.incidence.iter().enumerate() {
            let range = self.starts[column]..self.starts[column + 1];
            for (k, &row) in range.clone().zip(&self.indices[range]) {
                position[row] = k;
            }
            for &(e, local, factor) in elements {
                let entries = element_matrices[e].column(local);
                for (dof, value) in self.row_dofs[e].iter().zip(entries.iter()) {
                    if let Some((row, row_factor)) = dof {
                        values[position[*row]] += factor * row_factor * value;
                    }
                }
            }
        }
        let shape = (self.rows, self.incidence.len());
        SparseMatrix(CsMat::new_csc(shape, self.starts.clone(), self.indices.clone(), values))
    }
}
