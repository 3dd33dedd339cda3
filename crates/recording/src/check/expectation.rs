//! Expected content of a channel.

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
    /// An offset that is known and no mistake \[u\], 0 if there is none; its opposite is one.
    pub known: f64,
    /// The most that is expected beside it, or without it \[u\].
    pub largest: f64,
    /// The most that what is known explains \[u\].
    pub explained: f64,
    /// Its cause, e.g. "Earth rate not removed", or what is known.
    pub of: String,
}

/// Expected content of a channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Expectation {
    /// Range of its values \[u\].
    pub values: [f64; 2],
    /// Range beyond which no value is possible, whatever was recorded \[u\].
    pub possible: [f64; 2],
    /// Range in which a recording at rest in a room starts \[u\]; a start elsewhere is suspected if another unit brings it there.
    pub start: [f64; 2],
    /// Where the standard deviation of its white noise may lie \[u\].
    pub noise: [f64; 2],
    /// Values below this size whose noise is too small as well are in another unit \[u\].
    pub least_size: f64,
    /// The fastest that it can change for some rows \[u/s\].
    pub fastest: f64,
    /// Whether it may change by a step from one row to the next: a temperature inside a mass does not.
    pub may_jump: bool,
    /// Longest time for which a value of a slower logger may be repeated \[s\]; 0: what repeats was read that often, as levels that are commanded.
    pub longest_hold: f64,
    /// Units in which it may be by mistake.
    pub mistaken: Vec<Unit>,
    /// Its key where its unit is declared; empty if it cannot be.
    pub key: String,
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
            fastest: f64::INFINITY,
            may_jump: true,
            longest_hold: 0.0,
            mistaken: Vec::new(),
            key: String::new(),
            offset: None,
            essential: false,
        }
    }
}

/// Expected instants.
#[derive(Debug, Clone, PartialEq)]
pub struct Clock {
    /// Range of a recording's duration \[s\]; a short one needs many rows.
    pub span: [f64; 2],
    /// Usual duration \[s\]: the unit that comes nearest to it is the likeliest.
    pub usual: f64,
    /// Units in which the instants may be by mistake.
    pub mistaken: Vec<Unit>,
    /// Their key where their unit is declared; empty if it cannot be.
    pub key: String,
}

impl Default for Clock {
    /// Any.
    fn default() -> Self {
        Self { span: [0.0, f64::INFINITY], usual: 1.0, mistaken: Vec::new(), key: String::new() }
    }
}

impl Clock {
    /// Units in which instants that span so much \[s\] are plausible and, of a change that is `too_fast` times as fast as can be, slow enough;
    /// the likeliest first.
    pub(super) fn candidates(&self, span: f64, too_fast: f64) -> Vec<String> {
        let fits = |unit: &&Unit| within(unit.scale * span, self.span) && unit.scale >= too_fast;
        let distance = |unit: &Unit| (unit.scale * span / self.usual).ln().abs();
        let mut units: Vec<&Unit> = self.mistaken.iter().filter(fits).collect();
        units.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        units.into_iter().map(|unit| unit.name.clone()).collect()
    }
}

pub(super) fn within(value: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&value)
}
