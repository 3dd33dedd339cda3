//! Lags of linear first-order systems behind their input: columns that stand for a slow response of unknown shape.

/// Input minus the state of a first-order system of time constant `lag` \[s\], 0 or more, that follows it, from rest at the first instant.
///
/// The input is linear between the instants; the state is exact. Under a steady ramp the result settles at rate · lag.
///
/// # Panics
/// If there are not as many values as instants.
pub fn lagging(time: &[f64], input: &[f64], lag: f64) -> Vec<f64> {
    assert_eq!(time.len(), input.len(), "one value for each instant");
    let mut behind = 0.0;
    (0..time.len())
        .map(|row| {
            if row > 0 {
                let u = (time[row] - time[row - 1]) / lag;
                // d behind/dt = d input/dt − behind/lag
                let rise = if u > 0.0 { -(-u).exp_m1() / u } else { 1.0 };
                behind = behind * (-u).exp() + (input[row] - input[row - 1]) * rise;
            }
            behind
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::lagging;

    #[test]
    fn a_ramp_settles_and_a_step_decays() {
        let time: Vec<f64> = (0..200).map(|i| f64::from(i) * 30.0).collect();
        let ramp: Vec<f64> = time.iter().map(|t| 0.01 * t).collect();
        let behind = lagging(&time, &ramp, 500.0);
        for (t, b) in time.iter().zip(&behind) {
            assert!((b - 0.01 * 500.0 * (1.0 - (-t / 500.0).exp())).abs() < 1e-12, "{t} {b}");
        }
        let uneven = [0.0, 1.0, 5.0, 50.0];
        let behind = lagging(&uneven, &[0.0, 3.0, 3.0, 3.0], 10.0);
        assert!((behind[3] - behind[1] * (-4.9_f64).exp()).abs() < 1e-14);
    }
}
