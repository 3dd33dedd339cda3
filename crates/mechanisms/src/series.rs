//! Functions of series that laws are written with: a value for each row of a recording.

use crate::course::Parts;
use crate::design::REFERENCE_C;
use bias::units::S_PER_H;

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

/// A series that is read late and through a filter, to the second order: s − late ds/dt + bent d²s/dt², by differences of its neighbours; a first and a
/// last value have no bend.
pub(crate) fn read_late(time: &[f64], series: &[f64], late: f64, bent: f64) -> Vec<f64> {
    let slope = |a: usize, b: usize| (series[b] - series[a]) / (time[b] - time[a]);
    let last = series.len().saturating_sub(1);
    let of = |n: usize| match (n, n == last) {
        _ if last == 0 => series[n],
        (0, _) => series[0] - late * slope(0, 1),
        (_, true) => series[n] - late * slope(n - 1, n),
        _ => {
            let [before, behind] = [slope(n - 1, n), slope(n, n + 1)];
            let [to, from] = [time[n] - time[n - 1], time[n + 1] - time[n]];
            // the parabola through three neighbours
            let first = (before * from + behind * to) / (to + from);
            series[n] - late * first + bent * 2.0 * (behind - before) / (to + from)
        }
    };
    (0..series.len()).map(of).collect()
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
    fn exact_a_parabola_is_read_late_on_uneven_rows() {
        let time = [0.0, 1.0, 3.0, 4.5, 7.0];
        let series = time.map(|t| 2.0 - t + 0.5 * t * t);
        let late = read_late(&time, &series, 0.2, 0.02);
        for n in 1..4 {
            let shifted = time[n] - 0.2;
            assert!((late[n] - (2.0 - shifted + 0.5 * shifted * shifted)).abs() < 1e-12, "{late:?}");
        }
        // the ends go on straight
        assert!((late[0] - (2.0 + 0.2 * 0.5)).abs() < 1e-12);
        assert!((late[4] - (series[4] - 0.2 * (series[4] - series[3]) / 2.5)).abs() < 1e-12);
        assert_eq!((read_late(&[0.0], &[3.0], 1.0, 1.0), read_late(&[], &[], 1.0, 1.0)), (vec![3.0], Vec::new()));
    }
}
