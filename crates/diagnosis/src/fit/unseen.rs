//! A fit's knowledge of a record that it has not seen: a prediction, and the changes of it that the unknowns still allow.

use super::Fit;
use super::checked::{Response, responded};
use super::unknowns::{Unknown, expected, parameter};
use crate::{Active, Error, ForwardModel};
use nalgebra::DMatrix;

/// A prediction.
pub(crate) struct Unseen {
    pub(crate) response: Response,
    /// Effect of independent standard normal variables on it: `loadings[(moved, variable)]` of the series `moved`.
    pub(crate) moved: Vec<Response>,
    pub(crate) loadings: DMatrix<f64>,
}

/// Prediction of a record of so many rows by the model as it is designed; the numbers that every record has of its own are free.
///
/// # Errors
/// [`Error`] if the model fails.
pub(crate) fn designed(model: &dyn ForwardModel, (record, rows): (usize, usize)) -> Result<Unseen, Error> {
    let there = There { record, rows, nuisances: expected(model.nuisances()), active: Vec::new() };
    let response = there.respond(model)?;
    let own = own(model, &there, &response)?;
    let loadings = DMatrix::identity(own.len(), own.len());
    Ok(Unseen { response, moved: own, loadings })
}

/// Values of all numbers of a model in a record of so many rows.
#[derive(Clone)]
struct There {
    record: usize,
    rows: usize,
    nuisances: Vec<f64>,
    active: Vec<Active>,
}

impl There {
    fn respond(&self, model: &dyn ForwardModel) -> Result<Response, Error> {
        responded(model, self.record, self.rows, &self.nuisances, &self.active)
    }

    /// The derivative of the response, `response` here, along the change that `moves` the numbers by one unit in so many steps.
    fn derivative(
        &self,
        model: &dyn ForwardModel,
        response: &Response,
        step: f64,
        moves: impl FnOnce(&mut Self, f64),
    ) -> Result<Response, Error> {
        let mut beside = self.clone();
        moves(&mut beside, step);
        let mut there = beside.respond(model)?;
        for (there, here) in there.iter_mut().flatten().zip(response.iter().flatten()) {
            *there = (*there - here) / step;
        }
        Ok(there)
    }
}

/// Effect of one standard deviation of each number that every record has of its own.
fn own(model: &dyn ForwardModel, there: &There, response: &Response) -> Result<Vec<Response>, Error> {
    let local = model.nuisances().iter().enumerate().filter(|(_, nuisance)| nuisance.local);
    let moved = local.map(|(number, nuisance)| {
        let prior = nuisance.parameter.prior;
        there.derivative(model, response, nuisance.parameter.step, |there, u| there.nuisances[number] = prior.value(u))
    });
    moved.collect()
}

impl Fit {
    /// The prediction of a record of the model, of so many rows, with all unknowns that this fit leaves open.
    ///
    /// # Errors
    /// [`Error`] if the model fails.
    pub(crate) fn unseen(&self, model: &dyn ForwardModel, (record, rows): (usize, usize)) -> Result<Unseen, Error> {
        let middle = expected(model.nuisances());
        // what every record has of its own is not known here
        let shared = |(number, nuisance): (usize, &crate::Nuisance)| {
            if nuisance.local { middle[number] } else { self.nuisances[0][number] }
        };
        let nuisances = model.nuisances().iter().enumerate().map(shared).collect();
        let there = There { record, rows, nuisances, active: self.active.clone() };
        let response = there.respond(model)?;
        let free: Vec<usize> = (0..self.layout.len()).filter(|i| is_shared(self.layout[*i])).collect();
        let mut moved = Vec::new();
        for &i in &free {
            let Some(parameter) = parameter(model, &self.hypothesis, self.layout[i]) else { continue };
            // away from the end of the range that is looked at
            let step = if self.u[i] > 0.0 { -parameter.step } else { parameter.step };
            let at = |step: f64| parameter.prior.value(self.u[i] + step);
            moved.push(there.derivative(model, &response, step, |there, step| match self.layout[i] {
                Unknown::Nuisance { number, .. } => there.nuisances[number] = at(step),
                Unknown::Mechanism { place, parameter } => there.active[place].values[parameter] = at(step),
                Unknown::Offset { .. } => {}
            })?);
        }
        let own = own(model, &there, &response)?;
        let (known, all) = (moved.len(), moved.len() + own.len());
        let covariance = DMatrix::from_fn(known, known, |i, j| self.covariance[(free[i], free[j])]);
        let mut loadings = DMatrix::identity(all, all);
        // of what is no covariance nothing is known: the fitted values stand
        let factor = covariance.cholesky().map_or_else(|| DMatrix::zeros(known, known), |factor| factor.unpack());
        loadings.view_mut((0, 0), (known, known)).copy_from(&factor);
        moved.extend(own);
        Ok(Unseen { response, moved, loadings })
    }
}

/// Whether all records share an unknown.
fn is_shared(unknown: Unknown) -> bool {
    matches!(unknown, Unknown::Nuisance { record: None, .. } | Unknown::Mechanism { .. })
}
