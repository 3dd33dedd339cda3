//! Lone values far from their neighbours.

use super::channel::Context;
use super::{Finding, FindingKind, Repair, Severity};
use crate::statistics::median;

/// Neighbours on each side.
const REACH: usize = 3;
/// Neighbours lie within so many intervals.
const NEAR: f64 = 4.5;
/// Distance from the neighbours' median, in standard deviations of the noise: of normal noise one value in 10⁹.
const FAR: f64 = 6.5;
/// How much of the distance the value has to keep to both values beside it, and how much of it the neighbours may differ.
const LONE: [f64; 2] = [0.6, 0.5];

/// Hampel's test against the median of three neighbours on each side, which a ramp passes; a step, or a bend, is no outlier.
///
/// The first and last two rows are not judged.
pub(super) fn judge(context: &Context, mask: &mut [bool]) -> Option<Finding> {
    let Context { time, values, summary, interval } = context;
    let noise = summary.noise?.max(summary.step.unwrap_or(0.0) / 2.0);
    let used: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
    let mut found: Vec<(usize, f64)> = Vec::new();
    for n in 2..used.len().saturating_sub(2) {
        let row = used[n];
        let [left, right] = [used[n - 1], used[n + 1]].map(|other| values[row] - values[other]);
        if left.signum() != right.signum() || left.abs().min(right.abs()) <= LONE[0] * FAR * noise {
            continue; // what no median can make an outlier
        }
        let near = |m: &usize| (time[used[*m]] - time[row]).abs() < NEAR * interval;
        let before: Vec<usize> = (n.saturating_sub(REACH)..n).filter(near).collect();
        let after: Vec<usize> = (n + 1..(n + 1 + REACH).min(used.len())).filter(near).collect();
        let balanced = before.len().min(after.len());
        if balanced < 2 {
            continue;
        }
        let (before, after) = (&before[before.len() - balanced..], &after[..balanced]);
        let around: Vec<f64> = before.iter().chain(after).map(|&m| values[used[m]]).collect();
        // one of the neighbours may be an outlier itself
        let mut sorted = around.clone();
        sorted.sort_by(f64::total_cmp);
        let range = (sorted[sorted.len() - 2] - sorted[0]).min(sorted[sorted.len() - 1] - sorted[1]);
        let distance = values[row] - median(around).unwrap_or(values[row]);
        let beside = [left, right].map(|side| side * distance.signum());
        let lone = beside.into_iter().all(|side| side > LONE[0] * distance.abs()) && range < LONE[1] * distance.abs();
        if distance.abs() > FAR * noise && lone {
            found.push((row, distance.abs()));
        }
    }
    found.iter().for_each(|(row, _)| mask[*row] = false);
    let (first, last) = (found.first()?.0, found.last()?.0);
    let largest = found.iter().fold(0.0_f64, |most, (_, distance)| most.max(*distance));
    let span = [time[first], time[last]];
    Some(Finding::at(FindingKind::Outliers(largest), Severity::Note, span, found.len(), Repair::Masked))
}
