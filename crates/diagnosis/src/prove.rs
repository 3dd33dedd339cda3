//! Test of a fit on held-out records, independent of the search that found it.

use crate::hold_out::BARELY;
use crate::{Error, Fit, ForwardModel, HeldOut, Observation};

/// Comparison of two fits on held-out records.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// Every record, predicted by the other fit.
    pub before: Vec<HeldOut>,
    /// Every record, predicted by this one.
    pub after: Vec<HeldOut>,
    /// Whether a channel is predicted clearly better over all records, and no channel of any record clearly worse; false without a record.
    pub accepted: bool,
}

impl Proof {
    /// Root mean squares of a channel's residuals over all records, each with the same weight: before and after.
    pub fn rmse(&self, channel: usize) -> [f64; 2] {
        self.over_all(|held| held.rmse[channel])
    }

    fn over_all(&self, of: impl Fn(&HeldOut) -> f64) -> [f64; 2] {
        [&self.before, &self.after].map(|held| {
            let squares: f64 = held.iter().map(|held| of(held).powi(2)).sum();
            (squares / held.len().max(1) as f64).sqrt()
        })
    }
}

/// Judges `fit` beside `before` by records of the model that neither has seen; the noise is that of `fit`.
///
/// # Errors
/// [`Error`] if the model fails.
pub fn prove(model: &dyn ForwardModel, before: &Fit, fit: &Fit, held: &[(usize, &Observation)]) -> Result<Proof, Error> {
    let by = |which: &Fit| -> Result<Vec<HeldOut>, Error> {
        held.iter().map(|(record, observed)| which.hold_out(model, *record, observed, fit)).collect()
    };
    let mut proof = Proof { before: by(before)?, after: by(fit)?, accepted: false };
    let channels = 0..model.channels().len();
    let better = channels.clone().any(|c| {
        // whatever the length of the rows
        let [before, after] = proof.over_all(|held| held.of_minutes[c]);
        after < BARELY * before
    });
    let mut each = proof.before.iter().zip(&proof.after);
    let worse = each.any(|(before, after)| channels.clone().any(|c| after.clearly_worse_than(before, c)));
    proof.accepted = !held.is_empty() && better && !worse;
    Ok(proof)
}

/// The last of some fits, each of which has a law more than those before, that held-out records confirm, starting from `before`: a fit that they do not
/// confirm beside the last confirmed one is passed over. `None` if they confirm none.
///
/// # Errors
/// [`Error`] if the model fails.
pub fn proven<'f>(
    model: &dyn ForwardModel,
    before: &Fit,
    steps: &'f [Fit],
    held: &[(usize, &Observation)],
) -> Result<Option<&'f Fit>, Error> {
    let mut borne_out: Option<&Fit> = None;
    for step in steps {
        if prove(model, borne_out.unwrap_or(before), step, held)?.accepted {
            borne_out = Some(step);
        }
    }
    Ok(borne_out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_records_of_any_length_have_the_same_weight() {
        // errors of two channels
        let held = |rmse: [f64; 2]| HeldOut {
            prediction: Vec::new(),
            rmse: rmse.to_vec(),
            noise_floor: vec![1.0; 2],
            of_minutes: vec![f64::NAN; 2],
            quiet: vec![1.0; 2],
            log_score: 0.0,
        };
        let all = |before: &[[f64; 2]], after: &[[f64; 2]]| {
            let [before, after] = [before, after].map(|of| of.iter().copied().map(held).collect());
            Proof { before, after, accepted: false }
        };
        // 1² + 7² and 17² + 31² are twice 5² and 25²
        let proof = all(&[[1.0, 17.0], [7.0, 31.0]], &[[2.0, 0.5], [2.0, 0.5]]);
        assert_eq!([0, 1].map(|channel| proof.rmse(channel)), [[5.0, 2.0], [25.0, 0.5]]);
        assert_eq!(all(&[], &[]).rmse(0), [0.0; 2]);
    }
}
