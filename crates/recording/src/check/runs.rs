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
