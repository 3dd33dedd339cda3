//! The coil's chain as a forward model for diagnosis: nominal constants, their uncertainties, and the library of mechanisms.

use crate::catalogue::{Law, entries};
use crate::change::logistic;
use crate::interpolation::{linear_weights, weights};
use crate::library::{Functionals, Library, Path};
use crate::record::{Parts, Prepared};
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Error, Relaxation};
use diagnosis::{Active, Channel, ForwardModel, Mechanism, NoisePrior, Nuisance, Parameter, Prior, Role, State};
use nalgebra::DVector;
use std::cell::RefCell;
use std::collections::HashMap;
use winding::LayerDefect;

/// Temperature at which ∂n/∂T has its nominal value, and at which a read-out's temperature coefficient is zero \[°C\].
pub const REFERENCE_C: f64 = 20.0;

/// Order of the channels.
pub const SPOOL: usize = 0;
/// Order of the channels.
pub const RATE: usize = 1;

/// Order of the nuisances.
mod nuisance {
    pub(super) const GAIN: usize = 0;
    pub(super) const AIR: usize = 1;
    pub(super) const REST: usize = 2;
    pub(super) const MODULUS: usize = 3;
    pub(super) const ALPHA_R: usize = 4;
    /// E_z, α_z, spool expansion
    pub(super) const LINEAR: usize = 5;
    pub(super) const CONDUCTIVITY: usize = 8;
    pub(super) const THERMO_OPTIC: usize = 9;
    pub(super) const SHUPE: usize = 10;
}

/// Where a mechanism acts; `None` where the question makes no sense.
#[derive(Debug, Clone, PartialEq)]
pub struct Located {
    /// Part of the chain.
    pub stage: String,
    /// Temperatures of the coil \[°C\].
    pub temperature: Option<[f64; 2]>,
    /// Instants \[s\].
    pub time: Option<[f64; 2]>,
    /// Layers, 1 = innermost.
    pub layers: Option<[usize; 2]>,
}

/// A design's library and the recordings it is compared with.
pub struct Gyro {
    library: Library,
    records: Vec<Prepared>,
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    laws: Vec<Law>,
    mechanisms: Vec<Mechanism>,
    /// quadratic form of ∂n/∂T's curvature: phase per curvature \[deg/h s K²\] from drives and modes
    curvature: (nalgebra::DMatrix<f64>, DVector<f64>),
    /// functionals of rewound coils by layer (0 for none) and size, as they were asked for
    rewound: RefCell<HashMap<(usize, u64), Functionals>>,
}

impl Gyro {
    /// A forward model of `records`, each prepared by [`Prepared::new`].
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub fn new(library: Library, records: Vec<Prepared>) -> Result<Self, Error> {
        let temperatures = || records.iter().flat_map(|r| r.coil.iter().copied());
        let range = [temperatures().fold(f64::INFINITY, f64::min), temperatures().fold(f64::NEG_INFINITY, f64::max)];
        let (laws, mechanisms) = entries(&library, range).into_iter().unzip();
        let curvature = curvature(&library)?;
        let averaging = records.first().map_or(0.0, |r| r.averaging);
        Ok(Self {
            library,
            records,
            channels: channels(averaging),
            nuisances: nuisances(),
            laws,
            mechanisms,
            curvature,
            rewound: RefCell::default(),
        })
    }

    /// The design.
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// Number of a mechanism by its id.
    pub fn find(&self, id: &str) -> Option<usize> {
        self.mechanisms.iter().position(|m| m.id == id)
    }

    /// Where a mechanism acts.
    pub fn located(&self, active: &Active) -> Located {
        let v = &active.values;
        let none =
            Located { stage: self.mechanisms[active.mechanism].stage.clone(), temperature: None, time: None, layers: None };
        match self.laws[active.mechanism] {
            // nearly nine tenths of a logistic step lie within two widths
            Law::GlassTransition => Located { temperature: Some([v[0] - 2.0 * v[1], v[0] + 2.0 * v[1]]), ..none },
            Law::Debond => Located { temperature: Some([v[0], v[0] + v[1]]), ..none },
            Law::Defect => Located { layers: active.choice.map(|layer| [layer as usize; 2]), ..none },
            _ => none,
        }
    }

