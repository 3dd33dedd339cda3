//! A model that is linear in its constants, made anew about what the records say of them.

use crate::fit::{Fit, Fitter, Hypothesis, alternatives};
use crate::noise::Noise;
use crate::{Error, ForwardModel, Nuisance, Observation, Role};
use progress::Step;

const TASK: &str = "finding the constants about which to compare";
/// Times that a model is made anew, at most: each time the distance to where it settles shrinks as its square.
const ROUNDS: usize = 6;
/// Gain of ln evidence by which a mechanism beside the constants leads.
const MATTERS: f64 = 3.0;
/// Standard deviations from the drawing beyond which a constant is far.
const STRAINED: f64 = 2.0;
/// Choices of a mechanism that are tried.
const CHOICES: usize = 3;

/// A model about the constants for which the records speak.
pub struct Settled<M> {
    /// The model anew, where the one given was not good there.
    pub model: Option<M>,
    /// The constants re-estimated, nothing else at work, under the model that is good about *them*: to be compared with all others.
    pub recalibrated: Fit,
    /// The mechanism that explains most beside the constants, by its number, and how much ln evidence it gains on them alone, if it leads on them.
    pub suspect: Option<(usize, f64)>,
}

/// The model about the constants of the likeliest hypothesis: constants alone, or one mechanism beside them. Each is followed to where the model
/// about its own constants leads, as constants that make up for a mechanism that is left out may be far from those beside it.
///
/// # Errors
/// [`Error`] if the model or a fit fails.
pub fn settled<M: ForwardModel>(
    model: &M,
    records: &[usize],
    observations: &[Observation],
    progress: &dyn Fn(Step),
) -> Result<Settled<M>, Error<M::Error>> {
    let follow = |mechanisms: bool, first: usize| -> Result<(Option<M>, Fit), Error<M::Error>> {
        let mut about: Option<M> = None;
        let mut known: Option<Fit> = None;
        for round in 0..ROUNDS {
            progress(Step::counted(TASK, first + round, 2 * ROUNDS));
            let here = about.as_ref().unwrap_or(model);
            // who leads is settled after two rounds
            let among = match &known {
                Some(known) if round > 1 => vec![known.hypothesis.clone()],
                _ => candidates(model, mechanisms),
            };
            let (leader, _) = leader(here, records, observations, known.as_ref(), &among)?;
            let next = here.about(&leader.nuisances[0], &leader.active).map_err(Error::Model)?;
            known = Some(leader);
            match next {
                Some(next) => about = Some(next),
                None => break,
            }
        }
        let here = about.as_ref().unwrap_or(model);
        let fitter = Fitter::new(here, records, observations).map_err(Error::Model)?;
        let among = known.as_ref().map_or_else(Vec::new, |known| vec![known.hypothesis.clone()]);
        let (last, _) = leader(here, records, observations, known.as_ref(), &among)?;
        let fit = fitter.fit_with_noise(&last.hypothesis, &last, 2)?;
        Ok((about, fit))
    };
    let (about, recalibrated) = follow(false, 0)?;
    let here = about.as_ref().unwrap_or(model);
    let (leading, gain) = leader(here, records, observations, Some(&recalibrated), &candidates(model, true))?;
    // constants that had to go far may stand for a mechanism that is near the drawing: about them it does not show
    let suspect = leading.hypothesis.mechanisms.first().map(|(mechanism, _)| (*mechanism, gain));
    if gain <= MATTERS && strain(model, &recalibrated) <= STRAINED {
        return Ok(Settled { model: about, recalibrated, suspect });
    }
    let (beside, leader) = follow(true, ROUNDS)?;
    // each at its best, about its own constants
    let gain = leader.log_evidence - recalibrated.log_evidence;
    let suspect = leader.hypothesis.mechanisms.first().map(|(mechanism, _)| (*mechanism, gain));
    Ok(Settled { model: if gain > 0.0 { beside } else { about }, recalibrated, suspect })
}

/// The farthest that a constant of the design is from the drawing, standard deviations.
fn strain<M: ForwardModel>(model: &M, fit: &Fit) -> f64 {
    let of = |(nuisance, value): (&Nuisance, &f64)| match nuisance.role {
        Role::Constant => nuisance.parameter.prior.standard(*value).abs(),
        Role::ModelError | Role::Sensor => 0.0,
    };
    model.nuisances().iter().zip(&fit.nuisances[0]).map(of).fold(0.0, f64::max)
}

/// The mechanisms that have a name, each alone, of many choices a few; none at all where they are not asked for.
fn candidates<M: ForwardModel>(model: &M, mechanisms: bool) -> Vec<Hypothesis> {
    let all = if mechanisms { model.mechanisms().len() } else { 0 };
    let named = (0..all).filter(|m| model.mechanisms()[*m].named);
    named
        .flat_map(|mechanism| {
            let hypotheses = alternatives(model, mechanism);
            let every = hypotheses.len().div_ceil(CHOICES);
            hypotheses.into_iter().skip(every / 2).step_by(every).collect::<Vec<_>>()
        })
        .collect()
}

/// The best of some hypotheses and the constants alone, with the noise that it leaves, and by how much of ln evidence it leads on the latter.
fn leader<M: ForwardModel>(
    model: &M,
    records: &[usize],
    observations: &[Observation],
    known: Option<&Fit>,
    among: &[Hypothesis],
) -> Result<(Fit, f64), Error<M::Error>> {
    let fitter = Fitter::new(model, records, observations).map_err(Error::Model)?;
    let noise = match known {
        Some(fit) => fit.noise.calmed(model.channels(), observations)?,
        None => Noise::typical(model.channels(), observations)?,
    };
    let recalibrated = fitter.fit(&Hypothesis::RECALIBRATED, &noise, known)?;
    let mut best = recalibrated.clone();
    for hypothesis in among {
        best = Fit::better(Some(best), fitter.screened(hypothesis, &recalibrated)?);
    }
    let gain = best.log_evidence - recalibrated.log_evidence;
    // what the leader leaves is noise: the next round compares under that
    let noise = best.noise.refitted(model.channels(), observations, &best.residuals)?;
    Ok((Fit { noise, ..best }, gain))
}
