//! One hypothesis fitted to the records, and its evidence.
//!
//! [`checked`]: what cannot be fitted; [`hypothesis`]: the mechanisms at work; [`unknowns`]: the quantities to find, and [`beforehand`] their prior; [`objective`]: the function to minimise, with its
//! [`derivatives`], found by [`differences`]; from [`starts`] by [`descent`], and beside [`kinks`]: how; other minima: [`turned`]; [`laplace`]: the evidence; [`fitter`]: all together; [`unseen`]: what it foretells. [`mod@sampled`] checks it.

mod beforehand;
pub(crate) mod checked;
mod derivatives;
mod descent;
mod differences;
mod fitter;
mod hypothesis;
mod kinks;
mod laplace;
mod objective;
mod sampled;
mod starts;
mod turned;
mod unknowns;
mod unseen;

#[cfg(test)]
pub(crate) use beforehand::Beforehand;
#[cfg(test)]
pub(crate) use derivatives::Derivatives;
pub(crate) use derivatives::products;
pub use fitter::Fit;
pub(crate) use fitter::{Fitter, Offset};
pub use hypothesis::{Hypothesis, alternatives};
use objective::Objective;
pub use sampled::{Sampled, Samples, sampled};
pub use unknowns::expected;
pub(crate) use unknowns::{Unknown, parameter};
pub(crate) use unseen::{Unseen, designed};

use crate::noise::Noise;
use crate::{Active, Error};

/// Starts that are followed to the end.
const STARTS: usize = 4;
/// Descents one after another, at most.
const MOST_DESCENTS: usize = 12;
/// Difference of ln p below which two fits have ended alike: ten times the change at which one settles.
const ALIKE: f64 = 0.05;
/// Most second looks around a fit.
const SEARCHES: usize = 6;
/// Least gain of ln evidence by a round of fitting the noise after which another round follows.
const NOISE_SETTLED: f64 = 0.1;

impl Fitter<'_> {
    /// Fits a hypothesis under a known noise; `known` gives a place to start from.
    pub(crate) fn fit(&self, hypothesis: &Hypothesis, noise: &Noise, known: Option<&Fit>) -> Result<Fit, Error> {
        self.best(&Objective::new(self, hypothesis, noise)?, known, &[])
    }

    /// The same, begun anew from where it ended until that leads no further: a descent has so many steps, too few where the records lie far from its start.
    pub(crate) fn fit_to_the_end(&self, hypothesis: &Hypothesis, noise: &Noise) -> Result<Fit, Error> {
        let mut best = self.fit(hypothesis, noise, None)?;
        for _ in 0..MOST_DESCENTS {
            let further = self.fit(hypothesis, noise, Some(&best))?;
            let gained = best.value() - further.value();
            if gained > 0.0 {
                best = further;
            }
            if gained < ALIKE {
                break;
            }
        }
        Ok(best)
    }

    /// The same as [`Self::fit`] beside a fit under the same noise, whose derivatives by nuisances are taken for this one's: several times as fast. Mechanisms change
    /// the effect of nuisances a little; where the records know a nuisance far better than its prior, the fit may stay behind the best.
    pub(crate) fn screened(&self, hypothesis: &Hypothesis, beside: &Fit) -> Result<Fit, Error> {
        self.screened_from(hypothesis, beside, &[])
    }

    /// The same from where other fits have `found` some of its mechanisms, and from the likeliest of the usual starts.
    pub(crate) fn screened_from(&self, hypothesis: &Hypothesis, beside: &Fit, found: &[Active]) -> Result<Fit, Error> {
        self.best(&Objective::new(self, hypothesis, &beside.noise)?.with_derivatives_of(beside), Some(beside), found)
    }

    fn best(&self, objective: &Objective, known: Option<&Fit>, found: &[Active]) -> Result<Fit, Error> {
        let likeliest = |found: &[Active], count: usize| -> Result<Vec<_>, Error> {
            let starts = objective.starts(known, found).into_iter();
            let mut tried = starts.map(|u| objective.point(u)).collect::<Result<Vec<_>, _>>()?;
            tried.sort_by(|a, b| a.value.total_cmp(&b.value));
            tried.truncate(count);
            Ok(tried)
        };
        // the likeliest starts are followed
        let mut tried = likeliest(&[], if found.is_empty() { STARTS } else { 1 })?;
        if !found.is_empty() {
            tried.extend(likeliest(found, 1)?);
        }
        let mut best: Option<Fit> = None;
        for start in tried {
            let fit = objective.concluded(objective.descend(start)?)?;
            // two that end alike speak for all where a mechanism has one parameter and no kinks: one minimum
            let alike = best.as_ref().is_some_and(|best| (fit.value() - best.value()).abs() < ALIKE);
            best = Some(Fit::better(best, fit));
            if alike && !objective.may_have_many_minima() {
                break;
            }
        }
        best.ok_or(Error::NoStart)
    }

    /// Fits a hypothesis and its noise in turn, `rounds` times, and as often again where a second look has found a better minimum: the noise that the poorer
    /// one left is too large for it.
    pub(crate) fn fit_with_noise(&self, hypothesis: &Hypothesis, known: &Fit, rounds: usize) -> Result<Fit, Error> {
        let mut best = self.in_turn(self.fit(hypothesis, &known.noise, Some(known))?, rounds)?;
        for _ in 0..SEARCHES {
            let Some(found) = self.found_beside(&best)? else { break };
            best = self.in_turn(found, rounds)?;
        }
        Ok(best)
    }

    /// The same fit, or a better minimum that second looks around it find under the same noise.
    pub(crate) fn looked_around(&self, mut best: Fit) -> Result<Fit, Error> {
        for _ in 0..SEARCHES {
            let Some(found) = self.found_beside(&best)? else { break };
            best = found;
        }
        Ok(best)
    }

    /// Goes on from a fit: its noise and it in turn.
    fn in_turn(&self, mut best: Fit, rounds: usize) -> Result<Fit, Error> {
        for _ in 0..rounds {
            let noise = best.noise.refitted(self.model.channels(), self.observations, &best.residuals)?;
            let fit = self.fit(&best.hypothesis, &noise, Some(&best))?;
            let gained = fit.log_evidence - best.log_evidence;
            if gained > 0.0 {
                best = fit;
            }
            if gained < NOISE_SETTLED {
                break;
            }
        }
        Ok(best)
    }
}
