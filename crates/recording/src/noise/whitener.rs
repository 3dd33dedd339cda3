//! Innovations of the Kalman filter as a linear operator.
//!
//! The state is (drift, walk, rounding, passed) at the end of the last sample. A sample's mean and the state at its end are jointly Gaussian
//! given the state at its start, so means over the span need no further state: the filter has correlated process and measurement
//! noise. Gains depend on instants and mask alone.

use super::NoiseModel;
use crate::Error;
use crate::series::{check_length, check_time};

const STATES: usize = 4;
type Vector = [f64; STATES];

/// Whitens series of one set of instants: innovations divided by their standard deviations.
///
/// It is the exact inverse Cholesky factor of the model's covariance matrix over the rows used, so `‖apply(r)‖² = rᵀ C⁻¹ r` and
/// [`Whitener::log_det`] = ln det C, with gaps and uneven instants. The operator is linear: it serves a residual and the columns of
/// its Jacobian alike. The walk starts at 0 at the start of the first row used: a constant offset is the caller's to remove or to fit.
#[derive(Debug, Clone)]
pub struct Whitener {
    /// Rows of the series that are used.
    rows: Vec<usize>,
    steps: Vec<Step>,
    length: usize,
    log_det: f64,
}

/// Effect of a used row on the filter's mean.
#[derive(Debug, Clone, Copy)]
struct Step {
    /// From the state after the last row used to the sample.
    measure: Vector,
    /// From the state after the last row used to the state after this.
    advance: Vector,
    /// Kalman gain on the innovation divided by its standard deviation.
    gain: Vector,
    /// 1 / standard deviation of the innovation.
    precision: f64,
}

impl Whitener {
    /// Computes the gains. `time` increases \[s\]; rows where `mask` is `false` are not used.
    ///
    /// # Errors
    /// [`Error::Parameter`], [`Error::Time`], [`Error::Length`] if the mask is not as long as the instants.
    pub fn new(model: &NoiseModel, time: &[f64], mask: &[bool]) -> Result<Self, Error> {
        model.check()?;
        check_time(time)?;
        check_length("mask", mask.len(), time.len())?;
        let rows: Vec<usize> = (0..time.len()).filter(|&row| mask[row]).collect();
        let mut filter = Filter::new(model);
        let (mut steps, mut log_det) = (Vec::with_capacity(rows.len()), 0.0);
        for (n, &row) in rows.iter().enumerate() {
            let last = n.checked_sub(1).map(|n| rows[n]);
            let interval = last.map(|last| time[row] - time[last]);
            // a masked row still ends where this one starts
            let span = if row == 0 { f64::INFINITY } else { time[row] - time[row - 1] };
            let (step, of_row) = filter.step(interval, span);
            log_det += of_row;
            steps.push(step);
        }
        Ok(Self { rows, steps, length: time.len(), log_det })
    }

    /// The rows that are used, one for each whitened value.
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// ln det of the covariance matrix of the rows used.
    pub fn log_det(&self) -> f64 {
        self.log_det
    }

    /// Whitened values of the rows used; of the others no value is read.
    ///
    /// # Panics
    /// If the series has not one value for each instant.
    pub fn apply(&self, series: &[f64]) -> Vec<f64> {
        assert_eq!(series.len(), self.length, "one value for each instant");
        let mut state = [0.0; STATES];
        let whiten = |(step, &row): (&Step, &usize)| {
            let expected: f64 = (0..STATES).map(|i| step.measure[i] * state[i]).sum();
            let innovation = (series[row] - expected) * step.precision;
            state = std::array::from_fn(|i| step.advance[i] * state[i] + step.gain[i] * innovation);
            innovation
        };
        self.steps.iter().zip(&self.rows).map(whiten).collect()
    }

