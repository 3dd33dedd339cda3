//! Mechanisms that the recordings do not exclude.

use crate::{Candidate, ForwardModel};

/// Marginal probability from which a mechanism beside another is reported, though the other alone explains all.
const BESIDE: f64 = 0.15;

/// Whether all mechanisms of a candidate have a name.
pub(super) fn named(model: &dyn ForwardModel, candidate: &Candidate) -> bool {
    candidate.fit.hypothesis.mechanisms.iter().all(|(m, _)| model.mechanisms()[*m].named)
}

/// Probability of every mechanism in the candidates that are `counted`, most probable first.
pub(super) fn marginals(
    model: &dyn ForwardModel,
    candidates: &[Candidate],
    counted: impl Fn(&Candidate) -> bool,
) -> Vec<(usize, f64)> {
    let has = |c: &&Candidate, m: usize| counted(c) && c.fit.hypothesis.has(m);
    let of = |m| (m, candidates.iter().filter(|c| has(c, m)).map(|c| c.probability).sum());
    let mut all: Vec<(usize, f64)> = (0..model.mechanisms().len()).map(of).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all
}

/// Mechanisms `of_kind` that are not excluded, best first: each has at least the share `excluded` of the best one's probability, and is either
/// likely of itself or needed.
pub(super) fn likely(
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

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::fit::{Beforehand, Derivatives, Fit, Hypothesis};
    use crate::noise::Noise;
    use crate::{Active, Channel, Nuisance, Omission, State};

    /// A library alone: mechanisms with or without a name, constants and channels.
    pub(crate) struct Library(pub(crate) Vec<Omission>, pub(crate) Vec<Nuisance>, pub(crate) Vec<Channel>);

    pub(crate) fn library(named: &[bool]) -> Library {
        let of = |(n, named): (usize, &bool)| Omission {
            id: n.to_string(),
            stage: String::new(),
            parameters: Vec::new(),
            choice: None,
            starts: vec![Vec::new()],
            named: *named,
            weight: 1.0,
        };
        Library(named.iter().enumerate().map(of).collect(), Vec::new(), Vec::new())
    }

    impl ForwardModel for Library {
        fn channels(&self) -> &[Channel] {
            &self.2
        }
        fn nuisances(&self) -> &[Nuisance] {
            &self.1
        }
        fn mechanisms(&self) -> &[Omission] {
            &self.0
        }
        fn respond(&self, _: usize, _: &[f64], _: &[Active]) -> Result<Vec<Vec<f64>>, crate::Failure> {
            Ok(Vec::new())
        }
        fn state(&self, _: usize) -> &State {
            const { &State { level: Vec::new(), rate: Vec::new() } }
        }
    }

    /// A candidate with mechanisms and a probability, and nothing else.
    pub(crate) fn candidate(mechanisms: &[usize], probability: f64) -> Candidate {
        let hypothesis = Hypothesis { mechanisms: mechanisms.iter().map(|m| (*m, None)).collect(), constants_free: false };
        let fit = Fit {
            hypothesis,
            log_evidence: 0.0,
            nuisances: Vec::new(),
            active: Vec::new(),
            offsets: Vec::new(),
            residuals: Vec::new(),
            u: nalgebra::DVector::zeros(0),
            layout: Vec::new(),
            beforehand: Beforehand::new(0, |_, _| None).expect("nothing is known of nothing"),
            covariance: nalgebra::DMatrix::zeros(0, 0),
            noise: Noise::typical(&[], &[]).expect("no noise"),
            whitened: nalgebra::DVector::zeros(0),
            derivatives: Derivatives { jacobian: nalgebra::DMatrix::zeros(0, 0), products: nalgebra::DMatrix::zeros(0, 0) },
        };
        Candidate { fit, rival: None, log_weight: 0.0, probability }
    }

    /// The set of named mechanisms, with 3 % of the likeliest one's probability as the limit.
    fn set(named: &[bool], candidates: &[Candidate]) -> Vec<usize> {
        let model = library(named);
        likely(&marginals(&model, candidates, |_| true), candidates, |_| true, 0.03, |m| named[m])
    }

    #[test]
    fn a_set_holds_what_is_not_excluded_best_first() {
        // the second mechanism's probability is spread over ten choices; the limit is 3 % of their sum, 0.018
        let with = |third: f64| -> Vec<Candidate> {
            let choices = (0..10).map(|_| candidate(&[1], 0.06));
            choices.chain([candidate(&[0], 0.361), candidate(&[2], third), candidate(&[], 0.039 - third)]).collect()
        };
        assert_eq!(set(&[true; 3], &with(0.019)), [1, 0, 2]);
        assert_eq!(set(&[true; 3], &with(0.017)), [1, 0]);
        let candidates = with(0.017);
        // what has no name is no member of theirs
        assert_eq!(set(&[false, true, true], &candidates), [1]);
    }

    #[test]
    fn what_stands_beside_one_that_explains_all_is_no_member_unless_it_is_likely() {
        let pair = |p: f64| [candidate(&[0], 0.9 - p), candidate(&[0, 1], p), candidate(&[], 0.1)];
        assert_eq!(set(&[true; 2], &pair(0.1)), [0]);
        assert_eq!(set(&[true; 2], &pair(0.2)), [0, 1]);
        // needed: the pair has more than the first alone, though little beside a third
        let candidates = [candidate(&[2], 0.8), candidate(&[0, 1], 0.1), candidate(&[0], 0.05), candidate(&[1], 0.05)];
        assert_eq!(set(&[true; 3], &candidates), [2, 0, 1]);
    }

    #[test]
    fn even_the_best_is_no_member_where_it_is_all_but_excluded() {
        // a hundred candidates without it, none of them large
        let with = |best: f64| -> Vec<Candidate> {
            (0..100).map(|_| candidate(&[], (1.0 - best) / 100.0)).chain([candidate(&[0], best)]).collect()
        };
        assert_eq!(set(&[true], &with(0.0008)), []);
        assert_eq!(set(&[true], &with(0.0010)), [0]);
    }

    #[test]
    fn what_stands_in_a_pair_is_a_member_where_the_pair_loses_by_leaving_it_out() {
        let with = |pair: f64, alone: f64| {
            set(&[true; 3], &[candidate(&[2], 0.8), candidate(&[0, 1], pair), candidate(&[0], alone), candidate(&[], 0.02)])
        };
        assert_eq!(with(0.1, 0.02), [2, 0, 1]);
        // as likely without
        assert_eq!(with(0.07, 0.07), [2, 0]);
        assert_eq!(with(0.06, 0.08), [2, 0]);
    }
}
