//! Resolution, and runs of equal values that it does not explain.

use std::ops::Range;

use super::summary::Context;
use super::{Finding, FindingKind, Repair, Severity};
use crate::statistics::median;

/// Fewest different values of which a lattice can be told by their places alone.
const FEWEST_VALUES: usize = 5;
/// Changes from one value to another that tell a lattice of fewer: so many, and in one of so many rows. A programme's levels change more rarely, and so
/// does what is stuck now and then.
const CHANGES: [usize; 2] = [16, 20];
/// Largest distance of a value from its lattice, in steps: printing to few digits moves values.
const OFF_LATTICE: f64 = 0.2;
/// Steps below this share of the largest value are rounding.
const ROUNDING: f64 = 1e-10;
/// Shortest run \[rows\].
const SHORTEST: usize = 8;
/// Probability of the longest run in a sound recording below which a run is none of chance.
const CHANCE: f64 = 1e-6;
/// Rows on each side of a run that show the noise.
const BESIDE: usize = 24;
/// Rows among which they are sought.
const REACH: usize = 8 * BESIDE;
/// Minus the median product of neighbouring second differences of white noise of unit variance, by simulation.
const OPPOSITE: f64 = 1.49;
/// Noise, in steps, below which equal values say nothing unless a jump ends them.
const HIDDEN: f64 = 0.35;
/// That jump: in steps, and in the differences beside it.
const JUMP: f64 = 5.0;

/// Step of the lattice on which the values lie, in the order of time; `None` if they lie on none that is coarser than rounding.
pub(super) fn step(values: &[f64]) -> Option<f64> {
    let mut different = values.to_vec();
    different.sort_by(f64::total_cmp);
    different.dedup();
    let changes = || values.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let [fewest, rows] = CHANGES;
    if different.len() < 2 || different.len() < FEWEST_VALUES && changes() < fewest.max(values.len() / rows) {
        return None;
    }
    let differences: Vec<f64> = different.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let least = differences.iter().copied().fold(f64::INFINITY, f64::min);
    let single = || differences.iter().filter(|difference| **difference < 1.5 * least);
    let mut step = single().sum::<f64>() / single().count() as f64;
    // numbers of the values on the lattice, and the step that suits them best; twice, because larger differences need a better step
    for _ in 0..2 {
        let numbers = differences.iter().map(|difference| (difference / step).round());
        step = (different[different.len() - 1] - different[0]) / numbers.sum::<f64>();
    }
    let mut off = 0.0_f64;
    for value in &different {
        let number = (value - different[0]) / step;
        off = off.max((number - number.round()).abs());
    }
    let largest = different[0].abs().max(different[different.len() - 1].abs());
    (off < OFF_LATTICE && step > ROUNDING * largest).then_some(step)
}

/// Lists runs of equal values that noise and resolution do not explain, and masks them.
///
/// Where the resolution hides the noise, a run that a lone jump ends is listed; it stays in use where a true step may look the same.
pub(super) fn judge(context: &Context, mask: &mut [bool]) -> Vec<Finding> {
    let Context { time, values, summary, expectation, .. } = context;
    let used: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
    let step = summary.step.unwrap_or(0.0);
    let extreme = |fold: fn(f64, f64) -> f64| used.iter().map(|&row| values[row]).reduce(fold);
    let extremes = [extreme(f64::min), extreme(f64::max)];
    let mut findings = Vec::new();
    let mut end = 0;
    for run in used.chunk_by(|a, b| values[*a] == values[*b]) {
        end += run.len();
        let value = values[run[0]];
        if run.len() < SHORTEST {
            continue;
        }
        let noise = noise_beside(values, &used, end - run.len()..end).min(summary.noise.unwrap_or(0.0));
        // rounding to steps adds their variance to what differences show of a moving value
        let noise = (noise * noise - step * step / 12.0).max(0.0).sqrt();
        let shows = noise > HIDDEN * step;
        if !(if shows { unlikely(run.len(), used.len(), noise, step) } else { jumps(values, &used, end, step) }) {
            continue;
        }
        let repair = if shows || !expectation.may_jump { Repair::Masked } else { Repair::None };
        if repair == Repair::Masked {
            run.iter().for_each(|&row| mask[row] = false);
        }
        let kind = if extremes.contains(&Some(value)) { FindingKind::Saturation(value) } else { FindingKind::Stuck(value) };
        let span = [time[run[0]], time[run[run.len() - 1]]];
        findings.push(Finding::at(kind, Severity::Warning, span, run.len(), repair));
    }
    findings
}

