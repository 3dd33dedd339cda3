//! Two sets of constituents that explain the entries alike.

use super::emulator::Emulator;
use super::fit::minimise;
use super::response::{Response, known, solved};
use super::search::distance;
use super::target::{Target, distances};

/// Draws that are moved onto the best fit's entries.
const MOVED: usize = 120;
/// All of their constants are within this many standard deviations of their priors' medians.
const LIKELY: f64 = 2.0;
/// Entries are held to this many standard deviations of the best fit's.
const HELD: f64 = 0.05;
/// Two sets agree if no entry differs by more than this many standard deviations.
const AGREE: f64 = 0.3;
const MOST_CORRECTIONS: usize = 10;

/// The two draws farthest apart that give the best fit's entries, with their responses; none if fewer can be moved there.
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
                let response = solved(&emulator.family.cell(&u)?)?;
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
