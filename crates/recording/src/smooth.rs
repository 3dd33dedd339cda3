//! A measured course without its sensor's noise.

use crate::Error;
use crate::series::check_series;
use nalgebra::{Matrix2, Vector2};

/// Degrees of freedom of the disturbances' Student distribution: a programme turns seldom, but then sharply.
const FREEDOM: f64 = 2.0;
const ROUNDS: usize = 8;
/// ln of a disturbance's variance over the noise's that is searched, and how closely it is found.
const RATIOS: (f64, f64) = (-20.0, 20.0);
const CLOSE: f64 = 0.1;
/// Variance of an unknown start over the noise's.
const UNKNOWN: f64 = 1e8;
/// Fewest rows that can be smoothed.
pub const FEWEST_ROWS: usize = 8;

type Vector = Vector2<f64>;
type Matrix = Matrix2<f64>;

/// A course freed of white noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothed {
    /// The course at the instants given.
    pub values: Vec<f64>,
    /// Standard deviation of the noise that was taken off \[unit of the values\].
    pub noise: f64,
    /// Standard deviation of what is left of it, root mean square over all values, as the smoothing knows it: at corners more than in between.
    pub left: f64,
    /// Number of values of which a smoothed one is the mean, the median over all.
    pub of: f64,
}

/// Least step between two values of a series that differ; 0 of a constant.
fn resolution(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let range = sorted[sorted.len() - 1] - sorted[0];
    // what rounding leaves of one value is no step
    let steps = sorted.windows(2).map(|w| w[1] - w[0]).filter(|step| *step > 1e-7 * range);
    let least = steps.fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// Frees a series of white noise: its slope wanders, mostly little, at times much.
///
/// The noise has at least the size of the last digit that is written, beside its rounding: no thermometer is better than its display.
/// The slope is a random walk whose steps follow Student's distribution with two degrees of freedom, so that ramps and soaks are smoothed
/// while the corners between them stay; the sizes of noise and steps are the most likely ones. Kalman's filter and the smoother of Rauch,
/// Tung and Striebel (1965), reweighted as Lange, Little and Taylor (1989) do. From a series without noise next to nothing is taken.
///
/// # Errors
/// [`Error`] if instants do not increase, a value is not finite, or there are fewer than [`FEWEST_ROWS`].
pub fn smoothed(time: &[f64], values: &[f64]) -> Result<Smoothed, Error> {
    let found = check_series(time, &vec![true; time.len()], &[("values", values)])?;
    if found < FEWEST_ROWS {
        return Err(Error::TooFew { found, needed: FEWEST_ROWS });
    }
    // intervals in units of their mean
    let unit = (time[time.len() - 1] - time[0]) / (time.len() - 1) as f64;
    let steps: Vec<f64> = time.windows(2).map(|t| (t[1] - t[0]) / unit).collect();
    let step = resolution(values);
    let least = step * step * (1.0 + 1.0 / 12.0);
    let mut weights = vec![1.0; steps.len()];
    let mut ratio = most_likely(&steps, values, &weights, least);
    for round in 1..ROUNDS {
        let filter = Filter::new(&steps, values, ratio, &weights);
        let variance = filter.variance().max(least).max(f64::MIN_POSITIVE);
        let (_, squares, _) = filter.smooth(variance);
        for (w, square) in weights.iter_mut().zip(&squares) {
            *w = (FREEDOM + 2.0) / (FREEDOM + square / variance);
        }
        if round < 4 {
            ratio = most_likely(&steps, values, &weights, least);
        }
    }
    let filter = Filter::new(&steps, values, ratio, &weights);
    let variance = filter.variance().max(least);
    let (values, _, variances) = filter.smooth(variance);
    let noise = variance.sqrt();
    let left = noise * (variances.iter().sum::<f64>() / variances.len() as f64).max(0.0).sqrt();
    let of = 1.0 / crate::statistics::median(variances).unwrap_or(1.0).clamp(f64::MIN_POSITIVE, 1.0);
    Ok(Smoothed { values, noise, left, of })
}

/// The most likely variance of a step over that of the noise: golden section in its logarithm.
fn most_likely(steps: &[f64], values: &[f64], weights: &[f64], least: f64) -> f64 {
    let of = |x: f64| Filter::new(steps, values, x.exp(), weights).deviance(least);
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut a, mut b) = RATIOS;
    let (mut x, mut y) = (b - golden * (b - a), a + golden * (b - a));
    let (mut at_x, mut at_y) = (of(x), of(y));
    while b - a > CLOSE {
        if at_x < at_y {
            (b, y, at_y) = (y, x, at_x);
            x = b - golden * (b - a);
            at_x = of(x);
        } else {
            (a, x, at_x) = (x, y, at_y);
            y = a + golden * (b - a);
            at_y = of(y);
        }
    }
    ((a + b) / 2.0).exp()
}

fn inverse(a: &Matrix) -> Matrix {
    let det = a[(0, 0)] * a[(1, 1)] - a[(0, 1)] * a[(1, 0)];
    Matrix::new(a[(1, 1)], -a[(0, 1)], -a[(1, 0)], a[(0, 0)]) / det
}

fn forward(dt: f64) -> Matrix {
    Matrix::new(1.0, dt, 0.0, 1.0)
}

/// Covariance of what a random walk of the slope, of unit intensity, adds over an interval.
fn wander(dt: f64) -> Matrix {
    Matrix::new(dt.powi(3) / 3.0, dt * dt / 2.0, dt * dt / 2.0, dt)
}

/// Kalman's filter, variances in units of the noise's.
struct Filter<'a> {
    steps: &'a [f64],
    ratio: f64,
    weights: &'a [f64],
    /// mean and covariance after each value
    states: Vec<(Vector, Matrix)>,
    squares: f64,
    log_det: f64,
    count: usize,
}

