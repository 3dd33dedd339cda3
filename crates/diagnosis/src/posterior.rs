//! What a fit knows of its unknowns: normal in the coordinate in which each one's prior is standard normal.

use crate::fit::{Fit, Unknown};
use crate::{ForwardModel, Parameter, Prior, Role};

/// 95th percentile of the standard normal distribution.
const Z95: f64 = 1.644_853_626_951_472_2;

/// What an unknown of a fit stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// An uncertain number of the nominal model.
    Nominal(Role),
    /// A parameter of the mechanism at this place in the hypothesis.
    Mechanism(usize),
}

/// An unknown as a fit leaves it.
#[derive(Debug, Clone, PartialEq)]
pub struct Posterior {
    /// Name with unit.
    pub name: String,
    /// What it belongs to.
    pub place: Place,
    /// The record it belongs to, if every record has its own.
    pub record: Option<usize>,
    /// What was known beforehand.
    pub prior: Prior,
    /// Most probable u.
    pub u: f64,
    /// Standard deviation of u.
    pub sd: f64,
}

impl Posterior {
    /// Most probable value.
    pub fn value(&self) -> f64 {
        self.prior.value(self.u)
    }

    /// Ends of the interval that holds it with probability 0.9.
    pub fn ci90(&self) -> [f64; 2] {
        [-Z95, Z95].map(|z| self.prior.value(self.u + z * self.sd))
    }
}

impl Fit {
    /// Every unknown but the channels' offsets.
    pub fn posteriors<M: ForwardModel>(&self, model: &M) -> Vec<Posterior> {
        let of = |(i, unknown): (usize, &Unknown)| {
            let (parameter, place, record): (&Parameter, Place, Option<usize>) = match *unknown {
                Unknown::Nuisance { number, record } => {
                    let nuisance = &model.nuisances()[number];
                    (&nuisance.parameter, Place::Nominal(nuisance.role), record)
                }
                Unknown::Mechanism { place, parameter } => {
                    let mechanism = &model.mechanisms()[self.hypothesis.mechanisms[place].0];
                    (&mechanism.parameters[parameter], Place::Mechanism(place), None)
                }
                Unknown::Offset { .. } => return None,
            };
            let sd = self.covariance[(i, i)].max(0.0).sqrt();
            Some(Posterior { name: parameter.name.clone(), place, record, prior: parameter.prior, u: self.u[i], sd })
        };
        self.layout.iter().enumerate().filter_map(of).collect()
    }
}
