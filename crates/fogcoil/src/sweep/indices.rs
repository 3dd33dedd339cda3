//! Sobol' indices of |S| by groups of factors, with bootstrap intervals.
//!
//! With f(A), f(B) and f(A with group g of B), means over N pairs and V the variance of f:
//!
//! ```text
//! first order:  Sg  = mean( f(B) (f(ABg) − f(A)) ) / V        A. Saltelli et al., Comput. Phys. Commun. 181, 259 (2010), table 2 (b)
//! total:        STg = mean( (f(A) − f(ABg))² ) / 2V           M. J. W. Jansen, Comput. Phys. Commun. 117, 35 (1999)
//! ```
//!
//! f is taken less its mean, which changes no index and lessens the scatter of the first.

use super::random::below;
use crate::variants::Group;

/// A number and both ends of its 90 % interval.
pub(super) type WithInterval = (f64, [f64; 2]);

/// The indices of a group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Index {
    /// The group.
    pub group: Group,
    /// Share of the variance that the group has alone.
    pub first: WithInterval,
    /// Share of the variance that goes where the group is held.
    pub total: WithInterval,
}

/// The indices of all groups.
#[derive(Debug, Clone, PartialEq)]
pub struct Indices {
    /// The largest total first.
    pub all: Vec<Index>,
    /// Pairs of points A and B.
    pub pairs: usize,
    /// Pairs that are left out, as one of their designs cannot be.
    pub left_out: usize,
}

/// Resamples behind an interval.
const RESAMPLES: usize = 1000;
/// Stream of random numbers.
const STREAM: u64 = 1 << 40;

impl Indices {
    /// Indices from |S| of every point in the order of the plan, `None` where there is no such design; `None` where nothing varies.
    pub fn of(groups: &[Group], magnitudes: &[Option<f64>], seed: u64) -> Option<Self> {
        let blocks: Vec<Vec<f64>> =
            magnitudes.chunks_exact(groups.len() + 2).filter_map(|block| block.iter().copied().collect()).collect();
        let left_out = magnitudes.len() / (groups.len() + 2) - blocks.len();
        let every: Vec<usize> = (0..blocks.len()).collect();
        let here = estimate(&blocks, &every)?;
        let resampled: Vec<Vec<[f64; 2]>> = (0..RESAMPLES)
            .filter_map(|n| {
                let place = |k: usize| below(blocks.len(), seed, STREAM + n as u64, k as u64);
                estimate(&blocks, &(0..blocks.len()).map(place).collect::<Vec<_>>())
            })
            .collect();
        let of = |g: usize, kind: usize| (here[g][kind], interval(resampled.iter().map(|one| one[g][kind]).collect()));
        let index = |(g, group): (usize, &Group)| Index { group: *group, first: of(g, 0), total: of(g, 1) };
        let mut all: Vec<Index> = groups.iter().enumerate().map(index).collect();
        all.sort_by(|a, b| b.total.0.total_cmp(&a.total.0));
        Some(Self { all, pairs: blocks.len(), left_out })
    }
}

/// First-order and total index of every group from some of the blocks; `None` where f does not vary.
fn estimate(blocks: &[Vec<f64>], chosen: &[usize]) -> Option<Vec<[f64; 2]>> {
    let count = chosen.len() as f64;
    let mean = |of: &dyn Fn(&[f64]) -> f64| chosen.iter().map(|n| of(&blocks[*n])).sum::<f64>() / count;
    let middle = mean(&|f| (f[0] + f[1]) / 2.0);
    let variance = mean(&|f| ((f[0] - middle).powi(2) + (f[1] - middle).powi(2)) / 2.0);
    let groups = blocks.first()?.len() - 2;
    let of = |g: usize| {
        let first = mean(&|f| (f[1] - middle) * (f[2 + g] - f[0]));
        let total = mean(&|f| (f[0] - f[2 + g]).powi(2)) / 2.0;
        [first / variance, total / variance]
    };
    // the square of what rounding leaves of a constant
    (variance > 1e-28 * middle * middle && chosen.len() > 1).then(|| (0..groups).map(of).collect())
}

fn interval(mut all: Vec<f64>) -> [f64; 2] {
    all.sort_by(f64::total_cmp);
    let at = |share: f64| all.get(((share * all.len() as f64) as usize).min(all.len().saturating_sub(1))).copied();
    [at(0.05), at(0.95)].map(|end| end.unwrap_or(f64::NAN))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::points::{Points, Sampling};
    use std::f64::consts::PI;

    /// Ishigami's function, whose indices are known (T. Homma and A. Saltelli, 1996).
    #[test]
    fn exact_indices_of_ishigami() {
        let points = Points::new(Sampling::Indices(4096), 5, vec![0; 3], vec![0, 1, 2]);
        let f = |u: &[f64]| {
            let [x, y, z] = [0, 1, 2].map(|n| PI * (2.0 * u[n] - 1.0));
            x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin()
        };
        let values: Vec<Option<f64>> = (0..points.count().unwrap()).map(|n| Some(f(&points.point(n)))).collect();
        let groups = [Group::Fibre, Group::Spool, Group::Optics];
        let found = Indices::of(&groups, &values, 5).unwrap();
        let expected = [(Group::Fibre, 0.3139, 0.5576), (Group::Spool, 0.4424, 0.4424), (Group::Optics, 0.0, 0.2437)];
        for (group, first, total) in expected {
            let index = found.all.iter().find(|index| index.group == group).unwrap();
            assert!((index.first.0 - first).abs() < 0.02 && (index.total.0 - total).abs() < 0.02, "{index:?}");
            for (value, [low, high]) in [index.first, index.total] {
                assert!(low <= value && value <= high && high - low < 0.12, "{index:?}");
            }
        }
        assert_eq!((found.all[0].group, found.pairs, found.left_out), (Group::Fibre, 4096, 0));
    }

    #[test]
    fn what_cannot_be_is_left_out_and_a_constant_has_none() {
        let values: Vec<Option<f64>> = (0..30).map(|n| (n != 4).then_some(f64::from(n % 7))).collect();
        let found = Indices::of(&[Group::Spool], &values, 0).unwrap();
        assert_eq!((found.pairs, found.left_out), (9, 1));
        assert_eq!(Indices::of(&[Group::Spool], &[Some(0.1); 30], 0), None);
        assert_eq!(Indices::of(&[Group::Spool], &[None; 30], 0), None);
    }
}
