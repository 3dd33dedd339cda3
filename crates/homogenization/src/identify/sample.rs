//! Draws from the posterior on the emulator.
//!
//! The entries are so exact that the posterior is a thin bent sheet, on which ordinary chains stand still. So the deviations of the
//! entries become unknowns beside the parameters u, and the sheet a manifold: `D(u) + e(w) = 0`, with D the entries' distances from the
//! measurement in standard deviations, `e = w` (normal) for a value with a standard deviation, and `e = √3 tanh(w/2)` (w logistic, so e
//! uniform) for a rounded one. On it a Hamiltonian chain is exact up to the emulator: each step moves along the tangent and is
//! projected back, and is refused where it cannot be retraced (M. M. Graham, A. H. Thiery and A. Beskos, *J. R. Stat. Soc. B* 84,
//! 1229, 2022; E. Zappa, M. Holmes-Cerfon and J. Goodman, *Commun. Pure Appl. Math.* 71, 2609, 2018).

use super::emulator::Emulator;
use super::fit::jacobian;
use super::target::{Target, Uncertainty, distances};
use crate::random::Random;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Longest step and most steps of one trajectory; both are drawn anew for each.
const STEP: f64 = 0.8;
const STEPS: usize = 9;
/// Share of a chain thrown away at its beginning.
const WARM_UP: f64 = 0.1;
/// A point is on the manifold within this many standard deviations of each entry, and is met again within this distance.
const ON: f64 = 1e-7;
const RETRACED: f64 = 1e-4;
const MOST_CORRECTIONS: usize = 40;

#[derive(Debug, Clone)]
pub(crate) struct Chain {
    pub(crate) draws: Vec<Vec<f64>>,
    pub(crate) acceptance: f64,
}

struct Problem<'a> {
    emulator: &'a Emulator<'a>,
    targets: &'a [Target],
    dimensions: usize,
}

/// A point (u, w) of the manifold with what the next step needs.
#[derive(Clone)]
struct Point {
    q: DVector<f64>,
    /// Derivative of the constraint by q.
    normal: DMatrix<f64>,
    gram: Cholesky<f64, Dyn>,
    /// −ln density on the manifold and its gradient, the Gram determinant apart.
    potential: f64,
    gradient: DVector<f64>,
}

impl Problem<'_> {
    fn distances(&self, u: &[f64]) -> Option<Vec<f64>> {
        Some(distances(self.targets, &self.emulator.predict(u)?))
    }

    fn constraint(&self, q: &DVector<f64>) -> Option<DVector<f64>> {
        let (u, w) = q.as_slice().split_at(self.dimensions);
        let distances = self.distances(u)?;
        let deviations = self.targets.iter().zip(w).map(|(t, w)| deviation(t, *w));
        Some(DVector::from_iterator(w.len(), distances.iter().zip(deviations).map(|(d, e)| d + e)))
    }

    fn point(&self, q: DVector<f64>) -> Option<Point> {
        let (u, w) = q.as_slice().split_at(self.dimensions);
        let j = jacobian(|u| self.distances(u), u, &self.distances(u)?)?;
        let mut normal = DMatrix::zeros(w.len(), q.len());
        normal.columns_mut(0, u.len()).copy_from(&j);
        let mut gradient = q.clone();
        let mut potential = u.iter().map(|u| u * u / 2.0).sum();
        for (i, (target, &w)) in self.targets.iter().zip(w).enumerate() {
            let place = u.len() + i;
            match target.uncertainty {
                Uncertainty::Normal(_) => {
                    normal[(i, place)] = 1.0;
                    potential += w * w / 2.0;
                }
                Uncertainty::Rounded(_) => {
                    let tanh = (w / 2.0).tanh();
                    normal[(i, place)] = 3.0_f64.sqrt() / 2.0 * (1.0 - tanh * tanh);
                    potential += 2.0 * (w / 2.0).cosh().ln();
                    gradient[place] = tanh;
                }
            }
        }
        let gram = Cholesky::new(&normal * normal.transpose())?;
        potential += gram.l().diagonal().iter().map(|l| l.ln()).sum::<f64>();
        Some(Point { q, normal, gram, potential, gradient })
    }

    /// From `from` along `p` and back onto the manifold along the normals at `from`.
    fn moved(&self, from: &Point, p: &DVector<f64>) -> Option<DVector<f64>> {
        let mut q = &from.q + p;
        for _ in 0..MOST_CORRECTIONS {
            let c = self.constraint(&q)?;
            if c.amax() < ON {
                return Some(q);
            }
            q -= from.normal.transpose() * from.gram.solve(&c);
        }
        None
    }

    /// One step of the Hamiltonian flow; `None` where it leaves the cells there are or cannot be retraced.
    fn step(&self, from: &Point, p: &DVector<f64>, step: f64) -> Option<(Point, DVector<f64>)> {
        let p = from.tangent(&(p - &from.gradient * (step / 2.0)));
        let to = self.point(self.moved(from, &(&p * step))?)?;
        let p = to.tangent(&((&to.q - &from.q) / step));
        let back = self.moved(&to, &(&p * -step))?;
        if (back - &from.q).amax() > RETRACED {
            return None;
        }
        let p = to.tangent(&(p - &to.gradient * (step / 2.0)));
        Some((to, p))
    }
}

