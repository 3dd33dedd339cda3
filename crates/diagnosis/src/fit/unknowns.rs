//! The unknowns of a fit, all on one scale: each is a standard normal variable u beforehand ([`crate::Prior`]); what they stand for, and where they start.

use super::fitter::{Fit, Hypothesis, Offset};
use super::objective::Objective;
use crate::{Active, ForwardModel, Nuisance, Parameter, Prior};
use nalgebra::DVector;

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

/// The parameter that an unknown stands for; none for an offset.
pub(crate) fn parameter<'m, M: ForwardModel>(model: &'m M, hypothesis: &Hypothesis, unknown: Unknown) -> Option<&'m Parameter> {
    match unknown {
        Unknown::Nuisance { number, .. } => Some(&model.nuisances()[number].parameter),
        Unknown::Mechanism { place, parameter } => {
            Some(&model.mechanisms()[hypothesis.mechanisms[place].0].parameters[parameter])
        }
        Unknown::Offset { .. } => None,
    }
}

/// An unknown of a known fit [u] beyond which a fit starts from the middles of the priors, too.
const STRAYED: f64 = 3.0;

impl<M: ForwardModel> Objective<'_, M> {
    pub(super) fn parameter(&self, unknown: Unknown) -> Option<&Parameter> {
        parameter(self.fitter.model, self.hypothesis, unknown)
    }

    fn prior(&self, unknown: Unknown) -> Prior {
        match unknown {
            Unknown::Offset { record, channel } => {
                let Offset { mean, sd } = self.fitter.offset(record, channel);
                Prior::Normal { mean, sd }
            }
            _ => self.parameter(unknown).map_or(Prior::Normal { mean: 0.0, sd: 1.0 }, |p| p.prior),
        }
    }

    /// Nuisances of every record and mechanisms at the unknowns.
    pub(super) fn at(&self, u: &DVector<f64>) -> (Vec<Vec<f64>>, Vec<Active>) {
        let model = self.fitter.model;
        let mut nuisances = vec![expected(model.nuisances()); self.fitter.observations.len()];
        let still = |&(mechanism, choice): &(usize, Option<f64>)| {
            let values = vec![0.0; model.mechanisms()[mechanism].parameters.len()];
            Active { mechanism, values, choice }
        };
        let mut active: Vec<Active> = self.hypothesis.mechanisms.iter().map(still).collect();
        for (unknown, u) in self.layout.iter().zip(u.iter()) {
            let value = self.prior(*unknown).value(*u);
            match *unknown {
                Unknown::Nuisance { number, record } => {
                    let records = record.map_or(0..nuisances.len(), |r| r..r + 1);
                    nuisances[records].iter_mut().for_each(|n| n[number] = value);
                }
                Unknown::Mechanism { place, parameter } => active[place].values[parameter] = value,
                Unknown::Offset { .. } => {}
            }
        }
        (nuisances, active)
    }

    /// Unknowns of all combinations of the mechanisms' starts; `known` gives the others, and the mechanisms that it has fitted.
    pub(super) fn starts(&self, known: Option<&Fit>) -> Vec<DVector<f64>> {
        let mut base = DVector::zeros(self.layout.len());
        for (i, unknown) in self.layout.iter().enumerate().filter(|(_, u)| !u.is_mechanism()) {
            let of = |fit: &Fit| fit.layout.iter().position(|other| other == unknown).map(|at| fit.u[at]);
            base[i] = known.and_then(of).unwrap_or(0.0);
        }
        // where the known fit has strayed far to make up for what it lacks, its unknowns are a poor start
        let strayed = base.amax() > STRAYED;
        let mut starts = vec![base];
        if strayed {
            starts.push(DVector::zeros(self.layout.len()));
        }
        for (place, &(mechanism, choice)) in self.hypothesis.mechanisms.iter().enumerate() {
            // a mechanism that is already fitted goes on from there
            let same = |a: &&Active| a.mechanism == mechanism && a.choice == choice;
            let fitted = known.and_then(|fit| fit.active.iter().find(same)).map(|a| vec![a.values.clone()]);
            let values = fitted.unwrap_or_else(|| {
                let mut values = self.fitter.model.mechanisms()[mechanism].starts.clone();
                // what stands for a constant goes on from where that was
                if let (Some(number), Some(known), Some(first)) = (self.fitter.model.stands_for(mechanism), known, values.first())
                {
                    let mut goes_on = first.clone();
                    goes_on[0] = known.nuisances[0][number];
                    values.push(goes_on);
                }
                values
            });
            starts = starts.iter().flat_map(|u| values.iter().map(|values| self.placed(u, place, values))).collect();
        }
        starts
    }

    /// Unknowns with the parameters of the mechanism at `place` put in.
    fn placed(&self, u: &DVector<f64>, place: usize, values: &[f64]) -> DVector<f64> {
        let mut u = u.clone();
        for (i, unknown) in self.layout.iter().enumerate() {
            match *unknown {
                Unknown::Mechanism { place: at, parameter } if at == place => {
                    u[i] = self.prior(*unknown).standard(values[parameter]);
                }
                _ => {}
            }
        }
        u
    }
}
