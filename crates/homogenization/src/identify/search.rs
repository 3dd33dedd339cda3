//! The best cell of a family: many starts on the emulator, the promising ones refined with the solved cell.

use super::emulator::Emulator;
use super::fit::minimise;
use super::outcome::ORDINARY;
use super::response::{Response, known, solved};
use super::target::{Target, beyond, distances};
use crate::random::Random;

const STARTS: usize = 60;
const REFINED: usize = 8;
/// Minima closer than this, in prior standard deviations, are one.
const SAME: f64 = 0.5;
const MOST_REFINEMENTS: usize = 12;
/// The emulator is right where it misses every entry by less than this many standard deviations of it.
const RIGHT: f64 = 0.03;

/// The demand that a fit gives way to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Demand {
    /// Every entry is met if it can be, however far from the priors.
    Data,
    /// Every constant stays ordinary, whatever entries are missed.
    Ordinary,
}

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

/// Starts drawn from the priors of `dimensions` parameters, in prior standard deviations.
pub fn starts(dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::new(seed);
    (0..STARTS).map(|_| random.normals(dimensions)).collect()
}

/// The minima found, the best first; none if no cell can be solved. `told` how many of how many starts are refined.
pub(crate) fn search(
    emulator: &mut Emulator,
    targets: &[Target],
    demand: Demand,
    starts: &[Vec<f64>],
    told: &dyn Fn(usize, usize),
) -> Vec<Found> {
    let on_emulator =
        |emulator: &Emulator, start: &[f64]| minimise(|u| emulator.predict(u).map(|y| residuals(targets, demand, u, &y)), start);
    let mut minima: Vec<_> = starts.iter().filter_map(|start| on_emulator(emulator, start)).collect();
    minima.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut promising: Vec<Vec<f64>> = Vec::new();
    for (u, _) in minima {
        if promising.len() < REFINED && promising.iter().all(|other| distance(other, &u) > SAME) {
            promising.push(u);
        }
    }
    let mut found: Vec<Found> = Vec::new();
    let count = promising.len();
    for (refined, mut start) in promising.into_iter().enumerate() {
        told(refined, count);
        let mut best: Option<Found> = None;
        for _ in 0..MOST_REFINEMENTS {
            let Some((u, _)) = on_emulator(emulator, &start) else { break };
            let (Some(predicted), Some(cell)) = (emulator.predict(&u), emulator.family.cell(&u)) else { break };
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

pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
