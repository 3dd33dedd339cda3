//! Overlapping Allan deviation with confidence intervals.
//!
//! For means ȳ over τ = m intervals, σ²(τ) = ½ ⟨(ȳ(t + τ) − ȳ(t))²⟩ over every t (IEEE Std 952-1997, C.1). On a log-log plot the
//! deviation falls as τ⁻¹ where quantisation rules, as τ^−½ where white noise does, is flat at the bias instability and rises as τ^½
//! where rate random walk does. A deterministic signal in the series shows as noise: take it off first.

use crate::Error;
use crate::series::{check_series, median_interval};
use crate::statistics::chi_square_quantile;

/// One point of an Allan plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AllanPoint {
    /// Averaging time \[s\].
    pub tau: f64,
    /// Allan deviation \[u\].
    pub deviation: f64,
    /// Lower end of its confidence interval \[u\].
    pub low: f64,
    /// Upper end of its confidence interval \[u\].
    pub high: f64,
    /// Effective degrees of freedom.
    pub freedom: f64,
    /// Slope d ln σ / d ln τ towards its neighbours.
    pub slope: f64,
}

/// Confidence of the intervals of [`AllanPoint`]: two-sided 90 %.
pub const CONFIDENCE: f64 = 0.9;

/// Averaging times per octave of the table.
const PER_OCTAVE: f64 = 2.0;
/// Share of a mean's rows that have to be there.
const COMPLETE: f64 = 0.9;
/// Slots of the even lattice for each row: where gaps ask for more, they are shortened, to lengths that no mean spans.
const MOST_SLOTS: f64 = 20.0;
/// Shortest series \[rows\].
const SHORTEST: usize = 8;

/// Overlapping Allan deviation of a series at about evenly spaced instants, from one interval to a third of its length. It may have pauses of any length, which
/// no mean spans; all that lies between them counts.
///
/// Rows where `mask` is `false`, and instants that are missing, are left out of the means; a mean needs nine tenths of its rows.
///
/// # Errors
/// [`Error::Length`], [`Error::Time`], [`Error::Value`] for bad series; [`Error::TooFew`] for fewer than eight rows.
pub fn allan(time: &[f64], values: &[f64], mask: &[bool]) -> Result<Vec<AllanPoint>, Error> {
    let used = check_series(time, mask, &[("values", values)])?;
    let Some(interval) = median_interval(time).filter(|_| used >= SHORTEST) else {
        return Err(Error::TooFew { found: used, needed: SHORTEST });
    };
    let lattice = Lattice::new(time, values, mask, interval);
    let longest = lattice.longest;
    let mut spans: Vec<usize> =
        (0..).map(|i| (f64::from(i) / PER_OCTAVE).exp2() as usize).take_while(|m| *m <= longest).collect();
    spans.dedup();
    let raw: Vec<(usize, f64, usize)> =
        spans.into_iter().filter_map(|m| lattice.variance(m).map(|(variance, terms)| (m, variance, terms))).collect();
    let slopes: Vec<f64> = (0..raw.len()).map(|i| slope(&raw, i)).collect();
    // a chance slope at long times is not quantisation, whose many degrees of freedom would be claimed for it
    let quantised = slopes.iter().take_while(|slope| **slope < -0.75).count();
    let named = |i: usize| if i < quantised { slopes[i] } else { slopes[i].max(-0.5) };
    Ok((0..raw.len()).map(|i| AllanPoint { slope: slopes[i], ..point(raw[i], named(i), interval) }).collect())
}

fn slope(raw: &[(usize, f64, usize)], i: usize) -> f64 {
    let (a, b) = (raw[i.saturating_sub(1)], raw[(i + 1).min(raw.len() - 1)]);
    if a.0 < b.0 { 0.5 * (b.1 / a.1).ln() / (b.0 as f64 / a.0 as f64).ln() } else { f64::NAN }
}

fn point((m, variance, terms): (usize, f64, usize), slope: f64, interval: f64) -> AllanPoint {
    let freedom = freedom(m as f64, terms as f64, slope);
    let end = |probability: f64| (variance * freedom / chi_square_quantile(probability, freedom)).sqrt();
    let tail = (1.0 - CONFIDENCE) / 2.0;
    AllanPoint { tau: m as f64 * interval, deviation: variance.sqrt(), low: end(1.0 - tail), high: end(tail), freedom, slope }
}

/// Effective degrees of freedom of the overlapping estimate for the noise that the slope names (Riley, NIST SP 1065, table 5).
fn freedom(m: f64, terms: f64, slope: f64) -> f64 {
    let n = terms + 2.0 * m; // points of the integrated series
    let freedom = if slope < -0.75 {
        (n + 1.0) * (n - 2.0 * m) / (2.0 * (n - m))
    } else if slope < -0.25 || slope.is_nan() {
        (1.5 * (n - 1.0) / m - 2.0 * (n - 2.0) / n) * 4.0 * m * m / (4.0 * m * m + 5.0)
    } else if slope < 0.25 && m == 1.0 {
        2.0 * (n - 2.0).powi(2) / (2.3 * n - 4.9)
    } else if slope < 0.25 {
        5.0 * n * n / (4.0 * m * (n + 3.0 * m))
    } else {
        (n - 2.0) / m * ((n - 1.0).powi(2) - 3.0 * m * (n - 1.0) + 4.0 * m * m) / (n - 3.0).powi(2)
    };
    freedom.max(1.0)
}

