//! Checks of series that every routine asks for.

use crate::Error;
use crate::statistics::median;

/// Longest interval between rows that are neighbours, in usual intervals: beyond it a row is missing.
pub(crate) const GAP: f64 = 1.5;

/// Median time between rows \[s\]; `None` of fewer than two.
pub fn median_interval(time: &[f64]) -> Option<f64> {
    median(time.windows(2).map(|pair| pair[1] - pair[0]).collect())
}

pub(crate) fn check_time(time: &[f64]) -> Result<(), Error> {
    let mut previous = f64::NEG_INFINITY;
    for (row, &instant) in time.iter().enumerate() {
        if !(instant.is_finite() && instant > previous) {
            return Err(Error::Time { row, time: instant, previous });
        }
        previous = instant;
    }
    Ok(())
}

/// Checks that a series has one value for each instant.
pub(crate) fn check_length(name: &str, found: usize, expected: usize) -> Result<(), Error> {
    if found == expected { Ok(()) } else { Err(Error::Length { name: name.to_owned(), found, expected }) }
}

/// Checks instants, mask and series, finite where they are used; the number of rows used.
pub(crate) fn check_series(time: &[f64], mask: &[bool], series: &[(&str, &[f64])]) -> Result<usize, Error> {
    check_time(time)?;
    check_length("mask", mask.len(), time.len())?;
    for (name, values) in series {
        check_length(name, values.len(), time.len())?;
        if let Some(row) = (0..time.len()).find(|&row| mask[row] && !values[row].is_finite()) {
            return Err(Error::Value { name: (*name).to_owned(), row, value: values[row] });
        }
    }
    Ok(mask.iter().filter(|&&used| used).count())
}
