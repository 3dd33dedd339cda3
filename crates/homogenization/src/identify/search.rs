//! The best cell of a family: many starts on the emulator, the promising ones refined with finite elements.

use super::ORDINARY;
use super::emulator::Emulator;
use super::fit::minimise;
use super::random::Random;
use super::response::{Response, known, solved};
use super::target::{Target, beyond, distances};

/// Starts drawn from the priors.
const STARTS: usize = 60;
/// Starts that are refined.
const REFINED: usize = 8;
/// Minima closer than this, in prior standard deviations, are one.
const SAME: f64 = 0.5;
const MOST_REFINEMENTS: usize = 12;
/// The emulator is right where it misses every entry by less than this many standard deviations of it.
const RIGHT: f64 = 0.03;

/// What a fit gives way to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Demand {
    /// Every entry is met if it can be, however far from the priors.
    Data,
    /// Every constant stays ordinary, whatever entries are missed.
    Ordinary,
}

/// A cell found, with its finite-element response.
#[derive(Debug, Clone)]
pub(crate) struct Found {
    pub(crate) u: Vec<f64>,
    pub(crate) response: Response,
    pub(crate) cost: f64,
}

/// Residuals of the entries, then of the priors.
fn residuals(targets: &[Target], demand: Demand, u: &[f64], y: &Response) -> Vec<f64> {
    let known = known(y);
    let entries = targets.iter().map(|t| match demand {
        Demand::Data => t.residual(t.of(&known)),
        Demand::Ordinary => beyond(t.distance(t.of(&known)), 1.0),
    });
    let priors = u.iter().map(|&u| match demand {
        Demand::Data => u,
        Demand::Ordinary => 0.05 * u + 300.0 * beyond(u, 0.99 * ORDINARY),
    });
    entries.chain(priors).collect()
}

/// The minima found, the best first; none if the finite elements answer for no cell.
pub(crate) fn search(emulator: &mut Emulator, targets: &[Target], demand: Demand, random: &mut Random) -> Vec<Found> {
    let dimensions = emulator.family().parameters().len();
    let on_emulator =
        |emulator: &Emulator, start: &[f64]| minimise(|u| emulator.predict(u).map(|y| residuals(targets, demand, u, &y)), start);
    let mut minima: Vec<_> = (0..STARTS).filter_map(|_| on_emulator(emulator, &random.normals(dimensions))).collect();
    minima.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut starts: Vec<Vec<f64>> = Vec::new();
    for (u, _) in minima {
        if starts.len() < REFINED && starts.iter().all(|other| distance(other, &u) > SAME) {
            starts.push(u);
        }
    }
    let mut found: Vec<Found> = Vec::new();
    for mut start in starts {
        let mut best: Option<Found> = None;
        for _ in 0..MOST_REFINEMENTS {
            let Some((u, _)) = on_emulator(emulator, &start) else { break };
            let (Some(predicted), Some(cell)) = (emulator.predict(&u), emulator.family().cell(&u)) else { break };
            let Some(response) = solved(&cell) else { break };
            let cost = residuals(targets, demand, &u, &response).iter().map(|r| r * r).sum::<f64>() / 2.0;
            if best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Found { u: u.clone(), response, cost });
            }
            emulator.learn([(u.clone(), Some(response))]);
            if worst(targets, &predicted, &response) < RIGHT {
                break;
            }
            start = u;
        }
        found.extend(best);
    }
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut apart: Vec<Found> = Vec::new();
    for next in found {
        if apart.iter().all(|other| distance(&other.u, &next.u) > SAME) {
            apart.push(next);
        }
    }
    apart
}

/// Largest difference of an entry between two responses, in its standard deviations.
fn worst(targets: &[Target], a: &Response, b: &Response) -> f64 {
    distances(targets, a).iter().zip(distances(targets, b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Euclidean distance.
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
