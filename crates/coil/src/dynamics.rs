//! A coil in time: chamber temperature in, thermometer and bias out, through a reduced model of the heat flow.

use crate::mechanics::Blend;
use crate::{BiasOperator, Design, Drive, Error, Grid, Model, Reduced, Resolution, ThermalModel};
use bias::Bias;
use std::collections::HashMap;

/// How finely a coil in time is modelled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fidelity {
    /// Mesh of heat flow and mechanics.
    pub resolution: Resolution,
    /// Modes of the reduced model for each drive.
    pub modes: usize,
}

/// The mesh and the modes behind a simulation.
pub const STANDARD: Fidelity = Fidelity { resolution: crate::COARSE, modes: 40 };

/// A design ready to be simulated: its thermometer, mean coil temperature and bias parts as a few exponentials.
#[derive(Debug, Clone, PartialEq)]
pub struct Dynamics {
    reduced: Reduced,
    error: ReductionError,
    blend: Blend,
    states: usize,
    sensor_lag: f64,
    drives: Vec<Drive>,
}

/// Factor on the distance to a smaller model that [`ReductionError`] states: with few modes the error was seen to be up to four
/// times that distance.
pub const REDUCTION_SAFETY: f64 = 4.0;

/// Estimates of what the reduction leaves out, for any course of the drives and readings that are means over a second or more.
///
/// A response to any course is the convolution of the drive's rate with the step response, so a difference of step responses bounds
/// the difference of responses for every course of bounded rate. What is taken is [`REDUCTION_SAFETY`] times the difference to a model
/// with two thirds of the modes, the worst over drives and mechanical states: an estimate, not a bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReductionError {
    /// Thermometer: kelvin per (kelvin per second) of a drive \[s\].
    pub sensor: f64,
    /// Total bias, relative to the largest that a drive of the same largest rate can cause.
    pub bias: f64,
}

impl ReductionError {
    fn between(reduced: &Reduced, smaller: &Reduced, drives: usize, states: usize) -> Self {
        let times: Vec<f64> = [0.0].into_iter().chain(reduced.instants()).collect();
        let variation = |f: &dyn Fn(f64) -> f64| {
            let values: Vec<f64> = times.iter().map(|&t| f(t)).collect();
            values[0].abs() + values.windows(2).map(|w| (w[1] - w[0]).abs()).sum::<f64>()
        };
        let mut worst = Self { sensor: 0.0, bias: 0.0 };
        for drive in 0..drives {
            let off = |t: f64| (reduced.step_response(SENSOR, drive, t) - smaller.step_response(SENSOR, drive, t)).abs();
            let sensor: f64 = times.windows(2).map(|w| (w[1] - w[0]) * off(w[0]).max(off(w[1]))).sum();
            worst.sensor = worst.sensor.max(REDUCTION_SAFETY * sensor);
            for state in 0..states {
                let first = SHUPE + 3 * state;
                let bias = |model: &Reduced, t: f64| (first..first + 3).map(|k| model.step_response(k, drive, t)).sum::<f64>();
                let missing = variation(&|t| bias(reduced, t) - bias(smaller, t));
                worst.bias = worst.bias.max(REDUCTION_SAFETY * missing / variation(&|t| bias(reduced, t)));
            }
        }
        worst
    }
}

/// Courses of the drives in time, linear between instants.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Instants \[s\], increasing.
    pub time: Vec<f64>,
    /// One course per drive of the [`Dynamics`], each as long as `time`.
    pub drives: Vec<Vec<f64>>,
}

/// What a coil does at one instant of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Thermometer \[K or °C, as the profile\].
    pub sensor: f64,
    /// Mean temperature of the coil.
    pub coil: f64,
    /// Mean bias since the previous instant \[rad/s\]; zero at the first.
    pub bias: Bias,
}

/// Outputs of the reduced model, in this order.
const SENSOR: usize = 0;
const COIL: usize = 1;
const SHUPE: usize = 2;

/// A functional of the mechanical mesh's nodes on the nodes of the thermal mesh, which holds them all.
fn embed(from: &Grid, to: &Grid, functional: &[f64]) -> Result<Vec<f64>, Error> {
    // a tenth of a nanometre: far above rounding, far below any element
    let key = |p: [f64; 2]| p.map(|x| (x * 1e10).round() as i64);
    let index: HashMap<_, usize> = to.mesh().nodes().iter().enumerate().map(|(i, &p)| (key(p), i)).collect();
    let mut embedded = vec![0.0; to.mesh().nodes().len()];
    for (&p, value) in from.mesh().nodes().iter().zip(functional) {
        let missing = || Error::Resolution(format!("the thermal mesh lacks the mechanical node at {p:?} m"));
        // both faces of an opened bond lie at one place
        embedded[*index.get(&key(p)).ok_or_else(missing)?] += *value;
    }
    Ok(embedded)
}

/// Outputs of a coil as functionals of the temperature at the nodes of `thermal`'s mesh: thermometer and mean coil temperature \[K\],
/// then the Shupe, elasto-optic axial and radial parts, whose increase per time is the bias \[rad\].
///
/// # Errors
/// [`Error`] names the dimension or property at fault; both models must be made on one [`Resolution`].
pub fn functionals(design: &Design, model: &Model, thermal: &ThermalModel) -> Result<Vec<Vec<f64>>, Error> {
    let nodes = thermal.grid().mesh().nodes().len();
    let mut sensor = vec![0.0; nodes];
    thermal.grid().probe("sensor", design.sensor.radius, design.sensor.y)?.add_value(&mut sensor, 1.0);
    let BiasOperator { shupe, eo_axial, eo_radial } = model.bias_operator()?;
    let mut all = vec![sensor, thermal.grid().coil_mean()?];
    for part in [shupe, eo_axial, eo_radial] {
        all.push(embed(model.grid(), thermal.grid(), &part)?);
    }
    Ok(all)
}

