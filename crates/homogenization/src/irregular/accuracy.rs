//! Order and mesh that follow from the accuracy asked for.

use super::{Cell, Directional, Response, Solution};
use crate::homogenize::{SHARE, worst};
use crate::rounding::SPREAD;
use crate::{Error, SAFETY};

const FIRST_ORDER: usize = 4;
/// Highest polynomial order; then the mesh is refined.
const HIGHEST_ORDER: usize = 12;
/// Where a step of the order leaves more than this of the error, the mesh is refined.
const SLOW: f64 = 0.1;
/// A step that leaves more than this of the error has not helped; after [`PATIENCE`] of them in a row nothing does.
const STALLED: f64 = 0.5;
/// A higher order, a finer mesh, and once more.
const PATIENCE: usize = 3;
const FINEST: f64 = 4.0;
/// A step is never trusted to leave less than this of the error that the step before left.
const LEAST_RATIO: f64 = 0.1;
/// Cells a rounding away that are solved, on the coarsest elements.
const CELLS: u64 = 2;
/// Unknowns at most: about 5 GB.
const MOST_UNKNOWNS: usize = 1_000_000;

/// Effective constants of a cell with numerical errors, and the fields behind them.
#[derive(Debug, Clone)]
pub struct HomogenizedCell {
    /// The constants.
    pub constants: Directional,
    /// Estimated relative error of each constant by name: [`SAFETY`](crate::SAFETY) times the distance from its value on elements two
    /// orders lower or twice as large, less as the distances fall from step to step but no less than a tenth; over itself, or over
    /// [`NEGLIGIBLE`](crate::NEGLIGIBLE) of the natural size of its kind if that is larger; of those that vanish in symmetric cells
    /// (alpha_xy, k_xy, m_rxy) over all of that size. What rounding may do is added.
    pub relative_error: Vec<(&'static str, f64)>,
    /// All of the response.
    pub response: Response,
    /// Mesh and fluctuations.
    pub solution: Solution,
    /// Fineness of the mesh; 1 is standard.
    pub fineness: f64,
}

#[derive(Debug, Clone, Copy)]
struct Level {
    order: usize,
    fineness: f64,
}

impl Level {
    /// Two orders higher, or a mesh twice as fine if that did not help or the order is the highest.
    fn next(self, stalled: bool) -> Self {
        if stalled || self.order == HIGHEST_ORDER {
            Self { fineness: 2.0 * self.fineness, ..self }
        } else {
            Self { order: self.order + 2, ..self }
        }
    }

    /// By how much unknowns grow, and with them the condition and what rounding does.
    fn growth(self, from: Self) -> f64 {
        ((self.order as f64 / from.order as f64) * (self.fineness / from.fineness)).powi(2)
    }
}

impl Cell {
    /// Effective constants, each to `relative_error` by its own estimate: the order of the elements is raised from 4 by twos up to 12 until
    /// two solutions agree; where two orders do not bring the error to a tenth, the mesh is refined, twice at most.
    ///
    /// # Errors
    /// [`Error::Accuracy`] with the best estimate reached if neither helps, or a million unknowns do not suffice; [`Error::Tolerance`] for a
    /// `relative_error` that is negative or NaN; else [`Error`] names the constituent at fault, or the mesh or solve that failed.
    pub fn homogenize_to(&self, relative_error: f64) -> Result<HomogenizedCell, Error> {
        Error::unless_accuracy(relative_error)?;
        let mut level = Level { order: FIRST_ORDER, fineness: 1.0 };
        let mut last = constants(&self.solve(level.order, level.fineness)?)?;
        let rounding = self.rounding(level, &last);
        let (mut before, mut best, mut stalls, mut refined) = (None, f64::INFINITY, 0, false);
        level = level.next(false);
        loop {
            let solution = self.solve(level.order, level.fineness)?;
            let constants = constants(&solution)?;
            let mut errors = constants.differences(&last);
            let step = worst(&errors).1;
            let left = before.map(|before: f64| step / before);
            let ratio = left.map_or(1.0, |left| left.clamp(LEAST_RATIO, 1.0));
            let growth = level.growth(Level { order: FIRST_ORDER, fineness: 1.0 });
            for ((_, error), rounding) in errors.iter_mut().zip(&rounding) {
                *error = *error * ratio + rounding * growth;
            }
            let (constant, reached) = worst(&errors);
            if reached <= relative_error {
                let response = solution.response.clone();
                return Ok(HomogenizedCell { constants, relative_error: errors, response, solution, fineness: level.fineness });
            }
            best = best.min(reached);
            let rounded = growth * rounding.iter().fold(0.0, |most: f64, one| most.max(*one));
            // a refinement is followed by a higher order
            let next = level.next(!refined && left.is_some_and(|left| left > SLOW));
            let unknowns = (solution.response.unknowns as f64 * next.growth(level)) as usize;
            stalls = if left.is_some_and(|left| left > STALLED) { stalls + 1 } else { 0 };
            let why = if 2.0 * rounded > reached {
                "rounding stands in the way (a nearly incompressible phase, a great contrast): choose a tolerance above this value"
                    .into()
            } else if stalls == PATIENCE || next.fineness > FINEST {
                "neither a higher order nor a finer mesh brings it down: choose a tolerance above this value".into()
            } else if unknowns > MOST_UNKNOWNS {
                let remedy = "choose a tolerance above this value, or take fewer fibres";
                format!("the next step would take {unknowns} unknowns, more than {MOST_UNKNOWNS}: {remedy}")
            } else {
                refined = next.fineness > level.fineness;
                (level, last, before) = (next, constants, Some(step));
                continue;
            };
            let with = format!("{} elements of order {}", solution.mesh.elements().len(), level.order);
            return Err(Error::Accuracy { constant, requested: relative_error, reached: best, with, why });
        }
    }

    /// Effect of rounding on each constant at `level`, relative: a few times the largest distance between constants whose inputs
    /// differ by a rounding, as in [`crate::rounding`]; infinite where a rounding away there is no cell.
    fn rounding(&self, level: Level, exact: &Directional) -> Vec<f64> {
        let mut most = vec![0.0_f64; exact.named().len()];
        for seed in 0..CELLS {
            let shaken = self.shaken(seed).solve(level.order, level.fineness).and_then(|solution| constants(&solution));
            let distances = shaken.map(|shaken| exact.differences(&shaken)).unwrap_or_default();
            for (i, most) in most.iter_mut().enumerate() {
                *most = distances.get(i).map_or(f64::INFINITY, |(_, distance)| most.max(SPREAD / SAFETY * distance));
            }
        }
        let floor = SHARE * most.iter().fold(0.0, |worst: f64, one| worst.max(*one));
        most.into_iter().map(|one| one.max(floor)).collect()
    }
}

fn constants(solution: &Solution) -> Result<Directional, Error> {
    solution.response.constants().ok_or_else(Error::singular)
}
