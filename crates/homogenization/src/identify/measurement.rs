//! The next measurement.

use super::emulator::Emulator;
use super::response::{KNOWN, Known, known};
use super::{Family, Fit, Quantity, Target};
use crate::bounds::cylinders;
use crate::{FibreCell, Role};
use std::f64::consts::PI;

/// Draws whose predictions make up a spread.
const DRAWS: usize = 300;

/// A further measurement and what is predicted for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// The quantity to measure, and its specimen.
    pub what: String,
    /// Prediction of each of the two sets, SI.
    pub values: [f64; 2],
    /// Standard deviation of the posterior's predictions, SI.
    pub spread: f64,
    /// Standard deviation that such a measurement usually has, SI.
    pub error: f64,
}

impl Measurement {
    /// Distance of the two predictions in standard deviations of the measurement.
    pub fn separation(&self) -> f64 {
        (self.values[0] - self.values[1]).abs() / self.error
    }

    /// Spread of the posterior's predictions in standard deviations of the measurement: what it would teach.
    pub fn power(&self) -> f64 {
        self.spread / self.error
    }
}

/// Something that can be measured, its value in a cell and its usual error: a share of the value and an absolute one.
struct Quantified {
    what: String,
    value: f64,
    relative: f64,
    absolute: f64,
}

/// Every further measurement, the one with the most power first.
pub(crate) fn measurements(emulator: &Emulator, targets: &[Target], sets: [&Fit; 2], draws: &[Vec<f64>]) -> Vec<Measurement> {
    let family = emulator.family;
    let of = |cell: &FibreCell, values: &[f64], known: &Known| quantities(family, targets, cell, values, known);
    let [a, b] = sets.map(|set| of(&set.cell, &set.values, &set.known));
    let picked = (0..DRAWS.min(draws.len())).map(|i| &draws[i * draws.len() / DRAWS.min(draws.len())]);
    let predicted: Vec<Vec<Quantified>> = picked
        .filter_map(|u| {
            let values: Vec<f64> = family.parameters().iter().zip(u).map(|(p, u)| p.prior.value(*u)).collect();
            Some(of(&family.cell(u)?, &values, &known(&emulator.predict(u)?)))
        })
        .collect();
    let measurement = |(i, (a, b)): (usize, (Quantified, Quantified))| {
        let n = predicted.len() as f64;
        let mean = predicted.iter().map(|all| all[i].value).sum::<f64>() / n;
        let spread = (predicted.iter().map(|all| (all[i].value - mean).powi(2)).sum::<f64>() / n).sqrt();
        let error = (a.relative * (a.value.abs() + b.value.abs()) / 2.0).hypot(a.absolute);
        Measurement { what: a.what, values: [a.value, b.value], spread, error }
    };
    let mut all: Vec<Measurement> = a.into_iter().zip(b).enumerate().map(measurement).collect();
    all.retain(|m| m.power().is_finite());
    all.sort_by(|a, b| b.power().total_cmp(&a.power()));
    all
}

/// All further quantities that can be measured on a cell; NaN for those that it does not have.
fn quantities(family: &Family, targets: &[Target], cell: &FibreCell, values: &[f64], known: &Known) -> Vec<Quantified> {
    let mut all = Vec::new();
    let mut add = |what: String, value: f64, relative: f64, absolute: f64| {
        all.push(Quantified { what, value, relative, absolute });
    };
    for (i, name) in KNOWN.into_iter().enumerate().filter(|(_, name)| targets.iter().all(|t| t.name() != *name)) {
        let (relative, absolute) = match name {
            "nu_zr" | "nu_r" => (0.0, 0.01),
            "nu_rz" => (0.05, 0.0),
            "alpha_z" | "alpha_r" => (0.02, 0.0),
            "k_z" | "k_r" => (0.05, 0.0),
            _ => (0.03, 0.0),
        };
        add(format!("{name} of the coil"), known[i], relative, absolute);
    }
    let [modulus, axial, swelling] = fibre_alone(cell).unwrap_or([f64::NAN; 3]);
    add("Young's modulus of the coated fibre alone (tensile test)".into(), modulus, 0.01, 0.0);
    add("axial expansion of the coated fibre alone (dilatometer)".into(), axial, 0.02, 0.02e-6);
    add("swelling of the coated fibre alone (diameter over temperature)".into(), swelling, 0.05, 0.0);
    let glass: Vec<bool> = cell.rings.iter().map(|ring| ring.role == Role::Glass).chain([false]).collect();
    for (i, parameter) in family.parameters().into_iter().enumerate() {
        let (what, relative, absolute) = match parameter.quantity {
            Quantity::YoungsModulus => ("Young's modulus", 0.1, 0.0),
            Quantity::BulkModulus => ("bulk modulus (ultrasound)", 0.05, 0.0),
            Quantity::PoissonRatio => ("Poisson's ratio", 0.0, 0.01),
            Quantity::ThermalExpansion => ("expansion", 0.05, 0.0),
            Quantity::Conductivity => ("conductivity", 0.05, 0.0),
            Quantity::OuterDiameter => ("outer diameter (microscope)", 0.0, 0.5e-6),
        };
        // the glass is known better than any of these measures it
        if parameter.quantity == Quantity::OuterDiameter || !glass.get(i / 4).copied().unwrap_or(false) {
            add(format!("{what} of the {}", parameter.phase), values[i], relative, absolute);
        }
    }
    all
}

/// Young's modulus and the expansions along and across of the coated fibre without adhesive, exactly; `None` for a bare fibre.
fn fibre_alone(cell: &FibreCell) -> Option<[f64; 3]> {
    let (outer, inner) = cell.rings.split_last().filter(|(_, inner)| inner.iter().any(|ring| ring.role == Role::Glass))?;
    // the cell whose circle of equal area is the fibre
    let pitch = outer.outer_radius * (PI / 0.75_f64.sqrt()).sqrt();
    let fibre = FibreCell { packing: crate::Packing::Hexagonal, pitch, rings: inner.to_vec(), adhesive: outer.constituent };
    let constants = cylinders(&fibre).ok()?.constants()?;
    Some([constants.e_z, constants.alpha_z, constants.alpha_r])
}
