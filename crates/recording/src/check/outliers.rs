//! Lone values far from their neighbours.

use super::expectation::within;
use super::summary::Context;
use super::{Finding, FindingKind, Repair, Severity};
use crate::statistics::median;

/// Neighbours on each side.
const REACH: usize = 3;
/// Neighbours lie within so many intervals.
const NEAR: f64 = 4.5;
/// Distance from the neighbours' median, in standard deviations of the noise: of normal noise one value in 10⁹.
const FAR: f64 = 6.5;
/// Share of the distance that the value has to keep to both values beside it, and share by which the neighbours may differ.
const LONE: [f64; 2] = [0.6, 0.5];

/// Rows at an end: the one that is judged, and those by which it is.
const ENDS: usize = 6;
/// Distance of an end from the line of the rows beside it, in standard deviations of the noise and in the largest change between two of those. The line
/// is known there to 1.3 standard deviations, which leaves the chance that [`FAR`] has.
const FAR_END: [f64; 2] = [11.0, 10.0];

/// Values in a row that may be outliers together: a logger that repeats a bad one.
const TOGETHER: usize = 3;

/// Hampel's test against three neighbours on each side, less the line of their median slope (Theil and Sen): a ramp hides no outlier, and a step, or a
/// bend, is none. Up to three rows may be off together. What goes on with the line of one side alone is a corner.
///
/// The first two and the last two rows, and those beside a gap, are judged by the five next to them on their side, and have to be farther off.
pub(super) fn judge(context: &Context, mask: &mut [bool]) -> Vec<Finding> {
    let before = mask.to_vec();
    let mut found = lone_values(context, mask).unwrap_or_default();
    let moving = moving(context, &before, mask);
    if moving.is_some() {
        // the crests of a motion are no outliers
        found.retain(|(row, _)| within(context.values[*row], context.expectation.values));
    }
    found.sort_by_key(|(row, _)| *row);
    let largest = found.iter().fold(0.0_f64, |most, (_, distance)| most.max(*distance));
    let outliers = found.first().zip(found.last()).map(|((first, _), (last, _))| {
        let span = [context.time[*first], context.time[*last]];
        Finding::at(FindingKind::Outliers(largest), Severity::Note, span, found.len(), Repair::Masked)
    });
    outliers.into_iter().chain(moving).collect()
}

/// Rows of lone values, with their distance from the median; they are not used. `None` without noise to judge by.
fn lone_values(context: &Context, mask: &mut [bool]) -> Option<Vec<(usize, f64)>> {
    let Context { time, summary, .. } = context;
    let noise = summary.noise?.max(summary.step.unwrap_or(0.0) / 2.0);
    let mut found = Vec::new();
    for together in 1..=TOGETHER {
        let used: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
        for n in 2..(used.len() + 1).saturating_sub(2 + together) {
            if let Some(distance) = lone(context, &used, n, together, noise) {
                found.extend(used[n..n + together].iter().map(|row| (*row, distance)));
            }
        }
        found.iter().for_each(|(row, _)| mask[*row] = false);
    }
    let used: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
    // a row beside a longer gap has less than two neighbours behind it
    for run in used.chunk_by(|a, b| (time[*a] - time[*b]).abs() < (NEAR - 1.0) * context.interval) {
        for (row, distance) in
            [run.to_vec(), run.iter().rev().copied().collect()].iter().flat_map(|inwards| end(context, inwards, noise))
        {
            mask[row] = false;
            found.push((row, distance));
        }
    }
    Some(found)
}

/// Values of an essential channel that are not plausible, where most are: more than outliers, they say that what is recorded was moved. `before` are the
/// rows that were used before outliers were taken out.
fn moving(context: &Context, before: &[bool], mask: &mut [bool]) -> Option<Finding> {
    let Context { time, values, summary, expectation, .. } = context;
    let range = expectation.values;
    let implausible = |used: &[bool]| (0..time.len()).filter(|&row| used[row] && !within(values[row], range)).collect::<Vec<_>>();
    if !expectation.essential || !within(summary.median, range) || implausible(mask).len() <= TOGETHER {
        return None;
    }
    let rows = implausible(before);
    rows.iter().for_each(|&row| mask[row] = false);
    let largest = rows.iter().map(|&row| values[row]).reduce(|a, b| if b.abs() > a.abs() { b } else { a })?;
    let span = [time[rows[0]], time[rows[rows.len() - 1]]];
    Some(Finding::at(FindingKind::Moving { largest, range }, Severity::Error, span, rows.len(), Repair::Masked))
}

