//! Places where a residual is not noise: in time, over the state, in frequency.

use crate::fit::Fit;
use crate::noise::Noise;
use crate::{ForwardModel, Observation, State};
use nalgebra::Complex;
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

/// Share of false discoveries among the significant ones.
const FALSE_DISCOVERIES: f64 = 0.05;

/// A stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Start and end \[s\].
    pub time: [f64; 2],
    /// Sum of squares of the whitened residual divided by its expectation.
    pub excess: f64,
    /// Probability that noise gives as much or more.
    pub p: f64,
    /// Whether it stands out, the number of blocks considered.
    pub significant: bool,
}

/// A cell of the plane of level and rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Lower and upper level.
    pub level: [f64; 2],
    /// Lower and upper rate.
    pub rate: [f64; 2],
    /// Number of rows in it.
    pub rows: usize,
    /// Mean residual.
    pub mean: f64,
    /// Sum of the whitened residual over the root of the rows: standard normal in noise.
    pub z: f64,
    /// Whether it stands out, the number of cells considered.
    pub significant: bool,
}

/// Squared coherence of a residual with the state.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Frequency \[Hz\].
    pub frequency: f64,
    /// Coherence with level, rate, and the change of the rate, 0 to 1.
    pub coherence: [f64; 3],
    /// Threshold that noise exceeds once in twenty.
    pub threshold: f64,
}

/// Marks the significant ones (Benjamini and Hochberg 1995).
fn discoveries(p: &[f64]) -> Vec<bool> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&a, &b| p[a].total_cmp(&p[b]));
    let last = order.iter().enumerate().rev().find(|(k, i)| p[**i] <= FALSE_DISCOVERIES * (*k + 1) as f64 / p.len() as f64);
    let count = last.map_or(0, |(k, _)| k + 1);
    let mut found = vec![false; p.len()];
    order[..count].iter().for_each(|&i| found[i] = true);
    found
}

/// Probability that noise has a larger sum of products of neighbours at 30 lags, from whitened values ([`recording::statistics::whiteness`]);
/// NaN for no more than twice as many.
pub fn whiteness(whitened: &[f64]) -> f64 {
    const LAGS: usize = 30;
    let enough = (whitened.len() > 2 * LAGS).then_some(whitened);
    enough.and_then(|values| recording::statistics::whiteness(values, LAGS)).unwrap_or(f64::NAN)
}

/// Edges of equal steps over the range of x.
fn edges(x: &[f64], count: usize) -> Vec<f64> {
    let (low, high) = x.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    (0..=count).map(|k| low + (high - low) * k as f64 / count as f64).collect()
}

fn bin(edges: &[f64], x: f64) -> usize {
    edges.partition_point(|e| *e <= x).saturating_sub(1).min(edges.len() - 2)
}

impl Fit {
    /// A channel's residual in a record that was not fitted, whitened by the noise of the first record that was; only the rows that
    /// were observed. Empty where the instants do not increase.
    pub fn whiten(&self, channel: usize, observed: &Observation, residual: &[f64]) -> Vec<f64> {
        self.noise.pooled(observed).map_or(Vec::new(), |noise| noise.whiten(0, channel, residual))
    }

    /// The whitened residual of a channel in one of the records fitted, under the noise of `judge`, with the rows it belongs to.
    pub fn whitened_residual(
        &self,
        record: usize,
        channel: usize,
        observed: &Observation,
        judge: &Self,
    ) -> (Vec<usize>, Vec<f64>) {
        match Noise::of_record(&judge.noise, record, observed) {
            Ok(noise) => (noise.rows(0, channel).to_vec(), noise.whiten(0, channel, &self.residuals[record][channel])),
            Err(_) => (Vec::new(), Vec::new()),
        }
    }

    /// Equal stretches of the record, two dozen if it is long enough, in which the residual is larger than noise.
    pub fn in_time(&self, record: usize, channel: usize, observed: &Observation, judge: &Self) -> Vec<Block> {
        const STRETCHES: usize = 24;
        const FEWEST_ROWS: usize = 20;
        let (rows, w) = self.whitened_residual(record, channel, observed, judge);
        let Some((&first, &last)) = rows.first().zip(rows.last()) else { return Vec::new() };
        let (first, last) = (observed.time[first], observed.time[last]);
        let count = (rows.len() / FEWEST_ROWS).clamp(1, STRETCHES);
        let mut sums = vec![(0.0, 0_usize); count];
        let at = |t: f64| (((t - first) / (last - first).max(f64::MIN_POSITIVE) * count as f64) as usize).min(count - 1);
        for (row, w) in rows.iter().zip(&w) {
            let block = &mut sums[at(observed.time[*row])];
            block.0 += w * w;
            block.1 += 1;
        }
        let p: Vec<f64> = sums.iter().map(|(sum, n)| ChiSquared::new(*n as f64).map_or(1.0, |d| d.sf(*sum))).collect();
        let found = discoveries(&p);
        (0..count)
            .map(|k| Block {
                time: [k, k + 1].map(|k| first + (last - first) * k as f64 / count as f64),
                excess: sums[k].0 / (sums[k].1 as f64).max(1.0),
                p: p[k],
                significant: found[k],
            })
            .collect()
    }

