//! A comparison under the model that is good about its result.

use super::{Settings, diagnose_beside};
use crate::fit::{Fit, Fitter, Unknown};
use crate::settle::Settled;
use crate::{Diagnosis, Error, ForwardModel, Observation};
use progress::Step;

const TASK: &str = "the likeliest hypothesis about its own constants";
/// Most comparisons.
const COMPARISONS: usize = 3;
/// Most times that a model is made anew about one hypothesis.
const ROUNDS: usize = 6;
/// Change of ln evidence from which a hypothesis counts as another one about its own constants.
const MATTERS: f64 = 1.0;
/// Change of one of its parameters from which it does, standard deviations of what is left unknown of it.
const MOVED: f64 = 0.3;

/// Compares all hypotheses under the model that is good about the likeliest of them: beside other constants a mechanism acts otherwise, and its size would
/// be wrong. Where the comparison finds another hypothesis than that of [`Settled::model`], the model is made about that one and left in `settled`; a
/// hypothesis that was followed so counts as it is about its own constants, and if it is the likeliest after all its model is left there.
///
/// # Errors
/// [`Error::Data`] if the observations do not fit the model or one of them has no value, [`Error::Definition`] if the model contradicts itself;
/// [`Error`] if the model or a fit fails.
pub fn diagnose_settled<M: ForwardModel>(
    given: &M,
    settled: &mut Settled<M>,
    records: &[usize],
    observations: &[Observation],
    settings: &Settings,
    progress: &dyn Fn(Step),
) -> Result<Diagnosis, Error> {
    // those that led before, each with the model about it unless that is the one given
    let mut followed: Vec<(Fit, Option<M>)> = Vec::new();
    // those that were followed and did not lead: all hypotheses have not been compared about them
    let mut rivals = std::mem::take(&mut settled.rivals);
    let mut comparisons = 1;
    loop {
        let led = settled.leading.iter().chain(followed.iter().chain(&rivals).map(|(fit, _)| fit));
        let known: Vec<Fit> = [&settled.recalibrated].into_iter().chain(led).cloned().collect();
        let model = settled.model.as_ref().unwrap_or(given);
        let found = diagnose_beside(model, records, observations, settings, (&known, settled.leading.clone()), progress)?;
        let best = found.best();
        let is_best = |fit: &Fit| fit.hypothesis == best.fit.hypothesis;
        // beside a structure it is what this comparison found of it
        if let Some(at) = followed.iter().position(|(fit, _)| best.rival.is_none() && is_best(fit)) {
            let (fit, about) = followed.swap_remove(at);
            settled.lead(about, fit);
            return Ok(found);
        }
        if best.fit.active.is_empty() || settled.leading.as_ref().is_some_and(is_best) {
            return Ok(found);
        }
        if comparisons == COMPARISONS {
            // what was fitted about its own constants has its model
            if let Some(at) = rivals.iter().position(|(fit, _)| best.rival.is_none() && is_best(fit)) {
                let (fit, about) = rivals.swap_remove(at);
                settled.lead(about, fit);
            }
            return Ok(found);
        }
        progress(Step::begins(TASK));
        let (fit, about) = match rivals.iter().position(|(fit, _)| is_best(fit)) {
            Some(at) => rivals.swap_remove(at),
            None => {
                let (fit, about) = about_itself(model, &best.fit, records, observations)?;
                if about.is_none() || !differ(&best.fit, &fit) {
                    return Ok(found);
                }
                (fit, about)
            }
        };
        followed.retain(|(other, _)| other.hypothesis != fit.hypothesis);
        followed.extend(settled.lead(about, fit));
        comparisons += 1;
    }
}

/// A hypothesis that was fitted under `model` fitted about its own constants, and the model there; `None` if that is `model`.
fn about_itself<M: ForwardModel>(
    model: &M,
    fit: &Fit,
    records: &[usize],
    observations: &[Observation],
) -> Result<(Fit, Option<M>), Error> {
    let (mut fit, mut about) = (fit.clone(), None);
    for _ in 0..ROUNDS {
        let here = about.as_ref().unwrap_or(model);
        let Some(next) = here.about(&fit.nuisances[0], &fit.active).map_err(Error::Model)? else { break };
        fit = Fitter::new(&next, records, observations)?.fit_with_noise(&fit.hypothesis, &fit, 2)?;
        about = Some(next);
    }
    Ok((fit, about))
}

/// Whether two fits of one hypothesis say different things.
fn differ(a: &Fit, b: &Fit) -> bool {
    let moved = |(i, unknown): (usize, &Unknown)| {
        let by = (a.u[i] - b.u[i]).abs();
        matches!(unknown, Unknown::Mechanism { .. }) && by > MOVED * b.covariance[(i, i)].max(0.0).sqrt()
    };
    (a.log_evidence - b.log_evidence).abs() > MATTERS || b.layout.iter().enumerate().any(moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::candidate;
    use nalgebra::{DMatrix, DVector};

    /// A fit of a constant, which is known to 1, and of a mechanism's parameter, which is known to 0.1.
    fn fit(log_evidence: f64, [constant, parameter]: [f64; 2]) -> Fit {
        Fit {
            log_evidence,
            layout: vec![Unknown::Nuisance { number: 0, record: None }, Unknown::Mechanism { place: 0, parameter: 0 }],
            u: DVector::from_vec(vec![constant, parameter]),
            covariance: DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 0.01])),
            ..candidate(&[0], 0.0).fit
        }
    }

    #[test]
    fn fits_differ_by_how_likely_they_are_and_by_where_the_mechanism_is() {
        let here = fit(-100.0, [1.0, 2.0]);
        for (log_evidence, unknowns, expected) in [
            (-100.0, [1.0, 2.0], false),
            (-100.5, [1.0, 2.0], false),
            (-99.5, [1.0, 2.0], false),
            (-101.5, [1.0, 2.0], true),
            (-98.5, [1.0, 2.0], true),
            // a fifth of a standard deviation, and two fifths
            (-100.0, [1.0, 2.02], false),
            (-100.0, [1.0, 1.98], false),
            (-100.0, [1.0, 2.04], true),
            (-100.0, [1.0, 1.96], true),
            // where the constants are does not matter
            (-100.0, [5.0, 2.0], false),
        ] {
            assert_eq!(differ(&here, &fit(log_evidence, unknowns)), expected, "{log_evidence} {unknowns:?}");
        }
        // nothing differs from itself, not even where nothing is left unknown
        let known = Fit { covariance: DMatrix::zeros(2, 2), ..here };
        assert!(!differ(&known, &known));
    }
}
