//! Fields on a lattice and their integrals over rectangles, strip by strip.

use super::section::Section;
use super::strip::{Op, Strip};
use crate::{Design, Error};
use fem_core::dense::product;
use nalgebra::{DMatrix, DVector};

/// Fields at the nodes of a lattice, one a column; r fastest.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Fields {
    pub(super) width: usize,
    pub(super) values: DMatrix<f64>,
}

impl Fields {
    /// Their values in a rectangle: one row a node, r fastest.
    fn within(&self, r: &Strip, y: &Strip) -> DMatrix<f64> {
        let (columns, rows) = (r.nodes(), y.nodes());
        DMatrix::from_fn(columns * rows, self.values.ncols(), |k, field| {
            self.values[((y.first + k / columns) * self.width + r.first + k % columns, field)]
        })
    }

    /// Their values on a line across y (`along` 0: the nodes of a strip along r) or across r (1), one row a node.
    fn on_line(&self, strip: &Strip, along: usize, line: usize) -> DMatrix<f64> {
        let place =
            |k: usize| if along == 0 { line * self.width + strip.first + k } else { (strip.first + k) * self.width + line };
        DMatrix::from_fn(strip.nodes(), self.values.ncols(), |k, field| self.values[(place(k), field)])
    }

    /// Combinations of them, one a column of `of`.
    pub(super) fn combined(&self, of: &DMatrix<f64>) -> Self {
        Self { width: self.width, values: &self.values * of }
    }

    /// A functional of a lattice's field, applied to each.
    pub(super) fn apply(&self, functional: &[f64]) -> DVector<f64> {
        self.values.tr_mul(&DVector::from_column_slice(functional))
    }
}

/// An integral over a rectangle: its fields (numbers of components), and its matrices along r and y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kind {
    /// Components of rows and columns.
    pub(super) of: [usize; 2],
    pub(super) r: Op,
    pub(super) y: Op,
}

/// The integrals `kinds` over a rectangle of all pairs of `rows` and `columns`, each a list of components; those between different
/// components of a symmetric form (`symmetric`) with their transposes.
pub(super) fn integrals(
    kinds: &[Kind],
    rows: &[&Fields],
    columns: &[&Fields],
    [r, y]: [&Strip; 2],
    symmetric: bool,
) -> Vec<DMatrix<f64>> {
    let left: Vec<DMatrix<f64>> = rows.iter().map(|f| f.within(r, y).transpose()).collect();
    let right: Vec<DMatrix<f64>> = columns.iter().map(|f| f.within(r, y)).collect();
    kinds
        .iter()
        .map(|kind| {
            let integral = &left[kind.of[0]] * both(&right[kind.of[1]], &r.matrix(kind.r), &y.matrix(kind.y));
            if symmetric && kind.of[0] != kind.of[1] { &integral + integral.transpose() } else { integral }
        })
        .collect()
}

/// The sum of the integrals `kinds` with `coefficients` over a rectangle, of all pairs of `fields` (a list of components), symmetric.
pub(super) fn inner_products(kinds: &[Kind], coefficients: &[f64], fields: &[&Fields], [r, y]: [&Strip; 2]) -> DMatrix<f64> {
    let within: Vec<DMatrix<f64>> = fields.iter().map(|f| f.within(r, y)).collect();
    let count = within[0].ncols();
    let mut sum = DMatrix::zeros(count, count);
    for (row, left) in within.iter().enumerate() {
        let mut image = DMatrix::zeros(left.nrows(), count);
        for (kind, c) in kinds.iter().zip(coefficients).filter(|(kind, c)| kind.of[0] == row && **c != 0.0) {
            // those between different components stand for their transposes, too
            let twice = if kind.of[0] == kind.of[1] { 1.0 } else { 2.0 };
            image += both(&within[kind.of[1]], &r.matrix(kind.r), &y.matrix(kind.y)) * (c * twice);
        }
        sum += left.transpose() * image;
    }
    (&sum + sum.transpose()) / 2.0
}

/// `(Y ⊗ R)` times each column.
fn both(fields: &DMatrix<f64>, r: &DMatrix<f64>, y: &DMatrix<f64>) -> DMatrix<f64> {
    let (columns, rows, count) = (r.nrows(), y.nrows(), fields.ncols());
    let along_r = r * fields.clone().reshape_generic(nalgebra::Dyn(columns), nalgebra::Dyn(rows * count));
    let mut result = DMatrix::zeros(columns * rows, count);
    let across = y.transpose();
    for field in 0..count {
        let block = along_r.columns(field * rows, rows) * &across;
        result.column_mut(field).copy_from_slice(block.as_slice());
    }
    result
}

/// The integral along a line of all pairs of `fields`: the nodes of `strip` along r (0) or y (1).
pub(super) fn edge_integral(op: Op, fields: &Fields, strip: &Strip, along: usize, line: usize) -> DMatrix<f64> {
    let values = fields.on_line(strip, along, line);
    values.transpose() * (strip.matrix(op) * &values)
}

/// A sum of matrices with coefficients that a design gives, and the few combinations of them that a box of designs needs.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Terms {
    shape: (usize, usize),
    /// whether the lower triangles stand for the matrices
    symmetric: bool,
    /// entries of each matrix, one a column
    entries: DMatrix<f64>,
    /// coefficients of the kept matrices from those of the integrals, once compressed
    onto: Option<DMatrix<f64>>,
    /// sizes of the integrals
    sizes: Vec<f64>,
}

