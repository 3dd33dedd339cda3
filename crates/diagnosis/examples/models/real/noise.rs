//! Noise as a record shows it, with nothing of the size of what is looked for.

use diagnosis::NoisePrior;

/// Standard deviation of a uniform error of a digit, over the digit.
const OF_DIGIT: f64 = 0.288_675;

/// White noise of a row, from second differences, in which slow changes cancel; at least what a display's last digit does. Beside it a drift, whose correlation
/// time is about a thirtieth of the record, and a random walk, as [`beside`] for a nominal model that says nothing.
pub(crate) fn of_record(series: &[f64], digit: f64, duration: f64) -> NoisePrior {
    let white = scatter(series).max(OF_DIGIT * digit);
    let prior = NoisePrior::new((white, 0.5), (white, 1.0), (SHARE * duration, 1.0), (white, 1.0));
    beside(&prior, super::offered::spread(series.iter().copied()))
}

/// The drift's correlation time over the record.
const SHARE: f64 = 1.0 / 30.0;

/// The same noise where a nominal model leaves so much of the record, root mean square. Noise may be slow on two scales, hence a drift and a walk: what either
/// does within the record lies between the white noise and all that is left. Its median is their geometric mean, its spread a factor of e.
pub(crate) fn beside(noise: &NoisePrior, left: f64) -> NoisePrior {
    let (white, duration) = (noise.white.0, noise.drift_time.0 / SHARE);
    let slow = (white * left.max(white)).sqrt();
    NoisePrior { drift: (slow, 1.0), walk: (slow / duration.sqrt(), 1.0), ..*noise }
}

/// Noise that is white alone: a fit under it is one by least squares.
pub(crate) fn plain(white: f64) -> NoisePrior {
    let none = (1e-6 * white, 1e-3);
    NoisePrior::new((white, 2.0), none, (200.0, 1e-3), (1e-9 * white, 1e-3))
}

/// Standard deviation of the noise of a row.
pub(crate) fn scatter(series: &[f64]) -> f64 {
    let mut d: Vec<f64> = series.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs()).filter(|d| d.is_finite()).collect();
    d.sort_by(f64::total_cmp);
    // of a normal variable the median magnitude is 0.6745 σ
    d.get(d.len() / 2).copied().unwrap_or(0.0) / 0.6745 / 6.0_f64.sqrt()
}
