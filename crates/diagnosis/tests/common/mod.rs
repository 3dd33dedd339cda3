//! Numbers and a model that several tests share.

#![allow(dead_code, reason = "each test binary uses its part")]

pub(crate) mod lines;
pub(crate) mod valleys;

/// Standard normal numbers with a fixed seed: xorshift (Marsaglia 2003), Box and Muller.
pub(crate) fn normal(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut uniform = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    move || (-2.0 * uniform().max(1e-300).ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos()
}
