//! The instants of a recording.

use super::{Clock, Finding, FindingKind, Repair, Severity};
use crate::Recording;
use crate::series::GAP;
use crate::statistics::median;

/// Rows that are missing between two that are not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// Last instant before it \[s\].
    pub from: f64,
    /// First instant after it \[s\].
    pub to: f64,
    /// Number of rows that it would have held.
    pub missing: usize,
}

/// Summary of increasing instants.
#[derive(Debug, Clone, PartialEq)]
pub struct Instants {
    /// Median interval \[s\].
    pub interval: f64,
    /// Duration from the first to the last \[s\].
    pub span: f64,
    /// Root-mean-square distance of the intervals that are no gaps from the median \[s\].
    pub jitter: f64,
    /// Their largest distance \[s\].
    pub largest_jitter: f64,
    /// Gaps, where rows are missing.
    pub gaps: Vec<Gap>,
}

/// Jitter worth a note, in intervals.
const NOTED_JITTER: f64 = 1e-3;
/// Distance of an interval from a whole number of intervals that makes it a clock step: in intervals, and in largest jitters.
const STEP: [f64; 2] = [0.1, 4.0];

impl Instants {
    pub(super) fn new(time: &[f64]) -> Option<Self> {
        let intervals: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let interval = median(intervals.clone())?;
        let near = || intervals.iter().map(|dt| (dt - interval).abs()).filter(|distance| *distance < (GAP - 1.0) * interval);
        let gap = |pair: &[f64]| {
            let length = pair[1] - pair[0];
            let missing = (length / interval).round().max(2.0) as usize - 1;
            (length > GAP * interval).then_some(Gap { from: pair[0], to: pair[1], missing })
        };
        Some(Self {
            interval,
            span: time[time.len() - 1] - time[0],
            jitter: (near().map(|d| d * d).sum::<f64>() / near().count().max(1) as f64).sqrt(),
            largest_jitter: near().fold(0.0, f64::max),
            gaps: time.windows(2).filter_map(gap).collect(),
        })
    }

    pub(super) fn judge(&self, time: &[f64], findings: &mut Vec<Finding>) {
        if self.largest_jitter > NOTED_JITTER * self.interval {
            findings.push(Finding::whole(FindingKind::Jitter { rms: self.jitter, largest: self.largest_jitter }, Severity::Note));
        }
        for gap in &self.gaps {
            let kind = FindingKind::Gap { length: gap.to - gap.from, missing: gap.missing };
            findings.push(Finding::at(kind, Severity::Note, [gap.from, gap.to], 0, Repair::None));
        }
        let slack = (STEP[0] * self.interval).max(STEP[1] * self.largest_jitter);
        let is_odd = |from: f64, to: f64| {
            let (interval, whole) = (to - from, ((to - from) / self.interval).round() * self.interval);
            (interval - whole).abs() > slack || interval < 0.5 * self.interval
        };
        // a row between two others, beside which the clock goes on, is no step: the corner of a programme, say
        let is_between = |row: usize| {
            let around = row.checked_sub(1).and_then(|before| time.get(before)).zip(time.get(row + 1));
            around.is_some_and(|(from, to)| !is_odd(*from, *to))
        };
        for (row, pair) in time.windows(2).enumerate() {
            let interval = pair[1] - pair[0];
            if is_odd(pair[0], pair[1]) && !is_between(row) && !is_between(row + 1) {
                findings.push(Finding::at(
                    FindingKind::ClockStep(interval),
                    Severity::Warning,
                    [pair[0], pair[1]],
                    0,
                    Repair::None,
                ));
            }
        }
    }
}

impl Instants {
    /// Whether the recording lasts as long as one does; of a short one only if it has `many` rows.
    pub(super) fn judge_span(&self, many: bool, clock: &Clock) -> Option<Finding> {
        let [least, most] = clock.span;
        let candidates = clock.candidates(self.span, 0.0);
        let kind = FindingKind::Span { found: self.span, range: clock.span, candidates, key: clock.key.clone() };
        (self.span > most || many && self.span < least).then(|| Finding::whole(kind, Severity::Warning))
    }
}

