//! A recording made ready for a model: neighbours averaged where there are very many, gaps bridged, and whether it starts at rest.
//!
//! Nothing here knows what was recorded: what "many", "steady" and "apart" mean is the caller's to say, in its own units. Every function is
//! indifferent to where time begins and to the unit of a channel.

use std::ops::Range;

use crate::series::{GAP, median_interval};
use crate::statistics::median;
use crate::{Channel, Recording, Sampling};

/// Rule by which neighbouring rows are averaged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thinning {
    /// Rows up to which a recording stays as it is.
    pub many_rows: usize,
    /// Interval to which rows are averaged \[s\], > 0.
    pub interval: f64,
    /// Most rows that are wished for; of more, the interval grows. At least 1: 0 counts as 1.
    pub most_rows: usize,
}

/// A recording of which neighbouring rows were averaged.
#[derive(Debug, Clone, PartialEq)]
pub struct Thinned {
    /// The remaining recording.
    pub recording: Recording,
    /// Rows of the original in one of these, at least 2.
    pub every: usize,
    /// Rows of the original.
    pub rows: usize,
}

/// Means over whole numbers of rows; `None` where the recording stays as it is, because it has few rows or long intervals, or its interval
/// is not known.
///
/// `interval` is the usual time between its rows \[s\], > 0 ([`crate::check::Instants::interval`]). A group of `every` rows without a gap (an interval over 1.5 usual ones) becomes
/// one, at its last instant: what a gap cuts short is no mean over the interval, and is left out. A channel of means
/// ([`Sampling::Mean`]) is averaged over the group; momentary values over as many rows on either side of the instant as are there, at most
/// half a group, which is a reading at that instant with less noise. A mean of which less than half is finite is NaN. Of a momentary channel that
/// has a value in every so many rows only, as a slower sensor's, values between count as on lines; a group without one of its own is NaN.
pub fn thinned(recording: &Recording, interval: f64, rule: &Thinning) -> Option<Thinned> {
    let time = recording.time();
    let rows = time.len();
    let every = ((rule.interval / interval).round() as usize).max(rows.div_ceil(rule.most_rows.max(1)));
    // an interval of 0 (or NaN) tells no gap from a neighbour
    if rows <= rule.many_rows || every < 2 || interval.is_nan() || interval <= 0.0 {
        return None;
    }
    let neighbours = |row: usize| time[row] - time[row - 1] <= GAP * interval;
    let groups = groups(rows, every, neighbours);
    let about = |last: usize| {
        let side = (1..=every / 2).take_while(|k| last + k < rows && neighbours(last + k)).count();
        last - side..last + side + 1
    };
    let of = |channel: &Channel| {
        let between = between(time, &channel.values);
        let has_own = |group: &Range<usize>| channel.values[group.clone()].iter().any(|value| value.is_finite());
        let value = |group: &Range<usize>| match (channel.sampling, &between) {
            (Sampling::Mean, _) => mean(&channel.values[group.clone()]),
            (Sampling::Momentary, None) => mean(&channel.values[about(group.end - 1)]),
            (Sampling::Momentary, Some(values)) if has_own(group) => mean(&values[about(group.end - 1)]),
            (Sampling::Momentary, Some(_)) => f64::NAN,
        };
        Channel { values: groups.iter().map(value).collect(), ..channel.clone() }
    };
    let left = groups.iter().map(|group| time[group.end - 1]).collect();
    Some(Thinned { recording: recording.with(left, of), every, rows })
}

