//! Every mechanism alone, and the likeliest of them with the noise that each leaves.

use progress::Step;

use super::{BEHIND, FOLLOWED, LIKELIEST, Pool, SINGLES, sort};
use crate::Error;
use crate::fit::{Fit, Hypothesis};

/// Largest number of rounds of fitting all of them.
const ROUNDS: usize = 3;
/// Gain of ln evidence by which another fit takes the lead.
const LEADS: f64 = 0.5;
/// Gain of ln evidence of a round after which all are fitted once more, in the noise that the new leader leaves.
const ONCE_MORE: f64 = 3.0;

/// Whether the best fit of a round that has gained so much ln evidence leads from there on.
fn takes_the_lead(round: usize, gained: f64) -> bool {
    round == 0 || gained > LEADS
}

impl Pool<'_> {
    /// The leader with its own noise, and all fits under the noise of the leader before it, best first.
    pub(super) fn singles(&self, nominal: &Fit) -> Result<(Fit, Vec<Fit>), Error> {
        let (model, observations) = (self.fitter.model, self.fitter.observations);
        let nominal = self.candidates.iter().find(|c| c.is_constants_alone()).map_or(nominal, |c| &c.fit);
        // constants that make up for a mechanism may be too far from its own for a way back
        let first = self.leading.as_ref().unwrap_or(nominal);
        // noise fitted to a residual has swallowed part of the effect: what is sought first is sought in calmer noise
        let calm = first.noise.calmed(model.channels(), observations)?;
        let mut leader = self.fitter.fit(&first.hypothesis, &calm, Some(first))?;
        let (mut round, mut before) = (0, vec![leader.clone()]);
        loop {
            let fits = self.round(round, &leader, &before)?;
            let best = self.fitter.fit_with_noise(&fits[0].hypothesis, &fits[0], 2)?;
            let gained = best.log_evidence - if round == 0 { nominal.log_evidence } else { leader.log_evidence };
            if takes_the_lead(round, gained) {
                leader = best;
            }
            round += 1;
            if gained < ONCE_MORE || round == ROUNDS {
                return Ok((leader, fits));
            }
            before = fits;
        }
    }

    /// Every mechanism, with every choice, and the constants re-estimated, under the leader's noise, from where they were `before`; best first.
    fn round(&self, round: usize, leader: &Fit, before: &[Fit]) -> Result<Vec<Fit>, Error> {
        let count = self.singles.len();
        let mut fits: Vec<Fit> = Vec::new();
        for (k, hypotheses) in self.singles.iter().enumerate() {
            (self.progress)(Step::counted(SINGLES, round * count + k, ROUNDS * count));
            for hypothesis in hypotheses {
                let found = before.iter().find(|fit| fit.hypothesis == *hypothesis).map_or(&[][..], |fit| &fit.active);
                fits.push(self.fitter.screened_from(hypothesis, leader, found)?);
            }
        }
        fits.push(self.fitter.fit(&Hypothesis::RECALIBRATED, &leader.noise, Some(leader))?);
        sort(&mut fits);
        Ok(fits)
    }

    /// Takes in every single mechanism of `fits` (best first); returns those that were given their own noise, best first.
    pub(super) fn likeliest(&mut self, fits: Vec<Fit>) -> Result<Vec<Fit>, Error> {
        let lead = fits[0].log_evidence;
        let mut leaders: Vec<Fit> = Vec::new();
        let mut met: Vec<usize> = Vec::new();
        let count = fits.len();
        for (k, fit) in fits.into_iter().enumerate().filter(|(_, f)| !f.hypothesis.mechanisms.is_empty()) {
            (self.progress)(Step::counted(LIKELIEST, k, count));
            let mechanism = fit.hypothesis.mechanisms[0].0;
            let again = met.contains(&mechanism);
            // of a mechanism's choices the best alone has its own noise; the others lie close behind it
            if !again && (met.len() < FOLLOWED || lead - fit.log_evidence < BEHIND) {
                let own = self.fitter.fit_with_noise(&fit.hypothesis, &fit, 2)?;
                leaders.push(own.clone());
                self.push(own, None);
            } else {
                // another choice of a mechanism that has its own noise is fitted in that
                let known = leaders.iter().find(|l| again && l.hypothesis.mechanisms[0].0 == mechanism);
                let own = known.map(|leader| self.fitter.screened(&fit.hypothesis, leader)).transpose()?;
                self.push(own.map_or(fit.clone(), |own| Fit::better(Some(fit), own)), None);
            }
            if !again {
                met.push(mechanism);
            }
        }
        sort(&mut leaders);
        Ok(leaders)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_of_the_first_round_leads_and_later_ones_where_they_are_clearly_likelier() {
        let gains = [-5.0, 0.0, 0.9 * LEADS, 1.1 * LEADS, 50.0];
        assert_eq!(gains.map(|gained| takes_the_lead(0, gained)), [true; 5]);
        assert_eq!(gains.map(|gained| takes_the_lead(1, gained)), [false, false, false, true, true]);
    }
}
