//! The search: everything a model may leave out is fitted and weighed.

use crate::fit::{Fit, Fitter, Hypothesis};
use crate::flexible::Rival;
use crate::noise::Noise;
use crate::{Diagnosis, Error, ForwardModel, Observation};

/// Probabilities before any recording is seen, and what counts as excluded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Of the nominal model.
    pub none: f64,
    /// Of constants that must be re-estimated.
    pub recalibrate: f64,
    /// Of one mechanism, all together.
    pub single: f64,
    /// Of two mechanisms, all pairs together.
    pub pair: f64,
    /// Of something that is not in the library.
    pub unknown: f64,
    /// Smallest probability of a mechanism, relative to the best, at which it is not excluded.
    pub excluded: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { none: 0.38, recalibrate: 0.02, single: 0.45, pair: 0.07, unknown: 0.08, excluded: 0.03 }
    }
}

/// A hypothesis that was compared.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// At its most probable parameters.
    pub fit: Fit,
    /// Structure that was added to it, if any.
    pub rival: Option<Rival>,
    /// ln of evidence times prior probability.
    pub log_weight: f64,
    /// Probability among all that were compared.
    pub probability: f64,
}

/// Rounds of fitting all single mechanisms, at most.
const ROUNDS: usize = 3;
/// Tasks that are counted.
const SINGLES: &str = "single mechanisms";
const LIKELIEST: &str = "the likeliest mechanisms with their own noise";
const PAIRS: &str = "pairs of mechanisms";
/// Singles that are followed up with their own noise and as parts of pairs.
const FOLLOWED: usize = 5;
const LEADERS: usize = 5;
/// ln evidence behind the best beyond which a candidate is not worth its own noise.
const BEHIND: f64 = 25.0;
/// Choices of a mechanism that are fitted in full, after all were tried in a linear step.
const CHOICES: usize = 6;
/// Gain of ln evidence of one mechanism below which it is not sought what may stand beside it.
const PAIRED: f64 = 1.0;
/// Share of the unknown that the unnamed mechanisms have; the rest is the structures'.
const DESCRIBED: f64 = 0.5;

struct Pool<'a, M> {
    fitter: Fitter<'a, M>,
    settings: Settings,
    candidates: Vec<Candidate>,
}