    /// Log likelihood of a series under the model.
    ///
    /// # Panics
    /// If the series has not one value for each instant.
    pub fn log_likelihood(&self, series: &[f64]) -> f64 {
        let squares: f64 = self.apply(series).iter().map(|z| z * z).sum();
        -0.5 * (squares + self.log_det + self.rows.len() as f64 * std::f64::consts::TAU.ln())
    }
}

/// The filter's covariance on its way through the rows.
struct Filter<'a> {
    model: &'a NoiseModel,
    covariance: [Vector; STATES],
    last: Option<Last>,
}

/// The last step, over an interval and a span.
struct Last {
    interval: Option<f64>,
    span: f64,
    passage: Passage,
    step: Step,
    /// ln of the innovation's variance
    log_variance: f64,
    /// whether the covariance has settled
    settled: bool,
}

/// Change of the covariance, relative to the variances it belongs to, below which it has settled: rounding.
const SETTLED: f64 = 4.0 * f64::EPSILON;

impl<'a> Filter<'a> {
    fn new(model: &'a NoiseModel) -> Self {
        let mut covariance = [[0.0; STATES]; STATES];
        covariance[0][0] = model.drift * model.drift;
        covariance[2][2] = model.quantisation * model.quantisation;
        covariance[3][3] = model.passed * model.passed;
        Self { model, covariance, last: None }
    }

    /// A row's step, and ln of its innovation's variance. `interval` \[s\] since the last row used, `None` for the first; `span` \[s\] since the last row,
    /// used or not.
    fn step(&mut self, interval: Option<f64>, span: f64) -> (Step, f64) {
        let passage = match self.last.take() {
            Some(last) if (last.interval, last.span) == (interval, span) => {
                if last.settled {
                    let Last { step, log_variance, .. } = *self.last.insert(last);
                    return (step, log_variance);
                }
                last.passage
            }
            _ => Passage::new(self.model, interval, span),
        };
        let (step, after) = passage.update(&self.covariance);
        let close = |i: usize, j: usize| {
            (after[i][j] - self.covariance[i][j]).abs() <= SETTLED * (after[i][i].abs() * after[j][j].abs()).sqrt()
        };
        let settled = (0..STATES).all(|i| (0..=i).all(|j| close(i, j)));
        self.covariance = after;
        let log_variance = -2.0 * step.precision.ln();
        self.last = Some(Last { interval, span, passage, step, log_variance, settled });
        (step, log_variance)
    }
}

/// From the end of the last row used to the end of a row: an optional pause, then the row's span.
struct Passage {
    measure: Vector,
    advance: Vector,
    /// Variance that the pause adds to the state before the span begins.
    pause: Vector,
    /// Parts of that which reach the sample and the state.
    pause_measure: Vector,
    pause_advance: Vector,
    /// Noise of the sample, of the state, and their covariance, arising within the span.
    sample_noise: f64,
    state_noise: Vector,
    cross_noise: Vector,
}