impl Point {
    fn tangent(&self, p: &DVector<f64>) -> DVector<f64> {
        p - self.normal.transpose() * self.gram.solve(&(&self.normal * p))
    }
}

/// An entry's deviation in its standard deviations.
fn deviation(target: &Target, w: f64) -> f64 {
    match target.uncertainty {
        Uncertainty::Normal(_) => w,
        Uncertainty::Rounded(_) => 3.0_f64.sqrt() * (w / 2.0).tanh(),
    }
}

/// A chain of `trajectories` from `start`, which must lie within the rounding intervals; `None` if it does not.
pub(crate) fn chain(emulator: &Emulator, targets: &[Target], start: &[f64], trajectories: usize, seed: u64) -> Option<Chain> {
    let mut random = Random::new(seed);
    let problem = Problem { emulator, targets, dimensions: start.len() };
    let deviations = problem.distances(start)?.into_iter().zip(targets).map(|(d, t)| match t.uncertainty {
        Uncertainty::Normal(_) => -d,
        Uncertainty::Rounded(_) => -2.0 * (d / 3.0_f64.sqrt()).atanh(),
    });
    let q: Vec<f64> = start.iter().copied().chain(deviations).collect();
    let mut at = q.iter().all(|q| q.is_finite()).then(|| problem.point(q.into()))??;
    let (mut draws, mut accepted) = (Vec::with_capacity(trajectories), 0);
    for _ in 0..trajectories {
        let step = STEP * (0.2 + 0.8 * random.uniform());
        let steps = 1 + (random.uniform() * STEPS as f64) as usize;
        let threshold = random.uniform().ln();
        let mut p = at.tangent(&DVector::from_vec(random.normals(at.q.len())));
        let energy = |at: &Point, p: &DVector<f64>| at.potential + p.norm_squared() / 2.0;
        let before = energy(&at, &p);
        let mut next = Some(at.clone());
        for _ in 0..steps {
            next = next.and_then(|point| problem.step(&point, &p, step)).map(|(point, momentum)| {
                p = momentum;
                point
            });
        }
        if let Some(next) = next.filter(|next| threshold < before - energy(next, &p)) {
            at = next;
            accepted += 1;
        }
        draws.push(at.q.as_slice()[..start.len()].to_vec());
    }
    let warm_up = (WARM_UP * trajectories as f64) as usize;
    Some(Chain { draws: draws.split_off(warm_up), acceptance: accepted as f64 / trajectories as f64 })
}
