//! The lines of a file that a finding is about.

use std::ops::RangeInclusive;

use recording::check::{Finding, FindingKind};

/// Rows of a recording in the order of their instants, with their lines.
#[derive(Debug)]
pub struct Lines<'a> {
    time: &'a [f64],
    lines: &'a [u32],
    order: Vec<usize>,
}

impl<'a> Lines<'a> {
    /// Of rows with their instants \[s\] and lines; of rows without lines, none.
    pub(super) fn new(time: &'a [f64], lines: &'a [u32]) -> Self {
        let mut order: Vec<usize> = (0..time.len().min(lines.len())).collect();
        order.sort_by(|a, b| time[*a].total_cmp(&time[*b]));
        Self { time, lines, order }
    }

    /// First and last line of the rows at the instants of a finding. `None` if it is about all, if the recording has no lines, or if these rows stand in
    /// several places of a file whose clock is set back.
    pub fn of(&self, finding: &Finding) -> Option<RangeInclusive<u32>> {
        let [from, to] = finding.span?;
        let time = self.time;
        let first = self.order.partition_point(|row| time[*row] < from);
        let mut rows = &self.order[first..first.max(self.order.partition_point(|row| time[*row] <= to))];
        if let FindingKind::Backwards(_) = finding.kind {
            rows = std::slice::from_ref(rows.iter().find(|row| **row > 0 && time[**row] < time[**row - 1])?);
        }
        let (low, high) = (*rows.iter().min()?, *rows.iter().max()?);
        (high - low + 1 == rows.len()).then(|| self.lines[low]..=self.lines[high])
    }
}
