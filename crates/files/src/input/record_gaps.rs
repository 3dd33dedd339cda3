//! Lost rows of a recording whose rows are counted: where its clock goes on by more than a row, however coarse it is.

/// Intervals above which one is a gap, as in the checks.
const GAP: f64 = 1.5;
/// Ratio of what the clock and the rows tell apart from the gaps within which the clock is believed about these.
const NEAR: f64 = 1.5;
/// Tick of a clock \[s\], of which its steps are multiples.
const TICK_S: f64 = 1e-3;

/// What a clock shows beyond the instants of its rows, within its resolution \[s\].
#[derive(Clone, Copy)]
struct Band {
    low: f64,
    high: f64,
}

impl Band {
    /// Takes up another row; where the clock drifts, the oldest rows yield.
    fn with(self, beyond: f64, resolution: f64) -> Self {
        let Self { low, high } = self;
        Self { low: low.max(beyond - resolution).min(beyond), high: high.min(beyond + resolution).max(beyond) }
    }
}

/// The instants of rows that are counted with `interval` \[s\], later by the gaps that `clock` \[s\] shows, and the number of these. A clock is a gap ahead
/// if even the least that its resolution leaves is one; `written` is the last digit of its stamps \[s\]. There is none if the clock goes back, or
/// does not go with the rows.
pub(super) fn with_gaps(time: Vec<f64>, clock: &[f64], interval: f64, written: f64) -> (Vec<f64>, usize) {
    let steps: Vec<f64> = clock.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let resolution = resolution(&steps, interval, written);
    let is_gap = |step: f64| step - resolution > GAP * interval;
    let others = || steps.iter().filter(|step| !is_gap(**step));
    let (count, sum) = (others().count(), others().sum::<f64>());
    let goes_along = (1.0 / NEAR..NEAR).contains(&(sum / (count as f64 * interval))) && 2 * count >= steps.len();
    if clock.len() != time.len() || !goes_along || steps.iter().any(|step| *step < -resolution) {
        return (time, 0);
    }
    let (mut told, mut gaps, mut later) = (time, 0, 0.0);
    let mut before: Option<Band> = None;
    let mut first = 0;
    while first < told.len() {
        let next = (first..steps.len()).find(|row| is_gap(steps[*row])).map_or(told.len(), |row| row + 1);
        let rows = first..next;
        told[rows.clone()].iter_mut().for_each(|instant| *instant += later);
        let beyond = |told: &[f64], row: usize| clock[row] - told[row];
        let taken = |told: &[f64], band: Option<Band>, row: usize| {
            let beyond = beyond(told, row);
            Some(band.map_or(Band { low: beyond, high: beyond }, |band| band.with(beyond, resolution)))
        };
        // the rows next to the gap have the last word
        let after = rows.clone().rev().fold(None, |band, row| taken(&told, band, row));
        if let Some((before, after)) = before.zip(after) {
            let shift = lost(before, after, interval, resolution);
            told[rows.clone()].iter_mut().for_each(|instant| *instant += shift);
            (gaps, later) = (gaps + 1, later + shift);
        }
        before = rows.fold(before, |band, row| taken(&told, band, row));
        first = next;
    }
    (told, gaps)
}

/// The time \[s\] that a gap adds: whole rows where the clock allows them, or else the middle of what it allows.
fn lost(before: Band, after: Band, interval: f64, resolution: f64) -> f64 {
    let middle = 0.5 * (after.low + after.high - before.low - before.high);
    let slack = resolution - 0.5 * (after.high - after.low + before.high - before.low);
    let whole = (middle / interval).round() * interval;
    if (whole - middle).abs() < slack.max(1e-6 * interval) { whole } else { middle }
}

/// The resolution \[s\] of a clock with these steps: their largest common measure if rows are no multiple of it, or else the last digit written.
fn resolution(steps: &[f64], interval: f64, written: f64) -> f64 {
    let ticks = steps.iter().map(|step| (step / TICK_S).round().abs() as u64);
    let measure = ticks.fold(0, common) as f64 * TICK_S;
    let rows = interval / measure;
    if measure > 0.0 && (rows - rows.round()).abs() > 1e-6 { measure.max(written) } else { written }
}

