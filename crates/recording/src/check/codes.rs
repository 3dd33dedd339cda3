//! Values that are no measurement: what physics forbids, and what a logger writes beyond its range.

use super::units::within;
use super::{Expectation, Finding, FindingKind, Repair, Severity};

/// Sizes that codes have at most: an overload of either sign, no sensor, no number.
const SIZES: usize = 4;

/// Masks values that are impossible, and such as repeat to the last digit further from what is plausible than that is wide, where they are
/// few: measured ones differ.
pub(super) fn judge(time: &[f64], values: &[f64], expectation: &Expectation, mask: &mut [bool]) -> Option<Finding> {
    let used: Vec<usize> = (0..values.len()).filter(|&row| mask[row]).collect();
    let [low, high] = expectation.values;
    let wide = [low - (high - low), high + (high - low)];
    let mut sizes: Vec<f64> = used.iter().map(|&row| values[row]).filter(|v| !within(*v, wide)).map(f64::abs).collect();
    let few = 2 * sizes.len() < used.len();
    sizes.sort_by(f64::total_cmp);
    let repeated: Vec<f64> = sizes.chunk_by(|a, b| a == b).filter(|same| same.len() > 1).map(|same| same[0]).collect();
    let is_code = |value: f64| few && repeated.len() <= SIZES && !within(value, wide) && repeated.contains(&value.abs());
    let found: Vec<usize> =
        used.into_iter().filter(|&row| !within(values[row], expectation.possible) || is_code(values[row])).collect();
    let largest = found.iter().map(|&row| values[row]).reduce(|a, b| if b.abs() > a.abs() { b } else { a })?;
    found.iter().for_each(|&row| mask[row] = false);
    let span = [time[found[0]], time[found[found.len() - 1]]];
    Some(Finding::at(FindingKind::Impossible(largest), Severity::Warning, span, found.len(), Repair::Masked))
}
