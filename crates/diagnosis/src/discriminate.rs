//! Expected separation of hypotheses by records yet to be made.

use crate::fit::{Fit, Fitter, Hypothesis, checked, expected};
use crate::noise::Noise;
use crate::{Active, Channel, Error, Failure, ForwardModel, Nuisance, Observation, Omission, State};
use nalgebra::DMatrix;
use recording::noise::NoiseModel;

/// Records that may be made of a unit.
#[derive(Debug, Clone)]
pub struct Plan<'a> {
    /// Numbers of the model's records.
    pub records: &'a [usize],
    /// Their instants, with NaN where a channel is not recorded; no other value is read.
    pub instants: &'a [Observation],
    /// Noise of every channel; without it, the medians of the channels' priors.
    pub noise: Option<&'a [NoiseModel]>,
}

/// Distance of the truth from the nearest response of a rival hypothesis.
#[derive(Debug, Clone)]
pub struct Separation {
    /// Twice the least objective: the squared whitened distance of the noise-free response from the rival's nearest one, plus the squared
    /// distances in σ of the rival's parameters, nuisances and offsets from the middles of their priors.
    pub squared: f64,
    /// Cost of the truth's own parameters: their squared distances in σ from the middles of their priors.
    pub own: f64,
    /// The rival, fitted; its residuals are what tells the two apart.
    pub rival: Fit,
}

impl Separation {
    /// Distance in standard deviations of the noise, ≥ 0.
    pub fn sigma(&self) -> f64 {
        self.squared.sqrt()
    }

    /// Expected ln of the odds that the records will give the truth over the rival: over noise, the mean of half the difference of the two
    /// least objectives. The truth's own is at most what its parameters pay, so that this is a lower bound but for Laplace's determinants, which
    /// change by a few units where the distance changes by hundreds; negative where the rival explains the response by less unlikely parameters.
    pub fn log_odds(&self) -> f64 {
        (self.squared - self.own) / 2.0
    }
}

struct Under<'a> {
    model: &'a dyn ForwardModel,
    channels: Vec<Channel>,
}

impl ForwardModel for Under<'_> {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        self.model.nuisances()
    }

    fn stands_for(&self, mechanism: usize) -> Option<usize> {
        self.model.stands_for(mechanism)
    }

    fn precision(&self) -> Option<&DMatrix<f64>> {
        self.model.precision()
    }

    fn mechanisms(&self) -> &[Omission] {
        self.model.mechanisms()
    }

    fn respond(&self, record: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Failure> {
        self.model.respond(record, nuisances, active)
    }

    fn state(&self, record: usize) -> &State {
        self.model.state(record)
    }
}

/// Separation by the records of `plan` of `truth` (nothing at work: the nominal model) from the nearest of `rivals`, each of them fitted to the
/// noise-free response of the truth with its parameters, the model's errors and every offset free.
///
/// # Errors
/// [`Error::Data`] without records, rivals, or with another number of instants or noise models; [`Error`] if the model or a fit fails.
pub fn separation(
    model: &dyn ForwardModel,
    plan: &Plan<'_>,
    truth: &[Active],
    rivals: &[Hypothesis],
) -> Result<Separation, Error> {
    let (records, channels) = (plan.records, model.channels());
    if plan.noise.is_some_and(|noise| noise.len() != channels.len()) {
        return Err(Error::Data(format!("give a noise model for each of the {} channels", channels.len())));
    }
    let middle = expected(model.nuisances());
    let mut observations = plan.instants.to_vec();
    for (record, observation) in records.iter().zip(&mut observations) {
        let response = checked::responded(model, *record, observation.time.len(), &middle, truth)?;
        for (series, response) in observation.channels.iter_mut().zip(response) {
            series.iter_mut().zip(response).filter(|(y, _)| !y.is_nan()).for_each(|(y, r)| *y = r);
        }
    }
    let under = Under { model, channels: with_noise(channels, plan.noise) };
    let noise = Noise::typical(&under.channels, &observations)?;
    let fitter = Fitter::new(&under, records, &observations)?;
    let mut nearest: Option<(f64, Fit)> = None;
    for rival in rivals {
        let fit = fitter.fit_to_the_end(rival, &noise)?;
        let squared = 2.0 * fit.value();
        if nearest.as_ref().is_none_or(|(least, _)| squared < *least) {
            nearest = Some((squared, fit));
        }
    }
    let Some((squared, rival)) = nearest else { return Err(Error::Data("there is no rival to compare with".into())) };
    let paid = |active: &Active| -> f64 {
        let parameters = &model.mechanisms()[active.mechanism].parameters;
        parameters.iter().zip(&active.values).map(|(p, v)| p.prior.standard(*v).powi(2)).sum()
    };
    Ok(Separation { squared, own: truth.iter().map(paid).sum(), rival })
}

/// The channels with the medians of their noise replaced.
fn with_noise(channels: &[Channel], noise: Option<&[NoiseModel]>) -> Vec<Channel> {
    let mut channels = channels.to_vec();
    for (channel, noise) in channels.iter_mut().zip(noise.unwrap_or_default()) {
        let prior = &mut channel.noise;
        (prior.white.0, prior.drift.0, prior.walk.0) = (noise.white, noise.drift, noise.walk);
        (prior.drift_time.0, channel.averaging) = (noise.drift_time, noise.averaging);
    }
    channels
}

/// The best of some hypotheses on records, its noise fitted with it: sizes and noise as a [`Plan`] needs them.
///
/// # Errors
/// [`Error::Data`] without a hypothesis; [`Error`] if the model or a fit fails.
pub fn fitted(
    model: &dyn ForwardModel,
    records: &[usize],
    observations: &[Observation],
    hypotheses: &[Hypothesis],
) -> Result<Fit, Error> {
    let fitter = Fitter::new(model, records, observations)?;
    let typical = Noise::typical(model.channels(), observations)?;
    let mut best: Option<Fit> = None;
    for hypothesis in hypotheses {
        let fit = fitter.fit_to_the_end(hypothesis, &typical)?;
        best = Some(Fit::better(best, fit));
    }
    let best = best.ok_or_else(|| Error::Data("there is no hypothesis to fit".into()))?;
    fitter.fit_with_noise(&best.hypothesis, &best, 2)
}
