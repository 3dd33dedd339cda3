//! One hypothesis fitted to the records, and its evidence.
//!
//! [`hypothesis`] says what is at work, [`unknowns`] what is to be found, [`objective`] what is made least, [`descent`] and [`kinks`] how,
//! [`laplace`] what it proves.

mod descent;
mod hypothesis;
mod kinks;
mod laplace;
mod objective;
mod unknowns;

pub use hypothesis::{Hypothesis, alternatives};
use objective::Objective;
pub(crate) use unknowns::{Layout, Unknown, expected, parameter};

use crate::model::Active;
use crate::noise::Noise;
use crate::{Error, ForwardModel, Observation};
use nalgebra::{DMatrix, DVector};

/// A hypothesis at its most probable parameters.
#[derive(Debug, Clone)]
pub struct Fit {
    /// What was fitted.
    pub hypothesis: Hypothesis,
    /// ln of the marginal likelihood (Laplace), up to a constant that all fits to the same records share.
    pub log_evidence: f64,
    /// The nominal model's uncertain numbers, all of them, in every record.
    pub nuisances: Vec<Vec<f64>>,
    /// Mechanisms at work.
    pub active: Vec<Active>,
    /// Offset of every channel of every record.
    pub offsets: Vec<Vec<f64>>,
    /// Residual `[record][channel][row]`, NaN where nothing was recorded.
    pub residuals: Vec<Vec<Vec<f64>>>,
    pub(crate) u: DVector<f64>,
    pub(crate) layout: Layout,
    pub(crate) covariance: DMatrix<f64>,
    pub(crate) noise: Noise,
    pub(crate) whitened: DVector<f64>,
    pub(crate) jacobian: DMatrix<f64>,
}

impl Fit {
    /// Noise of a channel of a record that was fitted.
    pub fn noise_model(&self, record: usize, channel: usize) -> &recording::noise::NoiseModel {
        self.noise.model(record, channel)
    }
}

/// What is fitted: a model to observations of some of its records.
pub(crate) struct Fitter<'a, M> {
    pub(crate) model: &'a M,
    pub(crate) observations: &'a [Observation],
    /// numbers of the model's records
    pub(crate) records: &'a [usize],
}

/// Starts that are followed to the end.
const STARTS: usize = 4;
/// Gain of ln evidence by another round of fitting the noise below which none follows.
const NOISE_SETTLED: f64 = 0.1;

impl<M: ForwardModel> Fitter<'_, M> {
    /// Fits a hypothesis under a known noise; `known` gives a place to start from.
    pub(crate) fn fit(&self, hypothesis: &Hypothesis, noise: &Noise, known: Option<&Fit>) -> Result<Fit, Error<M::Error>> {
        let objective = Objective::new(self, hypothesis, noise);
        let mut tried = objective.starts(known).into_iter().map(|u| objective.point(u)).collect::<Result<Vec<_>, _>>()?;
        // the likeliest starts are followed
        tried.sort_by(|a, b| a.value.total_cmp(&b.value));
        tried.truncate(STARTS);
        let mut best: Option<Fit> = None;
        for start in tried {
            let fit = objective.concluded(objective.descend(start)?)?;
            if best.as_ref().is_none_or(|b| fit.log_evidence > b.log_evidence) {
                best = Some(fit);
            }
        }
        best.ok_or(Error::NoStart)
    }

    /// Fits a hypothesis and its noise in turn, `rounds` times.
    pub(crate) fn fit_with_noise(&self, hypothesis: &Hypothesis, known: &Fit, rounds: usize) -> Result<Fit, Error<M::Error>> {
        let mut best = self.fit(hypothesis, &known.noise, Some(known))?;
        for _ in 0..rounds {
            let noise = best.noise.refitted(self.model.channels(), self.observations, &best.residuals)?;
            let fit = self.fit(hypothesis, &noise, Some(&best))?;
            let gained = fit.log_evidence - best.log_evidence;
            if gained > 0.0 {
                best = fit;
            }
            if gained < NOISE_SETTLED {
                break;
            }
        }
        self.searched(best)
    }
}
