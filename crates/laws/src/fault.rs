//! The faults of an expression or a unit.

use std::fmt;
use std::ops::Range;

/// A mistake in a text: where, what, and how to mend it.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// Bytes of the text that it concerns.
    pub at: Range<usize>,
    /// The fault.
    pub problem: String,
    /// The remedy.
    pub remedy: String,
}

impl Fault {
    pub(crate) fn new(at: Range<usize>, problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { at, problem: problem.into(), remedy: remedy.into() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.problem, self.remedy)
    }
}

impl std::error::Error for Fault {}