/// Noise on that side of a run where it is less: what a sensor that is stuck has, and a course at rest without noise has not.
///
/// Neighbouring second differences of white noise tend to be opposite; of bends and decays they are alike.
fn noise_beside(values: &[f64], used: &[usize], run: Range<usize>) -> f64 {
    let of = |rows: &[usize]| {
        let second = |row: &[usize]| values[row[0]] - 2.0 * values[row[1]] + values[row[2]];
        let products = rows.windows(4).map(|four| second(&four[..3]) * second(&four[1..])).collect();
        (-median(products).unwrap_or(0.0) / OPPOSITE).max(0.0).sqrt()
    };
    // saturation comes and goes at first
    let other = |row: &usize| values[*row] != values[used[run.start]];
    let after: Vec<usize> = used[run.end..].iter().take(REACH).copied().filter(other).take(BESIDE).collect();
    let mut before: Vec<usize> = used[..run.start].iter().rev().take(REACH).copied().filter(other).take(BESIDE).collect();
    before.reverse();
    let sides = [before, after];
    sides.iter().filter(|side| side.len() >= BESIDE / 2).map(|side| of(side)).reduce(f64::min).unwrap_or(0.0)
}

/// Whether the run before the used row number `end` ends in a jump after which the values go on as if nothing had happened.
fn jumps(values: &[f64], used: &[usize], end: usize, step: f64) -> bool {
    let Some(&[last, first, next]) = used.get(end - 1..end + 2) else { return false };
    (values[first] - values[last]).abs() > JUMP * step.max((values[next] - values[first]).abs())
}

