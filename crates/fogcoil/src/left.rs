//! What a fit leaves of a channel in a record, beside the noise of the record's own rows.

use diagnosis::NoisePrior;
use recording::check::white_noise;

/// Usual drift over the median of its prior: about a standard deviation of its logarithm above. The median is a share of the white noise over a minute,
/// so that neither the size of the noise nor the length of rows matters.
const USUAL: f64 = 2.0;
/// Ratio of a residual to noise with usual drift from which it is more than noise. A record of a dozen correlation times of the drift holds some six
/// stretches of it, from which its size is known to 1/√(2·6) = 0.29: three times that above one, 1 + 3·0.29, rounded.
const MISFIT: f64 = 2.0;

/// Residual in one channel of a record, in the channel's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Left {
    /// Root mean square of recorded less fitted.
    pub(crate) rms: f64,
    /// Noise of a row: its difference from its neighbours, without slow changes.
    pub(crate) noise: f64,
    /// The same with the usual drift beside it, and the noise of the chamber's thermometer, passed through the model.
    pub(crate) with_drift: f64,
}

impl Left {
    /// Of the residual in the rows of a record, NaN where there is none; `white` is the noise of rows that do not differ from their neighbours. `None` for a channel that
    /// was not recorded.
    pub(crate) fn of(time: &[f64], residual: &[f64], beforehand: &NoisePrior, white: f64) -> Option<Self> {
        let used: Vec<f64> = residual.iter().copied().filter(|r| r.is_finite()).collect();
        let rms = (used.iter().map(|r| r * r).sum::<f64>() / used.len() as f64).sqrt();
        let mask: Vec<bool> = residual.iter().map(|r| r.is_finite()).collect();
        let noise = white_noise(time, residual, &mask).filter(|sd| *sd > 0.0).unwrap_or(white);
        // as known beforehand: where a fit leaves something unexplained, its own noise has swallowed that
        let NoisePrior { drift, passed, .. } = beforehand;
        let with_drift = noise.hypot(USUAL * drift.0).hypot(passed.0 * passed.1.exp());
        rms.is_finite().then_some(Self { rms, noise, with_drift })
    }

    /// Residual over noise with usual drift.
    pub(crate) fn over_noise(&self) -> f64 {
        self.rms / self.with_drift
    }

    /// Whether it is more than noise.
    pub(crate) fn is_misfit(&self) -> bool {
        self.over_noise() > MISFIT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise of 1 in rows of half a minute, and two rows that are far off: whatever a fit takes for noise, neighbours tell it.
    #[test]
    fn two_rows_far_off_are_no_noise() {
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 40) as f64 / f64::from(1_u32 << 24) - 0.5) * 12.0_f64.sqrt()
        };
        let time: Vec<f64> = (0..1000).map(|n| 30.0 * f64::from(n)).collect();
        let beforehand = NoisePrior::new((1.0, 0.5), (0.3, 1.2), (5000.0, 0.8), (1e-4, 1.5));
        for scale in [1e-6, 1.0, 1e6] {
            let mut rows: Vec<f64> = (0..1000).map(|_| scale * noise()).collect();
            let beforehand = NoisePrior { drift: (scale * 0.3, 1.2), ..beforehand };
            let sound = Left::of(&time, &rows, &beforehand, 0.0).expect("it was recorded");
            assert!(!sound.is_misfit() && (sound.noise / scale - 1.0).abs() < 0.15, "{sound:?}");
            (rows[0], rows[1]) = (115.0 * scale, -115.0 * scale);
            let off = Left::of(&time, &rows, &beforehand, 0.0).expect("it was recorded");
            assert!(off.is_misfit() && off.over_noise() > 4.0, "{off:?}");
        }
        assert_eq!(Left::of(&time, &[f64::NAN; 1000], &beforehand, 1.0), None);
    }
}
