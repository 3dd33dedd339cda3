//! Noise of every channel of every record, fitted to a residual under its prior.

use crate::model::NoisePrior;
use crate::{Channel, Observation};
use recording::minimise::{Effort, nelder_mead};
use recording::noise::{NoiseModel, Whitener};
use std::sync::Arc;

/// Span over which noise is stated, whatever the rows are \[s\].
pub(crate) const MINUTE: f64 = 60.0;

/// White noise of rows of one length, converted to rows of another \[s\]: the noise of means falls with their length.
fn white_in(model: &NoiseModel, interval: f64, other: f64) -> f64 {
    if model.averaging > 0.0 { model.white * (interval / other).sqrt() } else { model.white }
}

/// The noise models of some records with their whiteners: `[record][channel]`.
#[derive(Debug, Clone)]
pub(crate) struct Noise {
    models: Vec<Vec<NoiseModel>>,
    whiteners: Arc<Vec<Vec<Whitener>>>,
    /// interval of each record's rows \[s\]
    intervals: Vec<f64>,
    /// ln p of the noise's own parameters under their priors
    pub(crate) log_prior: f64,
}

/// Logarithms of white, drift, drift time, walk and passed in units of their priors.
type Standard = [f64; TERMS];
const TERMS: usize = 5;

fn terms(prior: &NoisePrior) -> [(f64, f64); TERMS] {
    [prior.white, prior.drift, prior.drift_time, prior.walk, prior.passed]
}

fn model(prior: &NoisePrior, averaging: f64, x: &Standard) -> NoiseModel {
    let of = |i: usize, (median, spread): (f64, f64)| median * (spread * x[i].clamp(-12.0, 12.0)).exp();
    let [white, drift, drift_time, walk, passed] = std::array::from_fn(|i| of(i, terms(prior)[i]));
    NoiseModel { averaging, white, drift, drift_time, walk, quantisation: 0.0, passed, passed_time: prior.passed_time }
}

fn standard(prior: &NoisePrior, model: &NoiseModel) -> Standard {
    let values = [model.white, model.drift, model.drift_time, model.walk, model.passed];
    // what is absent has its place in no prior
    let of = |value: f64, (median, spread): (f64, f64)| if median > 0.0 { (value / median).ln() / spread } else { 0.0 };
    std::array::from_fn(|i| of(values[i], terms(prior)[i]))
}

fn log_prior(x: &Standard) -> f64 {
    -x.iter().map(|x| x * x).sum::<f64>() / 2.0
}

/// Effort of a fit of the noise: enough to bring ln p within some hundredths of its maximum.
const EFFORT: Effort = Effort { tolerance: 1e-2, evaluations: 120 };
/// Edge of the first simplex, in standard deviations of the priors, towards their middles.
const EDGE: f64 = 0.4;

/// The parameters near `start` at which `cost` is least.
fn least(cost: impl Fn(&Standard) -> f64, start: Standard) -> Standard {
    let standard = |x: &[f64]| -> Standard { std::array::from_fn(|i| x[i]) };
    let edges = start.map(|x| if x > 0.0 { -EDGE } else { EDGE });
    let anywhere = [[f64::NEG_INFINITY, f64::INFINITY]; TERMS];
    standard(&nelder_mead(|x| cost(&standard(x)), &start, &edges, &anywhere, EFFORT).0)
}

/// Interval of a record's rows \[s\]; 1 for a record without rows.
fn interval(observed: &Observation) -> f64 {
    recording::median_interval(&observed.time).unwrap_or(1.0)
}

fn mask(series: &[f64]) -> Vec<bool> {
    series.iter().map(|v| !v.is_nan()).collect()
}

/// ln p of the whitened values under a model, without the constant of the normal density.
fn log_likelihood(whitener: &Whitener, series: &[f64]) -> f64 {
    -(whitener.apply(series).iter().map(|w| w * w).sum::<f64>() + whitener.log_det()) / 2.0
}

impl Noise {
    /// Noise at the medians of its priors.
    pub(crate) fn typical(channels: &[Channel], observations: &[Observation]) -> Result<Self, recording::Error> {
        let models = observations.iter().map(|_| channels.iter().map(|c| model(&c.noise, c.averaging, &[0.0; TERMS])).collect());
        Self::with(models.collect(), 0.0, observations)
    }

    fn with(models: Vec<Vec<NoiseModel>>, log_prior: f64, observations: &[Observation]) -> Result<Self, recording::Error> {
        let of = |(models, o): (&Vec<NoiseModel>, &Observation)| {
            models.iter().zip(&o.channels).map(|(m, series)| Whitener::new(m, &o.time, &mask(series))).collect()
        };
        let whiteners = models.iter().zip(observations).map(of).collect::<Result<Vec<_>, _>>()?;
        let intervals = observations.iter().map(interval).collect();
        Ok(Self { models, whiteners: Arc::new(whiteners), intervals, log_prior })
    }

    /// Noise of another record by all of these: means of the variances; the white noise of means falls with the length of rows.
    pub(crate) fn pooled(&self, observed: &Observation) -> Result<Self, recording::Error> {
        let rows = interval(observed);
        let channels = 0..self.models.first().map_or(0, Vec::len);
        let model = |c: usize| {
            let of = |size: &dyn Fn(&NoiseModel, f64) -> f64| {
                let each = self.models.iter().zip(&self.intervals).map(|(models, interval)| size(&models[c], *interval).powi(2));
                (each.sum::<f64>() / self.models.len() as f64).sqrt()
            };
            NoiseModel {
                white: of(&|m, interval| white_in(m, interval, rows)),
                drift: of(&|m, _| m.drift),
                drift_time: of(&|m, _| m.drift_time),
                walk: of(&|m, _| m.walk),
                passed: of(&|m, _| m.passed),
                ..self.models[0][c]
            }
        };
        Self::with(vec![channels.map(model).collect()], 0.0, std::slice::from_ref(observed))
    }

