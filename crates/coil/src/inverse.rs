//! The chamber's course from the thermometer's: Kalman filter and smoother on the reduced heat flow.
//!
//! Between rows the chamber is linear; from row to row its slope changes by a normal deviate of variance roughness² Δt. That is the
//! integrated random walk, whose smoother is the cubic smoothing spline (G. Wahba, *J. R. Stat. Soc. B* 40, 364 (1978)). The state is
//! the modes that matter to the thermometer, the chamber's temperature and its slope, and the thermometer's own lag if it has one; each
//! row observes it with white noise. Smoothing by P. de Jong, *Biometrika* 75, 594 (1988); the roughness by maximum likelihood
//! (F. C. Schweppe, *IEEE Trans. Inf. Theory* 11, 61 (1965)).

use crate::thermal::dot;
use crate::{Drive, Dynamics, Error, Profile, Reduced, Step, ThermalState};

/// Fewest rows of a record.
pub const FEWEST_ROWS: usize = 10;
/// Smallest noise \[K\]: less would be rounding of temperatures near 300.
pub const LEAST_NOISE: f64 = 1e-6;

/// Modes in the filter, at most: those with the largest share of the thermometer's lag behind a ramp. The others are taken as settled.
const MODES: usize = 12;
/// Standard deviation of the chamber's first temperature before the first row is seen, in noises.
const UNKNOWN: f64 = 100.0;
/// Decades of roughness \[K s^−3/2\] that are tried: the slope changes by 3 mK/min in a year, or by 1 K/s in a second.
const DECADES: std::ops::RangeInclusive<i32> = -8..=0;
/// Refinements of the best decade, each halving the step.
const HALVINGS: i32 = 2;

/// The chamber as a thermometer tells it, see [`chamber_from_sensor`].
#[derive(Debug, Clone, PartialEq)]
pub struct Inferred {
    /// The chamber at each instant, smoothed \[K or °C, as the record\].
    pub chamber: Vec<f64>,
    /// Its standard deviation \[K\] by the noise, if the chamber is as rough as [`Self::roughness`] and the model exact.
    pub chamber_sd: Vec<f64>,
    /// Root mean square of the record minus the thermometer under that chamber \[K\], all modes in.
    pub sensor_residual_rms: f64,
    /// The most likely roughness \[K s^−3/2\]: standard deviation of the slope's change over a second.
    pub roughness: f64,
}

/// Infers the chamber's course that a thermometer's record came from.
///
/// The design is at rest at the first instant, heaters off before it and on from it; walls and mounts follow the chamber. `noise` \[K\] is
/// the standard deviation of each reading, quantisation included. Time and memory grow with the number of rows.
///
/// # Errors
/// [`Error::Profile`] names the instant that is out of order or not finite; [`Error::Record`] if there are fewer than [`FEWEST_ROWS`]
/// instants, a reading each, if the noise is below [`LEAST_NOISE`], or if walls or mounts are driven on their own.
pub fn chamber_from_sensor(dynamics: &Dynamics, time: &[f64], sensor: &[f64], noise: f64) -> Result<Inferred, Error> {
    let refused = |problem: String| Err(Error::Record(problem));
    if dynamics.drives.iter().any(|d| !matches!(d, Drive::Chamber | Drive::Heaters)) {
        return refused("one thermometer cannot tell walls or mounts from the chamber; let them follow it".into());
    }
    if !(noise.is_finite() && noise >= LEAST_NOISE) {
        return refused(format!("a noise of {noise} K; give {LEAST_NOISE} K or more"));
    }
    Profile { time: time.to_vec(), drives: vec![sensor.to_vec()] }.check(1)?;
    if time.len() < FEWEST_ROWS {
        return refused(format!("{} rows are too few to infer the chamber from; give {FEWEST_ROWS} or more", time.len()));
    }
    let run = |chamber: Vec<f64>, heaters: f64| -> Result<Vec<f64>, Error> {
        let course = |d: &Drive| if *d == Drive::Heaters { vec![heaters; time.len()] } else { chamber.clone() };
        let drives = dynamics.drives.iter().map(course).collect();
        Ok(dynamics.simulate(&Profile { time: time.to_vec(), drives })?.iter().map(|row| row.sensor).collect())
    };
    // the heat flow is linear: what the heaters do is taken off first
    let heated = run(vec![0.0; time.len()], 1.0)?;
    let readings: Vec<f64> = sensor.iter().zip(heated).map(|(s, h)| s - h).collect();
    let filter = Filter { model: truncated(dynamics.reduced()), lag: dynamics.sensor_lag, time, readings: &readings, noise };
    let roughness = filter.most_likely_roughness();
    let (chamber, chamber_sd) = filter.smooth(roughness);
    let reproduced = run(chamber.clone(), 1.0)?;
    let squares: f64 = sensor.iter().zip(reproduced).map(|(s, r)| (s - r) * (s - r)).sum();
    Ok(Inferred { chamber, chamber_sd, sensor_residual_rms: (squares / time.len() as f64).sqrt(), roughness })
}

