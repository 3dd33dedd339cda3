//! What is fitted, and what a fit finds.

use super::unknowns::{Layout, Unknown};
use crate::noise::Noise;
use crate::{Active, ForwardModel, Observation, Role};
use nalgebra::{DMatrix, DVector};

/// Which mechanisms are at work, and whether the nominal constants are re-estimated.
#[derive(Debug, Clone, PartialEq)]
pub struct Hypothesis {
    /// Numbers in the library, each with the value of its choice, if it has one.
    pub mechanisms: Vec<(usize, Option<f64>)>,
    /// Whether the design's own constants are free.
    pub constants_free: bool,
}

impl Hypothesis {
    /// Nothing is left out.
    pub const NOMINAL: Self = Self { mechanisms: Vec::new(), constants_free: false };

    /// Nothing is left out, but the design's own constants are re-estimated.
    pub const RECALIBRATED: Self = Self { mechanisms: Vec::new(), constants_free: true };

    /// Whether a mechanism is at work, whatever its choice.
    pub(crate) fn has(&self, mechanism: usize) -> bool {
        self.mechanisms.iter().any(|(number, _)| *number == mechanism)
    }
}

/// The hypotheses of one mechanism alone, one for each of its choices.
pub fn alternatives<M: ForwardModel>(model: &M, mechanism: usize) -> Vec<Hypothesis> {
    let of = |choice| Hypothesis { mechanisms: vec![(mechanism, choice)], constants_free: false };
    match &model.mechanisms()[mechanism].choice {
        None => vec![of(None)],
        Some((_, values)) => values.iter().map(|v| of(Some(*v))).collect(),
    }
}

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

    /// The likelier of two; of equals the first.
    pub(crate) fn better(first: Option<Self>, second: Self) -> Self {
        first.filter(|first| second.log_evidence <= first.log_evidence).unwrap_or(second)
    }
}

/// What is fitted: a model to observations of some of its records.
pub(crate) struct Fitter<'a, M> {
    pub(crate) model: &'a M,
    pub(crate) observations: &'a [Observation],
    /// numbers of the model's records
    pub(crate) records: &'a [usize],
}

impl<M: ForwardModel> Fitter<'_, M> {
    /// The unknowns of a hypothesis: nuisances that are free, mechanisms' parameters, offsets.
    pub(super) fn layout(&self, hypothesis: &Hypothesis) -> Layout {
        let free = |role: Role| role == Role::ModelError || hypothesis.constants_free;
        let mut layout = Layout::new();
        for (number, nuisance) in self.model.nuisances().iter().enumerate().filter(|(_, n)| free(n.role)) {
            if nuisance.local {
                layout.extend((0..self.observations.len()).map(|r| Unknown::Nuisance { number, record: Some(r) }));
            } else {
                layout.push(Unknown::Nuisance { number, record: None });
            }
        }
        for (place, (mechanism, _)) in hypothesis.mechanisms.iter().enumerate() {
            let count = self.model.mechanisms()[*mechanism].parameters.len();
            layout.extend((0..count).map(|parameter| Unknown::Mechanism { place, parameter }));
        }
        for record in 0..self.observations.len() {
            layout.extend((0..self.model.channels().len()).map(|channel| Unknown::Offset { record, channel }));
        }
        layout
    }
}
