//! From weighed candidates to a verdict.

use crate::diagnose::{Candidate, Settings};
use crate::fit::{Estimate, Fit, Fitter, Hypothesis};
use crate::{Error, ForwardModel};

/// What the recordings say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The nominal model suffices.
    None,
    /// Re-estimating the design's own constants within their uncertainties suffices.
    Recalibrate,
    /// A mechanism of the library explains the difference, or two.
    Explained,
    /// There is structure that nothing in the library explains.
    Unknown,
}

/// The outcome.
#[derive(Debug, Clone)]
pub struct Diagnosis {
    /// In a word.
    pub verdict: Verdict,
    /// Everything compared, most probable first.
    pub candidates: Vec<Candidate>,
    /// Marginal probability of every mechanism (its number in the library), most probable first.
    pub mechanisms: Vec<(usize, f64)>,
    /// Mechanisms that the recordings do not exclude, best first.
    pub set: Vec<usize>,
    /// Parameters of the best candidate's mechanisms, in its order.
    pub parameters: Vec<Vec<Estimate>>,
    /// The nominal model, its offsets and model errors fitted.
    pub nominal: Fit,
    /// The nominal model under the best candidate's noise: what it leaves is the mismatch.
    pub mismatch: Fit,
    /// What a flexible input at each stage would make of the mismatch, best first.
    pub stages: Vec<crate::Stage>,
    verdicts: [f64; 4],
    excluded: f64,
}

/// Probability of the nominal model from which nothing is called a finding.
const SUFFICES: f64 = 0.65;
/// Least gain of ln evidence over the nominal model of anything that is called a finding.
const FINDING: f64 = 2.0;
/// Marginal probability from which a mechanism beside another is reported, though the other alone explains all.
const BESIDE: f64 = 0.15;

impl Diagnosis {
    /// Concludes from the weighed `candidates`; `nominal` is the fit of the nominal model alone.
    pub(crate) fn conclude<M: ForwardModel>(
        fitter: &Fitter<M>,
        settings: &Settings,
        mut candidates: Vec<Candidate>,
        nominal: Fit,
    ) -> Result<Self, Error<M::Error>> {
        let model = fitter.model;
        candidates.sort_by(|a, b| b.log_weight.total_cmp(&a.log_weight));
        let most = candidates[0].log_weight;
        let sum: f64 = candidates.iter().map(|c| (c.log_weight - most).exp()).sum();
        candidates.iter_mut().for_each(|c| c.probability = (c.log_weight - most).exp() / sum);
        let of =
            |test: &dyn Fn(&Candidate) -> bool| -> f64 { candidates.iter().filter(|c| test(c)).map(|c| c.probability).sum() };
        let plain = |c: &Candidate| c.rival.is_none();
        let none = of(&|c| plain(c) && c.fit.hypothesis == Hypothesis::NOMINAL);
        let unknown = of(&|c| !plain(c) || !named(model, c));
        let recalibrate = of(&|c| plain(c) && c.fit.hypothesis.mechanisms.is_empty() && c.fit.hypothesis.constants_free);
        let mechanisms = marginals(model, &candidates, plain);
        let explained = 1.0 - none - unknown - recalibrate;
        // many hypotheses that a record says nothing about are no finding: one of them has to stand out
        let gain = |c: &Candidate| c.fit.log_evidence + c.rival.as_ref().map_or(0.0, |r| r.gain) - nominal.log_evidence;
        let evidence = candidates.iter().map(gain).fold(f64::NEG_INFINITY, f64::max);
        let verdict = if none > SUFFICES || evidence < FINDING {
            Verdict::None
        } else if unknown > explained.max(recalibrate) {
            Verdict::Unknown
        } else if recalibrate > explained {
            Verdict::Recalibrate
        } else {
            Verdict::Explained
        };
        let likeliest = mechanisms.iter().map(|(m, _)| *m).find(|m| model.mechanisms()[*m].named);
        // the best candidate of the verdict leads
        let fits = |c: &Candidate| match verdict {
            Verdict::None => plain(c) && c.fit.hypothesis == Hypothesis::NOMINAL,
            Verdict::Recalibrate => plain(c) && c.fit.hypothesis.mechanisms.is_empty() && c.fit.hypothesis.constants_free,
            // of those that hold the likeliest mechanism, many small candidates together may outweigh a large one
            Verdict::Explained => {
                plain(c) && named(model, c) && c.fit.hypothesis.mechanisms.iter().any(|m| Some(m.0) == likeliest)
            }
            Verdict::Unknown => !plain(c) || !named(model, c),
        };
        if let Some(at) = candidates.iter().position(fits) {
            let chosen = candidates.remove(at);
            candidates.insert(0, chosen);
        }
        let best = &candidates[0];
        let places = 0..best.fit.active.len();
        let parameters = places.map(|place| crate::marginal::estimates(model, &candidates, place)).collect();
        let set = match verdict {
            // of those of the verdict's kind
            Verdict::Explained | Verdict::Unknown => {
                let of_kind = |m: usize| model.mechanisms()[m].named == (verdict == Verdict::Explained);
                likely(&mechanisms, &candidates, plain, settings.excluded, of_kind)
            }
            Verdict::None | Verdict::Recalibrate => Vec::new(),
        };
        let mismatch = fitter.fit(&Hypothesis::NOMINAL, &best.fit.noise, Some(&nominal))?;
        let stages = mismatch.stages(model, fitter.records, fitter.observations)?;
        let verdicts = [none, recalibrate, explained, unknown];
        let excluded = settings.excluded;
        Ok(Self { verdict, mechanisms, set, parameters, nominal, mismatch, stages, verdicts, excluded, candidates })
    }

