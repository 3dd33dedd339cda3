//! Verdict on weighed candidates.

use super::set::{likely, marginals, named};
use super::{Diagnosis, Verdict};
use crate::fit::{Fit, Fitter, Hypothesis};
use crate::{Candidate, Error, ForwardModel, Settings};

/// Least gain of ln evidence over the design and its constants of anything that is called a finding: strong evidence on the scale of Kass and
/// Raftery (1995). Were there but one finding to look for, the design would show such a ratio by chance at most once in twenty times (Markov's
/// inequality); for the choice among many their prior probabilities pay.
const FINDING: f64 = 3.0;

/// Gain of ln evidence from which another minimum of the likeliest hypothesis takes its place.
const LIKELIER: f64 = 0.5;

impl Diagnosis {
    /// Concludes from the weighed `candidates`; `nominal` is the fit of the nominal model alone.
    pub(crate) fn conclude(
        fitter: &Fitter,
        settings: &Settings,
        mut candidates: Vec<Candidate>,
        nominal: Fit,
    ) -> Result<Self, Error> {
        let model = fitter.model;
        weigh(&mut candidates);
        let verdicts = verdicts(model, &candidates);
        let gain = gain(model, &candidates);
        let verdict = decide(verdicts, gain);
        let mechanisms = marginals(model, &candidates, plain);
        lead(model, &mut candidates, verdict, &mechanisms);
        let set = match verdict {
            // of those of the verdict's kind
            Verdict::Explained | Verdict::Unknown => {
                let of_kind = |m: usize| model.mechanisms()[m].named == (verdict == Verdict::Explained);
                likely(&mechanisms, &candidates, plain, settings.excluded, of_kind)
            }
            Verdict::None | Verdict::Recalibrate => Vec::new(),
        };
        let best = &candidates[0].fit;
        let elsewhere = fitter.elsewhere(best)?;
        // the likeliest of several minima is the one that speaks
        let likelier = elsewhere.iter().max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence));
        if let Some(other) = likelier.filter(|other| other.log_evidence - best.log_evidence > LIKELIER) {
            let other = Fit::better(Some(other.clone()), fitter.fit_with_noise(&other.hypothesis, other, 2)?);
            refit(&mut candidates[0], other);
            return Self::conclude(fitter, settings, candidates, nominal);
        }
        let parameters =
            (0..best.active.len()).map(|place| crate::marginal::estimates(model, &candidates, &elsewhere, place)).collect();
        let mismatch = fitter.fit(&Hypothesis::NOMINAL, &best.noise, Some(&nominal))?;
        let stages = mismatch.stages(model, fitter.records, fitter.observations)?;
        let excluded = settings.excluded;
        Ok(Self { verdict, mechanisms, set, parameters, nominal, mismatch, stages, verdicts, excluded, candidates })
    }
}

/// Gives a candidate another fit of its hypothesis, as likely beforehand.
fn refit(candidate: &mut Candidate, fit: Fit) {
    candidate.log_weight += fit.log_evidence - candidate.fit.log_evidence;
    candidate.fit = fit;
}

/// Sorts candidates by their weights, best first, and turns the weights into probabilities.
fn weigh(candidates: &mut [Candidate]) {
    candidates.sort_by(|a, b| b.log_weight.total_cmp(&a.log_weight));
    let most = candidates[0].log_weight;
    let sum: f64 = candidates.iter().map(|c| (c.log_weight - most).exp()).sum();
    candidates.iter_mut().for_each(|c| c.probability = (c.log_weight - most).exp() / sum);
}

