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
