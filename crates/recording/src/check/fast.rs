//! Changes that are faster than what is recorded can be: the instants are in another unit.

use super::summary::Context;
use super::{Clock, Finding, FindingKind, Repair, Severity};

/// Intervals over which a change is fast: noise and lone jumps are not.
const ROWS: usize = 5;
/// Shortest time over which it is \[s\]: a thermometer that comes into other air may jump by some kelvin.
const SHORTEST: f64 = 20.0;
/// Largest share of the change that may lie between two rows; more is a jump.
const JUMP: f64 = 0.5;

/// The fastest change of a channel, if it is faster than expected for [`ROWS`] intervals and [`SHORTEST`] seconds.
pub(super) fn judge(context: &Context, mask: &[bool], clock: &Clock) -> Option<Finding> {
    let Context { time, values, expectation, .. } = context;
    let used: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
    let mut fastest: Option<(f64, [usize; 2])> = None;
    let (mut first, mut last) = (0, ROWS);
    let mut rows = 0;
    while last < used.len() {
        let [from, to] = [used[first], used[last]];
        if time[to] - time[from] < SHORTEST {
            last += 1;
            continue;
        }
        let rate = (values[to] - values[from]).abs() / (time[to] - time[from]);
        if rate > expectation.fastest && !jumps(values, &used[first..=last]) {
            rows += last - first;
            if fastest.is_none_or(|(most, _)| rate > most) {
                fastest = Some((rate, [from, to]));
            }
            first = last;
        } else {
            first += 1;
        }
        last = last.max(first + ROWS);
    }
    let (rate, [from, to]) = fastest?;
    let span = time[*used.last()?] - time[used[0]];
    let limit = expectation.fastest;
    let kind = FindingKind::TooFast { rate, limit, candidates: clock.candidates(span, rate / limit), key: clock.key.clone() };
    Some(Finding::at(kind, Severity::Warning, [time[from], time[to]], rows, Repair::None))
}

/// Whether most of a change lies between two rows.
fn jumps(values: &[f64], rows: &[usize]) -> bool {
    let change = values[rows[rows.len() - 1]] - values[rows[0]];
    let largest = rows.windows(2).map(|pair| (values[pair[1]] - values[pair[0]]).abs()).fold(0.0, f64::max);
    largest > JUMP * change.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{ChannelSummary, Expectation, Unit};

    #[test]
    fn a_change_between_two_rows_is_a_jump() {
        let jump = |values: &[f64]| jumps(values, &(0..values.len()).collect::<Vec<_>>());
        assert!(jump(&[0.0, 0.1, 10.1, 10.2]) && jump(&[5.0, 5.0, -5.0]));
        assert!(!jump(&[0.0, 4.0, 8.0, 12.0]) && !jump(&[0.0, -4.0, -8.0, -12.0]));
        // two steps of one size are no jump
        assert!(!jump(&[0.0, 5.0, 10.0]));
    }

    /// A ramp of 3 K/s for 100 s, where 0.5 K/s is the fastest and 5000 s the longest: in units of 6 s to 50 s it could be.
    #[test]
    fn exact_another_unit_of_time_is_slow_enough_and_lasts_as_long_as_it_may() {
        let units = [("5 s", 5.0), ("6 s", 6.0), ("half a minute", 30.0), ("100 s", 100.0)];
        let mistaken = units.map(|(name, scale)| Unit { name: name.into(), scale, offset: 0.0 }).to_vec();
        let clock = Clock { span: [60.0, 5000.0], usual: 600.0, mistaken, key: "time".into() };
        let expectation = Expectation { fastest: 0.5, ..Expectation::default() };
        let summary = ChannelSummary {
            name: "air".into(),
            unit: "degC".into(),
            present: 101,
            used: 101,
            least: 0.0,
            median: 150.0,
            largest: 300.0,
            noise: None,
            step: None,
        };
        for start in [0.0, 1e6] {
            let time: Vec<f64> = (0..=100).map(|n| start + f64::from(n)).collect();
            let values: Vec<f64> = (0..=100).map(|n| 3.0 * f64::from(n)).collect();
            let context = Context { time: &time, values: &values, summary: &summary, interval: 1.0, expectation: &expectation };
            let found = judge(&context, &[true; 101], &clock).expect("too fast");
            let candidates = vec!["6 s".into(), "half a minute".into()];
            assert_eq!(found.kind, FindingKind::TooFast { rate: 3.0, limit: 0.5, candidates, key: "time".into() });
            assert_eq!(found.span, Some([start, start + 20.0]));
            // as fast as it can be
            let values: Vec<f64> = (0..=100).map(|n| 0.5 * f64::from(n)).collect();
            assert_eq!(judge(&Context { values: &values, ..context }, &[true; 101], &clock), None);
        }
    }
}
