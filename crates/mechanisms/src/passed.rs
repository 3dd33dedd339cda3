//! Errors of the chamber's temperature and of the model, as thermometer and rate have them: terms of each channel's noise.

use crate::course::{Clock, Course, RATE, SPOOL, Series, total};
use coil::Reduced;

/// Errors of the channels that are passed through the coil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Passed {
    /// Standard deviations.
    pub(crate) sd: [f64; 2],
    /// Correlation times \[s\].
    pub(crate) time: [f64; 2],
}

/// Responses to errors of the chamber's temperature are followed for so many of their own times, and in so many steps of each.
const FOLLOWED: (usize, usize) = (60, 6);

/// Effect on thermometer and rate of errors of the chamber's temperature of size `sd` \[K\], each over a `time` \[s\] and independent of the next.
///
/// The response of a channel to them is the sum of its responses h to hats of one error each: its variance is ∫h²/time, its correlation time
/// that after which the autocorrelation of h has fallen to 1/e.
pub(crate) fn passed(model: &Reduced, (sd, width): (f64, f64), averaging: f64) -> Passed {
    if sd <= 0.0 || !width.is_finite() || width <= 0.0 {
        return Passed::NONE;
    }
    let (many, steps) = FOLLOWED;
    let step = width / steps as f64;
    let time: Vec<f64> = (0..many * steps).map(|n| step * n as f64).collect();
    let hat: Vec<f64> = time.iter().map(|t| sd * (1.0 - (t / width - 1.0).abs()).max(0.0)).collect();
    let clock = Clock { begins: vec![false; time.len()], rows: (0..time.len()).collect(), chamber: hat.clone(), time };
    let Series { sensor, parts } = Course::new(model, &clock, &[hat], &[0.0]).series(model);
    let rate = total(&parts);
    // a reading is a mean
    let window = ((averaging / step).round() as usize).max(1);
    let mean: Vec<f64> =
        (0..rate.len()).map(|n| rate[n.saturating_sub(window - 1)..=n].iter().sum::<f64>() / window as f64).collect();
    let [spool, rate] = [&sensor, &mean].map(|h| (overlaid(h, step, width), decay(h, step)));
    Passed { sd: [spool.0, rate.0], time: [spool.1, rate.1] }
}

/// Standard deviation of a sum of responses h, one after each `width` \[s\] and of either sign: h in steps of `step` \[s\].
fn overlaid(h: &[f64], step: f64, width: f64) -> f64 {
    (squares(h) * step / width).sqrt()
}

/// Time after which the autocorrelation of a response in steps of `step` \[s\] has fallen to 1/e; the length of the response where it never does.
fn decay(h: &[f64], step: f64) -> f64 {
    let product = |lag: usize| h.iter().zip(&h[lag..]).map(|(a, b)| a * b).sum::<f64>();
    let limit = squares(h) / std::f64::consts::E;
    (1..h.len()).find(|lag| product(*lag) < limit).unwrap_or(h.len()) as f64 * step
}

fn squares(h: &[f64]) -> f64 {
    h.iter().map(|x| x * x).sum()
}

impl Passed {
    pub(crate) const NONE: Self = Self { sd: [0.0; 2], time: [1.0; 2] };

    /// The same with the model's own error, for which no gain makes up.
    pub(crate) fn with_model_error(self, base: &Series) -> Self {
        let rate = total(&base.parts);
        let with = |channel: usize, by: f64| {
            let [own, added] = [self.sd[channel].powi(2), by * by];
            let time = (own * self.time[channel] + added * MODEL_ERROR_TIME) / (own + added).max(f64::MIN_POSITIVE);
            ((own + added).sqrt(), time)
        };
        let size = |series: &[f64]| (series.iter().map(|x| x * x).sum::<f64>() / series.len().max(1) as f64).sqrt();
        let mean = base.sensor.iter().sum::<f64>() / base.sensor.len().max(1) as f64;
        let around: Vec<f64> = base.sensor.iter().map(|t| t - mean).collect();
        let [spool, rate] = [with(SPOOL, MODEL_ERROR[SPOOL] * size(&around)), with(RATE, MODEL_ERROR[RATE] * size(&rate))];
        Self { sd: [spool.0, rate.0], time: [spool.1, rate.1] }
    }
}

/// Errors of a model beside its gain, of thermometer and rate, relative to their own size, and the time over which each is one error, of the
/// order of a coil's slowest transients \[s\].
///
/// Measured and rounded up: this chain and an independent code with meshes of its own differ by 0.1 % of the rate, rms, beside a gain, on coils of
/// 40, 90 and 130 mm. Another code, or a section that is no rectangle, may be off by more.
const MODEL_ERROR: [f64; 2] = [2e-4, 1.5e-3];
const MODEL_ERROR_TIME: f64 = 1500.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_responses_that_decay_have_their_own_time_and_add_up_to_their_size() {
        // h = a exp(-t/τ): ∫h² = a² τ/2, autocorrelation exp(-lag/τ)
        let (a, tau, step, width) = (3.0, 40.0, 0.5, 10.0);
        let h: Vec<f64> = (0..4000).map(|n| a * f64::exp(-step * f64::from(n) / tau)).collect();
        assert!((decay(&h, step) - tau).abs() <= step, "{}", decay(&h, step));
        let expected = a * (tau / 2.0 / width).sqrt();
        assert!((overlaid(&h, step, width) / expected - 1.0).abs() < 1e-2, "{}", overlaid(&h, step, width));
        assert_eq!(decay(&[1.0; 4], step), 1.5);
        assert_eq!(decay(&[0.0; 4], step), 2.0);
    }
}
