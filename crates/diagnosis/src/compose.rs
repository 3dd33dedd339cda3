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
/// Laws that may be added up.
const TERMS: usize = 2;
/// Laws that are fitted after they were ranked.
const FOLLOWED: usize = 6;
/// Of those, laws that are given noise of their own.
const LIKELIEST: usize = 3;
/// Least gain of ln evidence of a law, the choice among all paid for: e³ is strong evidence on the scale of Kass and Raftery (1995).
const WORTH: f64 = 3.0;

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
    let fitter = Fitter::new(model, records, observations).map_err(Error::Model)?;
    let choice = (laws.len().max(1) as f64).ln();
    let mut composed: Option<Composed> = None;
    for term in 0..TERMS {
        progress(Step::counted(TASK, term, TERMS));
        let known = composed.as_ref().map_or(beside, |composed| &composed.fit);
        // noise that has not swallowed what is sought
        let noise = known.noise.calmed(model.channels(), observations)?;
        let base = fitter.fit(&known.hypothesis, &noise, Some(known))?;
        let taken = known.hypothesis.numbers();
        let mut fits = Vec::new();
        for law in fitter.ranked(laws.clone().filter(|law| !taken.contains(law)), &base)?.into_iter().take(FOLLOWED) {
            let mut hypothesis: Hypothesis = base.hypothesis.clone();
            hypothesis.mechanisms.push((law.mechanism, None));
            let mut from = base.clone();
            from.active.push(law);
            fits.extend(defined(fitter.screened(&hypothesis, &from))?);
        }
        fits.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
        let mut own = Vec::new();
        for fit in fits.iter().take(LIKELIEST) {
            own.extend(defined(fitter.fit_with_noise(&fit.hypothesis, fit, 2))?);
        }
        own.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
        let Some(best) = own.first() else { break };
        let gain = best.log_evidence - known.log_evidence - choice;
        if gain < WORTH {
            break;
        }
        let before = composed.as_ref().map_or(0.0, |composed| composed.gain);
        let last = |fit: &Fit| fit.hypothesis.mechanisms.last().map(|(law, _)| *law);
        let others = own[1..].iter().filter_map(|fit| Some((last(fit)?, best.log_evidence - fit.log_evidence))).collect();
        let paid = (term + 1) as f64 * choice;
        composed = Some(Composed { fit: best.clone(), laws: term + 1, gain: before + gain, choice: paid, others });
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
    /// Laws by what their sizes would gain beside a fit, each at the best of its starts and of the size that is best there; the best first.
    fn ranked(&self, laws: impl Iterator<Item = usize>, base: &Fit) -> Result<Vec<Active>, Error<M::Error>> {
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
        ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
        Ok(ranked.into_iter().map(|(_, law)| law).collect())
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
