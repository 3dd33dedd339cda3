//! Residuals of a unit's records under its constants, beside the noise of the records.

use diagnosis::{Fit, ForwardModel, NoisePrior, Observation};
use mechanisms::{Gyro, RATE, SPOOL};
use recording::check::white_noise;

use crate::table::significant;

/// Usual drift over the median of its prior: about a standard deviation of its logarithm above. The median is a share of the white noise over a minute,
/// so that neither the size of the noise nor the length of rows matters.
const USUAL: f64 = 2.0;
/// Ratio of a residual to noise with usual drift from which it is more than noise. A record of a dozen correlation times of the drift holds some six
/// stretches of it, from which its size is known to 1/√(2·6) = 0.29: three times that above one, 1 + 3·0.29, rounded.
const MISFIT: f64 = 2.0;

/// Residual of a fit in one channel of a record, in the channel's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Left {
    /// Root mean square of recorded less fitted.
    pub(super) rms: f64,
    /// Noise of a row: its difference from its neighbours, without slow changes.
    pub(super) noise: f64,
    /// The same with the usual drift beside it, and the noise of the chamber's thermometer, passed through the model.
    pub(super) with_drift: f64,
}

impl Left {
    /// Residual in the record of a unit in which it is largest over the noise; `None` for a channel that was not recorded.
    fn of(gyro: &Gyro, fit: &Fit, observations: &[Observation], channel: usize) -> Option<Self> {
        let left = observations.iter().zip(&fit.residuals).enumerate().filter_map(|(record, (observed, residuals))| {
            let residual = &residuals[channel];
            let used: Vec<f64> = residual.iter().copied().filter(|r| r.is_finite()).collect();
            let rms = (used.iter().map(|r| r * r).sum::<f64>() / used.len() as f64).sqrt();
            let mask: Vec<bool> = residual.iter().map(|r| r.is_finite()).collect();
            let noise = white_noise(&observed.time, residual, &mask)
                .filter(|sd| *sd > 0.0)
                .unwrap_or(fit.noise_model(record, channel).white);
            // as known beforehand: where a fit leaves something unexplained, its own noise has swallowed that
            let NoisePrior { drift, passed, .. } = gyro.channels()[channel].noise;
            let with_drift = noise.hypot(USUAL * drift.0).hypot(passed.0 * passed.1.exp());
            rms.is_finite().then_some(Self { rms, noise, with_drift })
        });
        left.max_by(|a, b| (a.rms / a.with_drift).total_cmp(&(b.rms / b.with_drift)))
    }

    /// Whether it is more than noise.
    pub(super) fn is_misfit(&self) -> bool {
        self.rms > MISFIT * self.with_drift
    }
}

/// Residuals of a unit's rate \[deg/h\] and of its thermometer \[K\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LeftOfUnit {
    pub(super) rate: Option<Left>,
    pub(super) spool: Option<Left>,
}

impl LeftOfUnit {
    pub(super) fn of(gyro: &Gyro, fit: &Fit, observations: &[Observation]) -> Self {
        let of = |channel| Left::of(gyro, fit, observations, channel);
        Self { rate: of(RATE), spool: of(SPOOL) }
    }

    /// Its channels, with their names and units.
    pub(super) fn channels(&self) -> impl Iterator<Item = (&'static str, &'static str, Left)> {
        [("rate", "deg/h", self.rate), ("spool's thermometer", "K", self.spool)]
            .into_iter()
            .filter_map(|(name, unit, left)| Some((name, unit, left?)))
    }

    /// Reason why the design cannot be this unit's; `None` where the residual is noise.
    pub(super) fn misfit(&self) -> Option<String> {
        let misfits: Vec<String> = self
            .channels()
            .filter(|(.., left)| left.is_misfit())
            .map(|(name, unit, Left { rms, with_drift, .. })| {
                let [rms, noise] = [rms, with_drift].map(|value| significant(value, 3));
                format!("{rms} {unit} of the {name}, whose noise with usual drift is {noise} {unit}")
            })
            .collect();
        (!misfits.is_empty()).then(|| {
            format!("the design's constants leave {}: is the unit of this design, and a good one?", misfits.join(", and "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_has_no_scale_of_its_own() {
        for scale in [1e-6, 1.0, 1e6] {
            let left = |rms: f64| Left { rms: scale * rms, noise: scale, with_drift: 1.2 * scale };
            assert!(!left(1.0).is_misfit() && !left(2.3).is_misfit() && left(2.5).is_misfit());
            let unit = LeftOfUnit { rate: Some(left(9.0)), spool: Some(left(1.0)) };
            let says = unit.misfit().unwrap();
            assert!(says.contains("of the rate") && !says.contains("thermometer"), "{says}");
            assert_eq!(LeftOfUnit { rate: Some(left(1.0)), spool: None }.misfit(), None);
        }
    }
}