/// A recording whose gaps (intervals over 1.5 usual ones) have rows without a value, back from the row that ends each, as many as the usual interval has
/// room for; of more than half of the recording's rows, each gap gets its share, so that the usual interval stays what it is. What a programme did
/// meanwhile has a place then.
pub fn filled(recording: &Recording) -> Recording {
    let time = recording.time();
    let Some(interval) = median_interval(time).filter(|interval| *interval > 0.0) else { return recording.clone() };
    let left_out = |gap: f64| if gap > GAP * interval { gap / interval - 1.0 } else { 0.0 };
    let share = (time.len() as f64 / 2.0 / time.windows(2).map(|t| left_out(t[1] - t[0])).sum::<f64>()).min(1.0);
    // the row of the recording that each row is, if it is one
    let mut rows: Vec<(f64, Option<usize>)> = Vec::with_capacity(time.len());
    for n in 0..time.len() {
        let gap = time[n] - time[n.saturating_sub(1)];
        let more = (share * left_out(gap)).round() as usize;
        // what is read over an interval began one before its row
        let spacing = if share < 1.0 { gap / (more + 1) as f64 } else { interval };
        rows.extend((1..=more).rev().map(|k| (time[n] - spacing * k as f64, None)));
        rows.push((time[n], Some(n)));
    }
    let of = |channel: &Channel| {
        let values = rows.iter().map(|(_, row)| row.map_or(f64::NAN, |n| channel.values[n])).collect();
        Channel { values, ..channel.clone() }
    };
    recording.with(rows.iter().map(|(t, _)| *t).collect(), of)
}

/// Groups of `every` rows between gaps.
fn groups(rows: usize, every: usize, neighbours: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let rows: Vec<usize> = (0..rows).collect();
    let stretches = rows.chunk_by(|_, &row| neighbours(row));
    stretches.flat_map(|stretch| stretch.chunks_exact(every)).map(|group| group[0]..group[0] + every).collect()
}

/// A channel that usually has a value in every so many rows, with the rows between on lines; longer gaps stay. `None` if it usually has one in each.
fn between(time: &[f64], values: &[f64]) -> Option<Vec<f64>> {
    let known: Vec<usize> = (0..values.len()).filter(|&n| values[n].is_finite()).collect();
    let usual = median(known.windows(2).map(|pair| (pair[1] - pair[0]) as f64).collect()).filter(|rows| *rows > 1.0)?;
    let mut filled = values.to_vec();
    for pair in known.windows(2).filter(|pair| (pair[1] - pair[0]) as f64 <= 2.0 * usual) {
        let ends = [pair[0], pair[1]];
        (ends[0] + 1..ends[1]).for_each(|n| filled[n] = on_line(time, values, ends, n));
    }
    Some(filled)
}

/// Value in a row on the line between two others.
fn on_line(time: &[f64], values: &[f64], [a, b]: [usize; 2], row: usize) -> f64 {
    values[a] + (values[b] - values[a]) * (time[row] - time[a]) / (time[b] - time[a])
}

/// Mean of what is there; NaN if that is less than half.
pub(crate) fn mean(values: &[f64]) -> f64 {
    let (sum, count) = values.iter().filter(|v| v.is_finite()).fold((0.0, 0), |(s, n), v| (s + v, n + 1));
    if 2 * count < values.len() { f64::NAN } else { sum / count as f64 }
}

/// A series with what is not finite filled in: on straight lines in time between what is, and with the nearest value at its ends; `None`
/// if nothing is finite.
///
/// ```
/// use recording::condition::bridged;
///
/// let nan = f64::NAN;
/// assert_eq!(bridged(&[0.0, 1.0, 2.0, 4.0, 5.0], &[nan, 1.0, nan, 4.0, nan]), Some(vec![1.0, 1.0, 2.0, 4.0, 4.0]));
/// assert_eq!(bridged(&[0.0], &[nan]), None);
/// ```
///
/// # Panics
/// If there are fewer instants than values.
pub fn bridged(time: &[f64], values: &[f64]) -> Option<Vec<f64>> {
    let known: Vec<usize> = (0..values.len()).filter(|&n| values[n].is_finite()).collect();
    let (&first, &last) = known.first().zip(known.last())?;
    let filled = |n: usize| {
        if values[n].is_finite() {
            return values[n];
        }
        let at = known.partition_point(|k| *k < n);
        match (at.checked_sub(1).map(|k| known[k]), known.get(at)) {
            (Some(a), Some(&b)) => on_line(time, values, [a, b], n),
            (Some(_), None) => values[last],
            _ => values[first],
        }
    };
    Some((0..values.len()).map(filled).collect())
}

/// Slope of a series at each instant, from the values beside it; 0 where there is but one.
///
/// # Panics
/// If there are fewer values than instants.
pub fn slopes(time: &[f64], values: &[f64]) -> Vec<f64> {
    let at = |n: usize| {
        let (a, b) = (n.saturating_sub(1), (n + 1).min(time.len() - 1));
        if b > a { (values[b] - values[a]) / (time[b] - time[a]) } else { 0.0 }
    };
    (0..time.len()).map(at).collect()
}

