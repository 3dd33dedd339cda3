//! Least squares on whitened columns.

use nalgebra::{DMatrix, DVector};

/// The best combination of columns in a series, and what is left without it.
pub(super) struct Regression {
    /// Squared norm of what is left.
    pub(super) squares: f64,
    /// ln det(AᵀA) of the columns.
    pub(super) log_det: f64,
    /// Amount of every column in the series.
    pub(super) amounts: DVector<f64>,
    /// R of the columns' QR factors.
    upper: DMatrix<f64>,
}

impl Regression {
    /// By Householder's QR factors of the columns, which are independent (see [`independent`]) and no more than there are rows.
    pub(super) fn new(columns: Vec<Vec<f64>>, series: Vec<f64>) -> Self {
        let (rows, count) = (series.len(), columns.len());
        let factors = DMatrix::from_vec(rows, count, columns.concat()).qr();
        let mut rotated = DVector::from_vec(series);
        factors.q_tr_mul(&mut rotated);
        let upper = factors.r();
        let amounts = upper.solve_upper_triangular(&rotated.rows(0, count).into_owned());
        Self {
            squares: rotated.rows_range(count..).norm_squared(),
            log_det: upper.diagonal().iter().map(|d| 2.0 * d.abs().ln()).sum(),
            amounts: amounts.unwrap_or_else(|| DVector::repeat(count, f64::NAN)),
            upper,
        }
    }

    /// Covariance (AᵀA)⁻¹ of the amounts.
    pub(super) fn covariance(&self) -> DMatrix<f64> {
        let count = self.upper.nrows();
        let inverse = self.upper.solve_upper_triangular(&DMatrix::identity(count, count));
        inverse.map_or_else(|| DMatrix::repeat(count, count, f64::NAN), |inverse| &inverse * inverse.transpose())
    }
}

/// Norm of a column, relative to what it had before the others were taken away, below which it is their combination.
const DEPENDENT: f64 = 1e-9;

/// Numbers of the columns that are no combination of those before them.
pub(super) fn independent(columns: &[Vec<f64>]) -> Vec<usize> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    let mut kept = Vec::new();
    for (number, column) in columns.iter().enumerate() {
        let mut rest = DVector::from_column_slice(column);
        let norm = rest.norm();
        // twice: orthogonal to rounding
        for unit in basis.iter().chain(&basis) {
            rest.axpy(-unit.dot(&rest), unit, 1.0);
        }
        if rest.norm() > DEPENDENT * norm {
            basis.push(rest.normalize());
            kept.push(number);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_and_its_double() {
        let line: Vec<f64> = (0..9).map(f64::from).collect();
        let columns = vec![vec![1.0; 9], line.clone(), line.iter().map(|x| 3.0 - 2.0 * x).collect(), vec![0.0; 9]];
        assert_eq!(independent(&columns), [0, 1]);
        // y = 2 + x + (+1, −1, +1, …) as far as that is no line
        let series: Vec<f64> = (0..9_i32).map(|i| 2.0 + f64::from(i) + f64::from(1 - 2 * (i % 2))).collect();
        let regression = Regression::new(columns[..2].to_vec(), series);
        assert!((regression.squares - (9.0 - 1.0 / 9.0)).abs() < 1e-12, "{}", regression.squares);
        assert!((regression.log_det - (9.0_f64 * 60.0).ln()).abs() < 1e-12, "{}", regression.log_det);
        assert!((regression.amounts[0] - (2.0 + 1.0 / 9.0)).abs() < 1e-12 && (regression.amounts[1] - 1.0).abs() < 1e-12);
        // the slope's variance is 1 / Σ (x − x̄)² = 1 / 60
        assert!((regression.covariance()[(1, 1)] * 60.0 - 1.0).abs() < 1e-12, "{}", regression.covariance());
    }

    #[test]
    fn without_columns_all_is_left() {
        let regression = Regression::new(Vec::new(), vec![3.0, 4.0]);
        assert_eq!((regression.squares, regression.log_det, regression.amounts.len()), (25.0, 0.0, 0));
    }
}