    /// Parts with tails or a layer's turns changed; the nominal functionals are subtracted.
    fn rewound(&self, record: &Prepared, tail: f64, defect: Option<(usize, f64)>) -> Result<Parts, Error> {
        let functionals = match defect {
            None => self.library.rewound(tail, None)?,
            Some((layer, turns)) => {
                // turns are whole; in between, the response is interpolated
                let low = turns.floor();
                let at = |turns: f64| self.with_defect(layer, turns as i32);
                let (a, b) = (at(low)?, at(low + 1.0)?);
                [0, 1, 2].map(|p: usize| &a[p] + (&b[p] - &a[p]) * (turns - low))
            }
        };
        let nominal = self.with_defect(0, 0)?;
        Ok(record.course.parts(&[0, 1, 2].map(|p: usize| &functionals[p] - &nominal[p])))
    }

    fn with_defect(&self, layer: usize, turns: i32) -> Result<Functionals, Error> {
        let key = (layer, turns as u64);
        if let Some(known) = self.rewound.borrow().get(&key) {
            return Ok(known.clone());
        }
        let defect = (layer > 0 && turns != 0).then_some(LayerDefect { layer, turns });
        let functionals = self.library.rewound(0.0, defect)?;
        self.rewound.borrow_mut().insert(key, functionals.clone());
        Ok(functionals)
    }

    /// Parts with factors on the transverse modulus and on α_r that vary from row to row, less the nominal ones.
    fn softened(&self, record: &Prepared, factors: impl Fn(usize) -> (f64, f64)) -> Parts {
        let nodes: Vec<f64> = record.modulus.iter().map(|(x, ..)| *x).collect();
        let nominal = weights(&nodes, 0.0);
        let mut change: Parts = [0, 1, 2].map(|_| vec![0.0; record.time.len()]);
        let mut known: (f64, Vec<f64>) = (f64::NAN, Vec::new());
        for n in 0..record.time.len() {
            let (modulus, expansion) = factors(n);
            if modulus == 1.0 && expansion == 1.0 {
                continue;
            }
            if modulus != known.0 {
                known = (modulus, weights(&nodes, modulus.ln()));
            }
            for (k, (_, at_nominal, per_factor)) in record.modulus.iter().enumerate() {
                let (w, w0) = (known.1[k], nominal[k]);
                for p in 0..3 {
                    change[p][n] += (w - w0) * at_nominal[p][n] + w * (expansion - 1.0) * per_factor[p][n];
                }
            }
        }
        change
    }

    fn relaxed(&self, record: &Prepared, fraction: f64, time: f64) -> Parts {
        let nodes: Vec<f64> = record.modulus.iter().map(|(x, ..)| *x).collect();
        let at: Vec<Vec<f64>> = Relaxation::nodes().iter().map(|x| weights(&nodes, (1.0 - fraction * x).ln())).collect();
        let nominal = weights(&nodes, 0.0);
        let mut relaxation = Relaxation::new(time);
        let mut change: Parts = [0, 1, 2].map(|_| vec![0.0; record.time.len()]);
        #[expect(clippy::needless_range_loop, reason = "rows of many series")]
        for n in 1..record.time.len() {
            let of = |w: &[f64]| [0, 1, 2].map(|p: usize| w.iter().zip(&record.modulus).map(|(w, m)| w * m.1[p][n]).sum::<f64>());
            let states: Vec<[f64; 3]> = at.iter().map(|w| of(w)).collect();
            let (relaxed, unrelaxed) = (relaxation.rates(&states, record.time[n] - record.time[n - 1]), of(&nominal));
            for p in 0..3 {
                change[p][n] = relaxed[p] - unrelaxed[p];
            }
        }
        change
    }

