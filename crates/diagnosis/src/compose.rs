//! Laws that nobody listed: small ones are tried beside what is known, and the choice among them is paid for.
//!
//! A law's first parameter is its size, in which the response is linear. By what the size would gain at each of the law's starts all laws are ranked,
//! the best are fitted, constants and sensors free, and the best of those is kept; then a second law is sought beside it.

use crate::fit::{Fit, Fitter, Hypothesis};
use crate::{Active, Error, ForwardModel, Observation, Prior};
use nalgebra::DMatrix;
use progress::Step;
use std::ops::Range;

const TASK: &str = "composing a law for what nothing explains";
/// Least gain of ln evidence of a law, the choice among all paid for: e³ is strong evidence on the scale of Kass and Raftery (1995).
const WORTH: f64 = 3.0;

/// How far is looked for laws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Breadth {
    /// Laws that may be added up.
    pub terms: usize,
    /// Laws that are fitted after they were ranked.
    pub followed: usize,
    /// Of those, laws that are given noise of their own.
    pub likeliest: usize,
    /// What becomes of the laws before the last.
    pub earlier: Earlier,
}

/// What becomes of laws beside which another one was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Earlier {
    /// All stay.
    Kept,
    /// Those stay that still gain enough beside the others, the choice paid for.
    Weighed,
}

impl Default for Breadth {
    fn default() -> Self {
        Self { terms: 2, followed: 6, likeliest: 3, earlier: Earlier::Kept }
    }
}

/// Laws that were composed.
#[derive(Debug, Clone)]
pub struct Composed {
    /// The fit with them: its mechanisms are what was known, then the laws.
    pub fit: Fit,
    /// Number of laws.
    pub laws: usize,
    /// Gain of ln evidence over what was known, the choice among all laws paid for.
    pub gain: f64,
    /// What that choice costs of ln evidence.
    pub choice: f64,
    /// Other laws that were fitted in the place of the last, and by how much ln evidence they stay behind it; the nearest first.
    pub others: Vec<(usize, f64)>,
    /// The fit after every law that was added, the last of them [`Self::fit`].
    pub steps: Vec<Fit>,
}

/// The best of the `laws`, by their numbers in the model, one or two of them, beside a fit; `None` if none gains enough.
///
/// # Errors
/// [`Error`] if the model or a fit fails.
pub fn compose<M: ForwardModel>(
    model: &M,
    laws: Range<usize>,
    records: &[usize],
    observations: &[Observation],
    beside: &Fit,
    progress: &dyn Fn(Step),
) -> Result<Option<Composed>, Error<M::Error>> {
    compose_within(model, laws, records, observations, beside, Breadth::default(), progress)
}

/// The same, looking as far as is asked.
///
/// # Errors
/// As [`compose`].
pub fn compose_within<M: ForwardModel>(
    model: &M,
    laws: Range<usize>,
    records: &[usize],
    observations: &[Observation],
    beside: &Fit,
    breadth: Breadth,
    progress: &dyn Fn(Step),
) -> Result<Option<Composed>, Error<M::Error>> {
    let fitter = Fitter::new(model, records, observations).map_err(Error::Model)?;
    let weights: f64 = laws.clone().map(|law| model.mechanisms()[law].weight).sum();
    // ln of how unlikely a law is before anything is seen
    let cost = |law: usize| (weights / model.mechanisms()[law].weight).ln();
    let last = |fit: &Fit| fit.hypothesis.mechanisms.last().map_or(0, |(law, _)| *law);
    let net = |fit: &Fit| fit.log_evidence - cost(last(fit));
    let mut composed: Option<Composed> = None;
    for term in 0..breadth.terms {
        progress(Step::counted(TASK, term, breadth.terms));
        let known = composed.as_ref().map_or(beside, |composed| &composed.fit);
        // noise that has not swallowed what is sought
        let noise = known.noise.calmed(model.channels(), observations)?;
        let Some(base) = defined(fitter.fit(&known.hypothesis, &noise, Some(known)))? else { break };
        let taken = known.hypothesis.numbers();
        let mut fits = Vec::new();
        let mut ranked = fitter.ranked(laws.clone().filter(|law| !taken.contains(law)), &base)?;
        ranked.sort_by(|a, b| (b.0 - cost(b.1.mechanism)).total_cmp(&(a.0 - cost(a.1.mechanism))));
        for (_, law) in ranked.into_iter().take(breadth.followed) {
            let mut hypothesis: Hypothesis = base.hypothesis.clone();
            hypothesis.mechanisms.push((law.mechanism, None));
            let mut from = base.clone();
            from.active.push(law);
            fits.extend(defined(fitter.screened(&hypothesis, &from))?);
        }
        fits.sort_by(|a, b| net(b).total_cmp(&net(a)));
        let mut own = Vec::new();
        for fit in fits.iter().take(breadth.likeliest) {
            own.extend(defined(fitter.fit_with_noise(&fit.hypothesis, fit, 2))?);
        }
        own.sort_by(|a, b| net(b).total_cmp(&net(a)));
        let Some(best) = own.first() else { break };
        if net(best) - known.log_evidence < WORTH {
            break;
        }
        let others = own[1..].iter().map(|fit| (last(fit), net(best) - net(fit))).collect();
        let mut fit = best.clone();
        if breadth.earlier == Earlier::Weighed {
            fit = fitter.weighed(fit, beside.hypothesis.mechanisms.len(), &cost)?;
        }
        let own = &fit.hypothesis.mechanisms[beside.hypothesis.mechanisms.len()..];
        let choice = own.iter().map(|(law, _)| cost(*law)).sum();
        let mut steps = composed.map_or_else(Vec::new, |composed| composed.steps);
        steps.push(fit.clone());
        composed =
            Some(Composed { laws: own.len(), gain: fit.log_evidence - beside.log_evidence - choice, choice, fit, others, steps });
    }
    Ok(composed)
}

