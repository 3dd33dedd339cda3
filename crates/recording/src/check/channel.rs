//! One channel of a recording.

use super::expectation::Expectation;
use super::summary::{COARSE, ChannelSummary, Context};
use super::units::Course;
use super::white_noise::white_noise;
use super::{Clock, Finding, FindingKind, Instants, Repair, Severity, codes, fast, held, outliers, runs, units};
use crate::statistics::median;
use crate::{Channel, Sampling};

pub(super) struct Judged {
    pub(super) mask: Vec<bool>,
    pub(super) summary: ChannelSummary,
    pub(super) findings: Vec<Finding>,
}

pub(super) fn judge(
    time: &[f64],
    channel: &Channel,
    (expectation, clock): (&Expectation, &Clock),
    instants: Option<&Instants>,
) -> Judged {
    let mut mask: Vec<bool> = channel.values.iter().map(|value| value.is_finite()).collect();
    let mut findings = Vec::new();
    let useless = if expectation.essential { Severity::Error } else { Severity::Warning };
    missing(time, &mask, useless, &mut findings);
    findings.extend(codes::judge(time, &channel.values, expectation, &mut mask));
    let there = mask.iter().filter(|used| **used).count();
    let mut interval = instants.map_or(f64::NAN, |instants| instants.interval);
    // repeats of a mean are gone with their rows
    let is_read = channel.sampling == Sampling::Momentary;
    if let Some(held) = held::held(&channel.values, &mask, expectation.longest_hold / interval).filter(|_| is_read) {
        let stay: Vec<bool> = mask.iter().zip(&held.fresh).map(|(used, fresh)| !used || *fresh).collect();
        findings.push(held.finding(time, &stay, interval, Repair::Masked));
        interval *= held.rows;
        mask = held.fresh;
    }
    let used = |mask: &[bool]| channel.values.iter().zip(mask).filter(|(_, used)| **used).map(|(v, _)| *v).collect::<Vec<_>>();
    let present = used(&mask);
    if present.is_empty() && findings.iter().all(|finding| finding.kind != FindingKind::Empty) {
        findings.push(Finding::whole(FindingKind::Empty, useless));
    }
    let mut summary = ChannelSummary {
        name: channel.name.clone(),
        unit: channel.unit.clone(),
        present: there,
        used: present.len(),
        least: f64::NAN,
        median: median(present.clone()).unwrap_or(f64::NAN),
        largest: f64::NAN,
        noise: None,
        step: None,
    };
    if let (Some(first), Some(_)) = (present.first(), instants) {
        if present.iter().all(|value| value == first) {
            findings.push(Finding::whole(FindingKind::Constant(*first), useless));
        } else {
            summary.step = runs::step(&present);
            summary.noise = white_noise(time, &channel.values, &mask);
            let context = Context { time, values: &channel.values, summary: &summary, interval, expectation };
            findings.extend(runs::judge(&context, &mut mask));
            findings.extend(outliers::judge(&context, &mut mask));
            let course = Course::new(&used(&mask));
            let unit = course.map_or_else(Vec::new, |course| units::judge(&summary, &course, expectation));
            // in another unit it changes at another rate
            if unit.iter().all(|finding| !matches!(finding.kind, FindingKind::Unit { .. })) {
                findings.extend(fast::judge(&context, &mask, clock));
            }
            findings.extend(unit);
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Stairs of one step in every few rows: of three the resolution is three times the noise that their differences show.
    #[test]
    fn exact_a_resolution_above_three_standard_deviations_hides_the_noise() {
        let steps = |rows: usize| {
            let time: Vec<f64> = (0..20 * rows + 2).map(|n| n as f64).collect();
            let values = (0..time.len()).map(|n| (n / rows) as f64).collect();
            let channel = Channel { name: "air".into(), unit: "degC".into(), values, sampling: Sampling::Momentary };
            let instants = Instants::new(&time);
            let judged = judge(&time, &channel, (&Expectation::default(), &Clock::default()), instants.as_ref());
            judged.findings.into_iter().map(|finding| finding.kind).collect::<Vec<_>>()
        };
        assert_eq!(steps(3), []);
        let [FindingKind::Quantised { step, noise }] = steps(4)[..] else { panic!("{:?}", steps(4)) };
        assert!(step == 1.0 && (noise - 12.0_f64.sqrt().recip()).abs() < 1e-15, "{step} {noise}");
    }
}