    fn opened(&self, record: &Prepared, below: f64, hysteresis: f64, share: f64) -> Parts {
        let nodes: Vec<f64> = record.openings.iter().map(|(share, _)| *share).collect();
        let w = linear_weights(&nodes, share);
        let mut change: Parts = [0, 1, 2].map(|_| vec![0.0; record.time.len()]);
        let mut open = record.coil[0] < below;
        for n in 1..record.time.len() {
            // part of the interval after a threshold is crossed, the temperature being linear in it
            let (from, to) = (record.coil[n - 1], record.coil[n]);
            let after = |threshold: f64| if to == from { 0.0 } else { ((to - threshold) / (to - from)).clamp(0.0, 1.0) };
            let part = if open {
                let closes = to > below + hysteresis;
                open = !closes;
                if closes { 1.0 - after(below + hysteresis) } else { 1.0 }
            } else {
                open = to < below;
                if open { after(below) } else { 0.0 }
            };
            if part > 0.0 {
                for (w, (_, parts)) in w.iter().zip(&record.openings).filter(|(w, _)| **w != 0.0) {
                    for p in 0..3 {
                        change[p][n] += part * w * parts[p][n];
                    }
                }
            }
        }
        change
    }

    /// Phase of a curved ∂n/∂T in every row, differenced \[deg/h per 1/K²\].
    fn curved(&self, record: &Prepared) -> Vec<f64> {
        let (form, linear) = &self.curvature;
        let states = &record.course.states;
        let phases: Vec<f64> = (0..states.nrows())
            .map(|n| {
                let s = states.row(n).transpose();
                (&s.transpose() * form * &s)[(0, 0)] / 2.0 - REFERENCE_C * linear.dot(&s)
            })
            .collect();
        // d/dt of the phase at the middle of a row's span: exact for the mean where rows are evenly spaced
        let rates = &record.course.rates;
        (0..states.nrows())
            .map(|n| {
                let dt = if n > 0 { record.time[n] - record.time[n - 1] } else { 0.0 };
                let span = if record.averaging > 0.0 { dt.min(record.averaging) } else { dt };
                if n == 0 || span < dt {
                    // after a gap: the mean over the span from the state at its end
                    let (s, r) = (states.row(n).transpose(), rates.row(n).transpose());
                    let middle = s - &r * (span / 2.0);
                    (middle.transpose() * form * &r)[(0, 0)] - REFERENCE_C * linear.dot(&r)
                } else {
                    (phases[n] - phases[n - 1]) / dt
                }
            })
            .collect()
    }
}

/// Sums that make the phase of a curved ∂n/∂T, times n/(L D) in deg/h.
fn curvature(library: &Library) -> Result<(nalgebra::DMatrix<f64>, DVector<f64>), Error> {
    let design = library.design();
    let winding = winding::wind(&design.winding)?;
    let (form, linear) = library.fields.moments(&winding);
    let scale = DEG_PER_H_PER_RAD_PER_S * design.optics.refractive_index / (winding.length() * design.optics.sagnac_diameter);
    Ok((form * scale, linear * scale))
}

fn channels(averaging: f64) -> Vec<Channel> {
    let spool = NoisePrior { white: (0.012, 0.5), drift: (0.004, 0.8), drift_time: (3000.0, 0.8), walk: (1e-6, 1.5) };
    let rate = NoisePrior { white: (0.008, 0.8), drift: (0.0025, 0.6), drift_time: (6500.0, 0.5), walk: (5e-6, 1.2) };
    vec![
        Channel { name: "spool_c".into(), unit: "degC".into(), offset_sd: 0.05, averaging: 0.0, noise: spool },
        Channel { name: "rate_deg_per_h".into(), unit: "deg/h".into(), offset_sd: 0.1, averaging, noise: rate },
    ]
}

/// What the forward model is off by: discretisation, and a start that was not quite at rest.
const GAIN_ERROR: f64 = 0.003;
const AIR_ERROR: f64 = 0.001;
/// The Shupe part is what differences of temperature within the coil leave: small, and the first to feel a coarse mesh or a coarse record.
const SHUPE_ERROR: f64 = 0.015;
const REST_ERROR_K: f64 = 0.015;

