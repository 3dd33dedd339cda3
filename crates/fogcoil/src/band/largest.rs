//! The largest |rate| of a course, over units that differ within their tolerances.

use nalgebra::DMatrix;

use crate::sweep::{Points, Sampling, Spread};
use crate::variants::normal;

/// Units that are drawn, evenly in probability: their mean and standard deviation are known to about a per cent of the latter.
const UNITS: usize = 2048;
const SEED: u64 = 0;
/// Rows that are computed at a time.
const ROWS: usize = 256;

/// Spread of the largest |rate| over units: from the `rates` of the drawing in every row and their `changes` by one standard deviation of each number,
/// which go together as their `correlation` says. `None` without a row.
pub(super) fn largest(rates: &[f64], changes: &[&[f64]], correlation: &DMatrix<f64>) -> Option<Spread> {
    let units = units(correlation);
    let mut largest = vec![0.0_f64; UNITS];
    for (block, rates) in rates.chunks(ROWS).enumerate() {
        let by_number = DMatrix::from_fn(rates.len(), changes.len(), |n, k| changes[k][block * ROWS + n]);
        let by_unit = by_number * &units;
        for (most, changed) in largest.iter_mut().zip(by_unit.column_iter()) {
            *most = rates.iter().zip(changed.iter()).fold(*most, |most, (rate, by)| most.max((rate + by).abs()));
        }
    }
    (!rates.is_empty()).then(|| Spread::of("largest |rate|", largest)).flatten()
}

/// Deviations of the numbers of every unit, a column each, in standard deviations.
fn units(correlation: &DMatrix<f64>) -> DMatrix<f64> {
    let numbers = correlation.nrows();
    let points = Points::new(Sampling::Sobol(UNITS), SEED, vec![0; numbers], (0..numbers).collect());
    let alone = DMatrix::from_iterator(numbers, UNITS, (0..UNITS).flat_map(|unit| points.point(unit)).map(normal));
    match correlation.clone().cholesky() {
        Some(factor) => factor.l() * alone,
        None => alone,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn exact_a_rate_about_zero_and_one_that_another_row_overtakes() {
        let independent = DMatrix::identity(2, 2);
        // |x| of a normal x: mean sqrt(2/pi), variance 1 - 2/pi
        let one = largest(&[0.0], &[&[2.0], &[0.0]], &independent).expect("a row");
        assert!((one.mean / (2.0 * (2.0 / PI).sqrt()) - 1.0).abs() < 2e-3, "{one:?}");
        assert!((one.sd / (2.0 * (1.0 - 2.0 / PI).sqrt()) - 1.0).abs() < 5e-3, "{one:?}");
        // the larger of two normal numbers about 10: mean 10 + 1/sqrt(pi), variance 1 - 1/pi; of two that are nearly one, those of one
        let changes: [&[f64]; 2] = [&[1.0, 0.0], &[0.0, 1.0]];
        let two = largest(&[10.0, -10.0], &changes, &independent).expect("rows");
        assert!((two.mean - 10.0 - 1.0 / PI.sqrt()).abs() < 2e-3, "{two:?}");
        assert!((two.sd / (1.0 - 1.0 / PI).sqrt() - 1.0).abs() < 5e-3, "{two:?}");
        let together = DMatrix::from_row_slice(2, 2, &[1.0, 0.999_999, 0.999_999, 1.0]);
        let same = largest(&[10.0, 10.0], &changes, &together).expect("rows");
        assert!((same.mean - 10.0).abs() < 3e-3 && (same.sd - 1.0).abs() < 5e-3, "{same:?}");
        assert_eq!(largest(&[], &[], &DMatrix::identity(0, 0)), None);
        // nothing varies, and more rows than are computed at a time
        let still = largest(&vec![-3.0; 2 * ROWS + 1], &[], &DMatrix::identity(0, 0)).expect("rows");
        assert_eq!((still.mean, still.sd), (3.0, 0.0));
    }
}
