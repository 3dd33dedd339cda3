//! Readings that go on at another level from one row to the next.

use recording::check::white_noise;
use recording::smooth::resolution;

/// Rows on either side of a jump from which the level there is taken.
const BESIDE: usize = 10;
/// Least size of a jump, in standard deviations of the difference of two such levels.
const PLAIN: f64 = 8.0;
/// The same in steps of the display.
const DIGITS: f64 = 4.0;
/// The same in what the slope changes by in a row: where a programme turns, the lines of either side part by half of that, of a rounded corner by more.
const TURN: f64 = 2.0;
/// Least share of it between two rows, and between the rows before and behind the first.
const WITHIN: [f64; 2] = [0.4, 0.6];
/// Most jumps that are looked at, the largest.
const MOST: usize = 6;

/// Usual intervals from which an interval is a gap.
const GAP: f64 = 1.5;

/// A jump of the chamber's readings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Jump {
    /// First row after it.
    pub(crate) row: usize,
    /// By so much, beside the slopes on either side \[K\].
    pub(crate) by: f64,
    /// Whether rows are missing before it.
    pub(crate) is_behind_gap: bool,
}

/// A straight line through rows: its value in the middle of the jump, and its slope by usual intervals; instants are counted in them from there.
fn line(points: impl Iterator<Item = (f64, f64)> + Clone) -> [f64; 2] {
    let count = points.clone().count() as f64;
    let mean = points.clone().fold([0.0; 2], |[x, y], p| [x + p.0 / count, y + p.1 / count]);
    let [xx, xy] = points.fold([0.0; 2], |[xx, xy], p| [xx + (p.0 - mean[0]).powi(2), xy + (p.0 - mean[0]) * (p.1 - mean[1])]);
    [mean[1] - xy / xx * mean[0], xy / xx]
}

/// The median interval; `None` of a single row, or of instants that do not go on.
fn usual_interval(time: &[f64]) -> Option<f64> {
    let mut all: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().filter(|interval| *interval > 0.0)
}

