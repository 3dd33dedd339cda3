//! Rates, medians and means with their 90 % intervals.

use homogenization::identify::Random;
use recording::statistics::normal_quantile;

const RESAMPLES: usize = 4000;

/// A measured number with its 90 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// It lies between these with 90 % probability.
    pub interval: [f64; 2],
    /// Cases that it was measured on.
    pub cases: usize,
}

/// `hits` of `cases`; interval after Wilson (1927). `None` for no case.
pub fn rate(hits: usize, cases: usize) -> Option<Measured> {
    if cases == 0 {
        return None;
    }
    // a twentieth lies beyond either end
    let z = normal_quantile(0.95);
    let (n, p, z2) = (cases as f64, hits as f64 / cases as f64, z * z);
    let centre = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = z / (1.0 + z2 / n) * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    // at the ends the two terms are equal but for rounding
    let low = if hits == 0 { 0.0 } else { centre - half };
    let high = if hits == cases { 1.0 } else { centre + half };
    Some(Measured { value: p, interval: [low, high], cases })
}

/// The median; `None` for no value.
pub fn median(values: &[f64]) -> Option<Measured> {
    bootstrap(values, |sorted| middle(sorted.to_vec()))
}

/// The median alone; NaN of no value.
pub fn middle(values: Vec<f64>) -> f64 {
    recording::statistics::median(values).unwrap_or(f64::NAN)
}

/// The mean; `None` for no value.
pub fn mean(values: &[f64]) -> Option<Measured> {
    bootstrap(values, |sorted| sorted.iter().sum::<f64>() / sorted.len() as f64)
}

/// A statistic of sorted values, with the percentile interval of a bootstrap (Efron 1979) that always draws the same.
fn bootstrap(values: &[f64], statistic: impl Fn(&[f64]) -> f64) -> Option<Measured> {
    let sorted = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values
    };
    let values = sorted(values.to_vec());
    if values.is_empty() {
        return None;
    }
    let mut random = Random::new(1);
    let mut draw = || values[(random.bits() % values.len() as u64) as usize];
    let again = |_| statistic(&sorted((0..values.len()).map(|_| draw()).collect()));
    let resampled = sorted((0..RESAMPLES).map(again).collect());
    let interval = [0.05, 0.95].map(|share| resampled[(share * (RESAMPLES - 1) as f64).round() as usize]);
    Some(Measured { value: statistic(&values), interval, cases: values.len() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_s_interval_is_the_tabulated_one() {
        // 8 of 10 at 90 %: roots of (p − 0.8)² = z² p (1 − p)/10
        let of = rate(8, 10).unwrap();
        for p in of.interval {
            assert!(((p - 0.8).powi(2) - normal_quantile(0.95).powi(2) * p * (1.0 - p) / 10.0).abs() < 1e-12, "{of:?}");
        }
        assert_eq!(rate(0, 5).unwrap().interval[0], 0.0);
        assert_eq!(rate(5, 5).unwrap().interval[1], 1.0);
        assert!(rate(0, 0).is_none());
    }

    #[test]
    fn a_bootstrap_s_interval_has_the_width_of_theory() {
        let values: Vec<f64> = (0..400).map(|k| f64::from(k) / 400.0).collect();
        let Measured { value, interval, cases } = mean(&values).unwrap();
        assert!((value - 0.49875).abs() < 1e-12 && cases == 400);
        // uniform: standard deviation of the mean 1/√(12 n)
        let expected = 2.0 * normal_quantile(0.95) / (12.0 * 400.0_f64).sqrt();
        assert!(((interval[1] - interval[0]) / expected - 1.0).abs() < 0.1, "{interval:?}");
        assert_eq!(median(&[3.0, 1.0, 2.0, 10.0]).unwrap().value, 2.5);
        assert!(median(&[]).is_none());
    }
}
