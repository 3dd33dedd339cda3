//! The faults of a recording.
//!
//! Nothing is altered: [`check`] says which rows to keep and, channel by channel, which values to trust, and lists why.

mod channel;
mod codes;
mod expectation;
mod fast;
mod finding;
mod held;
mod instants;
mod outliers;
mod runs;
mod summary;
mod units;
mod white_noise;

pub use expectation::{Clock, Expectation, Offset, Unit};
pub use finding::{Finding, FindingKind, Repair, Severity};
pub use instants::{Gap, Instants};
pub use summary::ChannelSummary;
pub use white_noise::{white_noise, white_noise_beyond_cubics};

use crate::series::median_interval;
use crate::{Recording, Sampling};

/// Expected content of a recording.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Expectations {
    /// Expectations of the channels, in their order; of channels beyond its end nothing is expected.
    pub channels: Vec<Expectation>,
    /// Rows below which a recording is noted as short.
    pub fewest_rows: usize,
    /// Expectations of the instants.
    pub clock: Clock,
}

/// The findings of a check, and the rows and values that are fit for use.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Everything found, the worst first.
    pub findings: Vec<Finding>,
    /// Rows of the recording to keep: all but identical repeats, those of broken clocks, and those that repeat a mean.
    pub rows: Vec<usize>,
    /// For each channel and each row kept, whether its value is to be used.
    pub masks: Vec<Vec<bool>>,
    /// The instants kept; `None` for fewer than two.
    pub instants: Option<Instants>,
    /// The channels.
    pub channels: Vec<ChannelSummary>,
}

impl Report {
    /// Whether nothing forbids the use of the recording.
    pub fn usable(&self) -> bool {
        self.findings.iter().all(|finding| finding.severity != Severity::Error)
    }

    /// Usable part of the recording that was checked: the rows that are kept, NaN where a value is not used.
    ///
    /// # Panics
    /// If the report is of a recording with more rows or channels.
    pub fn used(&self, recording: &Recording) -> Recording {
        let mut kept = recording.select(&self.rows);
        kept.mask(&self.masks);
        kept
    }
}

const FEWEST_ROWS: usize = 3;

/// Checks a recording.
pub fn check(recording: &Recording, expectations: &Expectations) -> Report {
    let mut findings = Vec::new();
    let nothing = Expectation::default();
    let expected = |number: usize| expectations.channels.get(number).unwrap_or(&nothing);
    let rows = slower(recording, instants::keep(recording, &mut findings), &expected, &mut findings);
    let kept = recording.select(&rows);
    let instants = Instants::new(kept.time());
    if let Some(instants) = &instants {
        instants.judge(kept.time(), &mut findings);
        findings.extend(instants.judge_span(rows.len() >= expectations.fewest_rows, &expectations.clock));
    }
    if rows.len() < FEWEST_ROWS.max(expectations.fewest_rows) {
        let severity = if rows.len() < FEWEST_ROWS { Severity::Error } else { Severity::Warning };
        findings.push(Finding::whole(FindingKind::TooShort(rows.len()), severity));
    }
    let judge =
        |(number, channel)| channel::judge(kept.time(), channel, (expected(number), &expectations.clock), instants.as_ref());
    let (mut masks, mut channels) = (Vec::new(), Vec::new());
    for judged in kept.channels().iter().enumerate().map(judge) {
        masks.push(judged.mask);
        channels.push(judged.summary);
        findings.extend(judged.findings);
    }
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    Report { findings, rows, masks, instants, channels }
}

/// The rows that remain where means are repeated: those that say each for the first time, as a mean is over the time since the one before; where the
/// mean is missing, other channels go on at its rhythm.
fn slower<'a>(
    recording: &Recording,
    mut rows: Vec<usize>,
    expected: &dyn Fn(usize) -> &'a Expectation,
    findings: &mut Vec<Finding>,
) -> Vec<usize> {
    for (number, channel) in recording.channels().iter().enumerate().filter(|(_, channel)| channel.sampling == Sampling::Mean) {
        let time: Vec<f64> = rows.iter().map(|&row| recording.time()[row]).collect();
        let values: Vec<f64> = rows.iter().map(|&row| channel.values[row]).collect();
        let mask: Vec<bool> = values.iter().map(|value| value.is_finite()).collect();
        let Some(interval) = median_interval(&time) else { return rows };
        if let Some(held) = held::held(&values, &mask, expected(number).longest_hold / interval) {
            let mut last = f64::NEG_INFINITY;
            let stays = |row: usize| {
                let stays = held.fresh[row] || !mask[row] && time[row] - last > (held.rows - 0.5) * interval;
                last = if stays { time[row] } else { last };
                stays
            };
            let stay: Vec<bool> = (0..time.len()).map(stays).collect();
            let finding = held.finding(&time, &stay, interval, Repair::Dropped);
            findings.push(Finding { channel: Some(channel.name.clone()), unit: channel.unit.clone(), ..finding });
            rows = rows.into_iter().zip(stay).filter_map(|(row, stays)| stays.then_some(row)).collect();
        }
    }
    rows
}
