//! Posterior distribution, after the measurement.

use super::emulator::Emulator;
use super::fit::jacobian;
use super::region::{self, Region};
use super::response::{Response, solved_all};
use super::search::Found;
use super::target::{Target, distances};
use nalgebra::{Cholesky, DMatrix, DVector};

/// Rounds in which the emulator learns at draws of its own: trajectories of all chains, and draws solved.
const TRAINING: [(usize, usize); 3] = [(120, 40), (300, 60), (600, 80)];
/// Trajectories of the last chains together.
const TRAJECTORIES: usize = 3000;
const DRAWS: usize = 2700;

/// Draws of a family's parameters given the targets, in prior standard deviations.
#[derive(Debug, Clone)]
pub struct Posterior {
    /// The draws.
    pub draws: Vec<Vec<f64>>,
    /// Regions apart from each other that explain the entries, the likeliest first.
    pub regions: Vec<Region>,
    /// Share of the chains' proposals accepted.
    pub acceptance: f64,
    /// Least number of independent draws of any parameter that those of any region are worth (batch means).
    pub effective_draws: f64,
    /// How far the emulator's error moved the draws of its last round before it learned from them: the median, in prior standard
    /// deviations.
    pub emulator_error: f64,
    /// Directions in the space of the parameters by how well the entries fix them, at the best fit.
    pub directions: Vec<Direction>,
}

/// A combination of parameters that the entries see apart from all others.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// Change of the entries in their standard deviations per prior standard deviation along it (singular value).
    pub gain: f64,
    /// Its components along the parameters, of unit length.
    pub along: Vec<f64>,
}

impl Direction {
    /// Posterior over prior standard deviation along it, linearised.
    pub fn shrinkage(&self) -> f64 {
        1.0 / (1.0 + self.gain * self.gain).sqrt()
    }
}

impl Posterior {
    /// The central interval of parameter `j` that holds `probability`, in prior standard deviations.
    pub fn interval(&self, j: usize, probability: f64) -> [f64; 2] {
        central(self.draws.iter().map(|u| u[j]).collect(), probability)
    }

    /// The central interval of the combination `along` of parameters that holds `probability`, in prior standard deviations.
    pub fn interval_along(&self, along: &[f64], probability: f64) -> [f64; 2] {
        central(self.draws.iter().map(|u| u.iter().zip(along).map(|(u, a)| u * a).sum()).collect(), probability)
    }

    /// Directions along which the entries say more than the priors (gain above one).
    pub fn rank(&self) -> usize {
        self.directions.iter().filter(|d| d.gain > 1.0).count()
    }

    /// Standard deviation of parameter `j`: what is left of one.
    pub fn deviation(&self, j: usize) -> f64 {
        region::mean_and_deviation(&self.draws, j).1
    }

    /// Central intervals, all of the same tail probability, that hold all parameters together with `probability`.
    pub fn simultaneous(&self, probability: f64) -> Vec<[f64; 2]> {
        let (n, dimensions) = (self.draws.len(), self.draws.first().map_or(0, Vec::len));
        let mut least = vec![1.0_f64; n];
        let mut columns = Vec::with_capacity(dimensions);
        for j in 0..dimensions {
            let mut order: Vec<usize> = (0..n).collect();
            order.sort_by(|a, b| self.draws[*a][j].total_cmp(&self.draws[*b][j]));
            for (rank, &draw) in order.iter().enumerate() {
                let below = (rank as f64 + 0.5) / n as f64;
                least[draw] = least[draw].min(below.min(1.0 - below));
            }
            columns.push(order.iter().map(|&draw| self.draws[draw][j]).collect::<Vec<f64>>());
        }
        least.sort_by(f64::total_cmp);
        let tail = quantile(&least, 1.0 - probability);
        columns.iter().map(|values| [quantile(values, tail), quantile(values, 1.0 - tail)]).collect()
    }
}