/// Chamber to thermometer alone, on the modes with the largest lags.
fn truncated(full: &Reduced) -> Reduced {
    let lag = |i: &usize| (full.thermometer().modal[*i] * full.drive[*i][0] / full.rates[*i]).abs();
    let mut chosen: Vec<usize> = (0..full.rates.len()).collect();
    chosen.sort_by(|a, b| lag(b).total_cmp(&lag(a)));
    chosen.truncate(MODES);
    full.truncated(&chosen)
}

/// Modes, then the chamber, its slope over the interval that ends here, and the lagging thermometer if it lags.
struct Filter<'a> {
    model: Reduced,
    lag: f64,
    time: &'a [f64],
    readings: &'a [f64],
    noise: f64,
}

/// The transition over one interval: `x ↦ A x`, then a change of the slope acts along `push`.
struct Transition {
    dt: f64,
    decay: Vec<f64>,
    /// Contribution of a slope of 1 to each entry of the state.
    push: Vec<f64>,
    /// The lagging thermometer at the interval's end per unit of each entry at its start, the slope's in `push`.
    follow: Option<Vec<f64>>,
}

/// Row-major square matrix.
struct Square {
    n: usize,
    entries: Vec<f64>,
}

impl Square {
    fn zeros(n: usize) -> Self {
        Self { n, entries: vec![0.0; n * n] }
    }

    fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.n..(i + 1) * self.n]
    }

    fn times(&self, x: &[f64]) -> Vec<f64> {
        (0..self.n).map(|i| dot(self.row(i), x)).collect()
    }

    /// `M ↦ F M Fᵀ` of a symmetric matrix.
    fn congruence(&mut self, f: impl Fn(&mut [f64])) {
        let n = self.n;
        for _ in 0..2 {
            self.entries.chunks_exact_mut(n).for_each(&f);
            for i in 0..n {
                for j in 0..i {
                    self.entries.swap(i * n + j, j * n + i);
                }
            }
        }
    }

    /// Adds `factor (a bᵀ + b aᵀ)/2`.
    fn add_outer(&mut self, factor: f64, a: &[f64], b: &[f64]) {
        for (i, row) in self.entries.chunks_exact_mut(self.n).enumerate() {
            let (left, right) = (0.5 * factor * a[i], 0.5 * factor * b[i]);
            row.iter_mut().zip(a).zip(b).for_each(|((m, a), b)| *m += left * b + right * a);
        }
    }
}

impl Transition {
    fn apply(&self, x: &mut [f64]) {
        let (m, slope) = (self.decay.len(), x[self.decay.len() + 1]);
        let follower = self.follow.as_ref().map(|f| dot(f, x) + self.push[m + 2] * slope);
        let modes = x.iter_mut().zip(&self.decay).zip(&self.push);
        modes.for_each(|((q, decay), push)| *q = decay * *q + push * slope);
        x[m] += self.dt * slope;
        if let Some(follower) = follower {
            x[m + 2] = follower;
        }
    }

    fn apply_transposed(&self, x: &mut [f64]) {
        let m = self.decay.len();
        let slope = dot(&self.push, x);
        let follower = if self.follow.is_some() { x[m + 2] } else { 0.0 };
        x.iter_mut().zip(&self.decay).for_each(|(x, decay)| *x *= decay);
        x[m + 1] = slope;
        if let Some(follow) = &self.follow {
            x[m + 2] = 0.0;
            x.iter_mut().zip(follow).for_each(|(x, f)| *x += f * follower);
        }
    }
}

/// One row of the filter, as the smoother needs it.
struct Visit {
    /// The chamber, predicted from the rows before.
    predicted: f64,
    /// Covariance of that with each entry of the state.
    with: Vec<f64>,
    /// The reading minus its prediction, and the variance of that.
    innovation: f64,
    variance: f64,
    gain: Vec<f64>,
}

