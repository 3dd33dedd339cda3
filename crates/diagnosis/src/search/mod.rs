//! The search: every mechanism that a model may leave out is fitted and weighed.
//!
//! [`singles`] fits every mechanism alone and gives those that matter noise of their own; [`pairs`] looks for what may stand beside them. [`agreed`] does it under the model that is good about the result.

mod agreed;
mod columns;
mod pairs;
mod settings;
mod singles;

pub use agreed::diagnose_settled;
pub use settings::Settings;

use progress::Step;

use crate::fit::{Fit, Fitter, Hypothesis, alternatives, checked};
use crate::noise::Noise;
use crate::{Candidate, Diagnosis, Error, ForwardModel, Observation, Rival, Role};

// the long tasks, by the names that progress is told
const SINGLES: &str = "single mechanisms";
const LIKELIEST: &str = "the likeliest mechanisms with their own noise";
const PAIRS: &str = "pairs of mechanisms";
/// Singles, and pairs, that are followed up with their own noise and, if named, as parts of pairs.
const FOLLOWED: usize = 5;
/// Singles that are parts of pairs, and candidates to which structures are added.
const LEADERS: usize = 5;
/// ln evidence behind the best beyond which a candidate is not worth its own noise.
const BEHIND: f64 = 25.0;

struct Pool<'a> {
    fitter: Fitter<'a>,
    settings: Settings,
    /// Every mechanism alone, once for each of its choices.
    singles: Vec<Vec<Hypothesis>>,
    candidates: Vec<Candidate>,
    /// Fits of hypotheses by models that are good about them: what these tell of them holds.
    known: &'a [Fit],
    /// A likely fit that is known beforehand: the first search for all others begins at it.
    leading: Option<Fit>,
    /// Listener that is told each task as it begins, and the long ones as they go.
    progress: &'a dyn Fn(Step),
}

/// Compares all hypotheses of `model` on its records `records`, which observed `observations`.
///
/// `progress` is told each task as it begins, and the long ones as they go.
///
/// # Errors
/// [`Error::Data`] if the observations do not fit the model or one of them has no value, [`Error::Definition`] if the model contradicts itself;
/// [`Error`] if the model or a fit fails.
pub fn diagnose(
    model: &dyn ForwardModel,
    records: &[usize],
    observations: &[Observation],
    settings: &Settings,
    progress: &dyn Fn(Step),
) -> Result<Diagnosis, Error> {
    diagnose_beside(model, records, observations, settings, (&[], None), progress)
}

/// The same where fits of some hypotheses are `known` from models that are good about them, and one that is the likeliest under this model: where the search
/// begins.
fn diagnose_beside(
    model: &dyn ForwardModel,
    records: &[usize],
    observations: &[Observation],
    settings: &Settings,
    (known, leading): (&[Fit], Option<Fit>),
    progress: &dyn Fn(Step),
) -> Result<Diagnosis, Error> {
    let fitter = Fitter::new(model, records, observations)?;
    checked::states(model, records, observations)?;
    let singles = (0..model.mechanisms().len()).map(|m| alternatives(model, m)).collect();
    let mut pool = Pool { fitter, settings: *settings, singles, candidates: Vec::new(), known, leading, progress };
    if let Some(fit) = known.iter().find(|fit| fit.hypothesis == Hypothesis::RECALIBRATED) {
        pool.push(fit.clone(), None);
    }
    progress(Step::begins("nominal model and noise"));
    let nominal = pool.nominal()?;
    progress(Step::begins(SINGLES));
    let (leader, fits) = pool.singles(&nominal)?;
    let nominal = pool.without_mechanisms(nominal, &leader)?;
    progress(Step::begins(LIKELIEST));
    let likeliest = pool.likeliest(fits)?;
    progress(Step::begins(PAIRS));
    pool.pairs(&likeliest)?;
    progress(Step::begins("what no mechanism explains"));
    pool.rivals()?;
    Diagnosis::conclude(&pool.fitter, settings, pool.candidates, nominal)
}

fn sort(fits: &mut [Fit]) {
    fits.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
}

