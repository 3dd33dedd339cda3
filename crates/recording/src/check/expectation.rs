//! What a channel is expected to hold.

/// A unit in which a channel may be recorded by mistake: expected value = scale · value + offset.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// Its name.
    pub name: String,
    /// Factor.
    pub scale: f64,
    /// Added after the factor.
    pub offset: f64,
}

/// An offset that something known explains.
#[derive(Debug, Clone, PartialEq)]
pub struct Offset {
    /// The most that is expected \[u\].
    pub largest: f64,
    /// The most that what is known explains \[u\].
    pub explained: f64,
    /// What is known, e.g. "Earth rate not removed".
    pub of: String,
}

/// What a channel is expected to hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Expectation {
    /// Where its values may lie \[u\].
    pub values: [f64; 2],
    /// What no value is beyond, whatever was recorded \[u\].
    pub possible: [f64; 2],
    /// Where a recording at rest in a room starts \[u\]; a start elsewhere is suspected if another unit brings it there.
    pub start: [f64; 2],
    /// Where the standard deviation of its white noise may lie \[u\].
    pub noise: [f64; 2],
    /// Values below this size whose noise is too small as well are in another unit \[u\].
    pub least_size: f64,
    /// Units in which it may be by mistake.
    pub mistaken: Vec<Unit>,
    /// An offset that may have been left in.
    pub offset: Option<Offset>,
    /// Whether the recording is useless if the channel is empty or constant.
    pub essential: bool,
}

impl Default for Expectation {
    /// Anything.
    fn default() -> Self {
        let any = [f64::NEG_INFINITY, f64::INFINITY];
        Self {
            values: any,
            possible: any,
            start: any,
            noise: any,
            least_size: 0.0,
            mistaken: Vec::new(),
            offset: None,
            essential: false,
        }
    }
}

pub(super) fn within(value: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&value)
}