/// Gain of ln evidence of the likeliest finding over the design and its constants.
///
/// Many hypotheses that a record says nothing about are no finding: one of them has to stand out, all choices of its mechanisms together. It
/// is the likeliest one, not one that explains more with more.
fn gain(model: &dyn ForwardModel, candidates: &[Candidate]) -> f64 {
    let (design, findings): (Vec<&Candidate>, Vec<&Candidate>) =
        candidates.iter().partition(|c| matches!(kind(model, c), Verdict::None | Verdict::Recalibrate));
    let mut groups: Vec<Vec<&Candidate>> = Vec::new();
    for candidate in findings {
        match groups.iter_mut().find(|group| of_one_kind(group[0], candidate)) {
            Some(group) => group.push(candidate),
            None => groups.push(vec![candidate]),
        }
    }
    let likeliest = groups.iter().map(|group| marginal(group)).max_by(|a, b| a.log_weight.total_cmp(&b.log_weight));
    let design = design.iter().map(|c| c.log_evidence()).fold(f64::NEG_INFINITY, f64::max);
    likeliest.map_or(f64::NEG_INFINITY, |finding| finding.log_evidence - design)
}

/// Whether two candidates differ in choices alone: a layer, an instant.
fn of_one_kind(a: &Candidate, b: &Candidate) -> bool {
    let structure = |c: &Candidate| c.rival.as_ref().map(|r| (r.structure, r.channel));
    a.fit.hypothesis.numbers() == b.fit.hypothesis.numbers() && structure(a) == structure(b)
}

/// Several candidates taken as one.
struct Marginal {
    /// ln of their weights' sum.
    log_weight: f64,
    /// ln of the mean of their evidences, by their prior probabilities.
    log_evidence: f64,
}

fn marginal(candidates: &[&Candidate]) -> Marginal {
    let log_sum = |terms: &dyn Fn(&Candidate) -> f64| {
        let most = candidates.iter().map(|c| terms(c)).fold(f64::MIN, f64::max);
        most + candidates.iter().map(|c| (terms(c) - most).exp()).sum::<f64>().ln()
    };
    let log_weight = log_sum(&|c| c.log_weight);
    Marginal { log_weight, log_evidence: log_weight - log_sum(&|c| c.log_weight - c.log_evidence()) }
}

/// Whether no structure was added to a candidate.
fn plain(candidate: &Candidate) -> bool {
    candidate.rival.is_none()
}

/// Probabilities of the verdicts none, recalibrate, explained and unknown.
fn verdicts(model: &dyn ForwardModel, candidates: &[Candidate]) -> [f64; 4] {
    let of = |verdict: Verdict| -> f64 { candidates.iter().filter(|c| kind(model, c) == verdict).map(|c| c.probability).sum() };
    let [none, recalibrate, unknown] = [Verdict::None, Verdict::Recalibrate, Verdict::Unknown].map(of);
    // no less than nothing by rounding
    [none, recalibrate, (1.0 - none - unknown - recalibrate).max(0.0), unknown]
}

/// The verdict that a candidate speaks for.
fn kind(model: &dyn ForwardModel, candidate: &Candidate) -> Verdict {
    let hypothesis = &candidate.fit.hypothesis;
    if !plain(candidate) || !named(model, candidate) {
        Verdict::Unknown
    } else if *hypothesis == Hypothesis::NOMINAL {
        Verdict::None
    } else if *hypothesis == Hypothesis::RECALIBRATED {
        Verdict::Recalibrate
    } else {
        Verdict::Explained
    }
}

/// The verdict by the probabilities of all four, and the gain of ln evidence of the likeliest finding over the design and its constants.
fn decide([none, recalibrate, explained, unknown]: [f64; 4], gain: f64) -> Verdict {
    let design = none + recalibrate;
    // never a finding while the design is likelier
    if design >= explained.max(unknown) || gain < FINDING {
        if none >= recalibrate { Verdict::None } else { Verdict::Recalibrate }
    } else if unknown > explained {
        Verdict::Unknown
    } else {
        Verdict::Explained
    }
}

