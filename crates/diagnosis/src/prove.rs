//! Whether records that were held out bear out what was fitted, whatever a search said of it.

use crate::hold_out::BARELY;
use crate::{Error, Fit, ForwardModel, HeldOut, Observation};

/// What records that were held out say of a fit beside another.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// Every record as the other fit predicts it.
    pub before: Vec<HeldOut>,
    /// Every record as this one does.
    pub after: Vec<HeldOut>,
    /// Whether a channel is predicted clearly better over all records, and no channel of any record clearly worse; never so without a record.
    pub accepted: bool,
}

impl Proof {
    /// Root mean squares of what is left of a channel over all records, each with the same weight: before and after.
    pub fn rmse(&self, channel: usize) -> [f64; 2] {
        [&self.before, &self.after].map(|held| {
            let squares: f64 = held.iter().map(|held| held.rmse[channel].powi(2)).sum();
            (squares / held.len().max(1) as f64).sqrt()
        })
    }
}

/// Judges `fit` beside `before` by records of the model that neither has seen; the noise is that of `fit`.
///
/// # Errors
/// [`Error`] if the model fails.
pub fn prove<M: ForwardModel>(
    model: &M,
    before: &Fit,
    fit: &Fit,
    held: &[(usize, &Observation)],
) -> Result<Proof, Error<M::Error>> {
    let by = |which: &Fit| -> Result<Vec<HeldOut>, Error<M::Error>> {
        held.iter().map(|(record, observed)| which.hold_out(model, *record, observed, fit)).collect()
    };
    let mut proof = Proof { before: by(before)?, after: by(fit)?, accepted: false };
    let channels = 0..model.channels().len();
    let better = channels.clone().any(|c| {
        let [before, after] = proof.rmse(c);
        after < BARELY * before
    });
    let mut each = proof.before.iter().zip(&proof.after);
    let worse = each.any(|(before, after)| channels.clone().any(|c| after.clearly_worse_than(before, c)));
    proof.accepted = !held.is_empty() && better && !worse;
    Ok(proof)
}

/// The last of some fits, each of which has a law more than those before, to which records that were held out lead from `before`: a fit that they do not
/// bear out beside the last that they do is passed over. `None` if they bear out none.
///
/// # Errors
/// [`Error`] if the model fails.
pub fn proven<'f, M: ForwardModel>(
    model: &M,
    before: &Fit,
    steps: &'f [Fit],
    held: &[(usize, &Observation)],
) -> Result<Option<&'f Fit>, Error<M::Error>> {
    let mut borne_out: Option<&Fit> = None;
    for step in steps {
        if prove(model, borne_out.unwrap_or(before), step, held)?.accepted {
            borne_out = Some(step);
        }
    }
    Ok(borne_out)
}