/// Compares everything that `model` may leave out on its records `records`, which observed `observations`.
///
/// `progress` is told each task as it begins, and the long ones again with ` (k of n)` behind their name.
///
/// # Errors
/// [`Error`] if the model or a fit fails.
pub fn diagnose<M: ForwardModel>(
    model: &M,
    records: &[usize],
    observations: &[Observation],
    settings: &Settings,
    progress: &dyn Fn(&str),
) -> Result<Diagnosis, Error<M::Error>> {
    let fitter = Fitter { model, observations, records };
    let times: Vec<&[f64]> = observations.iter().map(|o| o.time.as_slice()).collect();
    let mut pool = Pool { fitter, settings: *settings, candidates: Vec::new() };
    progress("nominal model and noise");
    let typical = Noise::typical(model.channels(), observations)?;
    let first = pool.fitter.fit(&Hypothesis::NOMINAL, &typical, None)?;
    let mut nominal = pool.fitter.fit_with_noise(&Hypothesis::NOMINAL, &first, 3)?;
    let singles: Vec<Vec<Hypothesis>> = (0..model.mechanisms().len()).map(|m| variants(model, m)).collect();

    progress(SINGLES);
    // noise fitted to the nominal residual has swallowed part of the effect: what is sought first is sought in calmer noise
    let calm = nominal.noise.calmed(model.channels(), observations)?;
    let mut leader = Fit { noise: calm, ..nominal.clone() };
    let mut fits: Vec<Fit> = Vec::new();
    for round in 0..ROUNDS {
        fits = Vec::new();
        for (k, hypotheses) in singles.iter().enumerate() {
            progress(&counted(SINGLES, round * singles.len() + k, ROUNDS * singles.len()));
            for hypothesis in hypotheses {
                let known = (round > 0).then_some(&leader);
                fits.push(pool.fitter.fit(hypothesis, &leader.noise, known.or(Some(&nominal)))?);
            }
        }
        let recalibrated = Hypothesis { constants_free: true, ..Hypothesis::NOMINAL };
        fits.push(pool.fitter.fit(&recalibrated, &leader.noise, Some(&leader))?);
        fits.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
        let best = pool.fitter.fit_with_noise(&fits[0].hypothesis, &fits[0], 2)?;
        let gained = best.log_evidence - if round == 0 { nominal.log_evidence } else { leader.log_evidence };
        if round == 0 || gained > 0.5 {
            leader = best;
        }
        if gained < 3.0 || round + 1 == ROUNDS {
            break;
        }
    }
    nominal = better(nominal.clone(), pool.fitter.fit_with_noise(&Hypothesis::NOMINAL, &leader_noise(&nominal, &leader), 2)?);
    pool.push(nominal.clone(), None);
    let recalibrated = Hypothesis { constants_free: true, ..Hypothesis::NOMINAL };
    let recalibrated = pool.fitter.fit_with_noise(&recalibrated, &leader_noise(&nominal, &leader), 2)?;
    pool.push(recalibrated, None);

    progress(LIKELIEST);
    let lead = fits[0].log_evidence;
    let mut leaders: Vec<Fit> = Vec::new();
    let mut met: Vec<usize> = Vec::new();
    let count = fits.len();
    for (k, fit) in fits.into_iter().enumerate().filter(|(_, f)| !f.hypothesis.mechanisms.is_empty()) {
        progress(&counted(LIKELIEST, k, count));
        let mechanism = fit.hypothesis.mechanisms[0].0;
        let again = met.contains(&mechanism);
        // of a mechanism's choices the best alone has its own noise; the others lie close behind it
        if !again && (met.len() < FOLLOWED || lead - fit.log_evidence < BEHIND) {
            let own = pool.fitter.fit_with_noise(&fit.hypothesis, &fit, 2)?;
            if met.len() < FOLLOWED {
                let free = Hypothesis { constants_free: true, ..own.hypothesis.clone() };
                let free = pool.fitter.fit_with_noise(&free, &own, 1)?;
                pool.push(free, None);
            }
            leaders.push(own.clone());
            pool.push(own, None);
        } else {
            // another choice of a mechanism that has its own noise is fitted in that
            let known = leaders.iter().find(|l| again && l.hypothesis.mechanisms[0].0 == mechanism);
            let own = known.map(|leader| pool.fitter.fit(&fit.hypothesis, &leader.noise, Some(&fit))).transpose()?;
            pool.push(own.map_or(fit.clone(), |own| better(fit, own)), None);
        }
        if !again {
            met.push(mechanism);
        }
    }
    leaders.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));

    progress(PAIRS);
    let mut followed: Vec<usize> = Vec::new();
    for fit in leaders.iter().filter(|f| f.log_evidence - nominal.log_evidence > PAIRED) {
        let first = fit.hypothesis.mechanisms[0].0;
        if model.mechanisms()[first].named && !followed.contains(&first) && followed.len() < LEADERS {
            progress(&counted(PAIRS, followed.len(), LEADERS));
            followed.push(first);
            pool.pairs(fit, &singles)?;
        }
    }

    progress("what no mechanism explains");
    pool.rivals(&times)?;
    Diagnosis::conclude(&pool.fitter, settings, pool.candidates, nominal)
}

/// A task of which `k` of `n` parts are done.
fn counted(task: &str, k: usize, n: usize) -> String {
    format!("{task} ({k} of {n})")
}

/// The nominal fit, but under the leader's noise.
fn leader_noise(nominal: &Fit, leader: &Fit) -> Fit {
    Fit { noise: leader.noise.clone(), ..nominal.clone() }
}

fn better(a: Fit, b: Fit) -> Fit {
    if b.log_evidence > a.log_evidence { b } else { a }
}

/// A mechanism alone, once for each of its choices.
fn variants<M: ForwardModel>(model: &M, mechanism: usize) -> Vec<Hypothesis> {
    let of = |choice| Hypothesis { mechanisms: vec![(mechanism, choice)], constants_free: false };
    match &model.mechanisms()[mechanism].choice {
        None => vec![of(None)],
        Some((_, values)) => values.iter().map(|v| of(Some(*v))).collect(),
    }
}

