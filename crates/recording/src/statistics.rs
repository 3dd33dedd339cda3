//! Robust measures, quantiles, and a test of whiteness.

use statrs::distribution::{ChiSquared, ContinuousCDF, Normal, StudentsT};

/// Median; `None` of nothing. Values are finite.
pub fn median(mut values: Vec<f64>) -> Option<f64> {
    if values.is_empty() {
        return None;
    }
    let (middle, even) = (values.len() / 2, values.len().is_multiple_of(2));
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Some(if even { lower / 2.0 + upper / 2.0 } else { upper })
}

/// Standard deviation of normal values from the median of their distances to `centre`: 1.4826 times it.
pub fn robust_sd(values: impl Iterator<Item = f64>, centre: f64) -> Option<f64> {
    median(values.map(|value| (value - centre).abs()).collect()).map(|distance| MAD_TO_SD * distance)
}

/// 1 / Φ⁻¹(3/4).
const MAD_TO_SD: f64 = 1.482_602_218_505_602;

/// The value that a standard normal variable stays below with `probability` in (0, 1); NaN for another probability.
pub fn normal_quantile(probability: f64) -> f64 {
    if is_probability(probability) { Normal::standard().inverse_cdf(probability) } else { f64::NAN }
}

fn is_probability(value: f64) -> bool {
    value > 0.0 && value < 1.0
}

