//! Values of a slower logger, each repeated until the next: rows of several loggers put together.

use super::Finding;
use super::finding::{FindingKind, Repair, Severity};
use super::runs;

/// Fewest runs of equal values that tell a rhythm: that none of them is cut, at even odds each, has a chance of 10⁻⁶.
const FEWEST_RUNS: usize = 20;
/// Largest share of runs of a single row: outliers, and rows beside a gap.
const SINGLE: f64 = 0.05;
/// Least share of changes by more than one step of the resolution: a course that is only coarse changes by one.
const SEVERAL: f64 = 0.25;
/// A change by more than one step, in steps.
const ONE_STEP: f64 = 1.5;
/// Runs up to so many times the usual length are of one value that was read; longer ones of several that were equal.
const OF_ONE: f64 = 1.5;

/// A series whose values are repeats of fewer readings.
pub(super) struct Held {
    /// Usual number of rows for which a reading stands, > 1.
    pub(super) rows: f64,
    /// Whether a row is the first of its reading; of those not used none is.
    pub(super) fresh: Vec<bool>,
}

/// The readings that are repeated in a series, if each change is by itself: it goes by several steps of the resolution at once, and the
/// rows before it and behind it stand still. What is smooth and read in every row does not do that, nor does noise.
///
/// `longest` is the longest time for which a reading may stand, in rows.
pub(super) fn held(values: &[f64], mask: &[bool], longest: f64) -> Option<Held> {
    let used: Vec<usize> = (0..values.len()).filter(|&row| mask[row]).collect();
    let runs: Vec<&[usize]> = used.chunk_by(|a, b| values[*a] == values[*b]).collect();
    // the first and the last may have been cut
    let inner: Vec<usize> = runs.get(1..runs.len().checked_sub(1)?)?.iter().map(|run| run.len()).collect();
    let single = inner.iter().filter(|length| **length == 1).count();
    if inner.len() < FEWEST_RUNS || single as f64 > SINGLE * inner.len() as f64 {
        return None;
    }
    let present: Vec<f64> = used.iter().map(|&row| values[row]).collect();
    let step = runs::step(&present).unwrap_or(0.0);
    let changes = || runs.windows(2).map(|pair| (values[pair[1][0]] - values[pair[0][0]]).abs());
    let several = changes().filter(|change| *change > ONE_STEP * step).count();
    if (several as f64) < SEVERAL * changes().count() as f64 {
        return None;
    }
    // readings that are equal by chance make long runs: the shorter half is of single ones
    let mut lengths: Vec<f64> = inner.iter().map(|length| *length as f64).collect();
    lengths.sort_by(f64::total_cmp);
    let usual = lengths[lengths.len() / 4];
    let of_one: Vec<f64> = lengths.into_iter().filter(|length| *length <= OF_ONE * usual).collect();
    let rows = of_one.iter().sum::<f64>() / of_one.len() as f64;
    if rows > longest {
        return None;
    }
    let mut fresh = vec![false; values.len()];
    for run in runs {
        let readings = (run.len() as f64 / rows).round().max(1.0);
        (0..readings as usize).for_each(|n| fresh[run[(n as f64 * run.len() as f64 / readings) as usize]] = true);
    }
    Some(Held { rows, fresh })
}

impl Held {
    /// The finding of a series in rows of `interval` \[s\] each, some of which stay in use; those that do not were repeats.
    pub(super) fn finding(&self, time: &[f64], stay: &[bool], interval: f64, repair: Repair) -> Finding {
        let repeats: Vec<usize> = (0..time.len()).filter(|&row| !stay[row]).collect();
        let span = [time[repeats[0]], time[repeats[repeats.len() - 1]]];
        let kind = FindingKind::Held { rows: self.rows, interval: self.rows * interval };
        Finding::at(kind, Severity::Note, span, repeats.len(), repair)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Readings of five rows each, one of which was cut to a single row by a value that came early: the usual length is that of the others.
    #[test]
    fn exact_a_short_run_is_not_the_usual_one() {
        let lengths = (0..42).map(|n| if n == 20 { 1 } else { 5 });
        let values: Vec<f64> = lengths.enumerate().flat_map(|(n, rows)| vec![0.1 * ((7 * n) % 31) as f64; rows]).collect();
        let found = held(&values, &vec![true; values.len()], 100.0).expect("a rhythm");
        assert!((found.rows - (39.0 * 5.0 + 1.0) / 40.0).abs() < 1e-12, "{}", found.rows);
        assert_eq!(found.fresh.iter().filter(|fresh| **fresh).count(), 42);
    }

    /// Some readings stand for seven rows, which is less than one and a half times five: they count.
    #[test]
    fn exact_the_usual_length_is_the_mean_of_single_readings() {
        let lengths = (0..42).map(|n| if n % 4 == 1 { 7 } else { 5 });
        let values: Vec<f64> = lengths.enumerate().flat_map(|(n, rows)| vec![0.1 * ((7 * n) % 31) as f64; rows]).collect();
        let found = held(&values, &vec![true; values.len()], 100.0).expect("a rhythm");
        assert!((found.rows - (30.0 * 5.0 + 10.0 * 7.0) / 40.0).abs() < 1e-12, "{}", found.rows);
    }

    /// Forty changes, some of them by three steps, the others by one to and fro.
    #[test]
    fn exact_a_rhythm_has_a_quarter_of_its_changes_by_several_steps() {
        let rows = |several: u32| {
            let level = |n: u32| f64::from(3 * n.min(several) + n.saturating_sub(several) % 2);
            let values: Vec<f64> = (0..=40).flat_map(|n| [level(n); 5]).collect();
            held(&values, &[true; 205], 100.0).map(|held| held.rows)
        };
        assert_eq!([9, 10, 11].map(rows), [None, Some(5.0), Some(5.0)]);
    }

    #[test]
    fn exact_one_of_twenty_runs_may_be_a_single_row() {
        let rows = |single: usize| {
            let lengths = (0..22).map(|n| if (5..5 + single).contains(&n) { 1 } else { 5 });
            let values: Vec<f64> = lengths.enumerate().flat_map(|(n, rows)| vec![0.1 * ((7 * n) % 31) as f64; rows]).collect();
            held(&values, &vec![true; values.len()], 100.0).map(|held| held.rows)
        };
        assert_eq!([0, 1, 2].map(rows), [Some(5.0), Some(4.8), None]);
    }
}
