//! Every mechanism alone.

use progress::Step;

use super::{Pool, SINGLES, sort};
use crate::fit::{Fit, Hypothesis};
use crate::{Error, ForwardModel};

/// Rounds of fitting all of them, at most.
const ROUNDS: usize = 3;
/// Gain of ln evidence by which another fit takes the lead.
const LEADS: f64 = 0.5;
/// Gain of ln evidence of a round after which all are fitted once more, in the noise that the new leader leaves.
const ONCE_MORE: f64 = 3.0;

impl<M: ForwardModel> Pool<'_, M> {
    /// The leader with its own noise, and all fits under the noise of the leader before it, best first.
    pub(super) fn singles(&self, nominal: &Fit) -> Result<(Fit, Vec<Fit>), Error<M::Error>> {
        let (model, observations) = (self.fitter.model, self.fitter.observations);
        // noise fitted to the nominal residual has swallowed part of the effect: what is sought first is sought in calmer noise
        let mut leader = Fit { noise: nominal.noise.calmed(model.channels(), observations)?, ..nominal.clone() };
        let mut round = 0;
        loop {
            let fits = self.round(round, nominal, &leader)?;
            let best = self.fitter.fit_with_noise(&fits[0].hypothesis, &fits[0], 2)?;
            let gained = best.log_evidence - if round == 0 { nominal.log_evidence } else { leader.log_evidence };
            if round == 0 || gained > LEADS {
                leader = best;
            }
            round += 1;
            if gained < ONCE_MORE || round == ROUNDS {
                return Ok((leader, fits));
            }
        }
    }

    /// Every mechanism, with every choice, and the constants re-estimated, under the leader's noise; best first.
    fn round(&self, round: usize, nominal: &Fit, leader: &Fit) -> Result<Vec<Fit>, Error<M::Error>> {
        let known = if round > 0 { leader } else { nominal };
        let count = self.singles.len();
        let mut fits: Vec<Fit> = Vec::new();
        for (k, hypotheses) in self.singles.iter().enumerate() {
            (self.progress)(Step::counted(SINGLES, round * count + k, ROUNDS * count));
            for hypothesis in hypotheses {
                fits.push(self.fitter.fit(hypothesis, &leader.noise, Some(known))?);
            }
        }
        fits.push(self.fitter.fit(&Hypothesis::RECALIBRATED, &leader.noise, Some(leader))?);
        sort(&mut fits);
        Ok(fits)
    }
}
