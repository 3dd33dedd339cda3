//! A sensor's rate at rest over temperature: nominal is a cubic; the library holds what is popular beyond it, and what a body that is not
//! everywhere as warm as its thermometer does.

use diagnosis::{Active, Channel, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, State};

/// Polynomial in T, T-rate and time: the popular fit.
pub(crate) const RATE_AND_TIME: usize = 0;
/// A part that follows the thermometer slowly.
pub(crate) const SLOW_PART: usize = 1;
/// A linear drift in time.
pub(crate) const TIME: usize = 2;
/// Proportional to the temperature's rate.
pub(crate) const RATE: usize = 3;
/// A ripple over temperature, as of interference.
pub(crate) const RIPPLE: usize = 4;

/// Scale of temperature \[K\] and its middle \[°C\]: the polynomial's argument is within ±1 or so.
const SCALE_K: f64 = 50.0;
const MIDDLE_C: f64 = 25.0;

/// A test cut in two; what the sensor remembers goes on from one to the other.
pub(crate) struct Thermal {
    time: Vec<f64>,
    temperature: Vec<f64>,
    cut: usize,
    states: Vec<State>,
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
}

fn mechanism(id: &str, stage: &str, parameters: &[(&str, Prior)], starts: &[&[f64]]) -> Omission {
    Omission {
        id: id.into(),
        stage: stage.into(),
        parameters: parameters.iter().map(|(name, prior)| Parameter::new(*name, *prior)).collect(),
        choice: None,
        starts: starts.iter().map(|start| start.to_vec()).collect(),
        named: true,
        weight: 1.0,
    }
}

/// Noise of a sensor whose rows scatter by `white`: slow terms of a few times that.
pub(crate) fn coloured(white: f64) -> NoisePrior {
    NoisePrior::new((white, 0.5), (3.0 * white, 0.7), (200.0, 0.7), (1e-3 * white, 1.0))
}

/// Noise that is white alone: a fit under it is one by least squares.
pub(crate) fn plain(white: f64) -> NoisePrior {
    let none = (1e-6 * white, 1e-3);
    NoisePrior::new((white, 2.0), none, (200.0, 1e-3), (1e-9 * white, 1e-3))
}

impl Thermal {
    /// A test in time \[s\] and temperature \[°C\], its first `cut` rows being record 0 and the others record 1; `size` is that of the effects
    /// looked for and `noise` what is known of the noise, both in the sensor's unit.
    pub(crate) fn new(time: Vec<f64>, temperature: Vec<f64>, cut: usize, size: f64, noise: NoisePrior) -> Self {
        let of = |sd: f64| Prior::Normal { mean: 0.0, sd };
        let term = |name: &str| Nuisance::normal(name, 0.0, size, Role::ModelError);
        let channel = Channel { name: "rate".into(), unit: "rad/s".into(), offset: (0.0, 10.0 * size), averaging: 0.0, noise };
        let mechanisms = vec![
            mechanism("rate-and-time", "regression", &[("per_k_per_s", of(20.0 * size)), ("per_hour", of(size))], &[&[0.0, 0.0]]),
            mechanism(
                "slow-part",
                "package",
                &[("per_50_k", of(size)), ("tau_s", Prior::LogNormal { median: 600.0, spread: 1.0 })],
                &[&[0.0, 100.0], &[0.0, 500.0], &[0.0, 2000.0]],
            ),
            mechanism("drift-in-time", "ageing", &[("per_hour", of(size))], &[&[0.0]]),
            mechanism("rate-of-temperature", "package", &[("per_k_per_s", of(20.0 * size))], &[&[0.0]]),
            mechanism(
                "ripple",
                "electronics",
                &[("sine", of(size)), ("cosine", of(size)), ("period_k", Prior::LogNormal { median: 12.0, spread: 0.6 })],
                &[&[0.0, 0.0, 6.0], &[0.0, 0.0, 12.0], &[0.0, 0.0, 25.0]],
            ),
        ];
        let slope = |n: usize| {
            let (a, b) = (n.saturating_sub(3), (n + 3).min(time.len() - 1));
            (temperature[b] - temperature[a]) / (time[b] - time[a]).max(f64::MIN_POSITIVE)
        };
        let rate: Vec<f64> = (0..time.len()).map(slope).collect();
        let state = |rows: std::ops::Range<usize>| State { level: temperature[rows.clone()].to_vec(), rate: rate[rows].to_vec() };
        Self {
            states: vec![state(0..cut), state(cut..time.len())],
            time,
            temperature,
            cut,
            channels: vec![channel],
            nuisances: vec![term("linear"), term("quadratic"), term("cubic")],
            mechanisms,
        }
    }

    fn rows(&self, record: usize) -> std::ops::Range<usize> {
        if record == 0 { 0..self.cut } else { self.cut..self.time.len() }
    }

    /// A recorded series of the whole test, cut into the records.
    pub(crate) fn observations(&self, series: &[f64]) -> Vec<Observation> {
        [0, 1]
            .map(|r| Observation { time: self.time[self.rows(r)].to_vec(), channels: vec![series[self.rows(r)].to_vec()] })
            .into()
    }

    /// Response over the whole test.
    pub(crate) fn run(&self, terms: &[f64], active: &[Active]) -> Vec<f64> {
        let scaled: Vec<f64> = self.temperature.iter().map(|t| (t - MIDDLE_C) / SCALE_K).collect();
        let mut y: Vec<f64> = scaled.iter().map(|x| x * (terms[0] + x * (terms[1] + x * terms[2]))).collect();
        let rates = || self.states.iter().flat_map(|s| s.rate.iter());
        let hours = |n: usize| (self.time[n] - self.time[0]) / 3600.0;
        for Active { mechanism, values: v, .. } in active {
            match *mechanism {
                RATE_AND_TIME => y.iter_mut().zip(rates()).enumerate().for_each(|(n, (y, r))| *y += v[0] * r + v[1] * hours(n)),
                TIME => y.iter_mut().enumerate().for_each(|(n, y)| *y += v[0] * hours(n)),
                RATE => y.iter_mut().zip(rates()).for_each(|(y, r)| *y += v[0] * r),
                RIPPLE => y.iter_mut().zip(&self.temperature).for_each(|(y, t)| {
                    let (sine, cosine) = (std::f64::consts::TAU * t / v[2]).sin_cos();
                    *y += v[0] * sine + v[1] * cosine;
                }),
                _ => {
                    let mut slow = scaled[0];
                    for n in 0..y.len() {
                        let dt = if n > 0 { self.time[n] - self.time[n - 1] } else { 0.0 };
                        slow += (scaled[n] - slow) * -(-dt / v[1]).exp_m1();
                        y[n] += v[0] * (slow - scaled[n]);
                    }
                }
            }
        }
        y
    }
}

impl ForwardModel for Thermal {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, record: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        Ok(vec![self.run(nuisances, active)[self.rows(record)].to_vec()])
    }

    fn state(&self, record: usize) -> &State {
        &self.states[record]
    }
}