impl Pool<'_> {
    /// The nominal model with the noise that it leaves.
    fn nominal(&self) -> Result<Fit, Error> {
        let typical = Noise::typical(self.fitter.model.channels(), self.fitter.observations)?;
        let first = self.fitter.fit(&Hypothesis::NOMINAL, &typical, None)?;
        self.fitter.fit_with_noise(&Hypothesis::NOMINAL, &first, 3)
    }

    /// Takes in the nominal model, its constants given or re-estimated, each with its own noise found from the leader's; returns the former.
    fn without_mechanisms(&mut self, nominal: Fit, leader: &Fit) -> Result<Fit, Error> {
        let under_leader = |nominal: &Fit| Fit { noise: leader.noise.clone(), ..nominal.clone() };
        let again = self.fitter.fit_with_noise(&Hypothesis::NOMINAL, &under_leader(&nominal), 2)?;
        let nominal = Fit::better(Some(nominal), again);
        self.push(nominal.clone(), None);
        // a model without constants of its own has nothing to re-estimate
        if !self.fitter.model.nuisances().iter().any(|n| n.role == Role::Constant) {
            return Ok(nominal);
        }
        let again = self.fitter.fit_with_noise(&Hypothesis::RECALIBRATED, &under_leader(&nominal), 2)?;
        let known = self.candidates.iter().position(Candidate::is_constants_alone);
        let recalibrated = Fit::better(known.map(|at| self.candidates.remove(at).fit), again);
        self.push(recalibrated, None);
        Ok(nominal)
    }

    fn push(&mut self, fit: Fit, rival: Option<Rival>) {
        self.push_for(fit, rival, 0.0);
    }

    /// The same for a candidate that stands for others like it, too: `kin` is the ln of their number.
    fn push_for(&mut self, fit: Fit, rival: Option<Rival>, kin: f64) {
        let own = rival.is_none() && !fit.active.is_empty();
        let known = self.known.iter().find(|known| own && known.hypothesis == fit.hypothesis);
        // what leads is known from this model: there the better of two fits is the right one
        let leads = self.leading.as_ref().is_some_and(|leading| leading.hypothesis == fit.hypothesis);
        let fit = match known {
            Some(known) if leads => Fit::better(Some(known.clone()), fit),
            _ => known.cloned().unwrap_or(fit),
        };
        let log_prior = self.settings.log_prior(self.fitter.model, &fit.hypothesis, rival.is_some());
        let log_weight = log_prior + fit.log_evidence + rival.as_ref().map_or(0.0, |r| r.gain) + kin;
        self.candidates.push(Candidate { fit, rival, log_weight, probability: 0.0 });
    }

    fn named(&self, mechanism: usize) -> bool {
        self.fitter.model.mechanisms()[mechanism].named
    }

    /// Adds every structure to the likeliest candidates and to the design's constants alone, under their own noise or calmer noise, which has not
    /// swallowed it: the likelier.
    fn rivals(&mut self) -> Result<(), Error> {
        let mut order: Vec<usize> = (0..self.candidates.len()).collect();
        order.sort_by(|&a, &b| self.candidates[b].log_weight.total_cmp(&self.candidates[a].log_weight));
        // the design's constants beside a structure are weighed in any case: among mechanisms alone the nearest would stand for it
        let (likeliest, others) = order.split_at(order.len().min(LEADERS));
        let alone = |at: &&usize| self.candidates[**at].fit.hypothesis.mechanisms.is_empty();
        let design = if likeliest.iter().any(|at| alone(&at)) { None } else { others.iter().find(alone) };
        let order: Vec<usize> = likeliest.iter().chain(design).copied().collect();
        let Fitter { model, records, observations, .. } = self.fitter;
        let times: Vec<&[f64]> = observations.iter().map(|o| o.time.as_slice()).collect();
        for at in order {
            let fit = self.candidates[at].fit.clone();
            let calm = fit.noise.calmed(model.channels(), observations)?;
            let calmer = self.fitter.fit(&fit.hypothesis, &calm, Some(&fit))?;
            let found = [&fit, &calmer].map(|f| f.rivals(model, records, &times));
            let weight = |f: &Fit, r: &Rival| f.log_evidence + r.gain;
            for rival in &found[0] {
                let same = found[1].iter().find(|r| (r.structure, r.channel) == (rival.structure, rival.channel));
                match same.filter(|calm| weight(&calmer, calm) > weight(&fit, rival)) {
                    Some(calm) => self.push(calmer.clone(), Some(calm.clone())),
                    None => self.push(fit.clone(), Some(rival.clone())),
                }
            }
        }
        Ok(())
    }
}