/// The central interval that holds `probability` of some values.
fn central(mut values: Vec<f64>, probability: f64) -> [f64; 2] {
    values.sort_by(f64::total_cmp);
    [(1.0 - probability) / 2.0, (1.0 + probability) / 2.0].map(|p| quantile(&values, p))
}

/// Quantile of sorted values.
fn quantile(values: &[f64], p: f64) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let at = p.clamp(0.0, 1.0) * (values.len() - 1) as f64;
    let (i, share) = (at.floor() as usize, at.fract());
    values[i] + share * (values[(i + 1).min(values.len() - 1)] - values[i])
}

/// Samples the posterior about the minima of the search, teaching the emulator on the way; `None` if nothing can be sampled. `told` how
/// many of how many rounds are done.
pub(crate) fn posterior(
    emulator: &mut Emulator,
    targets: &[Target],
    minima: &[Found],
    seed: u64,
    told: &dyn Fn(usize, usize),
) -> Option<Posterior> {
    let rounds = TRAINING.len() + 1;
    let starts = region::starts(targets, minima);
    let mut emulator_error = f64::INFINITY;
    for (round, (trajectories, count)) in TRAINING.into_iter().enumerate() {
        told(round, rounds);
        let regions = region::sample(emulator, targets, &starts, trajectories, seed + 10 * round as u64);
        let picked = region::pooled(&regions, count)?;
        let cells: Vec<_> = picked.iter().map(|u| emulator.family.cell(u)).collect();
        let solved = solved_all(&cells);
        let mut misses: Vec<f64> =
            picked.iter().zip(&solved).filter_map(|(u, y)| shift(emulator, targets, u, y.as_ref()?)).collect();
        misses.sort_by(f64::total_cmp);
        emulator_error = quantile(&misses, 0.5);
        emulator.learn(picked.into_iter().zip(solved));
    }
    told(rounds - 1, rounds);
    let regions = region::sample(emulator, targets, &starts, TRAJECTORIES, seed + 100);
    Some(Posterior {
        draws: region::pooled(&regions, DRAWS)?,
        acceptance: regions.iter().map(|r| r.weight * r.acceptance).sum(),
        effective_draws: regions.iter().map(|r| r.effective_draws).fold(f64::INFINITY, f64::min),
        emulator_error,
        directions: directions(emulator, targets, &minima.first()?.u)?,
        regions,
    })
}

/// How far a draw lies from where the true response is what the emulator predicts, to first order.
fn shift(emulator: &Emulator, targets: &[Target], u: &[f64], solved: &Response) -> Option<f64> {
    let (predicted, j) = sensitivity(emulator, targets, u)?;
    let solved = distances(targets, solved);
    let missed = DVector::from_iterator(targets.len(), predicted.iter().zip(solved).map(|(p, s)| p - s));
    let gram = Cholesky::new(&j * j.transpose() + DMatrix::identity(targets.len(), targets.len()))?;
    Some((j.transpose() * gram.solve(&missed)).norm())
}

/// Distances of the entries from the measurement in standard deviations, and their derivatives by the parameters.
fn sensitivity(emulator: &Emulator, targets: &[Target], u: &[f64]) -> Option<(Vec<f64>, DMatrix<f64>)> {
    let predicted = |u: &[f64]| emulator.predict(u).map(|y| distances(targets, &y));
    let at = predicted(u)?;
    let j = jacobian(predicted, u, &at)?;
    Some((at, j))
}

fn directions(emulator: &Emulator, targets: &[Target], best: &[f64]) -> Option<Vec<Direction>> {
    let (_, j) = sensitivity(emulator, targets, best)?;
    // eigenvectors of JᵀJ, so that the directions the entries do not see at all are there as well
    let eigen = (j.transpose() * j).symmetric_eigen();
    let mut directions: Vec<Direction> = (eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()))
        .map(|(value, along)| Direction { gain: value.max(0.0).sqrt(), along: along.iter().copied().collect() })
        .collect();
    directions.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    Some(directions)
}
