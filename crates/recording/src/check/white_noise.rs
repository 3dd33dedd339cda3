//! White noise of a channel.

use crate::series;
use crate::statistics::{normal_quantile, robust_sd};

/// Standard deviation of white noise from differences of neighbours, which a slow signal hardly touches; outliers do not count.
///
/// Second differences, or fourth ones where those show that the second hold a signal's curvature. Of noise far below the resolution
/// it gives what the resolution leaves of it. `None` without three used neighbours.
pub fn white_noise(time: &[f64], values: &[f64], mask: &[bool]) -> Option<f64> {
    let second = from_differences(time, values, mask, &SECOND)?;
    Some(white_noise_beyond_cubics(time, values, mask).filter(|fourth| *fourth < CURVED * second).unwrap_or(second))
}

/// The same from fourth differences alone, which no cubic touches: a little less certain, and freer of a signal. `None` without five used neighbours.
pub fn white_noise_beyond_cubics(time: &[f64], values: &[f64], mask: &[bool]) -> Option<f64> {
    from_differences(time, values, mask, &FOURTH)
}

fn from_differences(time: &[f64], values: &[f64], mask: &[bool], weights: &[f64]) -> Option<f64> {
    // of readings that do not stand in every row, neighbours are those that follow each other
    let used: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
    let at: Vec<f64> = used.iter().map(|&row| time[row]).collect();
    let interval = series::median_interval(&at)?;
    let rounding = ROUNDING * used.iter().fold(0.0_f64, |most, &row| most.max(values[row].abs()));
    let reach = weights.len() - 1;
    let difference = |n: usize| {
        let together = at[n + reach] - at[n] < (reach as f64 + 0.5) * interval;
        together.then(|| used[n..=n + reach].iter().zip(weights).map(|(&row, weight)| weight * values[row]).sum::<f64>())
    };
    let differences: Vec<f64> = (0..used.len().saturating_sub(reach)).filter_map(difference).collect();
    Some(inner_sd(&differences, rounding)? / weights.iter().map(|weight| weight * weight).sum::<f64>().sqrt())
}

/// Weights of second differences: no slope passes.
const SECOND: [f64; 3] = [1.0, -2.0, 1.0];
/// Weights of fourth differences: no cubic passes.
const FOURTH: [f64; 5] = [1.0, -4.0, 6.0, -4.0, 1.0];
/// Share of the second differences' estimate that the fourth ones' falls below if there is curvature: far beyond chance.
const CURVED: f64 = 0.7;

/// Share of the largest value that arithmetic leaves of equal ones.
const ROUNDING: f64 = 1e-12;

/// Root mean square of values about 0 without their outliers; a median that is not above `rounding` counts as 0.
fn inner_sd(values: &[f64], rounding: f64) -> Option<f64> {
    let robust = robust_sd(values.iter().copied(), 0.0)?;
    // of a coarsely resolved series the median may be 0: then the size that 5 % exceed, 1.96 standard deviations, takes its place
    let exceeded = || largest_but(0.05, values.iter().map(|value| value.abs()).collect()) / normal_quantile(0.975);
    let scale = if robust > rounding { robust } else { exceeded() };
    let inner = || values.iter().filter(|value| value.abs() <= INNER * scale);
    Some((inner().map(|value| value * value).sum::<f64>() / inner().count() as f64).sqrt())
}

/// Values beyond so many standard deviations are outliers.
const INNER: f64 = 4.0;

/// The largest value but a share of them.
fn largest_but(share: f64, mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() - 1 - (share * values.len() as f64) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A channel that stands still for most rows, in values that are no binary fractions.
    #[test]
    fn noise_of_a_coarsely_resolved_channel_is_not_what_arithmetic_leaves() {
        let time: Vec<f64> = (0..400).map(f64::from).collect();
        for size in [1.0, 1e6] {
            // a step of the last digit in every twentieth row
            let value = |n: i32| 20.3 * size + if n % 20 == 7 { 0.1 } else { 0.0 } + 1e-15 * size * f64::from(n % 3);
            let values: Vec<f64> = (0..400).map(value).collect();
            let noise = white_noise(&time, &values, &vec![true; 400]).unwrap();
            assert!((0.01..0.05).contains(&noise), "{size:e}: {noise:e}");
        }
        // what is rounded alone has no noise at all
        let still: Vec<f64> = (0..400).map(|n| 20.3 + 4e-15 * f64::from(n % 3)).collect();
        assert!(white_noise(&time, &still, &vec![true; 400]).unwrap() < 1e-13);
    }

    #[test]
    fn exact_a_median_as_large_as_rounding_is_none() {
        let values = [[1.0; 9].as_slice(), &[10.0]].concat();
        let median = robust_sd([1.0].into_iter(), 0.0).unwrap();
        let [rounding, noise] = [median, 0.999 * median].map(|rounding| inner_sd(&values, rounding).unwrap());
        assert!((rounding - 10.9_f64.sqrt()).abs() < 1e-14 && noise == 1.0, "{rounding} {noise}");
    }

    /// A jump over one and a half intervals, and none.
    #[test]
    fn exact_neighbours_of_second_differences_are_within_two_and_a_half_intervals() {
        let noise =
            |pause: f64| white_noise(&[0.0, pause, pause + 1.0, pause + 2.0], &[10.0, 0.0, 0.0, 0.0], &[true; 4]).unwrap();
        assert_eq!(noise(1.5), 0.0);
        assert!((noise(1.25) - (50.0_f64 / 6.0).sqrt()).abs() < 1e-14, "{}", noise(1.25));
    }
}
