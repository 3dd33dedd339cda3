//! The unit in time: modes stepped by Radau IIA, mechanics that depends on temperature and history, thermometer and gyro.

use super::build::Build;
use super::chamber::STEP;
use super::heat::{Heat, MESH, VECTORS, dot};
use super::law::Law;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, Error, Model, functionals};
use nalgebra::{DMatrix, DVector};
use std::collections::HashMap;
use std::sync::Arc;

/// Reference of ∂n/∂T's curvature and of the read-out's coefficient \[°C\].
const REFERENCE: f64 = 20.0;

pub(super) struct Plant {
    heat: Arc<Heat>,
    sensor: Vec<f64>,
    coil: Vec<f64>,
    law: Law,
    /// Quadratic form and linear part of the phase of a curved ∂n/∂T [rad per curvature].
    curvature: Option<(DMatrix<f64>, DVector<f64>)>,
    build: Build,
}

/// A unit's course every [`STEP`] seconds.
pub(super) struct Run {
    /// Reading of the thermometer \[°C\].
    pub(super) sensor: Vec<f64>,
    /// Temperature at the thermometer's place \[°C\].
    pub(super) bore: Vec<f64>,
    /// Mean of the coil \[°C\].
    pub(super) coil: Vec<f64>,
    /// Integral of the rate \[deg/h s\].
    pub(super) angle: Vec<f64>,
}

impl Plant {
    /// The plant of `build`; heat flow is taken from `like` if it is the same there.
    pub(super) fn new(build: Build, like: Option<&Self>) -> Result<Self, Error> {
        let heat = match like.filter(|other| other.build.shares_heat(&build)) {
            Some(other) => other.heat.clone(),
            None => Arc::new(Heat::new(&build.design, VECTORS)?),
        };
        Self::on(heat, build)
    }

    /// The plant of `build` with its heat flow.
    pub(super) fn on(heat: Arc<Heat>, build: Build) -> Result<Self, Error> {
        let design = &build.design;
        let model = Model::new(design, &MESH)?;
        let nominal = functionals(design, &model, &heat.model)?;
        let law = Law::new(&build, &heat, heat.total(&nominal))?;
        let curvature = if build.curvature == 0.0 { None } else { Some(phase_of_curvature(design, &model, &heat)) };
        Ok(Self { sensor: heat.onto(&nominal.thermometer), coil: heat.onto(&nominal.coil_mean), law, curvature, heat, build })
    }

    /// Runs a chamber's course from rest; a heater is switched on at its start.
    pub(super) fn run(&self, chamber: &[f64]) -> Run {
        let Heat { rates, forcing, .. } = &*self.heat;
        let drives = forcing.len();
        let heater = drives > 1;
        // drives and modes
        let mut y = vec![0.0; drives + rates.len()];
        y[0] = chamber[0];
        if heater {
            y[1] = 1.0;
            (0..rates.len()).for_each(|i| y[drives + i] = -forcing[1][i]);
        }
        let keep: Vec<f64> = rates.iter().map(|rate| radau(-rate * STEP)).collect();
        let mut law = self.law.start(&y);
        let bore = dot(&self.sensor, &y);
        let mut run = Run { sensor: vec![bore], bore: vec![bore], coil: vec![dot(&self.coil, &y)], angle: vec![0.0] };
        let (mut mechanical, mut read_out, mut lagging) = (0.0, 0.0, bore);
        let begin = self.curved(&y);
        for n in 1..chamber.len() {
            let slope = (chamber[n] - chamber[n - 1]) / STEP;
            y[0] = chamber[n];
            for (i, q) in y[drives..].iter_mut().enumerate() {
                let settled = -forcing[0][i] * slope / rates[i];
                *q = settled + keep[i] * (*q - settled);
            }
            let (bore, before, coil) = (dot(&self.sensor, &y), run.bore[n - 1], dot(&self.coil, &y));
            mechanical += law.advance(&y, run.coil[n - 1], coil);
            read_out += STEP * self.build.read_out * ((bore + before) / 2.0 - REFERENCE);
            if self.build.lag > 0.0 {
                // the trapezium rule
                let x = STEP / (2.0 * self.build.lag);
                lagging = (lagging * (1.0 - x) + x * (bore + before)) / (1.0 + x);
            } else {
                lagging = bore;
            }
            run.sensor.push(lagging);
            run.bore.push(bore);
            run.coil.push(coil);
            let phase = mechanical + self.curved(&y) - begin;
            run.angle.push(self.build.gain * phase * DEG_PER_H_PER_RAD_PER_S + read_out);
        }
        run
    }

    /// Rate of the read-out with its thermometer at rest at this temperature [deg/h].
    pub(super) fn read_out_at(&self, temperature: f64) -> f64 {
        self.build.read_out * (temperature - REFERENCE)
    }

    fn curved(&self, y: &[f64]) -> f64 {
        self.curvature.as_ref().map_or(0.0, |(form, linear)| {
            let y = DVector::from_column_slice(y);
            self.build.curvature * ((form * &y).dot(&y) / 2.0 - REFERENCE * linear.dot(&y))
        })
    }
}

/// Stability function of the two-stage Radau IIA method, third order and L-stable (E. Hairer and G. Wanner, *Solving ODEs II*, IV.5).
fn radau(z: f64) -> f64 {
    (1.0 + z / 3.0) / (1.0 - 2.0 * z / 3.0 + z * z / 6.0)
}

/// `n/(L D) Σ W (T²/2 − reference T)` over the turns and tails is the phase of a curved ∂n/∂T, eq. (1) integrated in time: its forms.
fn phase_of_curvature(design: &Design, model: &Model, heat: &Heat) -> (DMatrix<f64>, DVector<f64>) {
    let place = |p: [f64; 2]| p.map(|x| (x * 1e10).round() as i64);
    let thermal: HashMap<_, usize> = heat.model.grid().mesh().nodes().iter().enumerate().map(|(i, p)| (place(*p), i)).collect();
    let shared: Vec<usize> = model.grid().mesh().nodes().iter().map(|p| thermal[&place(*p)]).collect();
    let winding = model.winding();
    let (ccw, cw) = winding.tail_spans();
    let tails: f64 = [ccw, cw].iter().map(|(start, end)| (end - start) * (winding.length() - start - end)).sum();
    let weights = DVector::from_iterator(winding.turns().len() + 1, winding.weights().into_iter().chain([tails]));
    let at_turns = |field: &Vec<f64>| {
        let nodal: Vec<f64> = shared.iter().map(|&node| field[node]).collect();
        let mut values = model.temperature_at_turns(&nodal);
        values.push(model.temperature_at_bore(&nodal));
        DVector::from_vec(values)
    };
    let t = DMatrix::from_columns(&heat.fields.iter().map(at_turns).collect::<Vec<_>>());
    let scale = design.optics.refractive_index / (winding.length() * design.optics.sagnac_diameter);
    let weighted = DMatrix::from_fn(t.nrows(), t.ncols(), |i, j| scale * weights[i] * t[(i, j)]);
    (t.tr_mul(&weighted), t.tr_mul(&weights) * scale)
}
