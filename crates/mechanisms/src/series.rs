//! Functions of series that laws are written with: a value for each row of a recording.

use crate::course::Parts;
use crate::design::REFERENCE_C;
use bias::units::S_PER_H;
use coil::Smooth;

/// Mean of a function over the interval that ends at each row, from its values at the ends.
pub fn middles(series: &[f64], of: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..series.len()).map(|n| (of(series[n]) + of(series[n.saturating_sub(1)])) / 2.0).collect()
}

/// Rate of a series since the row before \[per hour\]; 0 in the first row.
pub fn rates_per_hour(time: &[f64], series: &[f64]) -> Vec<f64> {
    let rate = |n: usize| if n > 0 { (series[n] - series[n - 1]) / (time[n] - time[n - 1]) * S_PER_H } else { 0.0 };
    (0..time.len()).map(rate).collect()
}

/// Parts times slope (T − [`REFERENCE_C`]) of a temperature \[°C\].
pub(crate) fn growing(parts: &Parts, temperature: &[f64], slope: f64) -> Parts {
    let factor = middles(temperature, |t| slope * (t - REFERENCE_C));
    [0, 1, 2].map(|p: usize| parts[p].iter().zip(&factor).map(|(x, f)| x * f).collect())
}

/// A series s that is read `late` \[s\] through a filter with the `squared` time constant \[s²\]: x with x − ½ `squared` x″ = s, even in time, as the filter's
/// own delay is in `late`. With a square below zero, which no filter has, the effect of one of the same size is taken off instead of put on: the two meet smoothly at
/// zero, and neither makes more than twice as much of a quick change.
pub(crate) fn read_late(time: &[f64], series: &[f64], late: f64, squared: f64) -> Vec<f64> {
    let mut read = series.to_vec();
    if squared != 0.0 {
        let filtered = filtered(time, series, squared.abs() / 2.0);
        read.iter_mut().zip(&filtered).for_each(|(x, filtered)| *x += squared.signum() * (filtered - *x));
    }
    if late != 0.0 {
        let smooth = Smooth::through(time, &read);
        read = time.iter().map(|t| smooth.at(t - late).0).collect();
    }
    read
}

/// x − `bent` x″ = s for x, by differences of neighbours; the ends stay (Thomas' algorithm).
fn filtered(time: &[f64], series: &[f64], bent: f64) -> Vec<f64> {
    let last = series.len().saturating_sub(1);
    // of each row the share of the next in what is not known yet
    let (mut shares, mut found) = (Vec::with_capacity(series.len()), Vec::with_capacity(series.len()));
    for n in 0..series.len() {
        let (before, after) = if n == 0 || n == last {
            (0.0, 0.0)
        } else {
            let [to, from] = [time[n] - time[n - 1], time[n + 1] - time[n]];
            (2.0 * bent / (to * (to + from)), 2.0 * bent / (from * (to + from)))
        };
        let [share, value] = if n > 0 { [shares[n - 1], found[n - 1]] } else { [0.0; 2] };
        let left = 1.0 + before + after - before * share;
        shares.push(after / left);
        found.push((series[n] + before * value) / left);
    }
    for n in (0..last).rev() {
        found[n] += shares[n] * found[n + 1];
    }
    found
}

/// A first-order follower of a series that is linear between its instants, exact; it starts settled. `lag` \[s\] > 0.
pub fn lagged(time: &[f64], series: &[f64], lag: f64) -> Vec<f64> {
    let mut x = series[0];
    let mut followed = vec![x];
    for n in 1..series.len() {
        let dt = time[n] - time[n - 1];
        let slope = (series[n] - series[n - 1]) / dt;
        let forget = (-dt / lag).exp();
        // x − (series − slope lag) decays
        x = series[n] - slope * lag + (x - series[n - 1] + slope * lag) * forget;
        followed.push(x);
    }
    followed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_parabola_is_read_late_through_a_filter() {
        let time: Vec<f64> = (0..400).map(f64::from).collect();
        let parabola = |t: f64| 2.0 - t + 0.5 * t * t;
        let series: Vec<f64> = time.iter().map(|t| parabola(*t)).collect();
        // far from the ends, which stay, an even filter adds half its square times the bend
        for squared in [3.0, 0.0, -3.0] {
            let read = read_late(&time, &series, 0.3, squared);
            assert!((read[200] - parabola(199.7) - squared / 2.0).abs() < 1e-9, "{squared}: {}", read[200]);
        }
        assert_eq!((read_late(&[0.0], &[3.0], 1.0, 1.0), read_late(&[], &[], 1.0, 1.0)), (vec![3.0], Vec::new()));
    }

    #[test]
    fn exact_a_filter_keeps_lines_on_uneven_rows_and_the_sum_on_even_ones() {
        let uneven: Vec<f64> = (0..50).map(|n| f64::from(n) + 0.3 * f64::from(n % 3)).collect();
        let line: Vec<f64> = uneven.iter().map(|t| 4.0 - 2.0 * t).collect();
        assert!(read_late(&uneven, &line, 0.0, 7.0).iter().zip(&line).all(|(a, b)| (a - b).abs() < 1e-12));
        let even: Vec<f64> = (0..200).map(f64::from).collect();
        let mut peak = vec![0.0; 200];
        peak[100] = 1.0;
        let read = read_late(&even, &peak, 0.0, 5.0);
        let of = |power: i32| read.iter().zip(&even).map(|(x, t)| x * (t - 100.0).powi(power)).sum::<f64>();
        assert!(
            (of(0) - 1.0).abs() < 1e-12 && of(1).abs() < 1e-12 && (of(2) - 5.0).abs() < 1e-9,
            "{} {} {}",
            of(0),
            of(1),
            of(2)
        );
    }

    /// A change in every row is damped, however slow the filter, and never turned round or made more than twice as large.
    #[test]
    fn quick_changes_stay_bounded() {
        let time: Vec<f64> = (0..100).map(|n| 20.0 * f64::from(n)).collect();
        let quick: Vec<f64> = (0..100).map(|n| if n % 2 == 0 { 1.0 } else { -1.0 }).collect();
        for (squared, low, high) in [(1e3, 0.0, 0.5), (1e6, -0.01, 0.01), (-1e3, 1.5, 2.0), (-1e6, 1.99, 2.01)] {
            let read = read_late(&time, &quick, 0.0, squared);
            assert!(low <= read[50] && read[50] <= high, "{squared}: {}", read[50]);
        }
    }
}
