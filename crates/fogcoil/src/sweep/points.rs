//! Points of the unit cube: a grid, a Latin hypercube, a Sobol' sequence, random ones, or those of two matrices that Sobol' indices are estimated by.

use serde::Deserialize;
use sobol_burley::{NUM_DIMENSIONS, sample};

use super::random::{bits, permutation, uniform};

/// Choice of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Sampling {
    /// Every combination of the values of all keys, the last key changing fastest.
    Grid,
    /// So many points, one in each of as many equal parts of every key's range.
    LatinHypercube(usize),
    /// The first so many points of a Sobol' sequence, scrambled by the seed (Burley 2020).
    Sobol(usize),
    /// So many random points.
    MonteCarlo(usize),
    /// Points A and B of a Sobol' sequence, so many each, and for every group A with B's values of that group (Saltelli et al. 2010).
    Indices(usize),
}

/// Longest sequence that is known.
pub(super) const LONGEST_SEQUENCE: usize = 1 << 16;

/// The points of a plan.
pub struct Points {
    sampling: Sampling,
    seed: u64,
    /// Number of values of each factor, for a grid.
    levels: Vec<usize>,
    /// The group of each factor.
    groups: Vec<usize>,
    /// Order of the parts of each factor's range, of a Latin hypercube.
    orders: Vec<Vec<u32>>,
}

/// Streams of random numbers that are used for different things.
const JITTER: u64 = 1 << 32;

impl Points {
    /// Points of factors with so many values each (a grid needs them), each of one of the groups 0, 1, ….
    pub fn new(sampling: Sampling, seed: u64, levels: Vec<usize>, groups: Vec<usize>) -> Self {
        let orders = match sampling {
            Sampling::LatinHypercube(count) => (0..groups.len() as u64).map(|n| permutation(count, seed, n)).collect(),
            _ => Vec::new(),
        };
        Self { sampling, seed, levels, groups, orders }
    }

    /// Number of groups.
    pub fn groups(&self) -> usize {
        self.groups.iter().max().map_or(0, |most| most + 1)
    }

    /// Points that are computed for each pair of A and B: both, and one for every group.
    pub fn block(&self) -> usize {
        self.groups() + 2
    }

    /// Number of points; `None` if a machine cannot count them.
    pub fn count(&self) -> Option<usize> {
        match self.sampling {
            Sampling::Grid => self.levels.iter().try_fold(1_usize, |all, levels| all.checked_mul(*levels)),
            Sampling::LatinHypercube(count) | Sampling::Sobol(count) | Sampling::MonteCarlo(count) => Some(count),
            Sampling::Indices(count) => count.checked_mul(self.block()),
        }
    }

    /// Coordinates of a point, from 0 to 1.
    pub fn point(&self, number: usize) -> Vec<f64> {
        let factors = self.groups.len();
        match self.sampling {
            Sampling::Grid => self.of_grid(number),
            Sampling::LatinHypercube(count) => {
                let of = |(n, order): (usize, &Vec<u32>)| {
                    (f64::from(order[number]) + uniform(self.seed, JITTER + n as u64, number as u64)) / count as f64
                };
                self.orders.iter().enumerate().map(of).collect()
            }
            Sampling::Sobol(_) => (0..factors).map(|n| self.of_sequence(number, n)).collect(),
            Sampling::MonteCarlo(_) => (0..factors).map(|n| uniform(self.seed, n as u64, number as u64)).collect(),
            Sampling::Indices(_) => {
                let (pair, place) = (number / self.block(), number % self.block());
                let from_b = |n: usize| place == 1 || (place > 1 && self.groups[n] == place - 2);
                (0..factors).map(|n| self.of_sequence(pair, if from_b(n) { factors + n } else { n })).collect()
            }
        }
    }

    fn of_sequence(&self, number: usize, dimension: usize) -> f64 {
        // the crate panics beyond; a plan is refused before
        let (number, dimension) = (number.min(LONGEST_SEQUENCE - 1) as u32, (dimension as u32).min(NUM_DIMENSIONS - 1));
        f64::from(sample(number, dimension, bits(self.seed, 0, 0) as u32))
    }

    fn of_grid(&self, number: usize) -> Vec<f64> {
        let mut rest = number;
        let mut point: Vec<f64> = self
            .levels
            .iter()
            .rev()
            .map(|levels| {
                let place = rest % levels;
                rest /= levels;
                (place as f64 + 0.5) / *levels as f64
            })
            .collect();
        point.reverse();
        point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(points: &Points) -> Vec<Vec<f64>> {
        (0..points.count().unwrap()).map(|n| points.point(n)).collect()
    }

    #[test]
    fn a_grid_has_every_combination_once() {
        let points = Points::new(Sampling::Grid, 0, vec![2, 3], vec![0, 1]);
        let places: Vec<[usize; 2]> = all(&points).iter().map(|p| [(p[0] * 2.0) as usize, (p[1] * 3.0) as usize]).collect();
        assert_eq!(places, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
        assert_eq!(Points::new(Sampling::Grid, 0, vec![usize::MAX, 2], vec![0, 0]).count(), None);
    }

    #[test]
    fn each_part_of_a_range_has_one_point_of_a_latin_hypercube() {
        let points = all(&Points::new(Sampling::LatinHypercube(50), 4, vec![0; 3], vec![0; 3]));
        for factor in 0..3 {
            let mut parts: Vec<usize> = points.iter().map(|p| (50.0 * p[factor]) as usize).collect();
            parts.sort_unstable();
            assert!(parts.into_iter().eq(0..50), "{factor}");
        }
        assert_ne!(points, all(&Points::new(Sampling::LatinHypercube(50), 5, vec![0; 3], vec![0; 3])));
    }

    #[test]
    fn a_sequence_fills_the_cube_more_evenly_than_chance() {
        // mean of x y over the square is 1/4
        let error = |sampling| {
            let points = all(&Points::new(sampling, 11, vec![0; 2], vec![0; 2]));
            (points.iter().map(|p| p[0] * p[1]).sum::<f64>() / points.len() as f64 - 0.25).abs()
        };
        assert!(error(Sampling::Sobol(1024)) < 1e-3, "{}", error(Sampling::Sobol(1024)));
        assert!(error(Sampling::MonteCarlo(1024)) < 0.03);
    }

    #[test]
    fn a_group_has_the_values_of_b_and_the_rest_those_of_a() {
        let points = Points::new(Sampling::Indices(8), 1, vec![0; 3], vec![0, 1, 0]);
        assert_eq!((points.count(), points.block()), (Some(32), 4));
        for pair in 0..8 {
            let [a, b, first, second] = [0, 1, 2, 3].map(|place| points.point(4 * pair + place));
            assert!((0..3).all(|n| a[n] != b[n]));
            assert_eq!(first, [b[0], a[1], b[2]]);
            assert_eq!(second, [a[0], b[1], a[2]]);
        }
    }
}
