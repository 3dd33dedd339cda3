//! Time constants of the lags behind a temperature that a recording can tell apart.

/// Shortest lag, in intervals; the longest is a third of the length.
const SHORTEST_LAG: f64 = 2.0;
/// A lag is this many times the one before.
const LAG_RATIO: f64 = 3.0;
/// Most values of all lags together: memory.
const MOST_VALUES: usize = 20_000_000;
/// Fewest rows for each lag.
const ROWS_A_LAG: usize = 20;

/// Time constants \[s\] for rows at an interval \[s\] over a span \[s\], the shortest first.
pub(super) fn lags(interval: f64, span: f64, rows: usize) -> Vec<f64> {
    let (shortest, longest) = (SHORTEST_LAG * interval, span / 3.0);
    let count = 1.0 + (longest / shortest).max(1.0).log(LAG_RATIO).floor();
    let count = (count as usize).min(rows / ROWS_A_LAG).min(MOST_VALUES / rows.max(1));
    let ratio = if count as f64 * LAG_RATIO.ln() < (longest / shortest).ln() && count > 1 {
        (longest / shortest).powf(1.0 / (count as f64 - 1.0))
    } else {
        LAG_RATIO
    };
    (0..count as i32).map(|n| shortest * ratio.powi(n)).collect()
}