/// Distance of the rows `used[n..n + together]` from their neighbours, if they are outliers.
fn lone(context: &Context, used: &[usize], n: usize, together: usize, noise: f64) -> Option<f64> {
    let Context { time, values, interval, .. } = context;
    let end = n + together;
    let (row, last) = (used[n], used[end - 1]);
    let near = |m: &usize| (time[used[*m]] - time[row]).abs().min((time[used[*m]] - time[last]).abs()) < NEAR * interval;
    let before: Vec<usize> = (n.saturating_sub(REACH)..n).filter(near).collect();
    let after: Vec<usize> = (end..(end + REACH).min(used.len())).filter(near).collect();
    let balanced = before.len().min(after.len());
    if balanced < 2 {
        return None;
    }
    let neighbours: Vec<usize> = before[before.len() - balanced..].iter().chain(&after[..balanced]).map(|&m| used[m]).collect();
    let beside = |level: &dyn Fn(usize) -> f64| [level(row) - level(used[n - 1]), level(last) - level(used[end])];
    let slope = median_slope(context, &neighbours)?;
    let level = |row: usize| values[row] - slope * (time[row] - time[last]);
    let around: Vec<f64> = neighbours.iter().map(|row| level(*row)).collect();
    // one of the neighbours may be an outlier itself
    let mut sorted = around.clone();
    sorted.sort_by(f64::total_cmp);
    let range = (sorted[sorted.len() - 2] - sorted[0]).min(sorted[sorted.len() - 1] - sorted[1]);
    let middle = median(around)?;
    let distances = || used[n..end].iter().map(|row| level(*row) - middle);
    let distance = distances().fold(f64::INFINITY, |least, d| if d.abs() < f64::abs(least) { d } else { least });
    let same = distances().all(|d| d.signum() == distance.signum());
    let far = |side: f64| side * distance.signum() > LONE[0] * distance.abs();
    let alone = beside(&level).into_iter().all(far) && range < LONE[1] * distance.abs();
    let off = |side: &[usize], row: usize| Some(values[row] - extrapolated(context, side, row)?);
    let is_corner = || {
        let (before, after) = neighbours.split_at(balanced);
        [off(before, row), off(after, last)].into_iter().any(|off| !off.is_some_and(far))
    };
    (same && distance.abs() > FAR * noise && alone && !is_corner()).then_some(distance.abs())
}

/// The first of some rows from an end inwards, a row that was cut, or a start, or else the second if the first is not off with it: with its distance from
/// the line of those beside it, if it is an outlier.
fn end(context: &Context, inwards: &[usize], noise: f64) -> Option<(usize, f64)> {
    let values = context.values;
    let off = |rows: &[usize]| {
        let (&row, others) = rows.get(..ENDS)?.split_first()?;
        let change = others.windows(2).map(|m| (values[m[0]] - values[m[1]]).abs()).fold(0.0, f64::max);
        let off = values[row] - extrapolated(context, others, row)?;
        (off.abs() > FAR_END[0] * noise && off.abs() > FAR_END[1] * change).then_some((row, off))
    };
    let second = || {
        let (row, off) = off(inwards.get(1..)?)?;
        let beside = (values[row] - values[inwards[0]]) * off.signum();
        (beside > LONE[0] * off.abs()).then_some((row, off))
    };
    off(inwards).or_else(second).map(|(row, off)| (row, off.abs()))
}

