//! A measured number and its interval, or the reason for having none.

/// A number with its 90 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figure {
    /// The number.
    pub value: f64,
    /// The ends of its interval.
    pub ci90: [f64; 2],
}

/// A number that is not told, or not its interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Untold {
    /// Reason why it, or its interval, is not told.
    pub why: String,
    /// The number, where only its interval is not known.
    pub value: Option<f64>,
}

impl From<String> for Untold {
    fn from(why: String) -> Self {
        Self { why, value: None }
    }
}

/// A number, or why the record does not tell it.
pub type Told = Result<Figure, Untold>;
