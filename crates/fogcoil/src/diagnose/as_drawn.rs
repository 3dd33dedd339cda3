//! The design as it is drawn in the rows of a record, beside what one mistake in reading it, or in drawing it, would make of it.

use diagnosis::{ForwardModel, Role, expected};
use mechanisms::Gyro;

/// Largest ratio of what a mistake leaves to what the answer leaves at which the mistake explains as much.
const AS_WELL: f64 = 1.1;
/// Standard deviations of the tolerances within which the constants, which a mistake leaves as drawn, make the rest.
pub(super) const TOLERATED: f64 = 2.0;

/// The design as it is drawn under a record.
pub(super) struct AsDrawn {
    /// Predicted channels.
    pub(super) predicted: Vec<Vec<f64>>,
    /// What the tolerances of the constants make of each channel, one standard deviation, rms.
    pub(super) tolerated: [f64; 2],
}

impl AsDrawn {
    /// The design of `gyro` under its record of this number.
    pub(super) fn of(gyro: &Gyro, number: usize) -> Result<Self, coil::Error> {
        let middle = expected(gyro.nuisances());
        let predicted = gyro.respond(number, &middle, &[])?;
        let mut tolerated = [0.0_f64; 2];
        for (k, nuisance) in gyro.nuisances().iter().enumerate().filter(|(_, n)| n.role == Role::Constant) {
            let mut moved = middle.clone();
            moved[k] = nuisance.parameter.prior.value(1.0);
            let channels = gyro.respond(number, &moved, &[])?;
            for (sum, (moved, drawn)) in tolerated.iter_mut().zip(channels.iter().zip(&predicted)) {
                *sum = sum.hypot(spread(moved, drawn, 1.0));
            }
        }
        Ok(Self { predicted, tolerated })
    }

    /// Whether a mistake that `would` leave so much of a channel explains a record as the answer does, which leaves `answered`, with its constants fitted: the
    /// mistake has them as drawn, and may leave what their tolerances make. Without an answer any explains more.
    pub(super) fn explains_as_much(&self, channel: usize, would: f64, answered: Option<f64>) -> bool {
        answered.is_none_or(|answered| would < (AS_WELL * answered).hypot(TOLERATED * self.tolerated[channel]))
    }
}

/// Whether a mistake explains a column as the answer does.
pub(super) fn as_well(would: f64, answered: Option<f64>) -> bool {
    answered.is_none_or(|answered| would < AS_WELL * answered)
}

/// Standard deviation of what is recorded less `sign` times what is predicted; 0 where nothing is recorded.
pub(super) fn spread(recorded: &[f64], predicted: &[f64], sign: f64) -> f64 {
    let left: Vec<f64> = recorded.iter().zip(predicted).map(|(y, p)| y - sign * p).filter(|r| r.is_finite()).collect();
    let mean = left.iter().sum::<f64>() / left.len().max(1) as f64;
    rms(&left.iter().map(|r| r - mean).collect::<Vec<_>>())
}

/// Root mean square of what is there.
pub(super) fn rms(series: &[f64]) -> f64 {
    let (sum, count) = series.iter().filter(|v| v.is_finite()).fold((0.0, 0.0_f64), |(s, n), v| (s + v * v, n + 1.0));
    (sum / count.max(1.0)).sqrt()
}