impl Dynamics {
    /// Models `design` under `drives`, the first of which must be [`Drive::Chamber`].
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn new(design: &Design, drives: &[Drive], fidelity: &Fidelity) -> Result<Self, Error> {
        if fidelity.modes == 0 {
            return Err(Error::Resolution("a reduced model needs at least one mode".into()));
        }
        let thermal = ThermalModel::new(design, &fidelity.resolution, drives)?;
        let (states, blend) = design.states();
        let mut outputs = Vec::new();
        for state in &states {
            let of_state = functionals(design, &Model::in_state(design, &fidelity.resolution, state)?, &thermal)?;
            outputs.extend(of_state.into_iter().skip(if outputs.is_empty() { 0 } else { SHUPE }));
        }
        let (reduced, smaller) = Reduced::new(&thermal, &outputs, fidelity.modes * drives.len())?;
        let error = ReductionError::between(&reduced, &smaller, drives.len(), states.len());
        Ok(Self { reduced, error, blend, states: states.len(), sensor_lag: design.sensor.lag, drives: drives.to_vec() })
    }

    /// What the reduction may leave out.
    pub fn reduction_error(&self) -> ReductionError {
        self.error
    }

    /// The reduced model.
    pub fn reduced(&self) -> &Reduced {
        &self.reduced
    }

    /// The three bias parts' phases \[rad\] in each mechanical state.
    fn phases(&self, u: &[f64], q: &[f64]) -> Vec<[f64; 3]> {
        let first = |state: usize| SHUPE + 3 * state;
        (0..self.states).map(|s| [0, 1, 2].map(|part| self.reduced.output(first(s) + part, u, q))).collect()
    }

    /// Runs a profile from rest at its first instant: heaters, if any, are off before it.
    ///
    /// # Errors
    /// [`Error::Profile`] names the instant that is out of order or not finite.
    pub fn simulate(&self, profile: &Profile) -> Result<Vec<Response>, Error> {
        profile.check(self.drives.len())?;
        let at = |n: usize| -> Vec<f64> { profile.drives.iter().map(|d| d[n]).collect() };
        let mut q = vec![0.0; self.reduced.rates.len()];
        let mut u = at(0);
        // rest: at the first temperature everywhere, heaters off
        let rest: Vec<f64> = self.drives.iter().zip(&u).map(|(d, u)| if *d == Drive::Heaters { 0.0 } else { *u }).collect();
        let jump: Vec<f64> = u.iter().zip(&rest).map(|(u, r)| u - r).collect();
        self.reduced.jump(&mut q, &jump);
        let mut lagging = self.reduced.output(SENSOR, &u, &q);
        let mut rows = vec![Response { sensor: lagging, coil: self.reduced.output(COIL, &u, &q), bias: Bias::ZERO }];
        let (mut interval, mut blend) = (self.reduced.interval(0.0), self.blend.clone());
        for n in 1..profile.time.len() {
            let dt = profile.time[n] - profile.time[n - 1];
            let next = at(n);
            let slope: Vec<f64> = next.iter().zip(&u).map(|(b, a)| (b - a) / dt).collect();
            let before = self.phases(&u, &q);
            let from = self.reduced.output(COIL, &u, &q);
            if self.sensor_lag > 0.0 {
                lagging = self.reduced.lagged(SENSOR, &u, &q, &slope, dt, self.sensor_lag, lagging);
            }
            if interval.dt != dt {
                interval = self.reduced.interval(dt);
            }
            self.reduced.advance(&mut q, &slope, &interval);
            u = next;
            if self.sensor_lag == 0.0 {
                lagging = self.reduced.output(SENSOR, &u, &q);
            }
            let coil = self.reduced.output(COIL, &u, &q);
            let rates: Vec<[f64; 3]> =
                self.phases(&u, &q).iter().zip(before).map(|(a, b)| [0, 1, 2].map(|p| (a[p] - b[p]) / dt)).collect();
            let [shupe, eo_axial, eo_radial] = blend.rates(&rates, from, coil, dt);
            rows.push(Response { sensor: lagging, coil, bias: Bias { shupe, eo_axial, eo_radial } });
        }
        Ok(rows)
    }
}

impl Profile {
    pub(crate) fn check(&self, drives: usize) -> Result<(), Error> {
        let bad = |row: usize, problem: String| Err(Error::Profile { row, problem });
        if self.time.is_empty() {
            return bad(0, "there is no instant; give at least one".into());
        }
        if self.drives.len() != drives || self.drives.iter().any(|d| d.len() != self.time.len()) {
            return bad(0, format!("{drives} courses of {} instants are needed", self.time.len()));
        }
        for (row, t) in self.time.iter().enumerate() {
            if !t.is_finite() || (row > 0 && *t <= self.time[row - 1]) {
                return bad(row, format!("time {t} s must be finite and later than the one before"));
            }
            if let Some(value) = self.drives.iter().map(|d| d[row]).find(|v| !v.is_finite()) {
                return bad(row, format!("{value} must be finite"));
            }
        }
        Ok(())
    }
}
