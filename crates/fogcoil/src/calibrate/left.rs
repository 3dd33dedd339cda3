//! Residuals of a unit's records under its constants, beside the noise of the records.

use diagnosis::{Fit, ForwardModel, Observation};
use mechanisms::{Gyro, RATE, SPOOL};

use crate::left::Left;
use crate::table::significant;

/// Residuals of a unit's rate \[deg/h\] and of its thermometer \[K\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LeftOfUnit {
    pub(super) rate: Option<Left>,
    pub(super) spool: Option<Left>,
}

impl LeftOfUnit {
    pub(super) fn of(gyro: &Gyro, fit: &Fit, observations: &[Observation]) -> Self {
        let of = |channel| largest(gyro, fit, observations, channel);
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

/// Residual in the record of a unit in which it is largest over the noise; `None` for a channel that was not recorded.
fn largest(gyro: &Gyro, fit: &Fit, observations: &[Observation], channel: usize) -> Option<Left> {
    let beforehand = &gyro.channels()[channel].noise;
    let left = observations.iter().zip(&fit.residuals).enumerate().filter_map(|(record, (observed, residuals))| {
        Left::of(&observed.time, &residuals[channel], beforehand, fit.noise_model(record, channel).white)
    });
    left.max_by(|a, b| a.over_noise().total_cmp(&b.over_noise()))
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