/// Condition of rest at the beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rest {
    /// Duration for which the drive should be steady \[s\].
    pub duration: f64,
    /// Largest movement of the drive, and largest difference from the channel that follows it \[u\]: offsets and noise of sensors.
    pub tolerance: f64,
}

/// Reason why a recording does not start at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unrest {
    /// The drive and the channel that follows it differ at first, by so much \[u\], and the difference moves within the duration.
    Apart(f64),
    /// The drive moves at first, by so much within the duration \[u\].
    Moving(f64),
}

/// Reason why a recording does not start at rest, if it does not: from `driver`, which is finite, and `follower`, NaN where it is not known.
///
/// At rest both stand still: a model that starts from equilibrium has no other beginning. Two thermometers may differ all the same, by a constant. The
/// follower's first finite value counts; that the two differ is said before that the driver moves.
///
/// # Panics
/// If the series are not of one length.
pub fn unrest(time: &[f64], driver: &[f64], follower: &[f64], rest: &Rest) -> Option<Unrest> {
    assert_eq!((driver.len(), follower.len()), (time.len(), time.len()), "a value for each instant");
    let (start, first) = (*time.first()?, *driver.first()?);
    let early = time.iter().take_while(|t| **t - start <= rest.duration).count();
    let farthest = |values: &mut dyn Iterator<Item = f64>| {
        let known: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        known
            .first()
            .map_or((0.0, 0.0), |first| (*first, known.iter().fold(0.0_f64, |most, value| most.max((value - first).abs()))))
    };
    let (_, moved) = farthest(&mut driver[..early].iter().copied());
    let (apart, closing) = farthest(&mut follower[..early].iter().map(|value| value - first));
    let is_apart = apart.abs() > rest.tolerance && closing > rest.tolerance;
    if is_apart { Some(Unrest::Apart(apart.abs())) } else { (moved > rest.tolerance).then_some(Unrest::Moving(moved)) }
}

/// Largest minus smallest of the values, those that are NaN left out; −∞ of nothing.
pub fn span(values: &[f64]) -> f64 {
    let [low, high] = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(*v), high.max(*v)]);
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_mean_is_none() {
        assert_eq!(mean(&[1.0, f64::NAN, 3.0, 5.0]), 3.0);
        assert!(mean(&[1.0, f64::NAN, f64::NAN]).is_nan() && mean(&[]).is_nan());
    }

    #[test]
    fn slopes_are_taken_over_both_neighbours() {
        assert_eq!(slopes(&[0.0, 1.0, 3.0], &[0.0, 2.0, 3.0]), [2.0, 1.0, 0.5]);
        assert_eq!((slopes(&[5.0], &[1.0]), slopes(&[], &[])), (vec![0.0], vec![]));
    }

    #[test]
    fn what_a_gap_cuts_short_is_no_group() {
        assert_eq!(groups(11, 3, |row| row != 5), [0..3, 5..8, 8..11]);
        assert_eq!(groups(2, 3, |_| true), []);
    }

    #[test]
    fn exact_readings_are_joined_over_twice_their_usual_distance_and_no_farther() {
        let of = |rows: &[u32]| {
            let time: Vec<f64> = (0..=40).map(f64::from).collect();
            let values: Vec<f64> = (0..=40).map(|n| if rows.contains(&n) { f64::from(n * n) } else { f64::NAN }).collect();
            between(&time, &values)
        };
        // every third row, then one six rows on, and one seven
        let joined = of(&[0, 3, 6, 9, 12, 18, 25]).expect("lines");
        let there: Vec<usize> = (0..joined.len()).filter(|&n| joined[n].is_finite()).collect();
        assert_eq!(there, (0..=18).chain([25]).collect::<Vec<_>>());
        // 12² + 2 (18² − 12²)/6, and the readings themselves
        assert_eq!([joined[3], joined[14], joined[18], joined[25]], [9.0, 204.0, 324.0, 625.0]);
        // usually one in each row: what is missing is no line
        assert_eq!(of(&[0, 1, 2, 3, 4, 6, 7]), None);
    }
}