/// The value that a chi-square variable of `freedom` > 0 degrees stays below with `probability` in (0, 1); NaN for another probability or
/// freedom.
///
/// By bisection: Newton's method in `statrs` 0.18 is off by 0.3 % at some 300 degrees of freedom and gives NaN for a million.
pub fn chi_square_quantile(probability: f64, freedom: f64) -> f64 {
    let Ok(distribution) = ChiSquared::new(freedom) else { return f64::NAN };
    // no value has it: the search below would never end
    if !(is_probability(probability) && freedom.is_finite()) {
        return f64::NAN;
    }
    let (mut low, mut high) = (0.0, freedom + 10.0);
    while distribution.cdf(high) < probability {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..80 {
        let middle = low / 2.0 + high / 2.0;
        if distribution.cdf(middle) < probability { low = middle } else { high = middle }
    }
    low / 2.0 + high / 2.0
}

/// The value that Student's t of `freedom` > 0 degrees stays below with `probability` in (0, 1); NaN for another probability or freedom.
pub fn student_quantile(probability: f64, freedom: f64) -> f64 {
    match StudentsT::new(0.0, 1.0, freedom) {
        Ok(distribution) if is_probability(probability) => distribution.inverse_cdf(probability),
        _ => f64::NAN,
    }
}

/// Probability that white noise is at least as correlated as a series (Ljung and Box, *Biometrika* 65, 297, 1978).
///
/// With the correlations r of x − x̄ at the first m = `lags` lags of n values, Q = n (n + 2) Σ r²/(n − lag) is χ² of m degrees if the series
/// is white. A small probability says that it is not. `None` for no lag, fewer than `lags` + 2 values, or a constant.
pub fn whiteness(series: &[f64], lags: usize) -> Option<f64> {
    let n = series.len() as f64;
    if series.len() < lags + 2 {
        return None;
    }
    let mean = series.iter().sum::<f64>() / n;
    let x: Vec<f64> = series.iter().map(|value| value - mean).collect();
    let product = |lag: usize| x.iter().zip(&x[lag..]).map(|(a, b)| a * b).sum::<f64>();
    let total: f64 = product(0);
    let squares = |lag: usize| (product(lag) / total).powi(2) / (n - lag as f64);
    let q = (1..=lags).map(squares).sum::<f64>() * n * (n + 2.0);
    let distribution = ChiSquared::new(lags as f64).ok()?;
    (total > 0.0).then(|| distribution.sf(q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median(vec![]), None);
        assert_eq!(median(vec![3.0]), Some(3.0));
        assert_eq!(median(vec![3.0, 1.0]), Some(2.0));
        assert_eq!(median(vec![5.0, 1.0, 3.0]), Some(3.0));
        assert_eq!(median(vec![5.0, 1.0, 3.0, 4.0]), Some(3.5));
    }

    #[test]
    fn chi_square_meets_its_tables() {
        // Abramowitz and Stegun, table 26.8
        let table =
            [(0.95, 1.0, 3.84146), (0.05, 10.0, 3.94030), (0.95, 30.0, 43.7730), (0.99, 100.0, 135.807), (0.05, 1.0, 0.00393214)];
        for (probability, freedom, value) in table {
            let found = chi_square_quantile(probability, freedom);
            assert!((found / value - 1.0).abs() < 1e-5, "{probability} {freedom}: {found} {value}");
        }
        // where Newton's method alone goes astray: Wilson and Hilferty (1931), good to 1e-5 there
        for freedom in [276.4_f64, 1.4e6] {
            let cube = |z: f64| freedom * (1.0 - 2.0 / (9.0 * freedom) + z * (2.0 / (9.0 * freedom)).sqrt()).powi(3);
            for probability in [0.05, 0.95] {
                let (found, expected) = (chi_square_quantile(probability, freedom), cube(normal_quantile(probability)));
                assert!((found / expected - 1.0).abs() < 1e-5, "{probability} {freedom}: {found} {expected}");
            }
        }
        // two degrees: −2 ln(1 − p)
        for probability in [0.01, 0.3, 0.999_f64] {
            let expected = -2.0 * (-probability).ln_1p();
            assert!((chi_square_quantile(probability, 2.0) / expected - 1.0).abs() < 1e-13, "{probability}");
        }
        assert!([-1.0, 0.0, f64::INFINITY, f64::NAN].into_iter().all(|freedom| chi_square_quantile(0.5, freedom).is_nan()));
    }

    #[test]
    fn student_meets_its_closed_forms_and_the_normal() {
        for probability in [0.01, 0.3, 0.975, 1.0 - 1e-4, 1.0 - 1e-6] {
            let upper = 1.0 - probability;
            let closed = [(1.0, -1.0 / (std::f64::consts::PI * probability).tan())];
            let two = (2.0 * probability - 1.0) / (2.0 * probability * upper).sqrt();
            for (freedom, expected) in closed.into_iter().chain([(2.0, two)]) {
                let found = student_quantile(probability, freedom);
                assert!((found / expected - 1.0).abs() < 1e-6, "{probability} {freedom}: {found} {expected}");
            }
        }
        // Abramowitz and Stegun, table 26.10
        assert!((student_quantile(0.995, 10.0) - 3.169).abs() < 5e-4 && (student_quantile(0.9995, 4.0) - 8.610).abs() < 5e-4);
        let many = student_quantile(1.0 - 1e-6, 1e6);
        assert!((many / normal_quantile(1.0 - 1e-6) - 1.0).abs() < 1e-4, "{many}");
        assert!(student_quantile(0.5, 0.0).is_nan() && student_quantile(0.5, f64::NAN).is_nan());
    }

    #[test]
    fn what_is_no_probability_has_no_quantile() {
        for probability in [-0.1, 0.0, 1.0, 1.5, f64::INFINITY, f64::NAN] {
            let quantiles =
                [chi_square_quantile(probability, 3.0), student_quantile(probability, 3.0), normal_quantile(probability)];
            assert!(quantiles.into_iter().all(f64::is_nan), "{probability}");
        }
    }

    #[test]
    fn the_median_distance_is_that_of_normal_values() {
        assert!((MAD_TO_SD * normal_quantile(0.75) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn an_alternation_is_not_white() {
        let alternating: Vec<f64> = (0..100_i32).map(|i| f64::from(i % 2)).collect();
        assert!(whiteness(&alternating, 5).is_some_and(|p| p < 1e-12));
        assert!(whiteness(&alternating[..7], 5).is_some_and(|p| p < 0.2));
        assert_eq!([whiteness(&[0.0; 50], 5), whiteness(&alternating[..6], 5), whiteness(&alternating, 0)], [None; 3]);
    }
}