/// Puts the best candidate of the verdict first: of the likeliest set of mechanisms, all its choices together, the likeliest.
fn lead(model: &dyn ForwardModel, candidates: &mut [Candidate], verdict: Verdict, mechanisms: &[(usize, f64)]) {
    // of those that hold the likeliest mechanism, many small candidates together may outweigh a large one
    let likeliest = mechanisms.iter().map(|(m, _)| *m).find(|m| model.mechanisms()[*m].named);
    let fits = |c: &Candidate| {
        kind(model, c) == verdict
            && (verdict != Verdict::Explained || likeliest.is_some_and(|mechanism| c.fit.hypothesis.has(mechanism)))
    };
    let together = |c: &Candidate| -> f64 {
        candidates.iter().filter(|other| fits(other) && of_one_kind(c, other)).map(|other| other.probability).sum()
    };
    // of one set the first, which is the likeliest
    let of_kind = candidates.iter().enumerate().filter(|(_, c)| fits(c)).rev();
    if let Some((at, _)) = of_kind.max_by(|a, b| together(a.1).total_cmp(&together(b.1))) {
        candidates[..=at].rotate_right(1);
    }
}

#[cfg(test)]
mod tests {
    use super::super::set::tests::{candidate, library};
    use super::*;
    use crate::{Rival, Structure};

    #[test]
    fn a_verdict_needs_probability_and_one_hypothesis_that_stands_out() {
        assert_eq!(decide([0.66, 0.0, 0.34, 0.0], 9.0), Verdict::None);
        assert_eq!(decide([0.45, 0.0, 0.55, 0.0], 9.0), Verdict::Explained);
        assert_eq!(decide([0.2, 0.3, 0.45, 0.05], 9.0), Verdict::Recalibrate);
        // the design and its constants count together
        assert_eq!(decide([0.3, 0.36, 0.34, 0.0], 9.0), Verdict::Recalibrate);
        assert_eq!(decide([0.1, 0.0, 0.9, 0.0], 2.9), Verdict::None);
        assert_eq!(decide([0.0, 0.1, 0.9, 0.0], 2.9), Verdict::Recalibrate);
        assert_eq!(decide([0.1, 0.2, 0.2, 0.5], 9.0), Verdict::Unknown);
        // equal shares speak for what has a name
        assert_eq!(decide([0.2, 0.0, 0.4, 0.4], 9.0), Verdict::Explained);
    }

    #[test]
    fn a_finding_gains_what_all_choices_of_its_mechanism_gain_together() {
        let model = library(&[true, true]);
        let with = |mechanisms: &[usize], log_evidence: f64, log_prior: f64| {
            let mut candidate = candidate(mechanisms, 0.0);
            candidate.fit.log_evidence = log_evidence;
            candidate.log_weight = log_evidence + log_prior;
            candidate
        };
        let choices = |n: usize| (0..n).map(|_| with(&[0], 6.0, -(n as f64).ln())).collect::<Vec<_>>();
        let gained = |findings: Vec<Candidate>| {
            gain(&model, &[vec![with(&[], 1.0, 0.0), with(&[], f64::NEG_INFINITY, 0.0)], findings].concat())
        };
        // the same in however many choices
        for n in [1, 2, 50] {
            assert!((gained(choices(n)) - 5.0).abs() < 1e-12);
        }
        // one choice out of fifty that explains it: the mean is what counts
        let mut one = choices(50);
        one[1..].iter_mut().for_each(|c| (c.fit.log_evidence, c.log_weight) = (-1e3, -1e3 - 50_f64.ln()));
        assert!((gained(one) - (5.0 - 50_f64.ln())).abs() < 1e-12);
        // another that explains more, but is less likely of itself, says nothing
        assert!((gained([choices(50), vec![with(&[1], 8.0, -3.0)]].concat()) - 5.0).abs() < 1e-12);
        assert_eq!(gained(Vec::new()), f64::NEG_INFINITY);
    }