/// The largest jumps from one course to the same course at another level, within a row, or within two where rows are means; over a gap beyond what the
/// slopes on either side make of its length.
pub(crate) fn jumps(time: &[f64], chamber: &[f64]) -> Vec<Jump> {
    let Some(white) = white_noise(time, chamber, &vec![true; chamber.len()]) else { return Vec::new() };
    let Some(interval) = usual_interval(time) else { return Vec::new() };
    let digit = resolution(chamber);
    // a line's end is twice as uncertain as its mean, and a step of the display is no jump
    let sure = (PLAIN * 2.0 * white * (2.0 / BESIDE as f64).sqrt()).max(DIGITS * digit);
    let at = |row: usize| -> Option<Jump> {
        let first = row.checked_sub(BESIDE)?;
        let last = Some(row + BESIDE).filter(|last| *last < chamber.len())?;
        let span = (time[row] - time[row - 1]) / interval;
        let middle = f64::midpoint(time[row], time[row - 1]);
        // of rows of means the one with the jump is between both levels
        let of = |from: usize, to: usize| line((from..to).map(|n| ((time[n] - middle) / interval, chamber[n])));
        let ([before, slope_before], [after, slope_after]) = (of(first, row - 1), of(row + 1, last));
        let by = after - before;
        // the programme may turn anywhere in a gap
        let is_turn = by.abs() <= TURN * span.max(1.0) * (slope_after - slope_before).abs();
        // a line is the less certain the farther it is followed
        let sure = sure * (BESIDE as f64 + span.max(1.0)) / (BESIDE as f64 + 1.0);
        // beyond the ramp's own steps
        let slope = f64::midpoint(slope_before, slope_after);
        let beyond = |to: usize| (chamber[to] - chamber[row - 1] - slope * (time[to] - time[row - 1]) / interval) / by;
        (by.abs() > sure && !is_turn && beyond(row) > WITHIN[0] && beyond(row + 1) > WITHIN[1]).then_some(Jump {
            row,
            by,
            is_behind_gap: span > GAP,
        })
    };
    let mut all: Vec<Jump> = (1..chamber.len()).filter_map(at).collect();
    all.sort_by(|a, b| b.by.abs().total_cmp(&a.by.abs()));
    let mut kept: Vec<Jump> = Vec::new();
    for jump in all {
        if kept.len() < MOST && kept.iter().all(|other| other.row.abs_diff(jump.row) > BESIDE) {
            kept.push(jump);
        }
    }
    kept
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Ten hours of minutes: a chamber that is cooled, held and warmed, with noise; its readings are off by `off` from row 320 on.
    pub(crate) fn chamber(off: f64) -> [Vec<f64>; 2] {
        let time: Vec<f64> = (0..600).map(|n| 60.0 * f64::from(n)).collect();
        let of = |n: usize| {
            let t = time[n];
            let course = 20.0 - ((t - 3000.0).clamp(0.0, 6000.0) - (t - 24_000.0).clamp(0.0, 6000.0)) / 150.0;
            course + 0.03 * ((n * 7919 % 1000) as f64 / 1000.0 - 0.5) + if n < 320 { 0.0 } else { off }
        };
        let readings = (0..600).map(of).collect();
        [time, readings]
    }

    #[test]
    fn a_jump_is_seen_where_it_is_and_a_ramp_is_none() {
        let [time, sound] = chamber(0.0);
        assert_eq!(jumps(&time, &sound), []);
        let [_, jumped] = chamber(-0.7);
        let found = jumps(&time, &jumped);
        assert!(found.len() == 1 && found[0].row == 320 && (found[0].by + 0.7).abs() < 0.05, "{found:?}");
        // in a ramp as well, by less than the ramp makes in three rows; its corners are none
        let ramp: Vec<f64> = sound.iter().enumerate().map(|(n, c)| c + if n < 100 { 0.0 } else { 1.0 }).collect();
        let found = jumps(&time, &ramp);
        assert!(found.len() == 1 && found[0].row == 100 && (found[0].by - 1.0).abs() < 0.05, "{found:?}");
        // means over three rows
        let means = |series: &[f64]| -> Vec<f64> { series.chunks(3).map(|c| c.iter().sum::<f64>() / 3.0).collect() };
        let found = jumps(&means(&time), &means(&jumped));
        assert!(found.len() == 1 && found[0].row.abs_diff(107) <= 1 && (found[0].by + 0.7).abs() < 0.05, "{found:?}");
        // a display of a tenth of a kelvin, without noise, steps in a slow course
        let display: Vec<f64> = time.iter().map(|t| (t / 40_000.0 * 10.0).round() / 10.0).collect();
        assert_eq!(jumps(&time, &display), []);
        // steps of degrees are jumps as well; whether they are real the spool tells
        let steps: Vec<f64> = sound.iter().enumerate().map(|(n, c)| c + if n < 100 { 0.0 } else { 15.0 }).collect();
        assert_eq!(jumps(&time, &steps).iter().map(|jump| jump.row).collect::<Vec<_>>(), [100]);
    }

    /// Rows that are missing in a ramp, at its corner or at rest are no jump; one of the readings in a gap is.
    #[test]
    fn a_gap_is_no_jump_where_the_programme_goes_on() {
        let without = |off: f64, from: usize, to: usize| -> [Vec<f64>; 2] {
            chamber(off)
                .map(|series| series.iter().enumerate().filter(|(n, _)| !(from..to).contains(n)).map(|(_, x)| *x).collect())
        };
        // rows 50 to 150 are a ramp down by 0.4 K each
        for (from, to) in [(90, 113), (40, 60), (45, 51), (140, 165), (250, 300)] {
            let [time, readings] = without(0.0, from, to);
            assert_eq!(jumps(&time, &readings), [], "{from} to {to}");
        }
        for (from, to) in [(320, 330), (310, 340)] {
            let [time, readings] = without(-1.5, from, to);
            let found = jumps(&time, &readings);
            assert!(found.len() == 1 && found[0].row == from && (found[0].by + 1.5).abs() < 0.1, "{from} to {to}: {found:?}");
            assert!(found[0].is_behind_gap);
        }
        let [time, readings] = without(0.0, 90, 113);
        let moved: Vec<f64> = readings.iter().enumerate().map(|(n, c)| c + if n < 90 { 0.0 } else { 3.0 }).collect();
        let found = jumps(&time, &moved);
        assert!(found.len() == 1 && found[0].row == 90 && (found[0].by - 3.0).abs() < 0.1, "{found:?}");
    }
}
