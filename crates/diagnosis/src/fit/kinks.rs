//! A second look around a fit whose responses have kinks, which make local minima.

use super::derivatives::Derivatives;
use super::fitter::{Fit, Fitter};
use super::objective::{Objective, Point};
use crate::Error;
use nalgebra::{Cholesky, DVector};

/// Least gain of ln p that is worth a round.
const WORTH: f64 = 0.3;
/// Linear steps by which the others follow a nuisance that is set aside.
const FOLLOWED: usize = 2;

impl Fitter<'_> {
    /// A better minimum around a fit, under its noise, if there is one: each parameter that asks for it ([`crate::Parameter::around`]) is set aside by its
    /// distances; of nuisances beside a mechanism's that asks.
    pub(super) fn found_beside(&self, best: &Fit) -> Result<Option<Fit>, Error> {
        let objective = Objective::new(self, &best.hypothesis, &best.noise)?;
        let Some(found) = objective.beside(best)?.filter(|found| found.value <= best.value() - WORTH) else { return Ok(None) };
        let fit = objective.concluded(objective.descend(found)?)?;
        Ok(Some(fit).filter(|fit| fit.log_evidence > best.log_evidence))
    }
}

impl Objective<'_> {
    /// Whether a fit may end in several places: a mechanism has several parameters, or one that asks for a second look.
    pub(super) fn may_have_many_minima(&self) -> bool {
        let several = |(mechanism, _): &(usize, Option<f64>)| self.fitter.model.mechanisms()[*mechanism].parameters.len() > 1;
        self.kinked().any(|i| self.layout[i].is_mechanism()) || self.hypothesis.mechanisms.iter().any(several)
    }

    /// Unknowns that ask for a second look.
    fn kinked(&self) -> impl Iterator<Item = usize> {
        let asks = |i: &usize| self.parameter(self.layout[*i]).is_some_and(|p| !p.around.is_empty());
        (0..self.layout.len()).filter(asks)
    }

    /// The least of the points around a fit; `None` if no parameter asks for any.
    fn beside(&self, best: &Fit) -> Result<Option<Point>, Error> {
        let (searched, nuisances): (Vec<usize>, Vec<usize>) = self.kinked().partition(|i| self.layout[*i].is_mechanism());
        if searched.is_empty() {
            return Ok(None);
        }
        let mut found: Option<Point> = None;
        for i in nuisances {
            for point in self.along(best, i)? {
                if found.as_ref().is_none_or(|least| point.value < least.value) {
                    found = Some(point);
                }
            }
        }
        // one alone, or one of a mechanism's against another: the sum of two may be what the records know
        let moves = searched
            .iter()
            .flat_map(|i| std::iter::once((*i, None)).chain(searched.iter().filter(move |j| *j != i).map(|j| (*i, Some(*j)))));
        for (i, other) in moves {
            let distances = self.parameter(self.layout[i]).map_or(&[][..], |p| &p.around);
            for by in distances.iter().flat_map(|d| [-d, *d]) {
                let mut u = best.u.clone();
                self.shift(&mut u, i, by);
                other.iter().for_each(|j| self.shift(&mut u, *j, -by));
                if let Some(point) = self.followed(&mut best.derivatives.clone(), u, (i, other))?
                    && found.as_ref().is_none_or(|least| point.value < least.value)
                {
                    found = Some(point);
                }
            }
        }
        Ok(found)
    }

    /// Moves an unknown by a distance in its parameter's own unit.
    fn shift(&self, u: &mut DVector<f64>, i: usize, by: f64) {
        if let Some(parameter) = self.parameter(self.layout[i]) {
            u[i] = parameter.prior.standard(parameter.prior.value(u[i]) + by);
        }
    }

    /// Points along a valley: a nuisance is set aside by one distance after another, to either side, and the others follow step by step. Instants of a switch
    /// follow a delay, row by row, where one step from afar would lose them. On the side of what is expected the way goes on as far beyond that.
    fn along(&self, best: &Fit, i: usize) -> Result<Vec<Point>, Error> {
        let Some(parameter) = self.parameter(self.layout[i]) else { return Ok(Vec::new()) };
        let middle = parameter.prior.value(0.0) - parameter.prior.value(best.u[i]);
        let mut points = Vec::new();
        'sides: for sign in [-1.0, 1.0] {
            let (mut u, mut derivatives, mut gone) = (best.u.clone(), best.derivatives.clone(), 0.0);
            for distance in as_far(&parameter.around, sign * middle) {
                self.shift(&mut u, i, sign * (distance - gone));
                gone = distance;
                for _ in 0..FOLLOWED {
                    let Some(point) = self.followed(&mut derivatives, u.clone(), (i, None))? else { continue 'sides };
                    u.clone_from(&point.u);
                    points.push(point);
                }
            }
        }
        Ok(points)
    }

    /// The point to which the other unknowns follow by one linear step when those of `moved` are held; the derivatives of what has kinks are found anew.
    fn followed(
        &self,
        derivatives: &mut Derivatives,
        u: DVector<f64>,
        (i, other): (usize, Option<usize>),
    ) -> Result<Option<Point>, Error> {
        let held = || std::iter::once(i).chain(other);
        let at = self.point(u)?;
        self.renew(&at, derivatives)?;
        let gradient = self.gradient(&at, derivatives);
        let mut products = derivatives.products.clone();
        for k in held() {
            products.row_mut(k).fill(0.0);
            products.column_mut(k).fill(0.0);
        }
        let Some(factor) = Cholesky::new(self.beforehand.curvature(products)) else { return Ok(None) };
        let mut step = factor.solve(&gradient);
        held().for_each(|k| step[k] = 0.0);
        self.shorten(&mut step, |_| true);
        self.point(at.u + step).map(Some)
    }
}

/// The distances, which increase, and further ones that are as far apart as the last two until they reach as far beyond what is `ahead`.
fn as_far(distances: &[f64], ahead: f64) -> Vec<f64> {
    let mut all = distances.to_vec();
    if let [.., before, last] = *distances {
        let further = ((ahead.max(0.0)) / (last - before)).ceil() as usize;
        all.extend((1..=further).map(|n| last + n as f64 * (last - before)));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_go_on_to_what_is_ahead_and_as_far_beyond() {
        let around = [0.5, 1.0, 1.5];
        assert_eq!(as_far(&around, 1.2), [0.5, 1.0, 1.5, 2.0, 2.5, 3.0]);
        assert_eq!(as_far(&around, 1.0), [0.5, 1.0, 1.5, 2.0, 2.5]);
        // behind, or with no step to go on by
        assert_eq!(as_far(&around, -7.0), around);
        assert_eq!(as_far(&[2.0], 9.0), [2.0]);
        assert!(as_far(&[], 9.0).is_empty());
    }
}
