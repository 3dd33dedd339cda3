//! Time constants with which a response may follow a ramp.

use super::absent::{Absent, SETTLED};

/// A time constant is half of the one before: less far apart they can hardly be told from each other, farther apart they miss what lies between.
const RATIO: f64 = 2.0;
const MOST: usize = 8;
/// Shortest, in intervals: of it a row sees 98 %, so that what follows at once is followed.
const SHORTEST: f64 = 0.25;
/// Fewest rows of a ramp.
const ROWS_OF_RAMP: f64 = 6.0;

/// Sets of lags \[s\], the longest first, where a response is seen to settle for `settling` \[s\], rows being `interval` apart \[s\].
///
/// The second set lies between the lags of the first: what a response of other time constants makes of one set and of the other tells how far off
/// a set may be.
pub(super) fn sets(settling: f64, interval: f64) -> Result<Vec<Vec<f64>>, Absent> {
    let longest = settling / SETTLED;
    if settling < ROWS_OF_RAMP * interval {
        return Err(Absent::Fast { duration: settling, rows: ROWS_OF_RAMP });
    }
    let shortest = SHORTEST * interval;
    let set = |first: f64| -> Vec<f64> {
        let all = (0..MOST as i32).map(|n| first / RATIO.powi(n));
        all.enumerate().filter(|(n, lag)| *n == 0 || *lag >= shortest).map(|(_, lag)| lag).collect()
    };
    Ok(vec![set(longest), set(longest / RATIO.sqrt())])
}

/// All lags of some sets in one: finer than each of them, where a record tells so many.
pub(super) fn finer(sets: &[Vec<f64>]) -> Vec<f64> {
    let mut all = sets.concat();
    all.sort_by(|a, b| b.total_cmp(a));
    all
}

/// A set that begins at twice the longest lag of another.
pub(super) fn slower(set: &[f64]) -> Vec<f64> {
    set.first().map(|first| RATIO * first).into_iter().chain(set.iter().copied()).collect()
}
