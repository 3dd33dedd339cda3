//! Mechanisms that may be at work beside the likeliest ones.

use progress::Step;

use super::{BEHIND, FOLLOWED, LEADERS, PAIRS, Pool};
use crate::fit::{Fit, Hypothesis};
use crate::{Candidate, Error};

/// Choices of a mechanism that are fitted beside another.
const CHOICES: usize = 6;
/// Gain of ln evidence below which nothing is sought beside a mechanism, and a pair is not worth its own noise.
const PAIRED: f64 = 1.0;

impl Pool<'_> {
    /// Takes in pairs of each of the `likeliest` mechanisms that has a name and gains on the design, its constants as they are or re-estimated.
    pub(super) fn pairs(&mut self, likeliest: &[Fit]) -> Result<(), Error> {
        let mut followed: Vec<usize> = Vec::new();
        let without = self.candidates.iter().filter(|c| c.fit.hypothesis.mechanisms.is_empty());
        let design = without.map(|c| c.fit.log_evidence).fold(f64::NEG_INFINITY, f64::max);
        for fit in likeliest.iter().filter(|f| f.log_evidence - design > PAIRED) {
            let first = fit.hypothesis.mechanisms[0].0;
            if self.named(first) && !followed.contains(&first) && followed.len() < LEADERS {
                (self.progress)(Step::counted(PAIRS, followed.len(), LEADERS));
                followed.push(first);
                self.pairs_of(fit)?;
            }
        }
        Ok(())
    }

    /// The mechanism of `fit` with every other one.
    fn pairs_of(&mut self, fit: &Fit) -> Result<(), Error> {
        let kin_of_first = self.kin(fit);
        let mut fits = Vec::new();
        for (pair, kin) in self.beside(fit.hypothesis.mechanisms[0]) {
            let alone = |c: &&Candidate| c.rival.is_none() && c.fit.hypothesis.mechanisms == pair.mechanisms[1..];
            let found = self.candidates.iter().find(alone).map_or(&[][..], |c| &c.fit.active);
            fits.push((self.fitter.screened_from(&pair, fit, found)?, kin));
        }
        fits.sort_by(|a, b| b.0.log_evidence.total_cmp(&a.0.log_evidence));
        let lead = fits.first().map_or(0.0, |f| f.0.log_evidence);
        for (rank, (pair, kin)) in fits.into_iter().enumerate() {
            let promising = rank < FOLLOWED && is_promising(pair.log_evidence, fit.log_evidence, lead);
            let own = if promising { self.fitter.fit_with_noise(&pair.hypothesis, &pair, 2)? } else { pair };
            self.push_for(own, None, kin + kin_of_first);
        }
        Ok(())
    }

    /// ln of the number of choices for which a single mechanism's best one stands: those that explain nearly as much.
    fn kin(&self, fit: &Fit) -> f64 {
        let mechanism = fit.hypothesis.mechanisms[0].0;
        let alone = |c: &&Candidate| matches!(c.fit.hypothesis.mechanisms[..], [one] if one.0 == mechanism);
        let likeness = |c: &Candidate| (c.fit.log_evidence - fit.log_evidence).min(0.0).exp();
        self.candidates.iter().filter(alone).map(likeness).sum::<f64>().max(1.0).ln()
    }

    /// Pairs of a mechanism with others that have a name and that it was not paired with, and ln of the choices for which each stands: the choice
    /// of a second mechanism is hardly determined, so that a few stand for all.
    fn beside(&self, first: (usize, Option<f64>)) -> Vec<(Hypothesis, f64)> {
        let mut pairs = Vec::new();
        for hypotheses in &self.singles {
            let second = hypotheses[0].mechanisms[0].0;
            if second == first.0 || !self.named(second) {
                continue;
            }
            let every = hypotheses.len().div_ceil(CHOICES);
            let kin = (hypotheses.len() as f64 / hypotheses.len().div_ceil(every) as f64).ln();
            let pair = |h: &Hypothesis| Hypothesis { mechanisms: vec![first, h.mechanisms[0]], constants_free: true };
            let known = |pair: &Hypothesis| self.candidates.iter().any(|c| same(&c.fit.hypothesis, pair));
            pairs.extend(hypotheses.iter().step_by(every).map(pair).filter(|pair| !known(pair)).map(|pair| (pair, kin)));
        }
        pairs
    }
}

/// Whether a pair of this ln evidence is worth a fit with its own noise: it explains more than one of its mechanisms alone, and is not far behind the best pair.
fn is_promising(pair: f64, alone: f64, best: f64) -> bool {
    pair - alone > PAIRED && best - pair < BEHIND
}

/// Whether two hypotheses hold the same mechanisms, in any order and with any choices.
fn same(a: &Hypothesis, b: &Hypothesis) -> bool {
    a.constants_free == b.constants_free
        && a.mechanisms.len() == b.mechanisms.len()
        && a.mechanisms.iter().all(|(mechanism, _)| b.has(*mechanism))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_is_promising_that_explains_more_and_is_not_far_behind() {
        let alone = 100.0;
        let best = alone + PAIRED + 2.0 * BEHIND;
        assert!(is_promising(best, alone, best) && is_promising(best - 0.9 * BEHIND, alone, best));
        assert!(!is_promising(best - 1.1 * BEHIND, alone, best));
        assert!(!is_promising(alone + 0.9 * PAIRED, alone, alone + 0.9 * PAIRED));
    }
}