fn nuisances() -> Vec<Nuisance> {
    let spread = |name: &str, spread: f64| Nuisance {
        parameter: Parameter::new(name, Prior::LogNormal { median: 1.0, spread }),
        role: Role::Constant,
        local: false,
    };
    vec![
        Nuisance::normal("gain of the rate", 1.0, GAIN_ERROR, Role::ModelError),
        Nuisance { role: Role::ModelError, ..spread("conductivity of the surroundings (model)", AIR_ERROR) },
        Nuisance { local: true, ..Nuisance::normal("start off rest [K]", 0.0, REST_ERROR_K, Role::ModelError) },
        spread("E_r and G", 0.10),
        Nuisance::normal("alpha_r", 1.0, 0.03, Role::Constant),
        Nuisance::normal("E_z", 1.0, 0.03, Role::Constant),
        Nuisance::normal("alpha_z", 1.0, 0.03, Role::Constant),
        Nuisance::normal("spool expansion", 1.0, 0.02, Role::Constant),
        spread("conductivity of the surroundings", 0.05),
        Nuisance::normal("dn/dT", 1.0, 0.10, Role::Constant),
        Nuisance::normal("gain of the Shupe part (model)", 1.0, SHUPE_ERROR, Role::ModelError),
    ]
}

/// Change of every part and of the thermometer.
struct Change {
    parts: Parts,
    sensor: Option<Vec<f64>>,
}

fn add(to: &mut [f64], what: &[f64], factor: f64) {
    to.iter_mut().zip(what).for_each(|(t, w)| *t += factor * w);
}

/// How much of a series another one is: ⟨a, b⟩/⟨b, b⟩.
fn share(a: &[f64], b: &[f64]) -> f64 {
    let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = of(b, b);
    if size > 0.0 { of(a, b) / size } else { 0.0 }
}

impl Gyro {
    /// Changes at a value of a path's parameter.
    fn path(&self, record: &Prepared, path: Path, value: f64) -> Change {
        let n = record.time.len();
        let mut change = Change { parts: [0, 1, 2].map(|_| vec![0.0; n]), sensor: Some(vec![0.0; n]) };
        if let Some((nodes, series)) = &record.paths[path as usize] {
            for (w, series) in weights(nodes, path.coordinate(value)).into_iter().zip(series) {
                for p in 0..3 {
                    add(&mut change.parts[p], &series.parts[p], w);
                }
                if let Some(sensor) = &mut change.sensor {
                    add(sensor, &series.sensor, w);
                }
            }
        }
        change
    }

    /// What a mechanism changes in the chain up to the optics.
    fn change(&self, record: &Prepared, law: Law, active: &Active) -> Result<Option<Change>, Error> {
        let v = &active.values;
        let parts = |parts: Parts| Ok(Some(Change { parts, sensor: None }));
        match law {
            Law::Tail => parts(self.rewound(record, v[0], None)?),
            Law::Defect => {
                let layer = active.choice.unwrap_or(1.0) as usize;
                parts(self.rewound(record, 0.0, Some((layer, v[0].clamp(-MOST_TURNS, MOST_TURNS))))?)
            }
            Law::Polymer => Ok(Some(self.path(record, Path::Polymer, v[0]))),
            Law::HubResistance => Ok(Some(self.path(record, Path::HubResistance, v[0]))),
            Law::Air => Ok(Some(self.path(record, Path::Air, v[0]))),
            Law::Mount => Ok(Some(self.path(record, Path::Mount, v[0]))),
            Law::GlassTransition => {
                let coil = &record.coil;
                parts(self.softened(record, |n| {
                    let middle = (coil[n] + coil[n.saturating_sub(1)]) / 2.0;
                    let s = logistic((middle - v[0]) / v[1]);
                    (1.0 + (v[2] - 1.0) * s, 1.0 + (v[3] - 1.0) * s)
                }))
            }
            Law::Relaxation => parts(self.relaxed(record, v[0], v[1])),
            Law::Debond => parts(self.opened(record, v[0], v[1], v[2])),
            Law::SelfHeating => Ok(record.heater.as_ref().zip(self.library.heater.as_ref()).map(|(heater, model)| {
                let series = heater.at(model, v[1]);
                let scaled = |s: &[f64]| s.iter().map(|x| v[0] * x).collect::<Vec<f64>>();
                Change { parts: [0, 1, 2].map(|p: usize| scaled(&series.parts[p])), sensor: Some(scaled(&series.sensor)) }
            })),
            Law::Curvature => {
                let zero = vec![0.0; record.time.len()];
                parts([self.curved(record).iter().map(|c| v[0] * c).collect(), zero.clone(), zero])
            }
            Law::SensorLag | Law::ReadOut => Ok(None),
        }
    }
}

/// More turns than this in one layer are no defect but another design.
const MOST_TURNS: f64 = 40.0;

