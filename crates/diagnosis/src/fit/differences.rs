//! Derivatives of the prediction by differences, some of them taken over from another fit.

use super::derivatives::Derivatives;
use super::objective::{Objective, Point, Series};
use super::unknowns::Unknown;
use crate::{Error, Observation};
use nalgebra::{DMatrix, DVector};

impl Objective<'_> {
    /// Derivatives at a point; those by unknowns that mechanisms leave as they are come from a fit beside this one, if there is one
    /// ([`Self::with_derivatives_of`]).
    pub(super) fn derivatives(&self, at: &Point) -> Result<Derivatives, Error> {
        let Some(like) = self.like else {
            let all = (0..self.layout.len()).map(|i| self.column(at, i)).collect::<Result<Vec<_>, _>>()?;
            return Ok(Derivatives::new(&all));
        };
        let known: Vec<Option<usize>> =
            self.layout.iter().map(|unknown| like.layout.iter().position(|own| own == unknown && !self.is_own(*own))).collect();
        let of = &like.derivatives;
        let zeros = DMatrix::zeros(of.jacobian.nrows(), known.len());
        let mut derivatives = Derivatives { jacobian: zeros, products: DMatrix::zeros(known.len(), known.len()) };
        for (i, from) in known.iter().enumerate().filter_map(|(i, from)| Some((i, (*from)?))) {
            derivatives.jacobian.column_mut(i).copy_from(&of.jacobian.column(from));
            for (j, other) in known.iter().enumerate().filter_map(|(j, other)| Some((j, (*other)?))) {
                derivatives.products[(i, j)] = of.products[(from, other)];
            }
        }
        let new: Vec<usize> = (0..known.len()).filter(|i| known[*i].is_none()).collect();
        self.renewed(at, &new, &mut derivatives)?;
        Ok(derivatives)
    }

    /// Whether an unknown has derivatives that another hypothesis does not share: a parameter of a mechanism, or a nuisance that acts on what a mechanism
    /// adds.
    fn is_own(&self, unknown: Unknown) -> bool {
        let acts = |number: usize| !self.hypothesis.mechanisms.is_empty() && self.fitter.model.acts_on_mechanisms(number);
        unknown.is_mechanism() || matches!(unknown, Unknown::Nuisance { number, .. } if acts(number))
    }

    /// Derivatives by unknowns of its own anew at a point ([`Self::is_own`]): those by all else hardly change on the way.
    pub(super) fn renew(&self, at: &Point, derivatives: &mut Derivatives) -> Result<(), Error> {
        let own: Vec<usize> = (0..self.layout.len()).filter(|i| self.is_own(self.layout[*i])).collect();
        self.renewed(at, &own, derivatives)
    }

    fn renewed(&self, at: &Point, places: &[usize], derivatives: &mut Derivatives) -> Result<(), Error> {
        let columns = places.iter().map(|i| self.column(at, *i)).collect::<Result<Vec<_>, _>>()?;
        derivatives.put(places, &columns);
        Ok(())
    }

    fn column(&self, at: &Point, i: usize) -> Result<DVector<f64>, Error> {
        let unknown = self.layout[i];
        let series = match unknown {
            Unknown::Offset { record, channel } => self.constant(record, channel),
            _ => self.derivative(at, i, self.parameter(unknown).map_or(1.0, |p| p.step))?,
        };
        Ok(self.whiten(&series))
    }

    /// Derivative by unknown `i`, by a difference away from the end of the range that is considered.
    fn derivative(&self, at: &Point, i: usize, step: f64) -> Result<Series, Error> {
        let mut beside = at.u.clone();
        let step = if at.u[i] > 0.0 { -step } else { step };
        beside[i] += step;
        let mut there = self.responses(&beside)?;
        for (there, here) in there.iter_mut().flatten().flatten().zip(at.responses.iter().flatten().flatten()) {
            *there = (*there - here) / step;
        }
        Ok(there)
    }

    /// An offset of one standard deviation in one channel of one record.
    fn constant(&self, record: usize, channel: usize) -> Series {
        let offset = self.fitter.offset(record, channel).sd;
        let of = |at: (usize, usize), rows: usize| vec![if at == (record, channel) { offset } else { 0.0 }; rows];
        let channels = |(r, o): (usize, &Observation)| (0..o.channels.len()).map(|c| of((r, c), o.time.len())).collect();
        self.fitter.observations.iter().enumerate().map(channels).collect()
    }
}