impl<M: ForwardModel> Pool<'_, M> {
    fn push(&mut self, fit: Fit, rival: Option<Rival>) {
        self.push_for(fit, rival, 0.0);
    }

    /// The same for a candidate that stands for others like it, too: `kin` is the ln of their number.
    fn push_for(&mut self, fit: Fit, rival: Option<Rival>, kin: f64) {
        let log_weight =
            self.log_prior(&fit.hypothesis, rival.is_some()) + fit.log_evidence + rival.as_ref().map_or(0.0, |r| r.gain) + kin;
        self.candidates.push(Candidate { fit, rival, log_weight, probability: 0.0 });
    }

    /// ln of the probability of a hypothesis before anything is seen.
    fn log_prior(&self, hypothesis: &Hypothesis, rival: bool) -> f64 {
        let library = self.fitter.model.mechanisms();
        // among those of its kind
        let share = |&(m, _): &(usize, Option<f64>)| {
            let all: f64 = library.iter().filter(|other| other.named == library[m].named).map(|m| m.weight).sum();
            let choices = library[m].choice.as_ref().map_or(1, |(_, values)| values.len());
            library[m].weight / all / choices as f64
        };
        let s = &self.settings;
        let base = match hypothesis.mechanisms.as_slice() {
            [] => {
                if hypothesis.constants_free {
                    s.recalibrate
                } else {
                    s.none
                }
            }
            [one] if library[one.0].named => s.single * share(one),
            [one] => s.unknown * DESCRIBED * share(one),
            // each pair is met in two orders
            many => s.pair * 2.0 * many.iter().map(share).product::<f64>(),
        };
        let constants: f64 = match (hypothesis.mechanisms.is_empty(), hypothesis.constants_free) {
            (true, _) => 1.0,
            (false, free) => {
                let odds = s.recalibrate / (s.none + s.recalibrate);
                if free { odds } else { 1.0 - odds }
            }
        };
        let structures = (crate::Structure::ALL.len() * self.fitter.model.channels().len()) as f64;
        (base * constants * if rival { s.unknown * (1.0 - DESCRIBED) / structures } else { 1.0 }).ln()
    }

    /// The mechanism of `fit` with every other one.
    fn pairs(&mut self, fit: &Fit, singles: &[Vec<Hypothesis>]) -> Result<(), Error<M::Error>> {
        let first = fit.hypothesis.mechanisms[0];
        // the first one's best choice stands for those that explain nearly as much
        let alone = |c: &&Candidate| {
            c.rival.is_none()
                && !c.fit.hypothesis.constants_free
                && matches!(c.fit.hypothesis.mechanisms[..], [one] if one.0 == first.0)
        };
        let of_first: f64 =
            self.candidates.iter().filter(alone).map(|c| (c.fit.log_evidence - fit.log_evidence).min(0.0).exp()).sum();
        let of_first = of_first.max(1.0).ln();
        let mut fits = Vec::new();
        let named = |m: usize| self.fitter.model.mechanisms()[m].named;
        for hypotheses in singles.iter().filter(|h| h[0].mechanisms[0].0 != first.0 && named(h[0].mechanisms[0].0)) {
            let mut pairs: Vec<Hypothesis> = hypotheses
                .iter()
                .map(|h| Hypothesis { mechanisms: vec![first, h.mechanisms[0]], constants_free: false })
                .collect();
            // the choice of a second mechanism is hardly determined: a few stand for all
            let all = pairs.len() as f64;
            if pairs.len() > CHOICES {
                let every = pairs.len().div_ceil(CHOICES);
                pairs = pairs.into_iter().step_by(every).collect();
            }
            for pair in &pairs {
                let known = self.candidates.iter().any(|c| same(&c.fit.hypothesis, pair));
                if !known {
                    fits.push((self.fitter.fit(pair, &fit.noise, Some(fit))?, (all / pairs.len() as f64).ln()));
                }
            }
        }
        fits.sort_by(|a, b| b.0.log_evidence.total_cmp(&a.0.log_evidence));
        let lead = fits.first().map_or(0.0, |f| f.0.log_evidence);
        for (rank, (pair, kin)) in fits.into_iter().enumerate() {
            let promising = pair.log_evidence - fit.log_evidence > 1.0 && lead - pair.log_evidence < BEHIND;
            let own = if rank < FOLLOWED && promising { self.fitter.fit_with_noise(&pair.hypothesis, &pair, 2)? } else { pair };
            self.push_for(own, None, kin + of_first);
        }
        Ok(())
    }

    /// Adds every structure to the most probable candidates, under their own noise and under calmer noise, which has not swallowed it; of
    /// the two the likelier counts.
    fn rivals(&mut self, times: &[&[f64]]) -> Result<(), Error<M::Error>> {
        let mut order: Vec<usize> = (0..self.candidates.len()).collect();
        order.sort_by(|&a, &b| self.candidates[b].log_weight.total_cmp(&self.candidates[a].log_weight));
        order.truncate(LEADERS);
        for at in order {
            let Fitter { model, records, observations } = self.fitter;
            let fit = self.candidates[at].fit.clone();
            let calm = fit.noise.calmed(model.channels(), observations)?;
            let calmer = self.fitter.fit(&fit.hypothesis, &calm, Some(&fit))?;
            let found = [&fit, &calmer].map(|f| f.rivals(model, records, times));
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

/// Whether two hypotheses hold the same mechanisms, in any order and with any choices.
fn same(a: &Hypothesis, b: &Hypothesis) -> bool {
    a.constants_free == b.constants_free
        && a.mechanisms.len() == b.mechanisms.len()
        && a.mechanisms.iter().all(|m| b.mechanisms.iter().any(|n| n.0 == m.0))
}