    /// The residual over level and rate.
    pub fn over_state(
        &self,
        model: &dyn ForwardModel,
        (record, of_model): (usize, usize),
        channel: usize,
        observed: &Observation,
        judge: &Self,
    ) -> Vec<Cell> {
        const LEVELS: usize = 12;
        const RATES: usize = 9;
        const FEWEST: usize = 5;
        let (rows, w) = self.whitened_residual(record, channel, observed, judge);
        let State { level, rate } = model.state(of_model);
        let (levels, rates) = (edges(level, LEVELS), edges(rate, RATES));
        let mut cells = vec![(0.0, 0.0, 0_usize); LEVELS * RATES];
        for (&row, w) in rows.iter().zip(&w) {
            let cell = &mut cells[bin(&levels, level[row]) * RATES + bin(&rates, rate[row])];
            cell.0 += w;
            cell.1 += self.residuals[record][channel][row];
            cell.2 += 1;
        }
        let z = |cell: &(f64, f64, usize)| cell.0 / (cell.2 as f64).sqrt();
        let enough: Vec<usize> = (0..cells.len()).filter(|k| cells[*k].2 >= FEWEST).collect();
        let normal = Normal::standard();
        let p: Vec<f64> = enough.iter().map(|&k| 2.0 * normal.sf(z(&cells[k]).abs())).collect();
        let found = discoveries(&p);
        enough
            .iter()
            .zip(found)
            .map(|(&k, significant)| {
                let (i, j) = (k / RATES, k % RATES);
                let (level, rate) = ([levels[i], levels[i + 1]], [rates[j], rates[j + 1]]);
                Cell { level, rate, rows: cells[k].2, mean: cells[k].1 / cells[k].2 as f64, z: z(&cells[k]), significant }
            })
            .collect()
    }

    /// Coherence of the residual with level, rate and the change of the rate, averaged over overlapping segments (Welch 1967).
    pub fn in_frequency(
        &self,
        model: &dyn ForwardModel,
        (record, of_model): (usize, usize),
        channel: usize,
        observed: &Observation,
    ) -> Vec<Spectrum> {
        const SEGMENTS: usize = 9;
        let time = &observed.time;
        let n = time.len();
        let length = 2 * n / (SEGMENTS + 1);
        if length < 64 {
            return Vec::new();
        }
        let State { level, rate } = model.state(of_model);
        let change: Vec<f64> =
            (0..n).map(|k| if k > 0 { (rate[k] - rate[k - 1]) / (time[k] - time[k - 1]) } else { 0.0 }).collect();
        let residual: Vec<f64> = self.residuals[record][channel].iter().map(|r| if r.is_nan() { 0.0 } else { *r }).collect();
        let span = time[length - 1] - time[0];
        let (low, high) = (2.0 / span, length as f64 / span / 4.0);
        // magnitude-squared coherence of noise with ν independent segments exceeds 1 − 0.05^(1/(ν−1)) once in twenty
        // neighbours that overlap by half under Hann's window share 1/36 of their power (Welch 1967)
        let count = SEGMENTS as f64;
        let independent = count / (1.0 + 2.0 / 36.0 * (1.0 - 1.0 / count));
        let threshold = 1.0 - 0.05_f64.powf(1.0 / (independent - 1.0));
        (0..FREQUENCIES)
            .map(|k| {
                let frequency = low * (high / low).powf(k as f64 / (FREQUENCIES - 1) as f64);
                // where the clock starts turns both transforms alike
                let transform = |series: &[f64], from: usize| -> Complex<f64> {
                    let part = &series[from..from + length];
                    let mean = part.iter().sum::<f64>() / length as f64;
                    let term = |(i, x): (usize, &f64)| {
                        let window = (std::f64::consts::PI * i as f64 / (length - 1) as f64).sin().powi(2);
                        Complex::cis(std::f64::consts::TAU * frequency * time[from + i]) * ((x - mean) * window)
                    };
                    part.iter().enumerate().map(term).sum()
                };
                let of_segments =
                    |series: &[f64]| -> Vec<_> { (0..SEGMENTS).map(|s| transform(series, s * length / 2)).collect() };
                let power = |parts: &[Complex<f64>]| parts.iter().map(Complex::norm_sqr).sum::<f64>();
                let of_residual = of_segments(&residual);
                let coherence = [level, rate, &change].map(|state: &Vec<f64>| {
                    let of_state = of_segments(state);
                    let cross: Complex<f64> = of_residual.iter().zip(&of_state).map(|(a, b)| a * b.conj()).sum();
                    let powers = power(&of_residual) * power(&of_state);
                    if powers > 0.0 { cross.norm_sqr() / powers } else { 0.0 }
                });
                Spectrum { frequency, coherence, threshold }
            })
            .collect()
    }
}

/// Frequencies of a [`Spectrum`].
pub const FREQUENCIES: usize = 32;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_tell_whether_they_are_white_where_they_are_more_than_twice_as_many_as_the_lags() {
        let wave = |count: usize| (0..count).map(|n| (n as f64 / 7.0).sin()).collect::<Vec<_>>();
        for (count, expected) in [(31, false), (45, false), (60, false), (61, true), (300, true)] {
            let found = whiteness(&wave(count));
            assert_eq!(!found.is_nan(), expected, "{count}");
            assert!(!expected || found < 1e-3, "{count}: {found}");
        }
    }
}