impl Filter<'_> {
    /// Index of the chamber in the state.
    fn chamber(&self) -> usize {
        self.model.rates.len()
    }

    fn size(&self) -> usize {
        self.chamber() + if self.lag > 0.0 { 3 } else { 2 }
    }

    /// Reading of the thermometer per unit of each entry of the state.
    fn observation(&self) -> Vec<f64> {
        let mut h = vec![0.0; self.size()];
        let m = self.chamber();
        if self.lag > 0.0 {
            h[m + 2] = 1.0;
        } else {
            h[..m].copy_from_slice(&self.model.thermometer().modal);
            h[m] = self.model.thermometer().at_rest[0];
        }
        h
    }

    fn transition(&self, dt: f64) -> Transition {
        let (n, m) = (self.size(), self.chamber());
        let interval = self.model.interval(dt);
        let (mut decay, mut push) = (vec![1.0; m], vec![0.0; m]);
        interval.advance(&mut decay, &[0.0]);
        interval.advance(&mut push, &[1.0]);
        push.extend([dt, 1.0]);
        let mut step = Transition { dt, decay, push, follow: None };
        if self.lag > 0.0 {
            // linear in its arguments: the response to each alone
            let response = |entry: usize| {
                let unit = |i: usize| f64::from(i == entry);
                let from = ThermalState { drives: vec![unit(m)], amplitudes: (0..m).map(unit).collect() };
                let step = Step { from, slope: vec![unit(m + 1)], dt };
                self.model.lagged(self.model.thermometer(), &step, self.lag, unit(m + 2))
            };
            let mut follow: Vec<f64> = (0..n).map(response).collect();
            step.push.push(follow[m + 1]);
            follow[m + 1] = 0.0;
            step.follow = Some(follow);
        }
        step
    }

    /// Runs the filter and returns the logarithm of the record's likelihood, up to a constant.
    fn run(&self, roughness: f64, mut visit: impl FnMut(Visit)) -> f64 {
        let (n, at, h) = (self.size(), self.chamber(), self.observation());
        let rest = self.readings[0] / self.model.thermometer().at_rest[0];
        let mut at_rest = vec![0.0; n];
        at_rest[at] = 1.0;
        if self.lag > 0.0 {
            at_rest[at + 2] = self.model.thermometer().at_rest[0];
        }
        let mut state: Vec<f64> = at_rest.iter().map(|unit| unit * rest).collect();
        let mut covariance = Square::zeros(n);
        covariance.add_outer((UNKNOWN * self.noise).powi(2), &at_rest, &at_rest);
        let (mut step, mut likelihood) = (self.transition(0.0), 0.0);
        for (k, reading) in self.readings.iter().enumerate() {
            if k > 0 {
                let dt = self.time[k] - self.time[k - 1];
                if step.dt != dt {
                    step = self.transition(dt);
                }
                step.apply(&mut state);
                covariance.congruence(|x| step.apply(x));
                covariance.add_outer(roughness * roughness * dt, &step.push, &step.push);
            }
            let seen = covariance.times(&h);
            let (innovation, variance) = (reading - dot(&h, &state), dot(&h, &seen) + self.noise * self.noise);
            let gain: Vec<f64> = seen.iter().map(|p| p / variance).collect();
            likelihood -= 0.5 * (variance.ln() + innovation * innovation / variance);
            let (predicted, with) = (state[at], covariance.row(at).to_vec());
            state.iter_mut().zip(&gain).for_each(|(x, g)| *x += g * innovation);
            covariance.add_outer(-1.0, &seen, &gain);
            visit(Visit { predicted, with, innovation, variance, gain });
        }
        likelihood
    }

    fn most_likely_roughness(&self) -> f64 {
        let tried = |exponent: f64| (exponent, self.run(10f64.powf(exponent), |_| ()));
        let better = |a: (f64, f64), b: (f64, f64)| if b.1 > a.1 { b } else { a };
        let mut best = DECADES.map(|decade| tried(f64::from(decade))).fold((0.0, f64::NEG_INFINITY), better);
        for halving in 1..=HALVINGS {
            let width = 0.5f64.powi(halving);
            best = [best.0 - width, best.0 + width].into_iter().map(tried).fold(best, better);
        }
        10f64.powf(best.0)
    }

    /// The chamber and its standard deviation at each row, given all rows.
    fn smooth(&self, roughness: f64) -> (Vec<f64>, Vec<f64>) {
        let (n, at, h) = (self.size(), self.chamber(), self.observation());
        let mut rows = Vec::with_capacity(self.time.len());
        self.run(roughness, |visit| rows.push(visit));
        let (mut chamber, mut sd) = (vec![0.0; rows.len()], vec![0.0; rows.len()]);
        let (mut score, mut information) = (vec![0.0; n], Square::zeros(n));
        let mut step = self.transition(0.0);
        for (k, Visit { predicted, with, innovation, variance, gain }) in rows.iter().enumerate().rev() {
            if k + 1 < rows.len() {
                let dt = self.time[k + 1] - self.time[k];
                if step.dt != dt {
                    step = self.transition(dt);
                }
                step.apply_transposed(&mut score);
                information.congruence(|x| step.apply_transposed(x));
            }
            let weight = innovation / variance - dot(gain, &score);
            score.iter_mut().zip(&h).for_each(|(s, h)| *s += h * weight);
            let known = information.times(gain);
            information.add_outer(dot(gain, &known) + 1.0 / variance, &h, &h);
            information.add_outer(-2.0, &h, &known);
            chamber[k] = predicted + dot(with, &score);
            sd[k] = (with[at] - dot(with, &information.times(with))).max(0.0).sqrt();
        }
        (chamber, sd)
    }
}
