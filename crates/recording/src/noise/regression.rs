//! Least squares on whitened columns.

/// What is left of a series when its best combination of columns is taken away.
pub(super) struct Regression {
    /// Squared norm of what is left, over the first `rows` entries.
    pub(super) squares: f64,
    /// ln det(AᵀA) of the columns' first entries.
    pub(super) log_det: f64,
    /// What is left: all entries.
    pub(super) rest: Vec<f64>,
}

impl Regression {
    /// By modified Gram–Schmidt over the first `rows` entries; what follows them is carried along.
    ///
    /// The columns are independent (see [`independent`]).
    pub(super) fn new(mut columns: Vec<Vec<f64>>, mut series: Vec<f64>, rows: usize) -> Self {
        let mut log_det = 0.0;
        while let Some(mut column) = columns.pop() {
            let norm = dot(&column[..rows], &column[..rows]).sqrt();
            log_det += 2.0 * norm.ln();
            column.iter_mut().for_each(|value| *value /= norm);
            columns.iter_mut().for_each(|other| remove(&column, other, rows));
            remove(&column, &mut series, rows);
        }
        Self { squares: dot(&series[..rows], &series[..rows]), log_det, rest: series }
    }
}

/// Norm of a column, relative to what it had before the others were taken away, below which it is their combination.
const DEPENDENT: f64 = 1e-9;

/// Numbers of the columns that are no combination of those before them.
pub(super) fn independent(columns: &[Vec<f64>]) -> Vec<usize> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut kept = Vec::new();
    for (number, column) in columns.iter().enumerate() {
        let mut rest = column.clone();
        for _ in 0..2 {
            basis.iter().for_each(|unit| remove(unit, &mut rest, column.len())); // twice: orthogonal to rounding
        }
        let norm = dot(&rest, &rest).sqrt();
        if norm > DEPENDENT * dot(column, column).sqrt() {
            rest.iter_mut().for_each(|value| *value /= norm);
            basis.push(rest);
            kept.push(number);
        }
    }
    kept
}

/// Takes a unit vector's share, judged over the first `rows` entries, from all entries.
fn remove(unit: &[f64], from: &mut [f64], rows: usize) {
    let share = dot(&unit[..rows], &from[..rows]);
    from.iter_mut().zip(unit).for_each(|(value, direction)| *value -= share * direction);
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Inverse of a symmetric positive definite matrix by Cholesky; `None` if it is not positive definite.
pub(super) fn inverse(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = matrix.len();
    let mut lower = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let rest = matrix[i][j] - (0..j).map(|k| lower[i][k] * lower[j][k]).sum::<f64>();
            lower[i][j] = if i == j { Some(rest.sqrt()).filter(|root| *root > 0.0)? } else { rest / lower[j][j] };
        }
    }
    let column = |unit: usize| {
        let mut x = vec![0.0; n];
        for i in 0..n {
            x[i] = (f64::from(u8::from(i == unit)) - (0..i).map(|k| lower[i][k] * x[k]).sum::<f64>()) / lower[i][i];
        }
        for i in (0..n).rev() {
            x[i] = (x[i] - (i + 1..n).map(|k| lower[k][i] * x[k]).sum::<f64>()) / lower[i][i];
        }
        x
    };
    Some((0..n).map(column).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inverse_is_one() {
        let matrix = vec![vec![4.0, 1.0, 0.5], vec![1.0, 3.0, -0.2], vec![0.5, -0.2, 2.0]];
        let inverse = inverse(&matrix).unwrap();
        let product = |i: usize, j: usize| (0..3).map(|k| matrix[i][k] * inverse[k][j]).sum::<f64>();
        assert!((0..9).all(|ij| (product(ij / 3, ij % 3) - f64::from(u8::from(ij / 3 == ij % 3))).abs() < 1e-14));
        assert!(super::inverse(&[vec![1.0, 2.0], vec![2.0, 1.0]]).is_none());
    }

    #[test]
    fn a_straight_line_and_its_double() {
        let line: Vec<f64> = (0..9).map(f64::from).collect();
        let columns = vec![vec![1.0; 9], line.clone(), line.iter().map(|x| 3.0 - 2.0 * x).collect(), vec![0.0; 9]];
        assert_eq!(independent(&columns), [0, 1]);
        // y = 2 + x + (+1, −1, +1, …) as far as that is no line
        let series: Vec<f64> = (0..9_i32).map(|i| 2.0 + f64::from(i) + f64::from(1 - 2 * (i % 2))).collect();
        let regression = Regression::new(columns[..2].to_vec(), series, 9);
        assert!((regression.squares - (9.0 - 1.0 / 9.0)).abs() < 1e-12, "{}", regression.squares);
        assert!((regression.log_det - (9.0_f64 * 60.0).ln()).abs() < 1e-12, "{}", regression.log_det);
    }
}
