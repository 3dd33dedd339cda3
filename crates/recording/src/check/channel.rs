//! One channel of a recording.

use super::units::Course;
use super::{Expectation, Finding, FindingKind, Instants, Repair, Severity, codes, outliers, runs, units};
use crate::statistics::{median, normal_quantile, robust_sd};
use crate::{Channel, series};

/// What there is to say about a channel.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelSummary {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Values that are there.
    pub present: usize,
    /// Values that are used.
    pub used: usize,
    /// Least value used \[u\].
    pub least: f64,
    /// Median of those present \[u\].
    pub median: f64,
    /// Largest value used \[u\].
    pub largest: f64,
    /// Standard deviation of the white noise of a value, from differences of neighbours \[u\].
    pub noise: Option<f64>,
    /// Step between values, if they lie on a lattice \[u\].
    pub step: Option<f64>,
}

pub(super) struct Context<'a> {
    pub(super) time: &'a [f64],
    pub(super) values: &'a [f64],
    pub(super) summary: &'a ChannelSummary,
    pub(super) interval: f64,
    pub(super) expectation: &'a Expectation,
}

/// Steps of resolution, in standard deviations of the noise, from which on it hides the noise.
pub(super) const COARSE: f64 = 3.0;

pub(super) struct Judged {
    pub(super) mask: Vec<bool>,
    pub(super) summary: ChannelSummary,
    pub(super) findings: Vec<Finding>,
}

pub(super) fn judge(time: &[f64], channel: &Channel, expectation: &Expectation, instants: Option<&Instants>) -> Judged {
    let mut mask: Vec<bool> = channel.values.iter().map(|value| value.is_finite()).collect();
    let mut findings = Vec::new();
    let useless = if expectation.essential { Severity::Error } else { Severity::Warning };
    missing(time, &mask, useless, &mut findings);
    findings.extend(codes::judge(time, &channel.values, expectation, &mut mask));
    let used = |mask: &[bool]| channel.values.iter().zip(mask).filter(|(_, used)| **used).map(|(v, _)| *v).collect::<Vec<_>>();
    let present = used(&mask);
    if present.is_empty() && findings.iter().all(|finding| finding.kind != FindingKind::Empty) {
        findings.push(Finding::whole(FindingKind::Empty, useless));
    }
    let mut summary = ChannelSummary {
        name: channel.name.clone(),
        unit: channel.unit.clone(),
        present: present.len(),
        used: present.len(),
        least: f64::NAN,
        median: median(present.clone()).unwrap_or(f64::NAN),
        largest: f64::NAN,
        noise: None,
        step: None,
    };
    if let (Some(first), Some(instants)) = (present.first(), instants) {
        if present.iter().all(|value| value == first) {
            findings.push(Finding::whole(FindingKind::Constant(*first), useless));
        } else {
            summary.step = runs::step(&present);
            summary.noise = white_noise(time, &channel.values, &mask);
            let interval = instants.interval;
            let context = Context { time, values: &channel.values, summary: &summary, interval, expectation };
            findings.extend(runs::judge(&context, &mut mask));
            findings.extend(outliers::judge(&context, &mut mask));
            if let Some(course) = Course::new(&used(&mask)) {
                findings.extend(units::judge(&summary, &course, expectation));
            }
            if let (Some(step), Some(noise)) = (summary.step, summary.noise)
                && step > COARSE * noise
            {
                findings.push(Finding::whole(FindingKind::Quantised { step, noise }, Severity::Note));
            }
        }
    }
    let used = used(&mask);
    let extreme = |fold: fn(f64, f64) -> f64| used.iter().copied().reduce(fold).unwrap_or(f64::NAN);
    (summary.used, summary.least, summary.largest) = (used.len(), extreme(f64::min), extreme(f64::max));
    for finding in &mut findings {
        (finding.channel, finding.unit) = (Some(channel.name.clone()), channel.unit.clone());
    }
    Judged { mask, summary, findings }
}

fn missing(time: &[f64], present: &[bool], useless: Severity, findings: &mut Vec<Finding>) {
    if present.iter().all(|there| !there) {
        return findings.push(Finding::whole(FindingKind::Empty, useless));
    }
    let mut end = 0;
    for run in present.chunk_by(|a, b| a == b) {
        let start = end;
        end += run.len();
        if !run[0] {
            let span = [time[start], time[end - 1]];
            findings.push(Finding::at(FindingKind::Missing, Severity::Note, span, run.len(), Repair::Masked));
        }
    }
}

/// Standard deviation of white noise from differences of neighbours, which a slow signal hardly touches; outliers do not count.
///
/// Second differences, or fourth ones where those show that the second hold a signal's curvature. Of noise far below the resolution
/// it gives what the resolution leaves of it. `None` without three used neighbours.
pub fn white_noise(time: &[f64], values: &[f64], mask: &[bool]) -> Option<f64> {
    let interval = series::median_interval(time)?;
    let from = |weights: &[f64]| {
        let reach = weights.len() - 1;
        let difference = |row: usize| {
            let rows = row..=row + reach;
            let together = time[row + reach] - time[row] < (reach as f64 + 0.5) * interval;
            let used = together && rows.clone().all(|row| mask[row]);
            used.then(|| rows.zip(weights).map(|(row, weight)| weight * values[row]).sum::<f64>())
        };
        let differences: Vec<f64> = (0..time.len().saturating_sub(reach)).filter_map(difference).collect();
        Some(inner_sd(&differences)? / weights.iter().map(|weight| weight * weight).sum::<f64>().sqrt())
    };
    let second = from(&SECOND)?;
    Some(from(&FOURTH).filter(|fourth| *fourth < CURVED * second).unwrap_or(second))
}

/// Weights of second differences: no slope passes.
const SECOND: [f64; 3] = [1.0, -2.0, 1.0];
/// Weights of fourth differences: no cubic passes.
const FOURTH: [f64; 5] = [1.0, -4.0, 6.0, -4.0, 1.0];
/// Share of the second differences' estimate that the fourth ones' falls below if there is curvature: far beyond chance.
const CURVED: f64 = 0.7;

/// Root mean square of values about 0 without their outliers.
fn inner_sd(values: &[f64]) -> Option<f64> {
    let robust = robust_sd(values.iter().copied(), 0.0)?;
    // of a coarsely resolved series the median may be 0: then the size that 5 % exceed, 1.96 standard deviations, takes its place
    let exceeded = || largest_but(0.05, values.iter().map(|value| value.abs()).collect()) / normal_quantile(0.975);
    let scale = if robust > 0.0 { robust } else { exceeded() };
    let inner = || values.iter().filter(|value| value.abs() <= INNER * scale);
    Some((inner().map(|value| value * value).sum::<f64>() / inner().count() as f64).sqrt())
}

/// Values beyond so many standard deviations are outliers.
const INNER: f64 = 4.0;

/// The largest value but a share of them.
fn largest_but(share: f64, mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() - 1 - (share * values.len() as f64) as usize]
}
