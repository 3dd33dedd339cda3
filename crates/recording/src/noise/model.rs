//! The noise of a rate sensor as a linear stochastic system.

use crate::Error;

/// White noise, exponentially correlated drift, rate random walk and quantisation, independent of each other.
///
/// A sample is the mean over the `averaging` seconds before its instant, or since the instant before if that is nearer; with
/// `averaging` = 0 it is the value at its instant. Units: u is the channel's. A term whose size is 0 is absent.
///
/// The rate is `white + drift + walk + d(angle rounding)/dt` with `d drift = −drift/T dt + √(2σ²/T) dW`, `d walk = K dW`
/// (IEEE Std 952-1997, annex C; the drift is its exponentially correlated, Markov, noise and stands for bias instability).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseModel {
    /// Span of a sample \[s\], 0 for momentary values.
    pub averaging: f64,
    /// White noise of a sample over the full span, standard deviation \[u\]; positive.
    pub white: f64,
    /// Drift, standard deviation σ \[u\].
    pub drift: f64,
    /// Correlation time T of the drift \[s\]; positive, without meaning if there is no drift.
    pub drift_time: f64,
    /// Rate random walk K \[u/√s\].
    pub walk: f64,
    /// Quantisation Q: standard deviation of the rounding of the integrated sample \[u s\]; needs a span.
    pub quantisation: f64,
    /// Noise of the driving temperature as it reaches the output: a second drift, standard deviation \[u\].
    pub passed: f64,
    /// Its correlation time \[s\]; positive, without meaning if there is none.
    pub passed_time: f64,
}

impl NoiseModel {
    /// White noise alone.
    pub fn white(sd: f64, averaging: f64) -> Self {
        Self { averaging, white: sd, drift: 0.0, drift_time: 1.0, walk: 0.0, quantisation: 0.0, passed: 0.0, passed_time: 1.0 }
    }

    /// Angle random walk N = white · √averaging \[u √s\]; none for momentary values.
    pub fn angle_random_walk(&self) -> Option<f64> {
        (self.averaging > 0.0).then(|| self.white * self.averaging.sqrt())
    }

    /// Bias instability: the flat of the drift's own Allan deviation \[u\], 0.6174 σ, at 1.8926 T.
    pub fn bias_instability(&self) -> f64 {
        DRIFT_PEAK * self.drift
    }

    /// Allan deviation of means over `tau` \[s\], `tau` a multiple of the span (IEEE Std 952-1997, C.1) \[u\].
    ///
    /// For momentary values the white noise falls with the number of samples, which needs `interval`, the time between them \[s\].
    pub fn allan_deviation(&self, tau: f64, interval: f64) -> f64 {
        let span = if self.averaging > 0.0 { self.averaging } else { interval };
        let white = self.white.powi(2) * span / tau;
        let drift = (self.drift * self.drift) * drift_allan(tau / self.drift_time);
        let walk = self.walk.powi(2) * tau / 3.0;
        let quantisation = 3.0 * (self.quantisation / tau).powi(2);
        let passed = (self.passed * self.passed) * drift_allan(tau / self.passed_time);
        (white + drift + walk + quantisation + passed).sqrt()
    }

    /// Checks every parameter.
    ///
    /// # Errors
    /// [`Error::Parameter`] names the first that is out of its range.
    pub fn check(&self) -> Result<(), Error> {
        let Self { averaging, white, drift, drift_time, walk, quantisation, passed, passed_time } = *self;
        let (zero_or_more, positive) = ("0 or more, and finite", "positive and finite");
        let with_a_span = "0 or more and finite, and 0 for momentary values";
        let rules = [
            ("averaging", averaging, averaging >= 0.0, zero_or_more),
            ("white", white, white > 0.0, positive),
            ("drift", drift, drift >= 0.0, zero_or_more),
            ("drift_time", drift_time, drift_time > 0.0, positive),
            ("walk", walk, walk >= 0.0, zero_or_more),
            ("passed", passed, passed >= 0.0, zero_or_more),
            ("passed_time", passed_time, passed_time > 0.0, positive),
            ("quantisation", quantisation, quantisation == 0.0 || (quantisation > 0.0 && averaging > 0.0), with_a_span),
        ];
        match rules.into_iter().find(|(_, value, holds, _)| !(*holds && value.is_finite())) {
            Some((name, value, _, range)) => Err(Error::Parameter { name, value, range }),
            None => Ok(()),
        }
    }
}

/// Largest value of the square root of [`drift_allan`], at 1.8926.
const DRIFT_PEAK: f64 = 0.617_364_3;

/// Allan variance of a drift of unit variance and unit correlation time for means over `x`.
fn drift_allan(x: f64) -> f64 {
    if x < 1e-3 {
        return 2.0 * x / 3.0 * (1.0 - 0.75 * x); // the closed form cancels
    }
    2.0 / x * (1.0 - (3.0 - 4.0 * (-x).exp() + (-2.0 * x).exp()) / (2.0 * x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_drift_peaks_where_it_is_said_to() {
        let peak = (1..400_000).map(|i| f64::from(i) * 1e-5).map(|x| (drift_allan(x).sqrt(), x));
        let (height, at) = peak.fold((0.0, 0.0), |best, next| if next.0 > best.0 { next } else { best });
        assert!((height - DRIFT_PEAK).abs() < 1e-6, "{height} at {at}");
        assert!((at - 1.8926).abs() < 1e-3, "{at}");
    }

    #[test]
    fn the_series_meets_the_closed_form() {
        let closed = |x: f64| 2.0 / x * (1.0 - (3.0 - 4.0 * (-x).exp() + (-2.0 * x).exp()) / (2.0 * x));
        assert!((drift_allan(0.999e-3) / closed(0.999e-3) - 1.0).abs() < 1e-6);
        // where the closed form would cancel
        for x in [1e-12, 1e-8, 1e-6, 1e-5] {
            assert!((drift_allan(x) / (2.0 * x / 3.0) - 1.0).abs() < 1e-5, "{x}");
        }
    }

    /// White noise falls with the root of the time over the span of a mean, or, of momentary values, over the time between them.
    #[test]
    fn exact_white_noise_in_an_allan_plot() {
        assert_eq!(NoiseModel::white(3.0, 2.0).allan_deviation(8.0, 99.0), 1.5);
        assert_eq!(NoiseModel::white(3.0, 0.0).allan_deviation(8.0, 2.0), 1.5);
    }
}
