//! The faults of an input file.

use std::fmt;
use std::path::PathBuf;

use crate::{shown, shown_path};

/// A value, a line or a file that cannot be used, with its place and its remedy.
///
/// Displays as one message, `file:line: field: problem; remedy`.
#[derive(Debug, Clone, PartialEq)]
pub struct InputError {
    /// The file.
    pub file: PathBuf,
    /// Line counted from 1, if the error has one.
    pub line: Option<usize>,
    /// Path of the field, e.g. `rings[1].material.poisson_ratio`, if the error has one.
    pub field: Option<String>,
    /// The fault, with the value.
    pub problem: String,
    /// The remedy; empty where the problem says it.
    pub remedy: String,
}

impl InputError {
    /// A complaint about a file as a whole.
    pub fn whole(file: impl Into<PathBuf>, problem: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { file: file.into(), line: None, field: None, problem: problem.into(), remedy: remedy.into() }
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", shown_path(&self.file))?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": ")?;
        if let Some(field) = &self.field {
            write!(f, "{}: ", cut(field))?;
        }
        write!(f, "{}", cut(&self.problem))?;
        if !self.remedy.is_empty() {
            write!(f, "; {}", self.remedy)?;
        }
        Ok(())
    }
}

/// Longest part of a message \[characters\]; what a file holds may be longer.
const LONGEST: usize = 400;

/// The start of a long text, without orders to a terminal.
fn cut(text: &str) -> String {
    let short: String = text.chars().take(LONGEST).collect();
    let more = if short.len() < text.len() { "..." } else { "" };
    shown(&short) + more
}

impl std::error::Error for InputError {}
