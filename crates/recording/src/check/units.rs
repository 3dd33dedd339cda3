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
        let [median, known, largest] = [summary.median, *known, *largest];
        let kind = FindingKind::Offset { median, known, largest, of: of.clone(), is_explained };
        findings.push(Finding::whole(kind, Severity::Note));
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary(median: f64, noise: f64, step: Option<f64>) -> ChannelSummary {
        ChannelSummary {
            name: "rate".into(),
            unit: "deg/h".into(),
            present: 1000,
            used: 1000,
            least: f64::NAN,
            median,
            largest: f64::NAN,
            noise: Some(noise),
            step,
        }
    }

    /// Findings of a rate from −`size` to `size` with a median and noise.
    fn of(size: f64, median: f64, noise: f64, expectation: &Expectation) -> Vec<Finding> {
        judge(&summary(median, noise, None), &Course { extremes: [-size, size], start: 0.0 }, expectation)
    }

    #[test]
    fn exact_values_below_the_least_size_are_in_another_unit() {
        let expectation = Expectation { noise: [0.1, 10.0], least_size: 0.5, essential: true, ..Expectation::default() };
        let severity = |size| of(size, 0.0, 0.01, &expectation).iter().map(|finding| finding.severity).collect::<Vec<_>>();
        assert_eq!([0.25, 0.5].map(severity), [[Severity::Error], [Severity::Warning]]);
    }

    /// Of 15 deg/h that are known and half of one that is expected beside them: their opposite is explained, neither other numbers nor other signs are.
    #[test]
    fn exact_what_is_known_explains_its_opposite() {
        let explained = |known: f64, median: f64| {
            let offset = Some(Offset { known, largest: 0.5, explained: 12.0, of: "Earth rate".into() });
            let found = of(20.0, median, 1.0, &Expectation { offset, ..Expectation::default() });
            found.first().map(|finding| matches!(finding.kind, FindingKind::Offset { is_explained: true, .. }))
        };
        let medians = [0.0, 0.5, 0.75, 14.25, 14.5, 15.5, 15.75, -14.25, -14.5, -15.0, -15.5, -15.75];
        let [none, no, yes] = [None, Some(false), Some(true)];
        let found = medians.map(|median| explained(15.0, median));
        assert_eq!(found, [none, none, no, no, none, none, no, no, yes, yes, yes, no]);
        assert_eq!([-13.0, -12.0, -0.5, 0.75, 12.0, 13.0].map(|median| explained(0.0, median)), [no, yes, none, yes, yes, no]);
    }

    #[test]
    fn exact_noise_is_judged_where_three_of_it_exceed_the_resolution() {
        let expectation = Expectation { noise: [1.0, 10.0], ..Expectation::default() };
        let is_quiet = |noise: f64, step: Option<f64>| {
            let found = judge(&summary(0.0, noise, step), &Course { extremes: [-20.0, 20.0], start: 0.0 }, &expectation);
            found.iter().any(|finding| matches!(finding.kind, FindingKind::Unit { what: "noise", .. }))
        };
        assert_eq!([None, Some(1.25), Some(1.5), Some(2.0)].map(|step| is_quiet(0.5, step)), [true, true, false, false]);
        assert_eq!([0.0, 0.5, 1.0].map(|noise| is_quiet(noise, None)), [false, true, false]);
    }

    /// A room at 70, which is 25 in a unit of half the size that begins at −10.
    #[test]
    fn exact_a_start_is_suspected_where_another_unit_makes_it_a_room_s() {
        let half = Unit { name: "half".into(), scale: 0.5, offset: -10.0 };
        let expectation = Expectation { start: [15.0, 30.0], mistaken: vec![half], key: "air".into(), ..Expectation::default() };
        let start = |start: f64| {
            let found = judge(&summary(50.0, 1.0, None), &Course { extremes: [0.0, 100.0], start }, &expectation);
            found.into_iter().map(|finding| finding.kind).next()
        };
        let suspected = |found: f64| Some(FindingKind::Start { found, candidate: "half".into(), key: "air".into() });
        assert_eq!([49.0, 50.0, 70.0, 80.0, 81.0].map(start), [None, suspected(50.0), suspected(70.0), suspected(80.0), None]);
        assert_eq!([20.0, 30.0].map(start), [None, None]);
    }
}
