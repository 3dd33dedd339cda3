//! Two sets of constituents that explain the entries alike, and the measurement that would tell them apart.

use super::emulator::Emulator;
use super::fit::minimise;
use super::response::{KNOWN, Known, Response, known, solved};
use super::search::distance;
use super::target::{Target, distances};
use super::{Parameter, Quantity};
use crate::bounds::cylinders;
use crate::{FibreCell, Role};
use std::f64::consts::PI;

/// Draws that are moved onto the best fit's entries.
const MOVED: usize = 120;
/// All of their constants are within this many standard deviations of their priors' medians.
const LIKELY: f64 = 2.0;
/// Entries are held to this many standard deviations of the best fit's.
const HELD: f64 = 0.05;
/// Two sets agree if no entry differs by more than this many standard deviations.
const AGREE: f64 = 0.3;
const MOST_CORRECTIONS: usize = 10;

/// A further measurement and what each set predicts for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// What is measured, and on what.
    pub what: String,
    /// What each of the two sets predicts, SI.
    pub values: [f64; 2],
    /// Standard deviation that such a measurement usually has, SI.
    pub error: f64,
}

impl Measurement {
    /// Distance of the two predictions in standard deviations of the measurement.
    pub fn separation(&self) -> f64 {
        (self.values[0] - self.values[1]).abs() / self.error
    }
}

/// The two draws farthest apart that give the best fit's entries, with their finite-element responses; none if fewer can be moved there.
pub(crate) fn pair(
    emulator: &mut Emulator,
    targets: &[Target],
    best: &Response,
    draws: &[Vec<f64>],
) -> Option<[(Vec<f64>, Response); 2]> {
    let goal = distances(targets, best);
    let moved = |emulator: &Emulator, from: &[f64], start: &[f64]| {
        let residuals = |u: &[f64]| {
            let found = distances(targets, &emulator.predict(u)?);
            let entries = found.iter().zip(&goal).map(|(found, goal)| (found - goal) / HELD);
            Some(entries.chain(u.iter().zip(from).map(|(u, from)| u - from)).collect())
        };
        minimise(residuals, start).map(|(u, _)| u)
    };
    let picked = (0..MOVED).filter_map(|i| draws.get(i * draws.len() / MOVED));
    let candidates: Vec<Vec<f64>> =
        picked.filter_map(|draw| moved(emulator, draw, draw)).filter(|u| u.iter().all(|u| u.abs() < LIKELY)).collect();
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for i in 0..candidates.len() {
        pairs.extend((0..i).map(|j| (distance(&candidates[i], &candidates[j]), i, j)));
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, i, j) in pairs.into_iter().take(5) {
        let mut exact = |from: &[f64]| {
            let mut u = from.to_vec();
            for _ in 0..MOST_CORRECTIONS {
                let response = solved(&emulator.family().cell(&u)?)?;
                let (known, found) = (known(&response), distances(targets, &response));
                let agrees = found.iter().zip(&goal).all(|(found, goal)| (found - goal).abs() < AGREE);
                if agrees && targets.iter().all(|t| t.is_met(t.of(&known))) {
                    return Some((u, response));
                }
                emulator.learn([(u.clone(), Some(response))]);
                u = moved(emulator, from, &u)?;
            }
            None
        };
        if let (Some(a), Some(b)) = (exact(&candidates[i]), exact(&candidates[j])) {
            return Some([a, b]);
        }
    }
    None
}

/// Every further measurement that tells two sets apart, the most telling first.
pub(crate) fn measurements(
    parameters: &[Parameter],
    targets: &[Target],
    cells: [&FibreCell; 2],
    values: [&[f64]; 2],
    known: [&Known; 2],
) -> Vec<Measurement> {
    let mut all = Vec::new();
    let mut add = |what: String, values: [f64; 2], relative: f64, absolute: f64| {
        let error = (relative * (values[0].abs() + values[1].abs()) / 2.0).hypot(absolute);
        all.push(Measurement { what, values, error });
    };
    for (i, name) in KNOWN.into_iter().enumerate().filter(|(_, name)| targets.iter().all(|t| t.name() != *name)) {
        let (relative, absolute) = match name {
            "nu_zr" | "nu_r" => (0.0, 0.01),
            "nu_rz" => (0.05, 0.0),
            "alpha_z" | "alpha_r" => (0.02, 0.0),
            "k_z" | "k_r" => (0.05, 0.0),
            _ => (0.03, 0.0),
        };
        add(format!("{name} of the coil"), [known[0][i], known[1][i]], relative, absolute);
    }
    if let [Some(a), Some(b)] = cells.map(fibre_alone) {
        add("Young's modulus of the coated fibre alone (tensile test)".into(), [a[0], b[0]], 0.01, 0.0);
        add("axial expansion of the coated fibre alone (dilatometer)".into(), [a[1], b[1]], 0.02, 0.02e-6);
        add("swelling of the coated fibre alone (diameter over temperature)".into(), [a[2], b[2]], 0.05, 0.0);
    }
    let glass: Vec<bool> = cells[0].rings.iter().map(|ring| ring.role == Role::Glass).chain([false]).collect();
    for (i, parameter) in parameters.iter().enumerate() {
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
            add(format!("{what} of the {}", parameter.phase), [values[0][i], values[1][i]], relative, absolute);
        }
    }
    all.retain(|m| m.separation().is_finite());
    all.sort_by(|a, b| b.separation().total_cmp(&a.separation()));
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
