//! Matched filter: whitening by the true noise, and the signal-to-noise ratio of a difference beyond what a forward model is granted.

use super::heat::dot;
use super::noise::{Component, Noise};
use nalgebra::{DMatrix, DVector};

/// Innovations of the Kalman filter of a unit's noise on one set of instants.
pub(super) struct Whitening {
    /// Coefficient of a reading on each state.
    measure: DVector<f64>,
    steps: Vec<Step>,
}

struct Step {
    transition: DMatrix<f64>,
    gain: DVector<f64>,
    /// 1 / standard deviation of the innovation.
    precision: f64,
}

/// Transition and process noise over an interval \[s\].
fn passage(components: &[Component], dt: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let size = states(components).0.len();
    let (mut transition, mut noise) = (DMatrix::identity(size, size), DMatrix::zeros(size, size));
    let mut k = 0;
    for component in components {
        match *component {
            Component::Markov(sd, time) => {
                let keep = (-dt / time).exp();
                (transition[(k, k)], noise[(k, k)]) = (keep, sd * sd * (1.0 - keep * keep));
            }
            Component::Walk(variance) => noise[(k, k)] = variance * dt,
            Component::Wave(_, frequency) => {
                let (sin, cos) = (frequency * dt).sin_cos();
                transition.fixed_view_mut::<2, 2>(k, k).copy_from_slice(&[cos, -sin, sin, cos]);
                k += 1;
            }
        }
        k += 1;
    }
    (transition, noise)
}

/// Coefficients of a reading on each state, and the states' variances at the start.
fn states(components: &[Component]) -> (DVector<f64>, DVector<f64>) {
    let (mut measured, mut variances) = (Vec::new(), Vec::new());
    for component in components {
        let (measure, variance): (&[f64], f64) = match *component {
            Component::Markov(sd, _) => (&[1.0], sd * sd),
            Component::Walk(_) => (&[1.0], 0.0),
            Component::Wave(rms, _) => (&[1.0, 0.0], rms * rms),
        };
        measured.extend(measure);
        variances.extend(measure.iter().map(|_| variance));
    }
    (DVector::from_vec(measured), DVector::from_vec(variances))
}

impl Whitening {
    /// Of readings that end at `time`.
    pub(super) fn new(noise: &Noise, time: &[f64]) -> Self {
        let components = noise.components();
        let (measure, variances) = states(&components);
        let mut covariance = DMatrix::from_diagonal(&variances);
        let mut known = (f64::NAN, passage(&components, 0.0));
        let step = |n: usize| {
            let dt = if n > 0 { time[n] - time[n - 1] } else { 0.0 };
            if known.0 != dt {
                known = (dt, passage(&components, dt));
            }
            let (transition, added) = &known.1;
            let before = transition * &covariance * transition.transpose() + added;
            let seen = &before * &measure;
            let variance = measure.dot(&seen) + noise.white(time[n]).powi(2);
            let gain = &seen / variance;
            covariance = before - &gain * seen.transpose();
            Step { transition: transition.clone(), gain, precision: variance.sqrt().recip() }
        };
        let steps = (0..time.len()).map(step).collect();
        Self { measure, steps }
    }

    /// Innovations over their standard deviations.
    pub(super) fn apply(&self, series: &[f64]) -> Vec<f64> {
        let mut state = DVector::zeros(self.measure.len());
        let whiten = |(step, value): (&Step, &f64)| {
            state = &step.transition * &state;
            let innovation = value - self.measure.dot(&state);
            state += &step.gain * innovation;
            innovation * step.precision
        };
        self.steps.iter().zip(series).map(whiten).collect()
    }
}

/// Length of `difference` beyond what the `granted` directions explain, each with a standard deviation of one; all are whitened.
pub(super) fn beyond(difference: &[f64], granted: &[Vec<f64>]) -> f64 {
    let n = granted.len();
    let normal = DMatrix::from_fn(n, n, |i, j| dot(&granted[i], &granted[j]) + f64::from(i == j));
    let onto = DVector::from_fn(n, |i, _| dot(&granted[i], difference));
    let explained = normal.cholesky().map_or(0.0, |factor| onto.dot(&factor.solve(&onto)));
    (dot(difference, difference) - explained).max(0.0).sqrt()
}
