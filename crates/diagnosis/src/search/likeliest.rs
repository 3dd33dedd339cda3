//! The likeliest single mechanisms, each with the noise that it leaves.

use progress::Step;

use super::{BEHIND, FOLLOWED, LIKELIEST, Pool, better, sort};
use crate::fit::{Fit, Hypothesis};
use crate::{Error, ForwardModel};

impl<M: ForwardModel> Pool<'_, M> {
    /// Takes in every single mechanism of `fits` (best first); those that were given their own noise, best first.
    pub(super) fn likeliest(&mut self, fits: Vec<Fit>) -> Result<Vec<Fit>, Error<M::Error>> {
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
                if met.len() < FOLLOWED {
                    let free = Hypothesis { constants_free: true, ..own.hypothesis.clone() };
                    let free = self.fitter.fit_with_noise(&free, &own, 1)?;
                    self.push(free, None);
                }
                leaders.push(own.clone());
                self.push(own, None);
            } else {
                // another choice of a mechanism that has its own noise is fitted in that
                let known = leaders.iter().find(|l| again && l.hypothesis.mechanisms[0].0 == mechanism);
                let own = known.map(|leader| self.fitter.fit(&fit.hypothesis, &leader.noise, Some(&fit))).transpose()?;
                self.push(own.map_or(fit.clone(), |own| better(fit, own)), None);
            }
            if !again {
                met.push(mechanism);
            }
        }
        sort(&mut leaders);
        Ok(leaders)
    }
}
