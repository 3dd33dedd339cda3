//! Series that go along with each other.

/// Correlation from which a column merely repeats a temperature, the rate, or the time.
const REPEATS: f64 = 0.99;

/// Rows in which both have a value, less the mean of each.
pub(super) fn centred(a: &[f64], b: &[f64]) -> Vec<(f64, f64)> {
    let both: Vec<(f64, f64)> =
        a.iter().copied().zip(b.iter().copied()).filter(|(a, b)| a.is_finite() && b.is_finite()).collect();
    let count = both.len().max(1) as f64;
    let mean = [both.iter().map(|pair| pair.0).sum::<f64>() / count, both.iter().map(|pair| pair.1).sum::<f64>() / count];
    both.into_iter().map(|(a, b)| (a - mean[0], b - mean[1])).collect()
}

/// Sums of squares and of products.
pub(super) fn sums(pairs: &[(f64, f64)]) -> [f64; 3] {
    pairs.iter().fold([0.0; 3], |[aa, ab, bb], (a, b)| [aa + a * a, ab + a * b, bb + b * b])
}

/// Whether two series in the rows of some records are straight lines of each other, or one of them is constant.
pub(super) fn repeats<'a>(records: impl Iterator<Item = (&'a [f64], &'a [f64])>) -> bool {
    let [aa, ab, bb] = sums(&records.flat_map(|(a, b)| centred(a, b)).collect::<Vec<_>>());
    ab.abs() >= REPEATS * (aa * bb).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_another_series_repeats_it() {
        let time: Vec<f64> = (0..600).map(|n| 60.0 * f64::from(n)).collect();
        let volts: Vec<f64> = (0..600).map(|n| 24.0 + 0.4 * (f64::from(n) / 40.0).sin()).collect();
        let noise = |row: usize| 0.01 * ((row * row * 37 % 101) as f64 / 50.0 - 1.0);
        let line: Vec<f64> = volts.iter().enumerate().map(|(n, v)| 3.0 - 2.0 * v + noise(n)).collect();
        assert!(repeats([(volts.as_slice(), line.as_slice())].into_iter()));
        assert!(!repeats([(volts.as_slice(), time.as_slice())].into_iter()));
        assert!(repeats([(vec![24.0; 600].as_slice(), time.as_slice())].into_iter()));
    }
}
