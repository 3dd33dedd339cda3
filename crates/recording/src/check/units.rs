//! Whether values are of the size that their unit makes them.

use super::channel::COARSE;
use super::{ChannelSummary, Finding, FindingKind, Severity};

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
    /// Where the standard deviation of its white noise may lie \[u\].
    pub noise: [f64; 2],
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
        Self { values: any, noise: any, mistaken: Vec::new(), offset: None, essential: false }
    }
}

fn within(value: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&value)
}

/// Judges the sizes; `extremes` are the values below and above which a hundredth lies.
pub(super) fn judge(summary: &ChannelSummary, extremes: [f64; 2], expectation: &Expectation) -> Vec<Finding> {
    let Expectation { values, noise, mistaken, offset, .. } = expectation;
    // noise that the resolution hides is not judged
    let measured = summary.noise.filter(|sd| *sd > 0.0 && summary.step.is_none_or(|step| step < COARSE * sd));
    let fits = |unit: &&Unit| {
        let plain = extremes.map(|value| unit.scale * value + unit.offset);
        plain.into_iter().all(|value| within(value, *values)) && measured.is_none_or(|sd| within(unit.scale.abs() * sd, *noise))
    };
    let candidates = || mistaken.iter().filter(fits).map(|unit| unit.name.clone()).collect();
    let mut findings = Vec::new();
    let mut suspect = |what, found, range| {
        findings.push(Finding::whole(FindingKind::Unit { what, found, range, candidates: candidates() }, Severity::Warning));
    };
    if let Some(found) = extremes.into_iter().find(|value| !within(*value, *values)) {
        suspect("values", found, *values);
    } else if let Some(found) = measured.filter(|sd| !within(*sd, *noise)) {
        suspect("noise", found, *noise);
    } else if let Some(Offset { largest, explained, of }) = offset
        && summary.median.abs() > *largest
        && summary.median.abs() <= *explained
    {
        let kind = FindingKind::Offset { median: summary.median, largest: *largest, of: of.clone() };
        findings.push(Finding::whole(kind, Severity::Warning));
    }
    findings
}
