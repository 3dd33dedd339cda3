//! A measured number and its interval, or the reason for having none.

/// A number with its 90 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figure {
    /// The number.
    pub value: f64,
    /// The ends of its interval.
    pub ci90: [f64; 2],
}

/// A number, or why the record does not tell it.
pub type Told = Result<Figure, String>;
