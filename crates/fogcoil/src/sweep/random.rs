//! Random numbers that follow from a seed and a place: no state, so that any thread has the same.
//!
//! SplitMix64 (G. L. Steele, D. Lea and C. H. Flood, OOPSLA 2014) as a hash of seed, stream and place.

fn mixed(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// 64 random bits.
pub(super) fn bits(seed: u64, stream: u64, place: u64) -> u64 {
    mixed(mixed(mixed(seed) ^ stream) ^ place)
}

/// A number from 0 to below 1.
pub(super) fn uniform(seed: u64, stream: u64, place: u64) -> f64 {
    (bits(seed, stream, place) >> 11) as f64 / (1u64 << 53) as f64
}

/// A whole number below `count`.
pub(super) fn below(count: usize, seed: u64, stream: u64, place: u64) -> usize {
    ((uniform(seed, stream, place) * count as f64) as usize).min(count.saturating_sub(1))
}

/// 0 to `count` in a random order.
pub(super) fn permutation(count: usize, seed: u64, stream: u64) -> Vec<u32> {
    let mut all: Vec<u32> = (0..count as u32).collect();
    for last in (1..count).rev() {
        all.swap(last, below(last + 1, seed, stream, last as u64));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_first_numbers() {
        // SplitMix64 of state 0: its first output
        assert_eq!(mixed(0), 0xe220_a839_7b1d_cdaf);
    }

    #[test]
    fn even_and_independent() {
        let draws: Vec<f64> = (0..20_000).map(|n| uniform(7, 1, n)).collect();
        let other: Vec<f64> = (0..20_000).map(|n| uniform(7, 2, n)).collect();
        let mean = |of: &dyn Fn(usize) -> f64| (0..20_000).map(of).sum::<f64>() / 20_000.0;
        assert!((mean(&|n| draws[n]) - 0.5).abs() < 0.01);
        assert!((mean(&|n| (draws[n] - 0.5).powi(2)) - 1.0 / 12.0).abs() < 0.002);
        assert!(mean(&|n| (draws[n] - 0.5) * (other[n] - 0.5)).abs() < 0.002);
        let mut order = permutation(1000, 3, 0);
        assert!(order.windows(2).filter(|w| w[0] < w[1]).count() < 600);
        order.sort_unstable();
        assert!(order.iter().enumerate().all(|(n, value)| n as u32 == *value));
    }
}