impl Passage {
    fn new(model: &NoiseModel, interval: Option<f64>, since_row: f64) -> Self {
        let span = model.averaging.min(since_row);
        let pause = interval.map_or(0.0, |interval| (interval - span).max(0.0));
        // rounding at the start of the span is that at the end of the row before only if the two are one instant
        let contiguous = interval == Some(since_row) && pause < 0.5 * span;
        let (walk, drift) = (model.walk * model.walk, model.drift * model.drift);
        let rounding = model.quantisation * model.quantisation;
        let passed = model.passed * model.passed;
        let [kept, kept_passed] = [model.drift_time, model.passed_time].map(|time| (-pause / time).exp());
        let [within, of_passed] = [model.drift_time, model.passed_time].map(|time| Within::new(span / time));
        let (measure_rounding, rounding_noise, rounding_cross) = if span > 0.0 && rounding > 0.0 {
            let fresh = if contiguous { 1.0 } else { 2.0 };
            (if contiguous { -1.0 / span } else { 0.0 }, fresh * rounding / (span * span), rounding / span)
        } else {
            (0.0, 0.0, 0.0)
        };
        let white = model.white * model.white * if span > 0.0 { model.averaging / span } else { 1.0 };
        Self {
            measure: [kept * within.mean, 1.0, measure_rounding, kept_passed * of_passed.mean],
            advance: [kept * within.end, 1.0, 0.0, kept_passed * of_passed.end],
            pause: [
                -drift * (-2.0 * pause / model.drift_time).exp_m1(),
                walk * pause,
                0.0,
                -passed * (-2.0 * pause / model.passed_time).exp_m1(),
            ],
            pause_measure: [within.mean, 1.0, 0.0, of_passed.mean],
            pause_advance: [within.end, 1.0, 0.0, of_passed.end],
            sample_noise: white + drift * within.mean_noise + walk * span / 3.0 + rounding_noise + passed * of_passed.mean_noise,
            state_noise: [drift * within.end_noise, walk * span, rounding, passed * of_passed.end_noise],
            cross_noise: [drift * within.cross_noise, walk * span / 2.0, rounding_cross, passed * of_passed.cross_noise],
        }
    }

    fn update(&self, before: &[Vector; STATES]) -> (Step, [Vector; STATES]) {
        let measured: Vector = std::array::from_fn(|i| (0..STATES).map(|j| before[i][j] * self.measure[j]).sum());
        let mut variance = self.sample_noise + (0..STATES).map(|i| measured[i] * self.measure[i]).sum::<f64>();
        let mut covariance = self.cross_noise;
        for i in 0..STATES {
            variance += self.pause[i] * self.pause_measure[i] * self.pause_measure[i];
            covariance[i] += self.advance[i] * measured[i] + self.pause[i] * self.pause_measure[i] * self.pause_advance[i];
        }
        let precision = variance.sqrt().recip();
        let gain = covariance.map(|c| c * precision);
        let mut after = [[0.0; STATES]; STATES];
        for i in 0..STATES {
            for j in 0..i {
                after[i][j] = self.advance[i] * before[i][j] * self.advance[j] - gain[i] * gain[j];
                after[j][i] = after[i][j];
            }
            let own = self.state_noise[i] + self.pause[i] * self.pause_advance[i] * self.pause_advance[i];
            after[i][i] = self.advance[i] * before[i][i] * self.advance[i] + own - gain[i] * gain[i];
        }
        (Step { measure: self.measure, advance: self.advance, gain, precision }, after)
    }
}

/// A drift of unit variance over u correlation times: weights of its start in its mean and its end, and what is added to both.
struct Within {
    mean: f64,
    end: f64,
    mean_noise: f64,
    end_noise: f64,
    cross_noise: f64,
}

impl Within {
    fn new(u: f64) -> Self {
        if u == 0.0 {
            return Self { mean: 1.0, end: 1.0, mean_noise: 0.0, end_noise: 0.0, cross_noise: 0.0 };
        }
        let lost = -(-u).exp_m1();
        let (mean, end) = (lost / u, 1.0 - lost);
        let mean_noise = if u < 1e-3 {
            u * (2.0 / 3.0 - u * (0.5 - u * 7.0 / 30.0)) // the closed form cancels
        } else {
            2.0 * (u - lost) / (u * u) - mean * mean
        };
        Self { mean, end, mean_noise, end_noise: -(-2.0 * u).exp_m1(), cross_noise: mean * lost }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Long even stretches cost no more than their rows.
    #[test]
    fn the_gains_of_an_even_stretch_settle() {
        let model = NoiseModel { drift: 0.3, drift_time: 20.0, walk: 0.1, ..NoiseModel::white(1.0, 1.0) };
        let mut filter = Filter::new(&model);
        filter.step(None, f64::INFINITY);
        for _ in 0..2000 {
            filter.step(Some(1.0), 1.0);
        }
        assert!(filter.last.is_some_and(|last| last.settled));
    }
}
