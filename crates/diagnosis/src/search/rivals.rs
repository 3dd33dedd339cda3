//! Structures beside the most probable candidates.

use super::{LEADERS, Pool};
use crate::fit::{Fit, Fitter};
use crate::{Error, ForwardModel, Rival};

impl<M: ForwardModel> Pool<'_, M> {
    /// Adds every structure to the most probable candidates, under their own noise and under calmer noise, which has not swallowed it; of
    /// the two the likelier counts.
    pub(super) fn rivals(&mut self) -> Result<(), Error<M::Error>> {
        let mut order: Vec<usize> = (0..self.candidates.len()).collect();
        order.sort_by(|&a, &b| self.candidates[b].log_weight.total_cmp(&self.candidates[a].log_weight));
        order.truncate(LEADERS);
        let Fitter { model, records, observations } = self.fitter;
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