impl ForwardModel for Gyro {
    type Error = Error;

    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Mechanism] {
        &self.mechanisms
    }

    fn respond(&self, record: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Error> {
        let record = &self.records[record];
        let nominal = &record.nominal.parts;
        let mut parts = nominal.clone();
        let mut sensor = record.nominal.sensor.clone();
        // the design's own constants
        let mut recalibrated: Vec<Change> = Vec::new();
        let (modulus, alpha) = (nuisances[nuisance::MODULUS], nuisances[nuisance::ALPHA_R]);
        if (modulus != 1.0 || alpha != 1.0) && !record.modulus.is_empty() {
            recalibrated.push(Change { parts: self.softened(record, |_| (modulus, alpha)), sensor: None });
        }
        for (k, of) in record.constants.iter().enumerate() {
            let by = nuisances[nuisance::LINEAR + k] - 1.0;
            for p in 0..3 {
                add(&mut parts[p], &of[p], by);
            }
        }
        let air = nuisances[nuisance::AIR] * nuisances[nuisance::CONDUCTIVITY];
        if air != 1.0 {
            recalibrated.push(self.path(record, Path::Air, air));
        }
        let thermo_optic = {
            let o = &self.library.design().optics;
            let (a, b) = (o.thermo_optic, o.refractive_index * o.thermal_expansion);
            (a * nuisances[nuisance::THERMO_OPTIC] + b) / (a + b)
        };
        let shupe = thermo_optic * nuisances[nuisance::SHUPE];
        parts[0].iter_mut().for_each(|s| *s *= shupe);
        let rest = nuisances[nuisance::REST];
        parts.iter_mut().zip(&record.off_rest.parts).for_each(|(part, change)| add(part, change, rest));
        add(&mut sensor, &record.off_rest.sensor, rest);
        for change in &recalibrated {
            parts.iter_mut().zip(&change.parts).for_each(|(part, change)| add(part, change, 1.0));
            if let Some(s) = &change.sensor {
                add(&mut sensor, s, 1.0);
            }
        }
        // mechanisms act on a coil that has the others: each one's gain on a part acts on the others' changes, too
        let mut gain: [f64; 3] = [0, 1, 2].map(|p: usize| share(&parts[p], &nominal[p]));
        for active in active {
            let Some(change) = self.change(record, self.laws[active.mechanism], active)? else { continue };
            for p in 0..3 {
                let own = share(&change.parts[p], &nominal[p]);
                let scaled = gain[p];
                // what was there grows by this one's gain; what this adds beyond its gain grows by what was there
                for (n, part) in parts[p].iter_mut().enumerate() {
                    let beyond = change.parts[p][n] - own * nominal[p][n];
                    *part += own * *part + scaled * beyond;
                }
                gain[p] *= 1.0 + own;
            }
            if let Some(s) = &change.sensor {
                add(&mut sensor, s, 1.0);
            }
        }
        let mut rate: Vec<f64> =
            (0..sensor.len()).map(|n| nuisances[nuisance::GAIN] * (parts[0][n] + parts[1][n] + parts[2][n])).collect();
        for active in active {
            match self.laws[active.mechanism] {
                Law::ReadOut => {
                    for (n, rate) in rate.iter_mut().enumerate() {
                        *rate += active.values[0] * ((sensor[n] + sensor[n.saturating_sub(1)]) / 2.0 - REFERENCE_C);
                    }
                }
                Law::SensorLag => sensor = lagged(&record.time, &sensor, active.values[0]),
                _ => {}
            }
        }
        Ok(vec![sensor, rate])
    }

    fn state(&self, record: usize) -> &State {
        &self.records[record].state
    }
}

/// A first-order follower of a series that is linear between its instants, exact; it starts settled.
fn lagged(time: &[f64], series: &[f64], lag: f64) -> Vec<f64> {
    let mut x = series[0];
    let mut followed = vec![x];
    for n in 1..series.len() {
        let dt = time[n] - time[n - 1];
        let slope = (series[n] - series[n - 1]) / dt;
        let forget = (-dt / lag).exp();
        // x − (series − slope lag) decays
        x = series[n] - slope * lag + (x - series[n - 1] + slope * lag) * forget;
        followed.push(x);
    }
    followed
}