    /// The same with no more drift and walk than expected beforehand: an unexplained effect does not swell the noise.
    pub(crate) fn calmed(&self, channels: &[Channel], observations: &[Observation]) -> Result<Self, recording::Error> {
        let calm = |(m, c): (&NoiseModel, &Channel)| NoiseModel {
            drift: m.drift.min(c.noise.drift.0),
            walk: m.walk.min(c.noise.walk.0),
            ..*m
        };
        let models: Vec<Vec<NoiseModel>> =
            self.models.iter().map(|models| models.iter().zip(channels).map(calm).collect()).collect();
        // of what is recorded, as in a refit
        let recorded = |record: usize, c: usize| observations[record].channels[c].iter().any(|v| !v.is_nan());
        let of = |(record, models): (usize, &Vec<NoiseModel>)| -> f64 {
            let of = |(c, m): (usize, &NoiseModel)| {
                if recorded(record, c) { log_prior(&standard(&channels[c].noise, m)) } else { 0.0 }
            };
            models.iter().enumerate().map(of).sum()
        };
        let sum = models.iter().enumerate().map(of).sum();
        Self::with(models, sum, observations)
    }

    /// The noise of one of the records, for another observation.
    pub(crate) fn of_record(other: &Self, record: usize, observed: &Observation) -> Result<Self, recording::Error> {
        Self::with(vec![other.models[record].clone()], 0.0, std::slice::from_ref(observed))
    }

    /// Fits every channel's noise to its residuals `[record][channel][row]`, starting from this.
    pub(crate) fn refitted(
        &self,
        channels: &[Channel],
        observations: &[Observation],
        residuals: &[Vec<Vec<f64>>],
    ) -> Result<Self, recording::Error> {
        let mut models = self.models.clone();
        let mut sum = 0.0;
        for (record, observation) in observations.iter().enumerate() {
            for (c, channel) in channels.iter().enumerate() {
                let (residual, used) = (&residuals[record][c], mask(&observation.channels[c]));
                if !used.iter().any(|u| *u) {
                    continue;
                }
                let objective = |x: &Standard| {
                    let whitener = Whitener::new(&model(&channel.noise, channel.averaging, x), &observation.time, &used);
                    whitener.map_or(f64::INFINITY, |w| -log_likelihood(&w, residual) - log_prior(x))
                };
                let best = least(objective, standard(&channel.noise, &models[record][c]));
                models[record][c] = model(&channel.noise, channel.averaging, &best);
                sum += log_prior(&best);
            }
        }
        Self::with(models, sum, observations)
    }

    pub(crate) fn model(&self, record: usize, channel: usize) -> &NoiseModel {
        &self.models[record][channel]
    }

    /// White noise of a channel of a record over a minute, whatever its rows.
    pub(crate) fn white_of_a_minute(&self, record: usize, channel: usize) -> f64 {
        white_in(&self.models[record][channel], self.intervals[record], MINUTE)
    }

    /// Whitened series of a channel of a record, of the rows that are used.
    pub(crate) fn whiten(&self, record: usize, channel: usize, series: &[f64]) -> Vec<f64> {
        self.whiteners[record][channel].apply(series)
    }

    pub(crate) fn rows(&self, record: usize, channel: usize) -> &[usize] {
        self.whiteners[record][channel].rows()
    }

    /// ½ ln det of the covariance of all.
    pub(crate) fn half_log_det(&self) -> f64 {
        self.whiteners.iter().flatten().map(Whitener::log_det).sum::<f64>() / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_of_other_rows_say_the_same_of_a_record_in_any_order() {
        let of =
            |every: f64| Observation { time: (0..50).map(|n| every * f64::from(n)).collect(), channels: vec![vec![0.0; 50]] };
        let model =
            |every: f64, white: f64| vec![NoiseModel { drift: 0.3, drift_time: 900.0, ..NoiseModel::white(white, every) }];
        let white = |order: [usize; 2], held: f64| {
            let [fine, coarse] = [(of(60.0), model(60.0, 2.0)), (of(240.0), model(240.0, 1.0))];
            let all = [fine, coarse];
            let (observations, models) = order.map(|k| all[k].clone()).into_iter().unzip::<_, _, Vec<_>, Vec<_>>();
            let pooled = Noise::with(models, 0.0, &observations).and_then(|noise| noise.pooled(&of(held))).expect("noise");
            *pooled.model(0, 0)
        };
        let minute = Noise::with(vec![model(60.0, 2.0), model(240.0, 1.0)], 0.0, &[of(60.0), of(240.0)]).expect("noise");
        assert_eq!([0, 1].map(|record| minute.white_of_a_minute(record, 0)), [2.0, 2.0]);
        for order in [[0, 1], [1, 0]] {
            assert!((white(order, 60.0).white - 2.0).abs() < 1e-12 && (white(order, 15.0).white - 4.0).abs() < 1e-12);
            assert!((white(order, 60.0).drift - 0.3).abs() < 1e-12);
        }
    }

    #[test]
    fn the_least_cost_is_found_from_the_middles_of_the_priors() {
        let target = [1.0, -0.5, 0.2, 2.0, 0.7];
        let cost = |x: &Standard| 50.0 * x.iter().zip(target).map(|(x, t)| (x - t).powi(2)).sum::<f64>();
        let found = least(cost, [0.0; TERMS]);
        assert!(cost(&found) < 1.0, "{found:?}");
    }
}
