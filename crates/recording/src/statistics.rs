//! Robust measures and the chi-square distribution.

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

/// ln Γ(x), x > 0, by Stirling's series after a shift; to 1e-13.
fn ln_gamma(mut x: f64) -> f64 {
    let mut shift = 0.0;
    while x < 12.0 {
        shift += x.ln();
        x += 1.0;
    }
    let r = 1.0 / (x * x);
    let series = (1.0 / 12.0 - r * (1.0 / 360.0 - r * (1.0 / 1260.0 - r * (1.0 / 1680.0 - r / 1188.0)))) / x;
    (x - 0.5) * x.ln() - x + 0.5 * std::f64::consts::TAU.ln() + series - shift
}

/// Probability that a chi-square variable of `freedom` > 0 degrees is below `x`.
pub fn chi_square_below(x: f64, freedom: f64) -> f64 {
    let (a, x) = (freedom / 2.0, x / 2.0);
    if x <= 0.0 {
        return 0.0;
    }
    let scale = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > 1e-17 * sum {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return (scale * sum).min(1.0);
    }
    // Lentz's continued fraction (Abramowitz and Stegun 6.5.31)
    let tiny = 1e-300;
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1.0 / tiny, 1.0 / b);
    let mut h = d;
    for i in 1..100_000 {
        let an = -f64::from(i) * (f64::from(i) - a);
        b += 2.0;
        d = 1.0 / (an * d + b).abs().max(tiny).copysign(an * d + b);
        c = (b + an / c).abs().max(tiny).copysign(b + an / c);
        h *= d * c;
        if (d * c - 1.0).abs() < 1e-15 {
            break;
        }
    }
    (1.0 - scale * h).max(0.0)
}

/// The value that a chi-square variable of `freedom` > 0 degrees stays below with `probability` in (0, 1).
pub fn chi_square_quantile(probability: f64, freedom: f64) -> f64 {
    let (mut low, mut high) = (0.0, freedom + 10.0);
    while chi_square_below(high, freedom) < probability {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..80 {
        let middle = low / 2.0 + high / 2.0;
        if chi_square_below(middle, freedom) < probability { low = middle } else { high = middle }
    }
    low / 2.0 + high / 2.0
}

/// Probability of residuals at least as correlated as these if they are white (Ljung and Box, *Biometrika* 65, 297, 1978).
///
/// `lags` correlations are tested together. A small value says that the series is not white. 1 for fewer values than `lags` + 2.
pub fn whiteness(series: &[f64], lags: usize) -> f64 {
    let n = series.len();
    if n < lags + 2 || lags == 0 {
        return 1.0;
    }
    let mean = series.iter().sum::<f64>() / n as f64;
    let product = |lag: usize| -> f64 { (lag..n).map(|i| (series[i] - mean) * (series[i - lag] - mean)).sum() };
    let total = product(0);
    if total == 0.0 {
        return 1.0;
    }
    let sum: f64 = (1..=lags).map(|lag| (product(lag) / total).powi(2) / (n - lag) as f64).sum();
    1.0 - chi_square_below(n as f64 * (n as f64 + 2.0) * sum, lags as f64)
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
        // two degrees: 1 − exp(−x/2), on both branches
        for x in [0.1, 1.0, 3.0, 5.0, 30.0] {
            assert!((chi_square_below(x, 2.0) - (1.0 - (-x / 2.0_f64).exp())).abs() < 1e-14, "{x}");
        }
        // many degrees: normal
        assert!((chi_square_below(1e6, 1e6) - 0.5).abs() < 3e-4);
    }

    #[test]
    fn ln_gamma_meets_factorials() {
        assert!((ln_gamma(0.5) - std::f64::consts::PI.sqrt().ln()).abs() < 1e-13);
        assert!((ln_gamma(5.0) - 24.0_f64.ln()).abs() < 1e-13);
    }

    #[test]
    fn an_alternation_is_not_white() {
        let alternating: Vec<f64> = (0..100_i32).map(|i| f64::from(i % 2)).collect();
        assert!(whiteness(&alternating, 5) < 1e-12);
        assert_eq!(whiteness(&[0.0; 50], 5), 1.0);
    }
}
