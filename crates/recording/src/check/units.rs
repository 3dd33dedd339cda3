//! Whether values are of the size that their unit makes them.

use super::channel::COARSE;
use super::{ChannelSummary, Finding, FindingKind, Severity};
use crate::statistics::median;

/// A unit in which a channel may be recorded by mistake: expected value = scale · value + offset.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// Its name.
    pub name: String,
    /// Factor.
    pub scale: f64,
    /// Added after the factor.
    pub offset: f64,
}

/// An offset that something known explains.
#[derive(Debug, Clone, PartialEq)]
pub struct Offset {
    /// The most that is expected \[u\].
    pub largest: f64,
    /// The most that what is known explains \[u\].
    pub explained: f64,
    /// What is known, e.g. "Earth rate not removed".
    pub of: String,
}

/// What a channel is expected to hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Expectation {
    /// Where its values may lie \[u\].
    pub values: [f64; 2],
    /// What no value is beyond, whatever was recorded \[u\].
    pub possible: [f64; 2],
    /// Where a recording at rest in a room starts \[u\]; a start elsewhere is suspected if another unit brings it there.
    pub start: [f64; 2],
    /// Where the standard deviation of its white noise may lie \[u\].
    pub noise: [f64; 2],
    /// Values below this size whose noise is too small as well are in another unit \[u\].
    pub least_size: f64,
    /// Units in which it may be by mistake.
    pub mistaken: Vec<Unit>,
    /// An offset that may have been left in.
    pub offset: Option<Offset>,
    /// Whether the recording is useless if the channel is empty or constant.
    pub essential: bool,
}

impl Default for Expectation {
    /// Anything.
    fn default() -> Self {
        let any = [f64::NEG_INFINITY, f64::INFINITY];
        Self {
            values: any,
            possible: any,
            start: any,
            noise: any,
            least_size: 0.0,
            mistaken: Vec::new(),
            offset: None,
            essential: false,
        }
    }
}

pub(super) fn within(value: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&value)
}

/// Values of a course that are used: those below and above which a hundredth lies, and the median of the first ones.
pub(super) struct Course {
    extremes: [f64; 2],
    start: f64,
}

/// Values that are the start.
const START: usize = 10;

impl Course {
    /// `None` for no values.
    pub(super) fn new(values: &[f64]) -> Option<Self> {
        let start = median(values.iter().take(START).copied().collect())?;
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let rank = sorted.len() / 100;
        Some(Self { extremes: [sorted[rank], sorted[sorted.len() - 1 - rank]], start })
    }
}

/// Judges the sizes.
pub(super) fn judge(summary: &ChannelSummary, course: &Course, expectation: &Expectation) -> Vec<Finding> {
    let Expectation { values, noise, mistaken, offset, .. } = expectation;
    let Course { extremes, start } = *course;
    // noise that the resolution hides is not judged
    let measured = summary.noise.filter(|sd| *sd > 0.0 && summary.step.is_none_or(|step| step < COARSE * sd));
    let fits = |unit: &&Unit| {
        let plain = extremes.map(|value| unit.scale * value + unit.offset);
        plain.into_iter().all(|value| within(value, *values)) && measured.is_none_or(|sd| within(unit.scale.abs() * sd, *noise))
    };
    let candidates = || mistaken.iter().filter(fits).map(|unit| unit.name.clone()).collect();
    let mut findings = Vec::new();
    let mut suspect = |what, found, range, useless: bool| {
        let severity = if expectation.essential && useless { Severity::Error } else { Severity::Warning };
        findings.push(Finding::whole(FindingKind::Unit { what, found, range, candidates: candidates() }, severity));
    };
    if let Some(found) = extremes.into_iter().find(|value| !within(*value, *values)) {
        suspect("values", found, *values, true);
    } else if let Some(found) = measured.filter(|sd| !within(*sd, *noise)) {
        let small = extremes.into_iter().all(|value| value.abs() < expectation.least_size);
        suspect("noise", found, *noise, small);
    } else if let Some(unit) = mistaken.iter().find(|unit| within(unit.scale * start + unit.offset, expectation.start))
        && !within(start, expectation.start)
    {
        let kind = FindingKind::Start { found: start, candidate: unit.name.clone() };
        findings.push(Finding::whole(kind, Severity::Warning));
    } else if let Some(Offset { largest, explained, of }) = offset
        && summary.median.abs() > *largest
        && summary.median.abs() <= *explained
    {
        let kind = FindingKind::Offset { median: summary.median, largest: *largest, of: of.clone() };
        findings.push(Finding::whole(kind, Severity::Warning));
    }
    findings
}