    /// The most probable candidate.
    pub fn best(&self) -> &Candidate {
        &self.candidates[0]
    }

    /// Probabilities of the verdicts none, recalibrate, explained and unknown, by the records that were fitted.
    pub fn verdicts(&self) -> [f64; 4] {
        self.verdicts
    }

    /// Takes back what a held-out record contradicts: nothing is left to explain if the nominal model `suffices` for that record, else
    /// what there is is unknown. The mechanisms lose their probabilities, which were of the fitted records alone.
    pub fn take_back(&mut self, suffices: bool) {
        self.verdict = if suffices { Verdict::None } else { Verdict::Unknown };
        self.set.clear();
        self.mechanisms.clear();
    }

    /// Whether what is called unknown is a structure beside mechanisms that have a name.
    pub fn is_beside_named<M: ForwardModel>(&self, model: &M) -> bool {
        let best = self.best();
        let something = best.rival.is_some() && !best.fit.hypothesis.mechanisms.is_empty();
        self.verdict == Verdict::Unknown && something && named(model, best)
    }

    /// Accepts the mechanisms beside which a structure was left ([`is_beside_named`](Self::is_beside_named)): a held-out record proves
    /// them. Their probabilities count the candidates with a structure, too.
    pub fn accept_beside<M: ForwardModel>(&mut self, model: &M) {
        self.verdict = Verdict::Explained;
        let counted = |c: &Candidate| named(model, c);
        self.mechanisms = marginals(model, &self.candidates, counted);
        self.set = likely(&self.mechanisms, &self.candidates, counted, self.excluded, |m| model.mechanisms()[m].named);
    }

    /// Ends of what the choice of the best candidate's mechanism at `place` may be, if it has one.
    pub fn choice(&self, place: usize) -> Option<[f64; 2]> {
        self.best().fit.hypothesis.mechanisms.get(place)?.1?;
        Some(self.parameters.get(place)?.first()?.ci90)
    }
}

/// Whether all mechanisms of a candidate have a name.
fn named<M: ForwardModel>(model: &M, candidate: &Candidate) -> bool {
    candidate.fit.hypothesis.mechanisms.iter().all(|(m, _)| model.mechanisms()[*m].named)
}

/// Probability of every mechanism in the candidates that are `counted`, most probable first.
fn marginals<M: ForwardModel>(model: &M, candidates: &[Candidate], counted: impl Fn(&Candidate) -> bool) -> Vec<(usize, f64)> {
    let has = |c: &&Candidate, m: usize| counted(c) && c.fit.hypothesis.mechanisms.iter().any(|(n, _)| *n == m);
    let of = |m| (m, candidates.iter().filter(|c| has(c, m)).map(|c| c.probability).sum());
    let mut all: Vec<(usize, f64)> = (0..model.mechanisms().len()).map(of).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all
}

/// Mechanisms that are not excluded, best first.
fn likely(
    marginals: &[(usize, f64)],
    candidates: &[Candidate],
    counted: impl Fn(&Candidate) -> bool,
    excluded: f64,
    of_kind: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let kind = || marginals.iter().filter(|(m, _)| of_kind(*m));
    // what is all but excluded is no member, even of a set of one
    let least = excluded * kind().next().map_or(0.0, |m| m.1).max(excluded);
    let counted: Vec<&Candidate> = candidates.iter().filter(|c| counted(c)).collect();
    let member = |(m, p): &&(usize, f64)| *p >= least && (*p >= BESIDE || needed(&counted, *m, excluded));
    kind().filter(member).map(|(m, _)| *m).collect()
}

/// Whether a mechanism stands in some likely candidate that loses by leaving it out: not merely beside another that explains all.
fn needed(candidates: &[&Candidate], mechanism: usize, excluded: f64) -> bool {
    let weight = |wanted: &[usize]| {
        let is = |c: &&&Candidate| {
            let has = &c.fit.hypothesis.mechanisms;
            has.len() == wanted.len() && has.iter().all(|(m, _)| wanted.contains(m))
        };
        candidates.iter().filter(is).map(|c| c.probability).sum::<f64>()
    };
    let least = excluded * candidates.iter().map(|c| c.probability).fold(0.0, f64::max);
    candidates.iter().any(|c| {
        let all: Vec<usize> = c.fit.hypothesis.mechanisms.iter().map(|(m, _)| *m).collect();
        let others: Vec<usize> = all.iter().copied().filter(|m| *m != mechanism).collect();
        all.contains(&mechanism) && weight(&all) > least && (others.is_empty() || weight(&all) > weight(&others))
    })
}
