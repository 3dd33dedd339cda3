//! Readings of a channel at rest at one temperature, reached from below and from above.

use super::absent::Absent;
use super::branches::Course;
use super::design::{Design, warmth};
use super::estimate::Estimate;
use super::model::{Model, Observed};

/// A rest is where the temperature's rate, as the slowest lag has it, is below this share of its largest.
const RESTING: f64 = 0.1;
/// Rests are at one temperature within this share of half the range.
const SAME: f64 = 0.1;
/// Rests count where the way there has been gone but for this.
const CAME: f64 = 0.1;
/// Fewest rows of a rest.
const FEWEST: usize = 10;

/// Reached from below, less reached from above: the amount of the last column, which is that of [`beside`].
pub(super) fn hysteresis(model: &Model) -> Result<Estimate, Absent> {
    model.sum(&vec![(model.design.columns.len() - 1, 1.0)])
}

/// A design with the `side` from which a temperature was reached.
pub(super) fn beside(design: &Design, side: &[f64]) -> Design {
    design.with(side.to_vec())
}

/// Whether rests lie at one temperature after either direction, `drive` being what moves the channel and `interval` that of the rows \[s\].
///
/// # Errors
/// [`Absent::ShortRest`] where a temperature is held so, and too short; else [`Absent::NoRest`].
pub(super) fn rests(design: &Design, course: &Course, observed: Observed, drive: &[f64], interval: f64) -> Result<(), Absent> {
    let at_rest = |rates: &[f64], warmth: &[f64]| {
        let largest = rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
        let rests = |side: f64| -> Vec<f64> {
            let rest = |row: &usize| {
                observed.mask[*row] && (course.side[*row] - side).abs() < CAME && rates[*row].abs() < RESTING * largest
            };
            let mut found: Vec<f64> = (0..observed.time.len()).filter(rest).map(|row| warmth[row]).collect();
            found.sort_by(f64::total_cmp);
            found
        };
        let [below, above] = [rests(0.5), rests(-0.5)];
        shared(&below, &above) >= FEWEST && shared(&above, &below) >= FEWEST
    };
    if at_rest(design.slowest_rate(), &design.warmth) {
        Ok(())
    } else if at_rest(design.fastest_rate(), &warmth(drive)) {
        let lag = design.lags[0];
        // the rate falls as e^(−t/lag)
        Err(Absent::ShortRest { lag, needed: -RESTING.ln() * lag + FEWEST as f64 * interval })
    } else {
        Err(Absent::NoRest)
    }
}

/// Number of values that have one of the others beside them; both lists are sorted.
fn shared(of: &[f64], others: &[f64]) -> usize {
    let beside = |x: &&f64| others.get(others.partition_point(|y| *y < **x - SAME)).is_some_and(|y| *y <= **x + SAME);
    of.iter().filter(beside).count()
}
