//! The unknowns of a fit, all on one scale: each is a standard normal variable u beforehand ([`crate::Prior`]); what they stand for.

use super::hypothesis::Hypothesis;
use crate::{ForwardModel, Nuisance, Parameter};

/// What an unknown is.
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
pub(crate) fn parameter<'m, M: ForwardModel>(model: &'m M, hypothesis: &Hypothesis, unknown: Unknown) -> Option<&'m Parameter> {
    match unknown {
        Unknown::Nuisance { number, .. } => Some(&model.nuisances()[number].parameter),
        Unknown::Mechanism { place, parameter } => {
            model.mechanisms().get(hypothesis.mechanisms[place].0)?.parameters.get(parameter)
        }
        Unknown::Offset { .. } => None,
    }
}
