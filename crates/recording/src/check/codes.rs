//! Values that are no measurement: what physics forbids, and what a logger writes beyond its range.

use super::expectation::{Expectation, within};
use super::{Finding, FindingKind, Repair, Severity};

/// Sizes that codes have at most: an overload of either sign, no sensor, no number.
const SIZES: usize = 4;
/// Rows at each end in which no outlier is found ([`super::outliers`]).
const END: usize = 2;

/// Masks values that are impossible, and such as lie further from what is plausible than that is wide, where they are few and repeat to the
/// last digit, as measured ones do not, or one alone at an end.
pub(super) fn judge(time: &[f64], values: &[f64], expectation: &Expectation, mask: &mut [bool]) -> Option<Finding> {
    let used: Vec<usize> = (0..values.len()).filter(|&row| mask[row]).collect();
    let [low, high] = expectation.values;
    let wide = [low - (high - low), high + (high - low)];
    let mut sizes: Vec<f64> = used.iter().map(|&row| values[row]).filter(|v| !within(*v, wide)).map(f64::abs).collect();
    let few = 2 * sizes.len() < used.len();
    sizes.sort_by(f64::total_cmp);
    let codes: Vec<f64> = sizes.chunk_by(|a, b| a == b).filter(|same| same.len() > 1).map(|same| same[0]).collect();
    // one alone is told by its neighbours, which the ends lack
    let at_end = |row: &usize| used.iter().take(END).chain(used.iter().rev().take(END)).any(|end| end == row);
    let is_code = |row: &usize| {
        few && codes.len() <= SIZES
            && !within(values[*row], wide)
            && (codes.contains(&values[*row].abs()) || sizes.len() == 1 && at_end(row))
    };
    let found: Vec<usize> =
        used.iter().copied().filter(|row| !within(values[*row], expectation.possible) || is_code(row)).collect();
    let largest = found.iter().map(|&row| values[row]).reduce(|a, b| if b.abs() > a.abs() { b } else { a })?;
    found.iter().for_each(|&row| mask[row] = false);
    let span = [time[found[0]], time[found[found.len() - 1]]];
    Some(Finding::at(FindingKind::Impossible(largest), Severity::Warning, span, found.len(), Repair::Masked))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest of either sign, and of some as large the first.
    #[test]
    fn exact_the_largest_impossible_value_is_told() {
        let of = |values: [f64; 4]| {
            let expectation = Expectation { possible: [-8.0, 8.0], ..Expectation::default() };
            let mut mask = [true; 4];
            let finding = judge(&[0.0, 1.0, 2.0, 3.0], &values, &expectation, &mut mask)?;
            assert_eq!((mask, finding.rows, finding.span), ([true, false, false, false], 3, Some([1.0, 3.0])));
            Some(finding.kind)
        };
        let told = |largest| Some(FindingKind::Impossible(largest));
        assert_eq!(of([1.0, 9.0, -12.0, 11.0]), told(-12.0));
        assert_eq!(of([1.0, -12.0, 12.0, 11.0]), told(-12.0));
        assert_eq!(of([1.0, 10.0, 9.0, -9.0]), told(10.0));
    }

    /// Values that are found among ten rows between 0 and 1, where −1 to 2 is not far from what is plausible.
    fn found(codes: &[f64]) -> Option<usize> {
        let expectation = Expectation { values: [0.0, 1.0], ..Expectation::default() };
        let mut values = [0.5; 10];
        values[2..2 + codes.len()].copy_from_slice(codes);
        judge(&[0.0; 10], &values, &expectation, &mut [true; 10]).map(|finding| finding.rows)
    }

    #[test]
    fn exact_codes_are_less_than_half_of_the_values() {
        assert_eq!([4, 5].map(|rows| found(&[9.0; 5][..rows])), [Some(4), None]);
    }

    #[test]
    fn exact_what_does_not_repeat_is_no_code() {
        assert_eq!([found(&[5.0, 7.0]), found(&[5.0, 7.0, 5.0]), found(&[5.0, -5.0])], [None, Some(2), Some(2)]);
    }
}
