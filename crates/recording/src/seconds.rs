//! Instants and intervals as messages tell them.

use std::fmt;

/// An instant or an interval \[s\], to the microsecond: what arithmetic leaves behind that is not shown.
///
/// ```
/// use recording::Seconds;
///
/// assert_eq!(format!("{} s, {} s", Seconds(60.00000000000001), Seconds(0.1 + 0.2)), "60 s, 0.3 s");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seconds(pub f64);

/// Digits of a second \[1/s\].
const MICROSECONDS: f64 = 1e6;

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded = (self.0 * MICROSECONDS).round() / MICROSECONDS;
        // beyond what a double holds in microseconds it is as it is
        write!(f, "{}", if rounded.is_finite() { rounded } else { self.0 })
    }
}
