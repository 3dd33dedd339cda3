//! Regions of the posterior that lie apart: a chain stays in the one it starts in, so each is sampled and weighed on its own.

use super::emulator::Emulator;
use super::sample::chain;
use super::search::Found;
use super::target::{Target, Uncertainty, distances};
use nalgebra::{Cholesky, DMatrix};
use std::thread;

/// A minimum this much worse than the best (in ln posterior density) is left out.
const WORSE: f64 = 8.0;
/// A region with less weight is left out.
const NEGLIGIBLE: f64 = 1e-3;
const MOST_REGIONS: usize = 4;
/// Fewest chains, so that both of two processors work.
const CHAINS: usize = 2;
const BATCHES: usize = 32;

/// A region that explains the entries.
#[derive(Debug, Clone)]
pub struct Region {
    /// Its probability (Laplace–Metropolis estimate, S. M. Lewis and A. E. Raftery, *J. Am. Stat. Assoc.* 92, 648, 1997).
    pub weight: f64,
    /// Point of the highest density, in prior standard deviations.
    pub centre: Vec<f64>,
    /// Share of proposals accepted.
    pub acceptance: f64,
    /// Least number of independent draws of any parameter that its draws are worth (batch means).
    pub effective_draws: f64,
    draws: Vec<Vec<f64>>,
    log_evidence: f64,
}

/// The minima that chains may start from: nearly as good as the best, and within every rounding interval.
pub(crate) fn starts<'a>(targets: &[Target], minima: &'a [Found]) -> Vec<&'a Found> {
    let inside = |found: &Found| {
        let distances = distances(targets, &found.response);
        targets.iter().zip(distances).all(|(t, d)| match t.uncertainty {
            Uncertainty::Rounded(_) => d.abs() < 3.0_f64.sqrt(),
            Uncertainty::Normal(_) => true,
        })
    };
    let least = minima.first().map_or(0.0, |best| best.cost);
    minima.iter().filter(|found| found.cost < least + WORSE && inside(found)).take(MOST_REGIONS).collect()
}

/// The regions about `starts`, the likeliest first, with `trajectories` shared among their chains.
pub(crate) fn sample(emulator: &Emulator, targets: &[Target], starts: &[&Found], trajectories: usize, seed: u64) -> Vec<Region> {
    let each = CHAINS.div_ceil(starts.len().max(1));
    let steps = trajectories / (each * starts.len().max(1));
    let chains: Vec<_> = thread::scope(|scope| {
        let run = |i: usize| chain(emulator, targets, &starts[i / each].u, steps, seed + i as u64);
        let handles: Vec<_> = (0..each * starts.len()).map(|i| scope.spawn(move || run(i))).collect();
        handles.into_iter().map(|handle| handle.join().ok().flatten()).collect()
    });
    let mut regions: Vec<Region> = Vec::new();
    for (start, chains) in starts.iter().zip(chains.chunks(each)) {
        let chains: Vec<_> = chains.iter().flatten().collect();
        if chains.is_empty() {
            continue;
        }
        let draws: Vec<Vec<f64>> = chains.iter().flat_map(|c| c.draws.clone()).collect();
        let acceptance = chains.iter().map(|c| c.acceptance).sum::<f64>() / chains.len() as f64;
        let Some(log_volume) = log_volume(&draws) else { continue };
        let region = Region {
            weight: 0.0,
            centre: start.u.clone(),
            acceptance,
            effective_draws: effective(&draws),
            draws,
            log_evidence: log_volume - start.cost,
        };
        if regions.iter().all(|other| apart(&other.draws, &region.draws)) {
            regions.push(region);
        }
    }
    weigh(&mut regions);
    regions.retain(|region| region.weight > NEGLIGIBLE);
    weigh(&mut regions);
    regions
}

fn weigh(regions: &mut [Region]) {
    let most = regions.iter().map(|r| r.log_evidence).fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = regions.iter().map(|r| (r.log_evidence - most).exp()).sum();
    regions.iter_mut().for_each(|r| r.weight = (r.log_evidence - most).exp() / sum);
    regions.sort_by(|a, b| b.weight.total_cmp(&a.weight));
}

