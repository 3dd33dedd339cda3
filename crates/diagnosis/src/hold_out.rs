//! What a fit predicts of a record that it has not seen.

use crate::fit::{Fit, Offset, expected};
use crate::{Error, ForwardModel, Observation};

/// A fit judged on a record that it has not seen.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// Prediction of every channel, with the offsets of the first record that was fitted.
    pub prediction: Vec<Vec<f64>>,
    /// Root mean square of recorded less predicted, of every channel.
    pub rmse: Vec<f64>,
    /// Standard deviation of the noise in a sample as identified in the fit, of every channel.
    pub noise_floor: Vec<f64>,
    /// The same with no more drift than is usual: where a fit leaves something unexplained, its noise has swallowed that.
    pub quiet: Vec<f64>,
    /// ln of the likelihood of the record, the offsets known only as well as their priors say, up to a constant that fits with the same noise share.
    pub log_score: f64,
}

/// ln of a likelihood ratio beyond which it is no matter of chance: if the other prediction were right, e⁵ or more would have a probability
/// of at most e⁻⁵ = 1/148 (Markov's inequality).
const CLEAR: f64 = 5.0;
/// Error over the noise identified elsewhere that is still noise. A record of a dozen correlation times of the drift holds some six
/// independent stretches of it, from which its size is known to 1/√(2·6) = 0.29 (1σ).
const NOISE: f64 = 1.3;
/// Error over the noise that is far more: beyond three times that uncertainty, 1 + 3·0.29, rounded.
const FAR: f64 = 2.0;
/// Error over the nominal model's that is hardly less: a tenth of the variance explained, 1 − 0.95².
pub(crate) const BARELY: f64 = 0.95;
/// Largest drift that is usual, over the median of its prior: about one standard deviation of its logarithm (0.7) above.
const USUAL: f64 = 2.0;
/// Share of the error beyond which one prediction is worse than another, by convention: two digits of it.
const WORSE: f64 = 0.01;

impl HeldOut {
    /// Whether what it leaves of a channel is no larger than noise.
    pub fn within_noise(&self, channel: usize) -> bool {
        self.rmse[channel] <= NOISE * self.quiet[channel]
    }

    /// Whether this is no proof of what was fitted: what it leaves of a channel is far more than noise, and hardly less than `nominal` leaves.
    pub fn proves_nothing(&self, nominal: &Self, channel: usize) -> bool {
        self.rmse[channel] > FAR * self.quiet[channel] && self.rmse[channel] > BARELY * nominal.rmse[channel]
    }

    /// Whether `other` predicts a channel clearly better: by its error, and by the likelihood of the whole record, for a fault of one channel may be
    /// what the other one shows.
    pub fn clearly_worse_than(&self, other: &Self, channel: usize) -> bool {
        self.rmse[channel] > (1.0 + WORSE) * other.rmse[channel] && self.log_score < other.log_score - CLEAR
    }
}

impl Fit {
    /// Predicts `record` of the model and compares with what was observed; `judge` gives the noise under which it is scored.
    ///
    /// # Errors
    /// [`Error`] if the model fails.
    pub fn hold_out<M: ForwardModel>(
        &self,
        model: &M,
        record: usize,
        observed: &Observation,
        judge: &Self,
    ) -> Result<HeldOut, Error<M::Error>> {
        let middle = expected(model.nuisances());
        // what every record has of its own is not known here
        let nuisances: Vec<f64> =
            model.nuisances().iter().enumerate().map(|(i, n)| if n.local { middle[i] } else { self.nuisances[0][i] }).collect();
        let response = model.respond(record, &nuisances, &self.active).map_err(Error::Model)?;
        judged(model, response, &self.offsets[0], observed, judge)
    }
}

/// The same for the model as it is designed: nothing fitted but the offsets, which are the means of what it leaves of `fitted`.
///
/// # Errors
/// [`Error`] if the model fails.
pub fn as_designed<M: ForwardModel>(
    model: &M,
    fitted: (usize, &Observation),
    held: (usize, &Observation),
    judge: &Fit,
) -> Result<HeldOut, Error<M::Error>> {
    let respond = |record| model.respond(record, &expected(model.nuisances()), &[]).map_err(Error::Model);
    let offsets: Vec<f64> = respond(fitted.0)?
        .iter()
        .zip(&fitted.1.channels)
        .map(|(predicted, recorded)| {
            let left: Vec<f64> = recorded.iter().zip(predicted).map(|(y, p)| y - p).filter(|r| r.is_finite()).collect();
            left.iter().sum::<f64>() / left.len().max(1) as f64
        })
        .collect();
    judged(model, respond(held.0)?, &offsets, held.1, judge)
}

/// A response with offsets against what was observed.
fn judged<M: ForwardModel>(
    model: &M,
    mut prediction: Vec<Vec<f64>>,
    offsets: &[f64],
    observed: &Observation,
    judge: &Fit,
) -> Result<HeldOut, Error<M::Error>> {
    let noise = judge.noise.pooled(observed)?;
    let (mut rmse, mut log_score) = (Vec::new(), 0.0);
    for (c, (predicted, recorded)) in prediction.iter_mut().zip(&observed.channels).enumerate() {
        let channel = &model.channels()[c];
        let own = Offset::of(channel, recorded, predicted);
        predicted.iter_mut().for_each(|p| *p += offsets[c]);
        // an offset that may be anything is this record's own
        let by = if channel.offset.1.is_finite() { offsets[c] } else { own.mean };
        let residual: Vec<f64> = recorded.iter().zip(predicted.iter()).map(|(y, p)| y - (p - offsets[c] + by)).collect();
        let used: Vec<f64> = residual.iter().copied().filter(|r| !r.is_nan()).collect();
        rmse.push((used.iter().map(|r| r * r).sum::<f64>() / used.len().max(1) as f64).sqrt());
        // an offset of its own, with its prior, is marginalised
        let ones = vec![own.sd; residual.len()];
        let (w, o) = (noise.whiten(0, c, &residual), noise.whiten(0, c, &ones));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        log_score -= (dot(&w, &w) - dot(&w, &o).powi(2) / (1.0 + dot(&o, &o))) / 2.0;
    }
    let floor = |most: f64| {
        let of = |(c, channel): (usize, &crate::Channel)| {
            let n = noise.model(0, c);
            n.white.hypot(n.drift.min(most * channel.noise.drift.0)).hypot(n.passed)
        };
        model.channels().iter().enumerate().map(of).collect()
    };
    Ok(HeldOut { prediction, rmse, noise_floor: floor(f64::INFINITY), quiet: floor(USUAL), log_score })
}