/// Combinations of coefficients below this, relative to the largest, are left out: their distance to the designs of the box is checked.
const LEAST_TERM: f64 = 1e-13;

impl Terms {
    /// A sum of matrices of one shape, or 0 × 0 for nothing.
    pub(super) fn new(matrices: Vec<DMatrix<f64>>, symmetric: bool) -> Self {
        let sizes: Vec<f64> = matrices.iter().map(DMatrix::norm).collect();
        let shape @ (rows, columns) = matrices.iter().map(DMatrix::shape).max().unwrap_or((0, 0));
        let first = |column: usize| if symmetric { column } else { 0 };
        let mut entries = DMatrix::zeros((0..columns).map(|j| rows - first(j)).sum(), matrices.len());
        for (matrix, mut entries) in matrices.iter().zip(entries.column_iter_mut()).filter(|(m, _)| !m.is_empty()) {
            let all = (0..columns).flat_map(|j| matrix.column(j).into_iter().skip(first(j)));
            entries.iter_mut().zip(all).for_each(|(entry, value)| *entry = *value);
        }
        Self { shape, symmetric, entries, onto: None, sizes }
    }

    /// Numbers that it holds.
    pub(super) fn numbers(&self) -> usize {
        self.entries.len() + self.onto.as_ref().map_or(0, DMatrix::len)
    }

    /// Shape of the sum.
    pub(super) fn shape(&self) -> (usize, usize) {
        self.shape
    }

    /// The same on the combinations that the coefficients of `samples` (one a column) span.
    pub(super) fn compressed(&self, samples: &DMatrix<f64>) -> Self {
        let mut scaled = samples.clone();
        for (mut row, size) in scaled.row_iter_mut().zip(&self.sizes) {
            row *= *size;
        }
        // each sample counts alike, whatever the size of its coefficients
        for mut column in scaled.column_iter_mut() {
            let norm = column.norm();
            column.unscale_mut(norm.max(f64::MIN_POSITIVE));
        }
        let svd = scaled.svd(true, false);
        let largest = svd.singular_values.max();
        let all = svd.u.expect("left vectors were asked for");
        let kept: Vec<usize> =
            (0..svd.singular_values.len()).filter(|&i| svd.singular_values[i] > LEAST_TERM * largest).collect();
        let count = self.sizes.len();
        let weight = |i: usize, k: usize| if self.sizes[i] > 0.0 { all[(i, kept[k])] / self.sizes[i] } else { 0.0 };
        let onto = DMatrix::from_fn(kept.len(), count, |k, i| all[(i, kept[k])] * self.sizes[i]);
        let entries = product(&self.entries, &DMatrix::from_fn(count, kept.len(), weight));
        Self { entries, onto: Some(onto), sizes: self.sizes.clone(), ..*self }
    }

    /// Σ cᵢ Mᵢ.
    pub(super) fn sum(&self, coefficients: &[f64]) -> DMatrix<f64> {
        let given = DMatrix::from_column_slice(coefficients.len(), 1, coefficients);
        let sum = match &self.onto {
            Some(onto) => product(&self.entries, &product(onto, &given)),
            None => product(&self.entries, &given),
        };
        let (rows, columns) = self.shape;
        if !self.symmetric {
            return sum.reshape_generic(nalgebra::Dyn(rows), nalgebra::Dyn(columns));
        }
        let mut matrix = DMatrix::zeros(rows, columns);
        let mut entries = sum.iter();
        for j in 0..columns {
            for (i, value) in (j..rows).zip(&mut entries) {
                (matrix[(i, j)], matrix[(j, i)]) = (*value, *value);
            }
        }
        matrix
    }

    /// How far coefficients are from those that were kept, relative to their size: 0 within the box.
    pub(super) fn left_out(&self, coefficients: &[f64]) -> f64 {
        let Some(onto) = &self.onto else { return 0.0 };
        let size: f64 = coefficients.iter().zip(&self.sizes).map(|(c, s)| (c * s).powi(2)).sum();
        let kept = (onto * DVector::from_column_slice(coefficients)).norm_squared();
        if size > 0.0 { ((size - kept).max(0.0) / size).sqrt() } else { 0.0 }
    }
}

/// Designs with their sections over which something is differenced, each with its weight.
pub(super) type Stencil = [(f64, Design, Section)];

/// Weighted sums of two lists of coefficients over a stencil; `None` for one that sums to nothing.
pub(super) fn combined(
    stencil: &Stencil,
    of: impl Fn(&Design, &Section) -> Result<[Vec<f64>; 2], Error>,
) -> Result<[Option<Vec<f64>>; 2], Error> {
    let mut sums: [Vec<f64>; 2] = Default::default();
    for (weight, design, section) in stencil {
        for (sum, coefficients) in sums.iter_mut().zip(of(design, section)?) {
            sum.resize(coefficients.len(), 0.0);
            sum.iter_mut().zip(coefficients).for_each(|(sum, c)| *sum += weight * c);
        }
    }
    Ok(sums.map(|sum| Some(sum).filter(|sum| sum.iter().any(|c| *c != 0.0))))
}
