//! Whitened derivatives of the prediction by every unknown, with their products.

use nalgebra::{DMatrix, DVector};

/// A matrix J with a column of whitened derivatives for each unknown, and JᵀJ.
#[derive(Debug, Clone)]
pub(crate) struct Derivatives {
    pub(crate) jacobian: DMatrix<f64>,
    pub(crate) products: DMatrix<f64>,
}

impl Derivatives {
    pub(super) fn new(columns: &[DVector<f64>]) -> Self {
        let jacobian = DMatrix::from_columns(columns);
        Self { products: products(&jacobian), jacobian }
    }

    /// Replaces some columns by others.
    pub(super) fn put(&mut self, places: &[usize], columns: &[DVector<f64>]) {
        for (place, column) in places.iter().zip(columns) {
            self.jacobian.column_mut(*place).copy_from(column);
        }
        for (place, column) in places.iter().zip(columns) {
            let with_all = self.jacobian.tr_mul(column);
            self.products.row_mut(*place).copy_from(&with_all.transpose());
            self.products.column_mut(*place).copy_from(&with_all);
        }
    }
}

/// JᵀJ.
pub(crate) fn products(jacobian: &DMatrix<f64>) -> DMatrix<f64> {
    // a product of blocks is several times as fast as one of columns
    jacobian.transpose() * jacobian
}
