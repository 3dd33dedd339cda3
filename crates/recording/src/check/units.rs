//! Whether values are of the size that their unit makes them.

use super::expectation::{Expectation, Offset, Unit, within};
use super::summary::{COARSE, ChannelSummary};
use super::{Finding, FindingKind, Severity};
use crate::statistics::median;

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
    let key = || expectation.key.clone();
    let mut findings = Vec::new();
    let mut suspect = |what, found, range, useless: bool| {
        let severity = if expectation.essential && useless { Severity::Error } else { Severity::Warning };
        findings.push(Finding::whole(FindingKind::Unit { what, found, range, candidates: candidates(), key: key() }, severity));
    };
    if let Some(found) = extremes.into_iter().find(|value| !within(*value, *values)) {
        suspect("values", found, *values, true);
    } else if let Some(found) = measured.filter(|sd| !within(*sd, *noise)) {
        let small = extremes.into_iter().all(|value| value.abs() < expectation.least_size);
        suspect("noise", found, *noise, small);
    } else if let Some(unit) = mistaken.iter().find(|unit| within(unit.scale * start + unit.offset, expectation.start))
        && !within(start, expectation.start)
    {
        let kind = FindingKind::Start { found: start, candidate: unit.name.clone(), key: key() };
        findings.push(Finding::whole(kind, Severity::Warning));
    } else if let Some(Offset { known, largest, explained, of }) = offset
        && summary.median.abs().min((summary.median - known).abs()) > *largest
    {
        // what is known explains its opposite alone
        let is_explained =
            if *known == 0.0 { summary.median.abs() <= *explained } else { (summary.median + known).abs() <= *largest };
        let kind = FindingKind::Offset { median: summary.median, largest: *largest, of: of.clone(), is_explained };
        findings.push(Finding::whole(kind, Severity::Note));
    }
    findings
}
