//! What each mechanism changes, computed from a library's models under the chamber of a recording.

use crate::REFERENCE_C;
use crate::beyond;
use crate::catalogue::Law;
use crate::change::logistic;
use crate::interpolation::{cubic_weights, weights};
use crate::library::{Functionals, Library, Path};
use crate::record::{Parts, Prepared};
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Error, Relaxation};
use diagnosis::Active;
use nalgebra::DVector;
use std::cell::RefCell;
use std::collections::HashMap;
use winding::LayerDefect;

/// What a mechanism changes.
pub(crate) struct Change {
    pub(crate) parts: Parts,
    pub(crate) sensor: Option<Vec<f64>>,
    /// of the output, beside the parts
    pub(crate) rate: Option<Vec<f64>>,
    /// share of every nominal part in the change of that part
    pub(crate) gain: [f64; 3],
}

impl Change {
    pub(crate) fn none(record: &Prepared) -> Self {
        Self { parts: [0, 1, 2].map(|_| vec![0.0; record.time.len()]), sensor: None, rate: None, gain: [0.0; 3] }
    }
}

pub(crate) fn add(to: &mut [f64], what: &[f64], factor: f64) {
    to.iter_mut().zip(what).for_each(|(t, w)| *t += factor * w);
}

/// How much of a series another one is: ⟨a, b⟩/⟨b, b⟩.
pub(crate) fn share(a: &[f64], b: &[f64]) -> f64 {
    let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = of(b, b);
    if size > 0.0 { of(a, b) / size } else { 0.0 }
}

/// More turns than this, or than half of a layer's, are no defect but another design.
const MOST_TURNS: f64 = 40.0;

/// A library with what is worked out from it once for all recordings.
pub(crate) struct Laws {
    pub(crate) library: Library,
    /// quadratic form of ∂n/∂T's curvature: phase per curvature \[deg/h s K²\] from drives and modes
    curvature: (nalgebra::DMatrix<f64>, DVector<f64>),
    /// functionals of rewound coils by layer (0 for none) and size, as they were asked for
    rewound: RefCell<HashMap<(usize, u64), Functionals>>,
}

impl Laws {
    pub(crate) fn new(library: Library) -> Result<Self, Error> {
        Ok(Self { curvature: curvature(&library)?, library, rewound: RefCell::default() })
    }

    /// Changes at a value of a path's parameter.
    pub(crate) fn path(&self, record: &Prepared, path: Path, value: f64) -> Change {
        let n = record.time.len();
        let mut change = Change { sensor: Some(vec![0.0; n]), ..Change::none(record) };
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
    pub(crate) fn change(&self, record: &Prepared, law: Law, active: &Active) -> Result<Change, Error> {
        let v = &active.values;
        let parts = |parts: Parts| Ok(Change { parts, ..Change::none(record) });
        match law {
            Law::Tail => parts(self.rewound(record, v[0], None)?),
            Law::Defect => {
                let layer = active.choice.unwrap_or(1.0) as usize;
                let most = MOST_TURNS.min((self.library.design().winding.turns_even_layers / 2) as f64 - 1.0).max(0.0);
                parts(self.rewound(record, 0.0, Some((layer, v[0].clamp(-most, most))))?)
            }
            Law::Polymer => Ok(self.path(record, Path::Polymer, v[0])),
            Law::HubResistance => Ok(self.path(record, Path::HubResistance, v[0])),
            Law::Air => Ok(self.path(record, Path::Air, v[0])),
            Law::Mount => Ok(self.path(record, Path::Mount, v[0])),
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
            Law::SelfHeating => {
                let Some((heater, model)) = record.heater.as_ref().zip(self.library.heater.as_ref()) else {
                    return Ok(Change::none(record));
                };
                let series = heater.at(model, v[1]);
                let scaled = |s: &[f64]| s.iter().map(|x| v[0] * x).collect::<Vec<f64>>();
                let parts = [0, 1, 2].map(|p: usize| scaled(&series.parts[p]));
                Ok(Change { parts, sensor: Some(scaled(&series.sensor)), ..Change::none(record) })
            }
            Law::Curvature => {
                let zero = vec![0.0; record.time.len()];
                parts([self.curved(record).iter().map(|c| v[0] * c).collect(), zero.clone(), zero])
            }
            Law::SensorLag | Law::ReadOut => Ok(Change::none(record)),
            _ => Ok(beyond::change(record, law, v)),
        }
    }

    /// Parts with tails or a layer's turns changed; the nominal functionals are subtracted.
    pub(crate) fn rewound(&self, record: &Prepared, tail: f64, defect: Option<(usize, f64)>) -> Result<Parts, Error> {
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
    pub(crate) fn softened(&self, record: &Prepared, factors: impl Fn(usize) -> (f64, f64)) -> Parts {
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
        // nothing open changes nothing
        let nodes: Vec<f64> = std::iter::once(0.0).chain(record.openings.iter().map(|(share, _)| *share)).collect();
        let w = &cubic_weights(&nodes, share.clamp(0.0, nodes[nodes.len() - 1]))[1..];
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
    pub(crate) fn curved(&self, record: &Prepared) -> Vec<f64> {
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

/// A first-order follower of a series that is linear between its instants, exact; it starts settled.
pub(crate) fn lagged(time: &[f64], series: &[f64], lag: f64) -> Vec<f64> {
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