/// Running sums over evenly spaced slots, some of them empty.
struct Lattice {
    sums: Vec<f64>,
    counts: Vec<u32>,
    /// Slots of the longest mean.
    longest: usize,
}

impl Lattice {
    fn new(time: &[f64], values: &[f64], mask: &[bool], interval: f64) -> Self {
        let empty = |pair: &[f64]| ((pair[1] - pair[0]) / interval).round().max(1.0) - 1.0;
        let gaps: Vec<f64> = time.windows(2).map(empty).filter(|empty| *empty > 0.0).collect();
        let (rows, all) = (time.len() as f64, gaps.iter().sum::<f64>());
        let most = if rows + all > MOST_SLOTS * rows { (MOST_SLOTS * rows / gaps.len() as f64).floor() } else { f64::INFINITY };
        let used = (0..time.len()).filter(|&row| mask[row]);
        let mean = used.clone().map(|row| values[row]).sum::<f64>() / used.count().max(1) as f64;
        let (mut sums, mut counts) = (vec![0.0], vec![0]);
        let mut push = |value: Option<f64>| {
            sums.push(sums[sums.len() - 1] + value.unwrap_or(0.0));
            counts.push(counts[counts.len() - 1] + u32::from(value.is_some()));
        };
        for row in 0..time.len() {
            if row > 0 {
                (0..empty(&time[row - 1..=row]).min(most) as usize).for_each(|_| push(None));
            }
            push(mask[row].then(|| values[row] - mean));
        }
        // a mean that lacks a shortened gap is not complete
        let spoilt = most / (1.0 - COMPLETE);
        let longest = ((sums.len() - 1) / 3).min(spoilt.ceil() as usize - 1);
        Self { sums, counts, longest }
    }

    fn slots(&self) -> usize {
        self.sums.len() - 1
    }

    /// Allan variance over `m` slots and the number of differences in it.
    fn variance(&self, m: usize) -> Option<(f64, usize)> {
        let needed = COMPLETE * m as f64;
        let (mut squares, mut terms) = (0.0, 0);
        for start in 0..=self.slots().checked_sub(2 * m)? {
            let mean = |first: usize| {
                let count = f64::from(self.counts[first + m] - self.counts[first]);
                (count >= needed).then(|| (self.sums[first + m] - self.sums[first]) / count)
            };
            if let (Some(a), Some(b)) = (mean(start), mean(start + m)) {
                squares += (b - a) * (b - a);
                terms += 1;
            }
        }
        // as many as a whole series has of means over a third of it
        (terms >= m).then(|| (squares / (2.0 * terms as f64), terms))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fractional frequency noise as a filter of white noise, by the slope of its deviation (N. J. Kasdin, 1995).
    fn filter(slope: f64, length: usize) -> Vec<f64> {
        let mut filter = vec![1.0];
        // white noise in phase, in frequency, flicker and random walk of frequency: orders -1, 0, 1/2 and 1 of integration
        let order = if slope == 0.0 { 0.5 } else { (slope + 0.5) * if slope < 0.0 { 2.0 } else { 1.0 } };
        for k in 1..length {
            filter.push(filter[k - 1] * (k as f64 - 1.0 + order) / k as f64);
        }
        filter
    }

    /// Degrees of freedom 2 E²/V of the mean square of overlapping differences, from their covariance.
    fn by_covariance(m: usize, terms: usize, slope: f64) -> f64 {
        const LONG: usize = 4000;
        let noise = filter(slope, LONG);
        let difference = |k: usize| match k {
            k if k < m => -1.0,
            k if k < 2 * m => 1.0,
            _ => 0.0,
        };
        let response: Vec<f64> = (0..LONG).map(|n| (0..=n.min(2 * m)).map(|k| difference(k) * noise[n - k]).sum()).collect();
        let covariance = |lag: usize| response.iter().zip(&response[lag..]).map(|(a, b)| a * b).sum::<f64>();
        let square = |lag: usize| (terms - lag) as f64 * covariance(lag).powi(2);
        let all = terms as f64;
        (all * covariance(0)).powi(2) / (square(0) + 2.0 * (1..terms).map(square).sum::<f64>())
    }

    #[test]
    fn exact_the_degrees_of_freedom_are_those_of_the_differences_covariance() {
        for (slope, tolerance) in [(-1.0, 0.03), (-0.5, 0.012), (0.0, 0.075), (0.5, 0.055)] {
            for (m, n) in [(1, 61), (1, 200), (2, 61), (2, 200), (5, 61), (5, 200), (20, 200)] {
                let terms = n - 2 * m;
                let (found, exact) = (freedom(m as f64, terms as f64, slope), by_covariance(m, terms, slope));
                assert!((found / exact - 1.0).abs() < tolerance, "m {m} of {n}, slope {slope}: {found}, exact {exact}");
            }
        }
        // printed by Riley, NIST SP 1065: 1000 frequencies, m = 10, white noise
        assert!((freedom(10.0, 981.0, -0.5) - 146.177).abs() < 5e-4);
    }

    #[test]
    fn exact_between_two_noises_a_slope_names_the_one_that_falls_less() {
        for m in [1.0, 5.0] {
            for (between, less) in [(-0.75, -0.5), (-0.25, 0.0), (0.25, 0.5)] {
                assert_eq!(freedom(m, 190.0, between), freedom(m, 190.0, less), "{m} {between}");
                assert_ne!(freedom(m, 190.0, between), freedom(m, 190.0, between - 0.25), "{m} {between}");
            }
        }
    }
}
