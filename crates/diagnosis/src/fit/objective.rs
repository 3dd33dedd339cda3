//! What a fit makes least: −ln p(data, u) = ½ ‖r(u)‖² + ½ uᵀPu, up to a constant, with the whitened residual r of all records and channels
//! and the precision P of what is known beforehand.

use super::beforehand::Beforehand;
use super::fitter::{Fit, Fitter, Hypothesis};
use super::unknowns::{Layout, Unknown};
use crate::noise::Noise;
use crate::{Error, ForwardModel, Observation};
use nalgebra::{DMatrix, DVector};

/// Series `[record][channel][row]`.
pub(super) type Series = Vec<Vec<Vec<f64>>>;

pub(super) struct Objective<'a, M> {
    pub(super) fitter: &'a Fitter<'a, M>,
    pub(super) hypothesis: &'a Hypothesis,
    pub(super) noise: &'a Noise,
    pub(super) layout: Layout,
    pub(super) beforehand: Beforehand,
    /// A fit under the same noise, whose derivatives by what is no mechanism's are taken over.
    like: Option<&'a Fit>,
}

/// Unknowns, and what follows from them.
pub(super) struct Point {
    pub(super) u: DVector<f64>,
    pub(super) responses: Series,
    pub(super) whitened: DVector<f64>,
    pub(super) value: f64,
}

impl<'a, M: ForwardModel> Objective<'a, M> {
    /// # Errors
    /// [`Error::NotFinite`] if what the model knows of its nuisances beforehand is no density.
    pub(super) fn new(fitter: &'a Fitter<'a, M>, hypothesis: &'a Hypothesis, noise: &'a Noise) -> Result<Self, Error<M::Error>> {
        let layout = fitter.layout(hypothesis);
        let beforehand = fitter.beforehand(&layout).ok_or(Error::NotFinite)?;
        Ok(Self { fitter, hypothesis, noise, layout, beforehand, like: None })
    }

    /// The same with the derivatives of a fit under the same noise.
    pub(super) fn with_derivatives_of(self, like: &'a Fit) -> Self {
        Self { like: Some(like), ..self }
    }

    /// Whether derivatives by nuisances are its own.
    pub(super) fn is_exact(&self) -> bool {
        self.like.is_none()
    }

    pub(super) fn point(&self, u: DVector<f64>) -> Result<Point, Error<M::Error>> {
        let responses = self.responses(&u)?;
        let whitened = self.whiten(&self.residuals(&u, &responses));
        let value = whitened.norm_squared() / 2.0 + self.beforehand.energy(&u);
        Ok(Point { u, responses, whitened, value })
    }

    fn responses(&self, u: &DVector<f64>) -> Result<Series, Error<M::Error>> {
        let (nuisances, active) = self.at(u);
        let of = |(record, n): (&usize, &Vec<f64>)| self.fitter.model.respond(*record, n, &active).map_err(Error::Model);
        self.fitter.records.iter().zip(&nuisances).map(of).collect()
    }

    /// Series of all records and channels, whitened, one behind another.
    fn whiten(&self, series: &Series) -> DVector<f64> {
        let mut all = Vec::new();
        for (record, channels) in series.iter().enumerate() {
            for (channel, series) in channels.iter().enumerate() {
                all.extend(self.noise.whiten(record, channel, series));
            }
        }
        DVector::from_vec(all)
    }

    /// What was observed less responses and offsets.
    pub(super) fn residuals(&self, u: &DVector<f64>, responses: &Series) -> Series {
        let difference = |(r, y): (&Vec<f64>, &Vec<f64>)| y.iter().zip(r).map(|(y, r)| y - r).collect();
        let of = |(response, o): (&Vec<Vec<f64>>, &Observation)| response.iter().zip(&o.channels).map(difference).collect();
        let mut residuals: Series = responses.iter().zip(self.fitter.observations).map(of).collect();
        for (record, channels) in self.offsets(u).iter().enumerate() {
            for (channel, offset) in channels.iter().enumerate() {
                residuals[record][channel].iter_mut().for_each(|r| *r -= offset);
            }
        }
        residuals
    }

    pub(super) fn offsets(&self, u: &DVector<f64>) -> Vec<Vec<f64>> {
        let channels = self.fitter.model.channels();
        let mut offsets = vec![vec![0.0; channels.len()]; self.fitter.observations.len()];
        for (unknown, u) in self.layout.iter().zip(u.iter()) {
            if let Unknown::Offset { record, channel } = *unknown {
                let offset = self.fitter.offset(record, channel);
                offsets[record][channel] = offset.mean + offset.sd * u;
            }
        }
        offsets
    }

    /// Whitened derivatives of the prediction by every unknown; by those that are no mechanism's, which hardly change on the way, from `known`.
    pub(super) fn jacobian(&self, at: &Point, known: Option<&DMatrix<f64>>) -> Result<DMatrix<f64>, Error<M::Error>> {
        let mut columns = Vec::with_capacity(self.layout.len());
        for (i, unknown) in self.layout.iter().enumerate() {
            if let (None, Some(column)) = (known, self.taken_over(*unknown)) {
                columns.push(column);
                continue;
            }
            columns.push(match (known, *unknown) {
                (Some(known), unknown) if !unknown.is_mechanism() => known.column(i).into_owned(),
                (_, Unknown::Offset { record, channel }) => self.whiten(&self.constant(record, channel)),
                (_, unknown) => self.whiten(&self.derivative(at, i, self.parameter(unknown).map_or(1.0, |p| p.step))?),
            });
        }
        Ok(DMatrix::from_columns(&columns))
    }

    fn taken_over(&self, unknown: Unknown) -> Option<DVector<f64>> {
        let like = self.like.filter(|_| !unknown.is_mechanism())?;
        let at = like.layout.iter().position(|other| *other == unknown)?;
        Some(like.jacobian.column(at).into_owned())
    }

    /// Derivative by unknown `i`, by a difference away from the end of the range that is looked at.
    fn derivative(&self, at: &Point, i: usize, step: f64) -> Result<Series, Error<M::Error>> {
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
