//! A table of the comparison, with what is said about it.

use super::row::ComparisonRow;
use crate::Failure;
use std::time::Instant;

/// The rows of one table.
#[derive(Debug, Clone)]
pub struct Section {
    /// Heading.
    pub title: String,
    /// Paragraphs above the rows, in Markdown.
    pub notes: Vec<String>,
    /// What took how long, for the terminal.
    pub timings: Vec<String>,
    /// The comparisons.
    pub rows: Vec<ComparisonRow>,
    /// |S| over spools where the section has them: material, hub, flanges; S \[(deg/h)/(degC/min)\].
    pub lines: Vec<(String, f64)>,
}

impl Section {
    /// One without rows.
    pub fn new(title: &str) -> Self {
        Self { title: title.into(), notes: Vec::new(), timings: Vec::new(), rows: Vec::new(), lines: Vec::new() }
    }

    /// Adds a paragraph.
    pub fn note(&mut self, text: impl Into<String>) {
        self.notes.push(text.into());
    }

    pub(super) fn timing(&mut self, text: String) {
        self.timings.push(text);
    }
}

/// A result with the seconds it took.
pub(super) fn timed<T, E: Into<Failure>>(work: impl FnOnce() -> Result<T, E>) -> Result<(T, f64), Failure> {
    let start = Instant::now();
    let result = work().map_err(Into::into)?;
    Ok((result, start.elapsed().as_secs_f64()))
}
