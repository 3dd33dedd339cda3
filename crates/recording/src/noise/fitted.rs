//! Amount of each column in a series, by generalised least squares under a noise model.

use nalgebra::{DMatrix, DVector};

use super::data::{Data, Series};
use super::regression::Regression;
use super::{NoiseModel, Whitener};
use crate::Error;

/// Amounts of columns and their covariance.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The columns that are no combination of those before them.
    numbers: Vec<usize>,
    amounts: DVector<f64>,
    covariance: DMatrix<f64>,
}

/// The best amounts of a series' columns under a model of its noise (Aitken 1935), which is taken as known.
///
/// # Errors
/// As [`super::identify`].
pub fn fitted(series: &Series, model: &NoiseModel) -> Result<Fitted, Error> {
    fitted_within(series, model, &[])
}

/// The same where sums of amounts, each given by numbers of columns and weights, are known beforehand to be 0 within a standard deviation of 1.
///
/// # Errors
/// As [`super::identify`].
pub fn fitted_within(series: &Series, model: &NoiseModel, known: &[Vec<(usize, f64)>]) -> Result<Fitted, Error> {
    let data = Data::new(series)?;
    let whitener = Whitener::new(&data.model(model), &data.time, &data.mask)?;
    // each is a row below the series'
    let in_row = |row: &Vec<(usize, f64)>, number: usize| -> f64 {
        row.iter().filter(|(other, _)| *other == number).map(|(_, weight)| weight).sum()
    };
    let of = |(number, column): (&usize, &Vec<f64>)| -> Vec<f64> {
        whitener.apply(column).into_iter().chain(known.iter().map(|row| in_row(row, *number))).collect()
    };
    let columns = data.numbers.iter().zip(&data.columns).map(of).collect();
    let values = whitener.apply(&data.values).into_iter().chain(known.iter().map(|_| 0.0)).collect();
    let regression = Regression::new(columns, values);
    let covariance = regression.covariance();
    Ok(Fitted { numbers: data.numbers, amounts: regression.amounts, covariance })
}

impl Fitted {
    /// A weighted sum of amounts, given by number of the column and weight, and its standard deviation.
    ///
    /// `None` where a column with a weight is a combination of those before it: the series does not tell its amount.
    pub fn sum(&self, weights: &[(usize, f64)]) -> Option<(f64, f64)> {
        let mut along = DVector::zeros(self.numbers.len());
        for (number, weight) in weights.iter().filter(|(_, weight)| *weight != 0.0) {
            along[self.numbers.iter().position(|kept| kept == number)?] += weight;
        }
        let variance = along.dot(&(&self.covariance * &along));
        let (value, sd) = (self.amounts.dot(&along), variance.sqrt());
        (value.is_finite() && sd.is_finite()).then_some((value, sd))
    }
}