/// The largest common measure (Euclid).
fn common(mut a: u64, mut b: u64) -> u64 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stamps of instants by a clock with a resolution, that began within it.
    fn stamps(instants: &[f64], resolution: f64, phase: f64) -> Vec<f64> {
        let of = |t: f64| ((t + phase) / resolution).floor() * resolution;
        instants.iter().map(|t| of(*t) - of(instants[0])).collect()
    }

    fn counted(count: usize, interval: f64) -> Vec<f64> {
        (0..count).map(|n| n as f64 * interval).collect()
    }

    /// Rows without those from the first of each pair to before its second.
    fn without(count: usize, interval: f64, lost: &[[usize; 2]]) -> Vec<f64> {
        let rows = (0..count).filter(|n| !lost.iter().any(|lost| (lost[0]..lost[1]).contains(n)));
        rows.map(|n| n as f64 * interval).collect()
    }

    #[test]
    fn lost_rows_are_found_whole_by_a_clock_without_seconds() {
        for (interval, lost) in [
            (30.0, vec![[200, 228], [700, 722]]),
            (7.0, vec![[300, 340], [600, 625]]),
            (60.0, vec![[1, 4], [90, 100], [101, 111]]),
        ] {
            let truth = without(1000, interval, &lost);
            for phase in [0.0, 0.3, 17.0, 30.0, 59.9] {
                let clock = stamps(&truth, 60.0, phase);
                let (told, gaps) = with_gaps(counted(truth.len(), interval), &clock, interval, 60.0);
                assert_eq!(gaps, lost.len(), "{interval} {phase}");
                assert!(told.iter().zip(&truth).all(|(a, b)| (a - b).abs() < 1e-6), "{interval} {phase}");
            }
        }
    }

    #[test]
    fn a_gap_behind_the_first_row_is_known_within_the_resolution() {
        let truth = without(1000, 7.0, &[[1, 40]]);
        let (told, gaps) = with_gaps(counted(truth.len(), 7.0), &stamps(&truth, 60.0, 17.0), 7.0, 60.0);
        assert!(gaps == 1 && told.iter().zip(&truth).all(|(a, b)| (a - b).abs() < 60.0), "{:?}", &told[..3]);
    }

    #[test]
    fn a_clock_that_goes_with_the_rows_has_no_gap() {
        // by the minute, with seconds that are always 0, slower by a thousandth, and with seconds
        for (interval, resolution, written, rate) in [
            (30.0, 60.0, 60.0, 1.0),
            (90.0, 60.0, 1.0, 1.0),
            (61.0, 60.0, 1.0, 1.0),
            (7.0, 60.0, 60.0, 1.001),
            (60.0, 60.0, 60.0, 1.001),
            (30.0, 1.0, 1.0, 1.0),
            (0.1, 1.0, 1.0, 1.0),
        ] {
            let instants: Vec<f64> = counted(3000, interval).iter().map(|t| t * rate).collect();
            let time = counted(3000, interval);
            let found = with_gaps(time.clone(), &stamps(&instants, resolution, 11.0), interval, written);
            assert_eq!(found, (time, 0), "{interval} {resolution}");
        }
    }

    #[test]
    fn a_fine_clock_tells_one_row_and_part_of_one() {
        let mut truth = without(500, 30.0, &[[100, 101]]);
        truth[300..].iter_mut().for_each(|t| *t += 47.0);
        let (told, gaps) = with_gaps(counted(499, 30.0), &truth, 30.0, 1.0);
        assert_eq!((gaps, told), (2, truth));
    }

    #[test]
    fn a_clock_that_is_wrong_tells_no_gap() {
        let time = counted(400, 30.0);
        let changed = |change: fn(usize, f64) -> f64| time.iter().enumerate().map(|(n, t)| change(n, *t)).collect::<Vec<f64>>();
        for clock in [
            changed(|n, t| if n < 200 { t } else { t - 3600.0 }),
            changed(|n, t| {
                if n < 200 {
                    t
                } else if n < 300 {
                    t + 7200.0
                } else {
                    t + 3600.0
                }
            }),
            changed(|n, _| if n < 200 { 0.0 } else { 9000.0 }),
            changed(|_, t| 30.0 * t),
            changed(|_, _| 0.0),
            Vec::new(),
        ] {
            assert_eq!(with_gaps(time.clone(), &clock, 30.0, 1.0), (time.clone(), 0));
        }
        assert_eq!(with_gaps(vec![0.0], &[0.0], 30.0, 1.0), (vec![0.0], 0));
    }
}
