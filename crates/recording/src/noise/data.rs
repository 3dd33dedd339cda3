//! A series made ready: checked, and long ones as means over groups of rows, for which the model stays exact.

use super::NoiseModel;
use super::regression::independent;
use crate::Error;
use crate::series::{self, GAP, check_series};

/// Most rows before groups of them are averaged: white noise is then known to half a percent, and a fit takes a second.
const MOST_ROWS: usize = 20_000;
const FEWEST_ROWS: usize = 16;

/// A series whose noise is sought.
#[derive(Debug, Clone, Copy)]
pub struct Series<'a> {
    /// Instants, increasing \[s\].
    pub time: &'a [f64],
    /// Values \[u\].
    pub values: &'a [f64],
    /// Rows that are used; of others no value is read.
    pub mask: &'a [bool],
    /// Terms besides noise that the series may hold, each in an unknown amount: an offset, a trend, the columns of a Jacobian. [`super::identify`] lets it
    /// have an offset in any case, the other functions only where it is among these.
    pub columns: &'a [&'a [f64]],
}

/// A series with its independent columns, perhaps thinned.
pub(super) struct Data {
    pub(super) time: Vec<f64>,
    pub(super) mask: Vec<bool>,
    pub(super) values: Vec<f64>,
    /// Columns of the original that are no combination of those before them, and their numbers there.
    pub(super) columns: Vec<Vec<f64>>,
    pub(super) numbers: Vec<usize>,
    /// Rows of the original in one of these.
    pub(super) group: usize,
    /// Median time between the original's rows \[s\].
    pub(super) interval: f64,
}

impl Data {
    pub(super) fn new(series: &Series) -> Result<Self, Error> {
        Self::beside(series, series.columns)
    }

    /// The same with an offset, unless the columns make one.
    pub(super) fn with_offset(series: &Series) -> Result<Self, Error> {
        let one = vec![1.0; series.time.len()];
        Self::beside(series, &[series.columns, &[&one]].concat())
    }

    fn beside(series: &Series, columns: &[&[f64]]) -> Result<Self, Error> {
        let Series { time, values, mask, .. } = *series;
        let names: Vec<String> = (0..columns.len()).map(|i| format!("column {i}")).collect();
        let named = names.iter().map(String::as_str).zip(columns.iter().copied());
        let used = check_series(time, mask, &std::iter::once(("values", values)).chain(named).collect::<Vec<_>>())?;
        let needed = FEWEST_ROWS + series.columns.len();
        let Some(interval) = series::median_interval(time).filter(|_| used >= needed) else {
            return Err(Error::TooFew { found: used, needed });
        };
        let group = used.div_ceil(MOST_ROWS);
        let starts = if group > 1 { groups(time, mask, group, interval) } else { Vec::new() };
        // a mask so ragged that few groups are complete leaves the series as it is
        let mut data = if starts.len() >= MOST_ROWS / 4 {
            let means = |series: &[f64]| -> Vec<f64> {
                starts.iter().map(|&first| series[first..first + group].iter().sum::<f64>() / group as f64).collect()
            };
            let ends = starts.iter().map(|&first| time[first + group - 1]).collect();
            Self::of(ends, vec![true; starts.len()], group, interval, means, values, columns)
        } else {
            // masked rows hold 0, so that no arithmetic meets what they held
            let clean = |series: &[f64]| series.iter().zip(mask).map(|(value, used)| if *used { *value } else { 0.0 }).collect();
            Self::of(time.to_vec(), mask.to_vec(), 1, interval, clean, values, columns)
        };
        data.numbers = independent(&data.columns);
        data.columns = data.numbers.iter().map(|&number| std::mem::take(&mut data.columns[number])).collect();
        Ok(data)
    }

    fn of(
        time: Vec<f64>,
        mask: Vec<bool>,
        group: usize,
        interval: f64,
        take: impl Fn(&[f64]) -> Vec<f64>,
        values: &[f64],
        columns: &[&[f64]],
    ) -> Self {
        let columns = columns.iter().map(|column| take(column)).collect();
        Self { time, mask, values: take(values), columns, numbers: Vec::new(), group, interval }
    }

    /// The model of a row of these, given that of a row of the original: white noise falls with the root of the group.
    pub(super) fn model(&self, original: &NoiseModel) -> NoiseModel {
        if self.group == 1 {
            return *original;
        }
        let group = self.group as f64;
        let averaging = group * if original.averaging > 0.0 { original.averaging } else { self.interval };
        NoiseModel { averaging, white: original.white / group.sqrt(), ..*original }
    }

    pub(super) fn rows(&self) -> usize {
        self.mask.iter().filter(|&&used| used).count()
    }
}

/// First rows of complete, contiguous groups.
fn groups(time: &[f64], mask: &[bool], group: usize, interval: f64) -> Vec<usize> {
    let used: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
    let stretches = used.chunk_by(|&a, &b| b == a + 1 && time[b] - time[a] <= GAP * interval);
    stretches.flat_map(|stretch| stretch.chunks_exact(group)).map(|rows| rows[0]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_groups_stop_at_a_gap_whenever_the_clock_began() {
        for start in [0.0, 1e6] {
            let time = [0.0, 1.0, 2.0, 10.0, 11.0, 12.0].map(|t| start + t);
            assert_eq!(groups(&time, &[true; 6], 2, 1.0), [0, 3]);
            assert_eq!(groups(&time, &[true, true, true, true, false, true], 1, 1.0), [0, 1, 2, 3, 5]);
        }
    }
}
