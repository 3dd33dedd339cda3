//! Posterior of a fit's unknowns: normal in the coordinate in which each one's prior is standard normal.

use crate::fit::{Fit, Unknown, parameter};
use crate::{ForwardModel, Prior, Role};
use nalgebra::DVector;
use recording::statistics::normal_quantile;

/// A parameter with its 90 % interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Name with unit.
    pub name: String,
    /// Most probable value.
    pub value: f64,
    /// Ends of the interval that holds it with probability 0.9.
    pub ci90: [f64; 2],
}

/// Meaning of an unknown of a fit.
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
    /// The number or mechanism that it belongs to.
    pub place: Place,
    /// The record it belongs to, if every record has its own.
    pub record: Option<usize>,
    /// Its prior.
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
        let half = normal_quantile(0.95) * self.sd;
        [-half, half].map(|by| self.prior.value(self.u + by))
    }
}

impl Fit {
    /// Standard deviation of an unknown's u: of a mechanism's parameter with that by which nuisances carry it along ([`ForwardModel::carries`]).
    pub(crate) fn deviation(&self, model: &dyn ForwardModel, i: usize) -> f64 {
        let mut way = DVector::zeros(self.layout.len());
        way[i] = 1.0;
        let slope = |j: usize| parameter(model, &self.hypothesis, self.layout[j]).map_or(0.0, |p| p.prior.slope(self.u[j]));
        if let Unknown::Mechanism { place, parameter } = self.layout[i]
            && slope(i) > 0.0
            && let Some(active) = self.active.get(place)
        {
            for (j, unknown) in self.layout.iter().enumerate() {
                let Unknown::Nuisance { number, record: None } = *unknown else { continue };
                let by = model.carries(number, active).get(parameter).copied().unwrap_or_default();
                way[j] = by * slope(j) / slope(i);
            }
        }
        way.dot(&(&self.covariance * &way)).max(0.0).sqrt()
    }

    /// Every unknown but the channels' offsets.
    pub fn posteriors(&self, model: &dyn ForwardModel) -> Vec<Posterior> {
        let of = |(i, unknown): (usize, &Unknown)| {
            let (place, record) = match *unknown {
                Unknown::Nuisance { number, record } => (Place::Nominal(model.nuisances()[number].role), record),
                Unknown::Mechanism { place, .. } => (Place::Mechanism(place), None),
                Unknown::Offset { .. } => return None,
            };
            let crate::Parameter { name, prior, .. } = parameter(model, &self.hypothesis, *unknown)?;
            let sd = self.deviation(model, i);
            Some(Posterior { name: name.clone(), place, record, prior: *prior, u: self.u[i], sd })
        };
        self.layout.iter().enumerate().filter_map(of).collect()
    }

    /// Parameters of the mechanism at `place` in the hypothesis, its choice before them.
    pub fn estimates(&self, model: &dyn ForwardModel, place: usize) -> Vec<Estimate> {
        let Some(active) = self.active.get(place) else { return Vec::new() };
        let choice = model.mechanisms()[active.mechanism].choice.as_ref().zip(active.choice);
        let choice = choice.map(|((name, _), value)| Estimate { name: name.clone(), value, ci90: [value, value] });
        let own = self.posteriors(model).into_iter().filter(|p| p.place == Place::Mechanism(place));
        choice.into_iter().chain(own.map(|p| Estimate { value: p.value(), ci90: p.ci90(), name: p.name })).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::{candidate, library};
    use crate::{Active, Nuisance, Parameter};
    use nalgebra::DMatrix;

    /// Of a parameter beyond all that is considered the value stays where it is, whatever a constant does.
    #[test]
    fn nothing_is_carried_along_where_the_value_does_not_change() {
        let mut model = library(&[true]);
        model.0[0].parameters = vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 1.0 })];
        model.1 = vec![Nuisance::normal("constant", 0.0, 1.0, Role::Constant)];
        let active = Active { mechanism: 0, values: vec![8.0], choice: None };
        assert!(model.carries(0, &active).is_empty());
        for u in [1.0, 8.0, 8.5] {
            let fit = Fit {
                active: vec![active.clone()],
                layout: vec![Unknown::Nuisance { number: 0, record: None }, Unknown::Mechanism { place: 0, parameter: 0 }],
                u: DVector::from_vec(vec![0.5, u]),
                covariance: DMatrix::from_row_slice(2, 2, &[4.0, 0.1, 0.1, 0.09]),
                ..candidate(&[0], 1.0).fit
            };
            assert!((fit.deviation(&model, 1) - 0.3).abs() < 1e-12, "{}", fit.deviation(&model, 1));
        }
    }
}