/// Whether a run is too long for noise that is rounded to steps: each value meets the one before with probability step/(2√π noise).
fn unlikely(length: usize, rows: usize, noise: f64, step: f64) -> bool {
    let meets = (step / (2.0 * std::f64::consts::PI.sqrt() * noise)).min(0.9);
    rows as f64 * meets.powf(length as f64 - 1.0) < CHANCE
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::{ChannelSummary, Expectation};

    /// Runs that are found: first row, length and whether they are masked.
    fn found(values: &[f64], noise: Option<f64>, step: Option<f64>) -> Vec<(f64, usize, Repair)> {
        let time: Vec<f64> = (0..values.len()).map(|n| n as f64).collect();
        let summary = ChannelSummary {
            name: "air".into(),
            unit: "degC".into(),
            present: values.len(),
            used: values.len(),
            least: f64::NAN,
            median: f64::NAN,
            largest: f64::NAN,
            noise,
            step,
        };
        let expectation = Expectation::default();
        let context = Context { time: &time, values, summary: &summary, interval: 1.0, expectation: &expectation };
        let findings = judge(&context, &mut vec![true; values.len()]);
        findings.iter().map(|finding| (finding.span.expect("a span")[0], finding.rows, finding.repair)).collect()
    }

    /// Noise that goes to and fro between 0 and 1.
    fn to_and_fro(rows: usize) -> Vec<f64> {
        (0..rows).map(|n| (n % 2) as f64).collect()
    }

    /// Of second differences that are 2 and −2 by turns.
    fn noise_to_and_fro() -> f64 {
        (4.0 / OPPOSITE).sqrt()
    }

    #[test]
    fn exact_five_values_or_sixteen_changes_tell_a_resolution() {
        assert_eq!([4, 5].map(|count| step(&[7.25, 8.25, 9.25, 10.25, 11.25][..count])), [None, Some(1.0)]);
        assert_eq!([16, 17].map(|rows| step(&to_and_fro(rows))), [None, Some(1.0)]);
    }

    #[test]
    fn exact_one_and_a_half_of_the_least_difference_are_two_steps() {
        assert_eq!(step(&[0.0, 1.5, 2.5, 4.0, 5.5]), Some(5.5 / 7.0));
        assert_eq!(step(&[0.0, 1.4375, 2.4375, 3.875, 5.3125]), Some(5.3125 / 4.0));
    }

    #[test]
    fn exact_a_ten_billionth_of_the_largest_value_is_rounding() {
        let up_to = |largest: f64| step(&[4.0, 3.0, 2.0, 1.0, 0.0].map(|below| largest - below));
        assert_eq!([1e10, 0.5e10, -0.5e10 + 4.0].map(up_to), [None, Some(1.0), Some(1.0)]);
    }

    #[test]
    fn exact_eight_equal_values_are_a_run() {
        let run = |rows: usize| found(&[to_and_fro(30), vec![0.5; rows], to_and_fro(30)].concat(), Some(1.0), None);
        assert_eq!([7, 8].map(run), [vec![], vec![(30.0, 8, Repair::Masked)]]);
    }

    #[test]
    fn a_long_rest_of_a_course_without_noise_is_sound() {
        let slope = |n: usize| n as f64 / 3.0;
        let course: Vec<f64> = (0..500).map(|n| slope(n.min(100)) + slope(n.saturating_sub(400))).collect();
        assert_eq!([None, Some(0.0)].map(|noise| found(&course, noise, None)), [vec![], vec![]]);
    }

    /// The noise that is measured is a step over the root of twelve, less a little.
    #[test]
    fn exact_a_run_of_a_coarse_channel_is_the_resolution_s() {
        let coarse = [to_and_fro(60), vec![2.0; 100], to_and_fro(60)].concat();
        assert_eq!([0.28, 1.0].map(|noise| found(&coarse, Some(noise), Some(1.0)).len()), [0, 1]);
    }

    #[test]
    fn where_a_course_comes_to_rest_without_noise_noise_behind_it_is_not_its_own() {
        let ramp: Vec<f64> = (0..40).map(|n| 0.25 * f64::from(n)).collect();
        let noise: Vec<f64> = to_and_fro(60).iter().map(|value| 10.0 + 0.125 * value).collect();
        let course = [ramp, vec![10.0; 20], noise[1..].to_vec()].concat();
        assert_eq!(found(&course, Some(0.1), None), []);
    }

    #[test]
    fn exact_the_noise_beside_a_run_is_that_of_the_quieter_side() {
        let beside = |before: &[f64], after: &[f64]| {
            let values = [before, &[0.5; 10], after].concat();
            noise_beside(&values, &(0..values.len()).collect::<Vec<_>>(), before.len()..before.len() + 10)
        };
        let (all, half) = (to_and_fro(40), to_and_fro(40).iter().map(|value| 0.5 * value).collect::<Vec<_>>());
        let noise = noise_to_and_fro();
        // of half the size 0.5 itself is left out
        let quiet: Vec<f64> = half.iter().map(|value| value + 0.125).collect();
        assert_eq!([beside(&all, &all), beside(&quiet, &all), beside(&all, &quiet)], [noise, noise / 2.0, noise / 2.0]);
        // fewer than twelve rows tell nothing
        assert_eq!([beside(&[], &all), beside(&all, &[]), beside(&[], &[])], [noise, noise, 0.0]);
        assert_eq!([11, 12].map(|rows| beside(&quiet[..rows], &all)), [noise, noise / 2.0]);
    }

    #[test]
    fn exact_a_jump_is_more_than_five_steps_and_five_changes_behind_it() {
        let is_jump = |first: f64, next: f64, step: f64| jumps(&[0.0, first, next], &[0, 1, 2], 1, step);
        assert_eq!([5.0, 5.5].map(|first| is_jump(first, first, 1.0)), [false, true]);
        assert_eq!([5.0, 5.5].map(|first| is_jump(-first, -first - 1.0, 0.0)), [false, true]);
        assert!(!jumps(&[0.0, 9.0], &[0, 1], 1, 1.0));
    }

    /// Each value meets the one before in one of ten cases.
    #[test]
    fn exact_a_run_of_chance_is_in_no_more_than_a_millionth_of_recordings() {
        let noise = 4.0;
        let step = 0.1 * 2.0 * std::f64::consts::PI.sqrt() * noise;
        assert_eq!([8, 9, 10].map(|length| unlikely(length, 200, noise, step)), [false, false, true]);
        assert_eq!([8, 9, 10].map(|length| unlikely(length, 50, noise, step)), [false, true, true]);
    }

    /// Of a thousand rows with noise of a step, neighbours meet with a probability of 0.282: 17 alike are chance (1.6e-6), 18 are not (4.5e-7).
    #[test]
    fn exact_a_run_is_unlikely_from_a_length_on() {
        assert_eq!([17, 18].map(|length| unlikely(length, 1000, 1.0, 1.0)), [false, true]);
    }
}