/// Value in a row on the line of some rows: that of their median slope through their median.
fn extrapolated(context: &Context, rows: &[usize], row: usize) -> Option<f64> {
    let Context { time, values, .. } = context;
    let slope = median_slope(context, rows)?;
    median(rows.iter().map(|m| values[*m] - slope * (time[*m] - time[row])).collect())
}

/// Median of the slopes between any two of some rows.
fn median_slope(Context { time, values, .. }: &Context, rows: &[usize]) -> Option<f64> {
    let pairs = rows.iter().enumerate().flat_map(|(k, a)| rows[k + 1..].iter().map(move |b| (*a, *b)));
    median(pairs.map(|(a, b)| (values[b] - values[a]) / (time[b] - time[a])).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{ChannelSummary, Expectation};

    /// Noise of one, and values of which a plausible one is within 10.
    fn judged<T>(time: &[f64], values: &[f64], [noise, step]: [f64; 2], of: impl Fn(&Context) -> T) -> T {
        let summary = ChannelSummary {
            name: "rate".into(),
            unit: "deg/h".into(),
            present: values.len(),
            used: values.len(),
            least: f64::NAN,
            median: 0.0,
            largest: f64::NAN,
            noise: Some(noise),
            step: (step > 0.0).then_some(step),
        };
        let expectation = Expectation { values: [-10.0, 10.0], essential: true, ..Expectation::default() };
        of(&Context { time, values, summary: &summary, interval: 1.0, expectation: &expectation })
    }

    fn even(rows: usize) -> Vec<f64> {
        (0..rows).map(|n| n as f64).collect()
    }

    /// Rows that are found, their instants being given.
    fn found_at(time: &[f64], values: &[f64], noise: [f64; 2]) -> Vec<usize> {
        judged(time, values, noise, |context| {
            let mut mask = vec![true; values.len()];
            let found = lone_values(context, &mut mask).expect("noise");
            let rows: Vec<usize> = (0..values.len()).filter(|&row| !mask[row]).collect();
            assert_eq!(found.len(), rows.len());
            rows
        })
    }

    /// The same of rows one interval apart.
    fn found(values: &[f64], noise: [f64; 2]) -> Vec<usize> {
        found_at(&even(values.len()), values, noise)
    }

    /// Fifteen values of nothing but for some.
    fn nothing_but(values: &[(usize, f64)]) -> Vec<f64> {
        let mut all = vec![0.0; 15];
        values.iter().for_each(|&(row, value)| all[row] = value);
        all
    }

    /// Distance of the value in the fourth row of seven from the others.
    fn in_the_middle_of(values: &[f64; 7]) -> Option<f64> {
        let used: Vec<usize> = (0..7).collect();
        judged(&even(7), values, [1.0, 0.0], |context| lone(context, &used, 3, 1, 1.0))
    }

    const NONE: [usize; 0] = [];

    #[test]
    fn exact_a_lone_value_is_six_and_a_half_standard_deviations_off_and_more() {
        let found = [6.5, 6.75, -6.75].map(|value| in_the_middle_of(&[0.0, 0.0, 0.0, value, 0.0, 0.0, 0.0]));
        assert_eq!(found, [None, Some(6.75), Some(6.75)]);
    }

    #[test]
    fn exact_half_a_step_of_the_resolution_is_its_least_noise() {
        let is_found = |value: f64| found(&nothing_but(&[(7, value)]), [1e-3, 2.0]);
        assert_eq!([6.5, 6.75].map(is_found), [vec![], vec![7]]);
    }

    #[test]
    fn exact_a_lone_value_keeps_three_fifths_of_its_distance_to_the_next_one() {
        // the last three rows reach 8 at the value's instant
        assert_eq!(in_the_middle_of(&[0.0, 0.0, 0.0, 20.0, 8.0, 0.0, 8.0]), None);
        assert_eq!(in_the_middle_of(&[0.0, 0.0, 0.0, 20.0, 7.5, 0.0, 7.5]), Some(20.0));
    }

    #[test]
    fn exact_neighbours_differ_by_less_than_half_of_the_distance() {
        let among = |by: f64| in_the_middle_of(&[-by, by, 0.0, 20.0, 0.0, by, -by]);
        assert_eq!([5.0, 4.75].map(among), [None, Some(20.0)]);
    }

    #[test]
    fn exact_three_wrong_rows_before_the_last_two_are_found() {
        assert_eq!(found(&nothing_but(&[(10, 20.0), (11, 20.0), (12, 20.0)]), [1.0, 0.0]), [10, 11, 12]);
    }

    /// A row of 8 has to be farther off where it has no two neighbours behind it: those within four and a half intervals.
    #[test]
    fn exact_beside_a_gap_a_value_is_judged_by_one_side() {
        let beside = |gap: f64, value: f64| {
            let time: Vec<f64> = (0..15).map(|n| f64::from(n) + if n > 7 { gap - 1.0 } else { 0.0 }).collect();
            found_at(&time, &nothing_but(&[(7, value)]), [1.0, 0.0])
        };
        assert_eq!([3.25, 3.5, 4.0].map(|gap| beside(gap, 8.0)), [vec![7], vec![], vec![]]);
        assert_eq!([3.25, 3.5, 4.0].map(|gap| beside(gap, 12.0)), [[7]; 3]);
    }

    #[test]
    fn exact_the_first_row_is_eleven_standard_deviations_off_and_more() {
        assert_eq!([11.0, 11.5].map(|value| found(&nothing_but(&[(0, value)]), [1.0, 0.0])), [vec![], vec![0]]);
        assert_eq!([11.0, 11.5].map(|value| found(&nothing_but(&[(14, value)]), [1.0, 0.0])), [vec![], vec![14]]);
        // and ten changes of those beside it
        assert_eq!([10.0, 10.5].map(|value| found(&nothing_but(&[(0, value), (5, 1.0)]), [0.5, 0.0])), [vec![], vec![0]]);
    }

    #[test]
    fn exact_the_second_row_is_off_from_the_first_one_too() {
        assert_eq!([8.0, 7.5].map(|first| found(&nothing_but(&[(0, first), (1, 20.0)]), [1.0, 0.0])), [vec![], vec![1]]);
        assert_eq!([-8.0, -7.5].map(|first| found(&nothing_but(&[(0, first), (1, -20.0)]), [1.0, 0.0])), [vec![], vec![1]]);
    }

    /// By a clock that counts from 1970, too.
    #[test]
    fn exact_an_outlier_on_a_ramp_is_found_wherever_time_begins() {
        for start in [0.0, 1.7e9] {
            let time: Vec<f64> = (0..15).map(|n| start + f64::from(n)).collect();
            let ramp: Vec<f64> = (0..15).map(|n| f64::from(n) + if n == 7 { 1e-7 } else { 0.0 }).collect();
            assert_eq!(found_at(&time, &ramp, [1e-8, 0.0]), [7], "{start}");
            assert_eq!(found_at(&time, &ramp, [1e-7, 0.0]), NONE, "{start}");
        }
    }

    #[test]
    fn exact_more_than_three_implausible_values_are_a_motion() {
        let is_moving = |rows: usize, is_essential: bool, median: f64| {
            let values: Vec<f64> = (0..15).map(|n| if n < rows { 11.0 } else { 0.0 }).collect();
            judged(&even(15), &values, [1.0, 0.0], |context| {
                let expectation = Expectation { essential: is_essential, ..context.expectation.clone() };
                let summary = ChannelSummary { median, ..context.summary.clone() };
                let mut mask = vec![true; 15];
                let found = moving(&Context { expectation: &expectation, summary: &summary, ..*context }, &[true; 15], &mut mask);
                found.map(|finding| (finding.rows, mask.iter().filter(|used| !**used).count()))
            })
        };
        assert_eq!([0, 3, 4].map(|rows| is_moving(rows, true, 0.0)), [None, None, Some((4, 4))]);
        // of another unit most values are implausible; a channel that may stand at anything does not move
        assert_eq!([is_moving(4, false, 0.0), is_moving(4, true, 11.0), is_moving(3, true, 11.0)], [None; 3]);
    }
}
