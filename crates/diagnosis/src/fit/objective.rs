//! Objective that a fit minimises: −ln p(data, u) = ½ ‖r(u)‖² + ½ uᵀPu, up to a constant, with the whitened residual r of all records and
//! channels and the precision P of the prior.

use super::beforehand::Beforehand;
use super::checked;
use super::fitter::{Fit, Fitter, Offset};
use super::hypothesis::Hypothesis;
use super::unknowns::{Layout, Unknown, expected, parameter};
use crate::noise::Noise;
use crate::{Active, Error, Observation, Parameter, Prior};
use nalgebra::DVector;

/// Series `[record][channel][row]`.
pub(super) type Series = Vec<Vec<Vec<f64>>>;

pub(super) struct Objective<'a> {
    pub(super) fitter: &'a Fitter<'a>,
    pub(super) hypothesis: &'a Hypothesis,
    pub(super) noise: &'a Noise,
    pub(super) layout: Layout,
    pub(super) beforehand: Beforehand,
    /// A fit under the same noise, whose derivatives by all but mechanisms' parameters are taken over.
    pub(super) like: Option<&'a Fit>,
}

/// Unknowns with the residuals and derivatives that follow from them.
pub(super) struct Point {
    pub(super) u: DVector<f64>,
    pub(super) responses: Series,
    pub(super) whitened: DVector<f64>,
    pub(super) value: f64,
}

impl<'a> Objective<'a> {
    /// # Errors
    /// [`Error::NotFinite`] if the model's prior of its nuisances is no density.
    pub(super) fn new(fitter: &'a Fitter<'a>, hypothesis: &'a Hypothesis, noise: &'a Noise) -> Result<Self, Error> {
        let layout = fitter.layout(hypothesis);
        let beforehand = fitter.beforehand(hypothesis, &layout).ok_or(Error::NotFinite)?;
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

    pub(super) fn parameter(&self, unknown: Unknown) -> Option<&Parameter> {
        parameter(self.fitter.model, self.hypothesis, unknown)
    }

    pub(super) fn prior(&self, unknown: Unknown) -> Prior {
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

    pub(super) fn point(&self, u: DVector<f64>) -> Result<Point, Error> {
        let responses = self.responses(&u)?;
        let whitened = self.whiten(&self.residuals(&u, &responses));
        let value = whitened.norm_squared() / 2.0 + self.beforehand.energy(&u);
        Ok(Point { u, responses, whitened, value })
    }

    pub(super) fn responses(&self, u: &DVector<f64>) -> Result<Series, Error> {
        let (nuisances, active) = self.at(u);
        let Fitter { model, records, observations, .. } = self.fitter;
        let of = |((record, observed), n): ((&usize, &Observation), &Vec<f64>)| {
            checked::responded(*model, *record, observed.time.len(), n, &active)
        };
        records.iter().zip(*observations).zip(&nuisances).map(of).collect()
    }

    /// Series of all records and channels, whitened, one behind another.
    pub(super) fn whiten(&self, series: &Series) -> DVector<f64> {
        let mut all = Vec::new();
        for (record, channels) in series.iter().enumerate() {
            for (channel, series) in channels.iter().enumerate() {
                // of nothing nothing is left, and many a mechanism does nothing to one of the channels
                if series.iter().all(|x| *x == 0.0) {
                    all.resize(all.len() + self.noise.rows(record, channel).len(), 0.0);
                } else {
                    all.extend(self.noise.whiten(record, channel, series));
                }
            }
        }
        DVector::from_vec(all)
    }

    /// Observations less responses and offsets.
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
}