/// About `count` draws of all regions, of each by its weight; `None` if there is no region.
pub(crate) fn pooled(regions: &[Region], count: usize) -> Option<Vec<Vec<f64>>> {
    let of = |region: &Region| {
        let share = (region.weight * count as f64).round() as usize;
        (0..share).map(|i| region.draws[i * region.draws.len() / share].clone()).collect::<Vec<_>>()
    };
    let all: Vec<_> = regions.iter().flat_map(of).collect();
    (!all.is_empty()).then_some(all)
}

pub(super) fn mean_and_deviation(draws: &[Vec<f64>], j: usize) -> (f64, f64) {
    let n = draws.len() as f64;
    let mean = draws.iter().map(|u| u[j]).sum::<f64>() / n;
    (mean, (draws.iter().map(|u| (u[j] - mean).powi(2)).sum::<f64>() / n).sqrt())
}

/// Whether some parameter's means lie farther apart than the wider of its spreads.
fn apart(a: &[Vec<f64>], b: &[Vec<f64>]) -> bool {
    (0..a.first().map_or(0, Vec::len)).any(|j| {
        let ((mean_a, sd_a), (mean_b, sd_b)) = (mean_and_deviation(a, j), mean_and_deviation(b, j));
        (mean_a - mean_b).abs() > sd_a.max(sd_b)
    })
}

/// Half the logarithm of the determinant of the draws' covariance.
fn log_volume(draws: &[Vec<f64>]) -> Option<f64> {
    let (n, d) = (draws.len(), draws.first()?.len());
    let means: Vec<f64> = (0..d).map(|j| mean_and_deviation(draws, j).0).collect();
    let centred = DMatrix::from_fn(n, d, |i, j| draws[i][j] - means[j]);
    let covariance = Cholesky::new(centred.transpose() * &centred / n as f64)?;
    Some(covariance.l().diagonal().iter().map(|l| l.ln()).sum())
}

/// Least effective number of draws of any parameter, by the variance of the means of batches.
fn effective(draws: &[Vec<f64>]) -> f64 {
    let size = (draws.len() / BATCHES).max(1);
    let of = |j: usize| {
        let means: Vec<Vec<f64>> = draws.chunks_exact(size).map(|batch| vec![mean_and_deviation(batch, j).0]).collect();
        let ratio = mean_and_deviation(draws, j).1 / mean_and_deviation(&means, 0).1;
        means.len() as f64 * ratio * ratio
    };
    (0..draws.first().map_or(0, Vec::len)).map(of).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two independent directions of standard deviation 2 and 3, far from zero: √det = 6. Of draws on a line there is no volume.
    #[test]
    fn exact_a_volume_is_that_of_the_spread_wherever_it_lies() {
        let corners = [(2.0, 3.0), (2.0, -3.0), (-2.0, 3.0), (-2.0, -3.0)];
        let draws: Vec<Vec<f64>> = corners.map(|(x, y)| vec![50.0 + x, y - 70.0]).to_vec();
        assert!((log_volume(&draws).unwrap() - 6.0_f64.ln()).abs() < 1e-12);
        assert_eq!(log_volume(&[vec![1.0, 1.0], vec![1.0, 1.0]]), None);
    }

    #[test]
    fn exact_weights_are_shares_of_the_evidence_however_small_it_is() {
        for offset in [0.0, 3.0, -5000.0, 5000.0] {
            let region = |odds: f64| Region {
                weight: 0.0,
                centre: vec![odds],
                acceptance: 1.0,
                effective_draws: 1.0,
                draws: Vec::new(),
                log_evidence: offset + odds.ln(),
            };
            let mut regions = [region(1.0), region(3.0)];
            weigh(&mut regions);
            for (region, [odds, weight]) in regions.iter().zip([[3.0, 0.75], [1.0, 0.25]]) {
                assert!(region.centre == [odds] && (region.weight - weight).abs() < 1e-11, "{region:?} at {offset}");
            }
        }
    }
}
