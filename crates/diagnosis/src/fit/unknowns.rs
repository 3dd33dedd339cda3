//! The unknowns of a fit and their meaning; all are on one scale, each a standard normal variable u beforehand ([`crate::Prior`]).

use super::hypothesis::Hypothesis;
use crate::{ForwardModel, Nuisance, Parameter};

/// Kind of an unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unknown {
    /// `record` where every record has its own
    Nuisance {
        number: usize,
        record: Option<usize>,
    },
    Mechanism {
        place: usize,
        parameter: usize,
    },
    Offset {
        record: usize,
        channel: usize,
    },
}

impl Unknown {
    pub(super) fn is_mechanism(self) -> bool {
        matches!(self, Unknown::Mechanism { .. })
    }
}

pub(crate) type Layout = Vec<Unknown>;

/// Values of the nuisances at the middles of their priors: the nominal model as it is designed.
pub fn expected(nuisances: &[Nuisance]) -> Vec<f64> {
    nuisances.iter().map(|n| n.parameter.prior.value(0.0)).collect()
}

/// The parameter that an unknown stands for; none for an offset, or for a mechanism that the model does not have.
pub(crate) fn parameter<'m>(model: &'m dyn ForwardModel, hypothesis: &Hypothesis, unknown: Unknown) -> Option<&'m Parameter> {
    match unknown {
        Unknown::Nuisance { number, .. } => Some(&model.nuisances()[number].parameter),
        Unknown::Mechanism { place, parameter } => {
            model.mechanisms().get(hypothesis.mechanisms[place].0)?.parameters.get(parameter)
        }
        Unknown::Offset { .. } => None,
    }
}
