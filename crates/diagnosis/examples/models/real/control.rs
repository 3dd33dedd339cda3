//! Negative controls: what is left of a record, robbed of all that a law could have made of it.

use std::f64::consts::TAU;

/// In another order.
pub(crate) fn shuffled(series: &[f64], seed: u64) -> Vec<f64> {
    let mut normal = normal(seed);
    let mut keyed: Vec<(f64, f64)> = series.iter().map(|x| (normal(), *x)).collect();
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
    keyed.into_iter().map(|(_, x)| x).collect()
}

/// Noise of the same spectrum: random phases (Theiler et al. 1992).
pub(crate) fn surrogate(series: &[f64], seed: u64) -> Vec<f64> {
    let mut normal = normal(seed);
    let n = series.len();
    let mean = series.iter().sum::<f64>() / n as f64;
    let mut y = vec![mean; n];
    for k in 1..n / 2 {
        let angle = |i: usize| TAU * ((k * i) % n) as f64 / n as f64;
        let sums = series.iter().enumerate().map(|(i, x)| ((x - mean) * angle(i).cos(), (x - mean) * angle(i).sin()));
        let (a, b) = sums.fold((0.0, 0.0), |(a, b), (c, s)| (a + c, b + s));
        let (size, phase) = (2.0 * a.hypot(b) / n as f64, TAU * normal());
        y.iter_mut().enumerate().for_each(|(i, y)| *y += size * (angle(i) + phase).cos());
    }
    y
}

/// Standard normal numbers with a fixed seed: xorshift (Marsaglia 2003), Box and Muller.
pub(crate) fn normal(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut uniform = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    move || (-2.0 * uniform().max(1e-300).ln()).sqrt() * (TAU * uniform()).cos()
}