/// The rows whose instants increase: repeats are dropped, wherever the row stands that they repeat; the rest that does not increase is an error,
/// one for all rows in a row that a clock which was put back leaves behind.
pub(super) fn keep(recording: &Recording, findings: &mut Vec<Finding>) -> Vec<usize> {
    let time = recording.time();
    let mut rows: Vec<usize> = Vec::with_capacity(time.len());
    // the last row that a clock left behind, and its finding
    let mut behind: Option<(usize, usize)> = None;
    for row in 0..time.len() {
        let Some(&last) = rows.last() else {
            rows.push(row);
            continue;
        };
        // the row of the same instant, if there is one
        let twin = || rows.binary_search_by(|&kept| time[kept].total_cmp(&time[row])).ok().map(|place| rows[place]);
        let finding = |kind, severity| Finding::at(kind, severity, [time[row]; 2], 1, Repair::Dropped);
        if time[row] > time[last] {
            rows.push(row);
        } else if twin().is_some_and(|twin| same(recording, row, twin)) {
            findings.push(finding(FindingKind::Duplicate, Severity::Note));
        } else if let Some((_, place)) = behind.filter(|(before, _)| before + 1 == row) {
            let begun = &mut findings[place];
            begun.rows += 1;
            begun.span = begun.span.map(|[from, to]| [from.min(time[row]), to.max(time[row])]);
            behind = Some((row, place));
        } else if time[row] < time[last] {
            behind = Some((row, findings.len()));
            findings.push(finding(FindingKind::Backwards(time[last] - time[row]), Severity::Error));
        } else {
            findings.push(finding(FindingKind::Conflict, Severity::Error));
        }
    }
    rows
}

fn same(recording: &Recording, row: usize, other: usize) -> bool {
    recording.channels().iter().all(|channel| {
        let (a, b) = (channel.values[row], channel.values[other]);
        a == b || (a.is_nan() && b.is_nan())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const INTERVAL: f64 = 10.0;

    /// Findings of instants \[s\] whose usual interval is 10 s.
    fn found(time: &[f64], largest_jitter: f64) -> Vec<FindingKind> {
        let instants = Instants { interval: INTERVAL, span: 0.0, jitter: largest_jitter, largest_jitter, gaps: Vec::new() };
        let mut findings = Vec::new();
        instants.judge(time, &mut findings);
        findings.into_iter().map(|finding| finding.kind).collect()
    }

    /// Of two rows so far apart.
    fn steps(interval: f64, largest_jitter: f64) -> bool {
        found(&[100.0, 100.0 + interval], largest_jitter).contains(&FindingKind::ClockStep(interval))
    }

    #[test]
    fn exact_jitter_is_noted_beyond_a_thousandth_of_an_interval() {
        let jitter = FindingKind::Jitter { rms: 0.0101, largest: 0.0101 };
        assert_eq!([0.01, 0.0101].map(|jitter| found(&[0.0, INTERVAL], jitter)), [vec![], vec![jitter]]);
    }

    #[test]
    fn exact_a_clock_step_is_off_by_more_than_a_tenth_of_an_interval() {
        assert_eq!([0.0, 1.0, 1.25].map(|off| steps(INTERVAL + off, 0.0)), [false, false, true]);
        assert_eq!([0.0, 1.0, 1.25].map(|off| steps(2.0 * INTERVAL - off, 0.0)), [false, false, true]);
    }

    #[test]
    fn exact_a_clock_step_is_off_by_more_than_four_jitters() {
        assert_eq!([1.0, 1.25].map(|off| steps(INTERVAL + off, 0.125)), [false, true]);
        assert_eq!([2.0, 2.25].map(|off| steps(INTERVAL + off, 0.5)), [false, true]);
    }

    #[test]
    fn exact_less_than_half_an_interval_is_a_clock_step_however_large_the_jitter() {
        assert_eq!([4.0, 4.75, 5.0, 6.0, INTERVAL].map(|interval| steps(interval, 2.0)), [true, true, false, false, false]);
    }

    #[test]
    fn exact_a_recording_lasts_from_the_least_to_the_most() {
        let clock = Clock { span: [60.0, 3600.0], ..Clock::default() };
        let is_found = |span: f64| {
            let instants = Instants { interval: 1.0, span, jitter: 0.0, largest_jitter: 0.0, gaps: Vec::new() };
            [false, true].map(|many| instants.judge_span(many, &clock).is_some())
        };
        assert_eq!([59.0, 60.0, 3600.0, 3601.0].map(is_found), [[false, true], [false; 2], [false; 2], [true; 2]]);
    }
}