impl<'a> Filter<'a> {
    fn new(steps: &'a [f64], values: &[f64], ratio: f64, weights: &'a [f64]) -> Self {
        let mut states = Vec::with_capacity(values.len());
        let (mut x, mut p) = (Vector::new(values[0], 0.0), UNKNOWN * Matrix::identity());
        let (mut squares, mut log_det, mut count) = (0.0, 0.0, 0);
        for (n, value) in values.iter().enumerate() {
            if n > 0 {
                let f = forward(steps[n - 1]);
                x = f * x;
                p = f * p * f.transpose() + ratio / weights[n - 1] * wander(steps[n - 1]);
            }
            let (surprise, s) = (value - x[0], p[(0, 0)] + 1.0);
            // the first two say where it starts
            if n > 1 {
                squares += surprise * surprise / s;
                log_det += s.ln();
                count += 1;
            }
            let gain: Vector = p.column(0) / s;
            x += gain * surprise;
            p -= gain * gain.transpose() * s;
            states.push((x, p));
        }
        Self { steps, ratio, weights, states, squares, log_det, count }
    }

    /// Most likely variance of the noise.
    fn variance(&self) -> f64 {
        self.squares / self.count as f64
    }

    /// −2 ln of the likelihood but for a constant, the noise's variance at its most likely value that is no less than `least`.
    fn deviance(&self, least: f64) -> f64 {
        let variance = self.variance().max(least).max(f64::MIN_POSITIVE);
        self.count as f64 * variance.ln() + self.log_det + self.squares / variance
    }

    /// The smoothed values, and of every step the expected square of its disturbance over its variance at weight 1, times the noise's
    /// variance, which is `variance`; and the variance of every smoothed value over the noise's.
    fn smooth(&self, variance: f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let last = self.states.len() - 1;
        let mut values = vec![0.0; last + 1];
        let mut squares = vec![0.0; last];
        let (mut x, mut p) = self.states[last];
        let mut variances = vec![0.0; last + 1];
        (values[last], variances[last]) = (x[0], p[(0, 0)]);
        for n in (0..last).rev() {
            let (f, q) = (forward(self.steps[n]), wander(self.steps[n]));
            let (here, here_p) = &self.states[n];
            let (ahead, ahead_p) = (f * here, f * here_p * f.transpose() + self.ratio / self.weights[n] * q);
            let gain = here_p * f.transpose() * inverse(&ahead_p);
            let smooth = here + gain * (x - ahead);
            let smooth_p = here_p + gain * (p - ahead_p) * gain.transpose();
            // the disturbance is x(n+1) − F x(n); x(n) and x(n+1) share the covariance gain · p
            let shared = f * (gain * p);
            let d = x - f * smooth;
            let spread = p - (shared + shared.transpose()) + f * smooth_p * f.transpose();
            let q = inverse(&q);
            squares[n] = (d.dot(&(q * d)) + variance * (q * spread).trace()).max(0.0) / self.ratio;
            (x, p) = (smooth, smooth_p);
            (values[n], variances[n]) = (x[0], p[(0, 0)]);
        }
        (values, squares, variances)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ramps of 0.01 K/s and soaks, rounded by a lag of `lag` \[s\].
    fn programme(lag: f64) -> (Vec<f64>, Vec<f64>) {
        let time: Vec<f64> = (0..1200).map(|n| 30.0 * f64::from(n)).collect();
        let target = |t: f64| 0.01 * ((t - 6000.0).clamp(0.0, 6000.0) - (t - 20000.0).clamp(0.0, 8000.0));
        let mut x = target(0.0);
        let course = time
            .iter()
            .map(|t| {
                x += (target(*t) - x) * -(-30.0 / lag).exp_m1();
                20.0 + x
            })
            .collect();
        (time, course)
    }

    fn noise(n: usize) -> Vec<f64> {
        let mut state = 7_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..n).map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0).collect()
    }

    fn rms(a: &[f64]) -> f64 {
        (a.iter().map(|x| x * x).sum::<f64>() / a.len() as f64).sqrt()
    }

    #[test]
    fn noise_goes_and_corners_stay() {
        let (time, course) = programme(90.0);
        let noisy: Vec<f64> = course.iter().zip(noise(course.len())).map(|(c, e)| c + 0.01 * e).collect();
        let smooth = smoothed(&time, &noisy).unwrap();
        assert!((smooth.noise / 0.01 - 1.0).abs() < 0.1, "{}", smooth.noise);
        let off: Vec<f64> = smooth.values.iter().zip(&course).map(|(a, b)| a - b).collect();
        assert!(rms(&off) < 0.005, "{}", rms(&off));
        // at the four corners, too
        for corner in [200, 400, 667, 933] {
            assert!(off[corner - 8..corner + 12].iter().all(|o| o.abs() < 0.03), "{:?}", &off[corner - 8..corner + 12]);
        }
    }

    #[test]
    fn a_quiet_series_stays() {
        let (time, course) = programme(200.0);
        let smooth = smoothed(&time, &course).unwrap();
        let off = smooth.values.iter().zip(&course).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        assert!(off < 1e-3, "{off}");
    }

    #[test]
    fn what_cannot_be_smoothed_is_refused() {
        assert!(matches!(smoothed(&[0.0, 1.0, 2.0], &[1.0, 2.0, 3.0]), Err(Error::TooFew { .. })));
        let time: Vec<f64> = (0..10).map(f64::from).collect();
        assert!(matches!(smoothed(&time, &[f64::NAN; 10]), Err(Error::Value { .. })));
        // a constant is kept
        assert!(smoothed(&time, &[5.0; 10]).unwrap().values.iter().all(|v| (v - 5.0).abs() < 1e-9));
    }
}