/// A fit, unless its law is no number somewhere on the way: then it is no law for these records.
fn defined<E>(fit: Result<Fit, Error<E>>) -> Result<Option<Fit>, Error<E>> {
    match fit {
        Ok(fit) => Ok(Some(fit)),
        Err(Error::NotFinite | Error::NoStart) => Ok(None),
        Err(error) => Err(error),
    }
}

impl<M: ForwardModel> Fitter<'_, M> {
    /// A fit without those of its laws, from number `first` on and before the last, that gain less than they cost.
    fn weighed(&self, mut fit: Fit, first: usize, cost: &impl Fn(usize) -> f64) -> Result<Fit, Error<M::Error>> {
        let mut place = first;
        while place + 1 < fit.hypothesis.mechanisms.len() {
            let mut hypothesis = fit.hypothesis.clone();
            let (law, _) = hypothesis.mechanisms.remove(place);
            match defined(self.fit_with_noise(&hypothesis, &fit, 2))? {
                Some(without) if fit.log_evidence - without.log_evidence < cost(law) + WORTH => (fit, place) = (without, first),
                _ => place += 1,
            }
        }
        Ok(fit)
    }

    /// Laws with what their sizes would gain beside a fit, each at the best of its starts and of the size that is best there.
    fn ranked(&self, laws: impl Iterator<Item = usize>, base: &Fit) -> Result<Vec<(f64, Active)>, Error<M::Error>> {
        let respond = |at: usize, active: &[Active]| {
            self.model.respond(self.records[at], &base.nuisances[at], active).map_err(Error::Model)
        };
        let without = (0..self.records.len()).map(|at| respond(at, &base.active)).collect::<Result<Vec<_>, _>>()?;
        let mut ranked: Vec<(f64, Active)> = Vec::new();
        for law in laws {
            let omission = &self.model.mechanisms()[law];
            let Prior::Normal { sd, .. } = omission.parameters[0].prior else { continue };
            let mut most: Option<(f64, Active)> = None;
            for start in &omission.starts {
                let own = Active { mechanism: law, values: start.clone(), choice: None };
                let active: Vec<Active> = base.active.iter().cloned().chain([own.clone()]).collect();
                let mut column = Vec::new();
                for (at, without) in without.iter().enumerate() {
                    for (channel, (with, without)) in respond(at, &active)?.iter().zip(without).enumerate() {
                        let per_sd: Vec<f64> = with.iter().zip(without).map(|(a, b)| (a - b) / start[0] * sd).collect();
                        column.extend(base.noise.whiten(at, channel, &per_sd));
                    }
                }
                let Some((gain, amplitude)) = gained(base, column) else { continue };
                if most.as_ref().is_none_or(|(most, _)| gain > *most) {
                    let mut values = start.clone();
                    values[0] = amplitude * sd;
                    most = Some((gain, Active { values, ..own }));
                }
            }
            ranked.extend(most);
        }
        Ok(ranked)
    }
}

/// ln evidence that a whitened function gains beside a fit, its amplitude known beforehand to a standard deviation of 1, and the likeliest amplitude;
/// `None` if it is not finite.
fn gained(base: &Fit, column: Vec<f64>) -> Option<(f64, f64)> {
    let (free, gradient) = base.marginal(&DMatrix::from_vec(column.len(), 1, column));
    let (precision, along) = (1.0 + free[0].max(0.0), gradient[0]);
    let gain = along * along / precision / 2.0 - precision.ln() / 2.0;
    gain.is_finite().then_some((gain, along / precision))
}