    #[test]
    fn weights_become_probabilities_whatever_is_added_to_all() {
        for shift in [0.0, -1e5, 1e5] {
            let weighed = |ln: f64| Candidate { log_weight: ln + shift, ..candidate(&[0], 0.0) };
            let mut candidates = vec![weighed(0.0), weighed(3.0_f64.ln()), weighed(f64::NEG_INFINITY)];
            weigh(&mut candidates);
            for (candidate, expected) in candidates.iter().zip([0.75, 0.25, 0.0]) {
                assert!((candidate.probability - expected).abs() < 1e-10, "{} {expected}", candidate.probability);
            }
        }
    }

    #[test]
    fn every_candidate_speaks_for_one_verdict() {
        let model = library(&[true, true, false]);
        let rival = Some(Rival { structure: Structure::Step, channel: 0, at: None, gain: 0.0 });
        let mut recalibrated = candidate(&[], 0.2);
        recalibrated.fit.hypothesis.constants_free = true;
        let candidates = [
            candidate(&[], 0.1),
            recalibrated,
            candidate(&[0], 0.3),
            candidate(&[0, 1], 0.15),
            candidate(&[2], 0.05),
            candidate(&[0, 2], 0.08),
            Candidate { rival, ..candidate(&[1], 0.12) },
        ];
        for (found, expected) in verdicts(&model, &candidates).iter().zip([0.1, 0.2, 0.45, 0.25]) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }

    #[test]
    fn the_best_candidate_of_the_verdict_leads_and_the_others_keep_their_order() {
        let model = library(&[true, true, false]);
        let shares = |candidates: &[Candidate]| candidates.iter().map(|c| c.probability).collect::<Vec<_>>();
        // the first mechanism alone is the largest candidate, the second in two pairs has more together
        let all = || vec![candidate(&[], 0.3), candidate(&[0], 0.25), candidate(&[1], 0.24), candidate(&[1, 1], 0.21)];
        let order = |verdict| {
            let mut candidates = all();
            let mechanisms = marginals(&model, &candidates, plain);
            lead(&model, &mut candidates, verdict, &mechanisms);
            shares(&candidates)
        };
        assert_eq!(order(Verdict::None), [0.3, 0.25, 0.24, 0.21]);
        assert_eq!(order(Verdict::Explained), [0.24, 0.3, 0.25, 0.21]);
        // none speaks for it: as they were
        assert_eq!(order(Verdict::Unknown), [0.3, 0.25, 0.24, 0.21]);
    }

    #[test]
    fn of_the_sets_of_mechanisms_the_likeliest_leads_though_its_choices_share_it() {
        let model = library(&[true; 3]);
        let choices = [0.15, 0.14, 0.13].map(|p| candidate(&[0, 2], p));
        let mut candidates = [vec![candidate(&[0, 1], 0.3), candidate(&[0], 0.28)], choices.to_vec()].concat();
        let mechanisms = marginals(&model, &candidates, plain);
        lead(&model, &mut candidates, Verdict::Explained, &mechanisms);
        let leads = &candidates[0];
        assert_eq!((leads.fit.hypothesis.numbers(), leads.probability), (vec![0, 2], 0.15));
    }

    #[test]
    fn another_fit_of_a_candidate_weighs_what_it_is_likelier_and_is_as_likely_beforehand() {
        let rival = Some(Rival { structure: Structure::Step, channel: 0, at: None, gain: 3.0 });
        let mut refitted = Candidate { rival, log_weight: -101.0, ..candidate(&[0], 0.5) };
        refitted.fit.log_evidence = -100.0;
        let before = refitted.log_prior();
        let likelier = Fit { log_evidence: -90.0, offsets: vec![vec![2.0]], ..refitted.fit.clone() };
        refit(&mut refitted, likelier);
        assert_eq!((refitted.log_weight, refitted.log_prior()), (-91.0, before));
        assert_eq!((refitted.fit.log_evidence, refitted.fit.offsets[0][0]), (-90.0, 2.0));
    }
}
