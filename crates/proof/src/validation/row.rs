//! One comparison: printed, computed ± numerical error, verdict, kind of agreement, reason; and a table of them.

use super::fixtures::{Printed, decimals};
use crate::Failure;
use serde::Serialize;
use std::time::Instant;

/// Kind of an agreement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Agreement {
    /// Follows from inputs that owe nothing to the printed value.
    Predicted,
    /// Nothing printed is compared: the program against itself, an identity, a count, or an independent code.
    Verified,
    /// The inputs were identified from the printed values.
    Identified,
    /// An input the paper leaves open was chosen to agree.
    Calibrated,
    /// The printed value cannot be right as it stands.
    Misprint,
}

/// Comparison of printed and computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// They agree by a test.
    Holds,
    /// Nothing is tested: the number is shown for what it is.
    Shown,
    /// They differ, for the reason given.
    Differs,
    /// They had to agree and do not.
    Fails,
}

/// One row of the comparison.
#[derive(Debug, Clone, Serialize)]
pub struct ComparisonRow {
    /// Permanent, with the table in front.
    pub id: String,
    /// The compared quantity.
    pub quantity: String,
    /// The paper's number, digit by digit; `None` where it has none.
    pub printed: Option<String>,
    /// Ours, in `unit`.
    pub computed: f64,
    /// Absolute, in `unit`.
    pub numerical_error: f64,
    /// Unit of both.
    pub unit: String,
    /// Their comparison.
    pub verdict: Verdict,
    /// Kind of an agreement.
    pub kind: Agreement,
    /// Whether the command fails with this row.
    pub must_hold: bool,
    /// Reason of the difference, or meaning of the agreement.
    pub reason: String,
}

impl ComparisonRow {
    /// A number without a printed one; nothing is tested yet.
    pub(super) fn shown([id, quantity, unit]: [&str; 3], computed: f64, numerical_error: f64, kind: Agreement) -> Self {
        let [id, quantity, unit] = [id, quantity, unit].map(str::to_owned);
        let (printed, reason, verdict) = (None, String::new(), Verdict::Shown);
        Self { id, quantity, printed, computed, numerical_error, unit, verdict, kind, must_hold: false, reason }
    }

    /// A number in SI beside the printed one; they differ until a test says otherwise.
    pub(super) fn beside(printed: &Printed, computed: f64, relative_error: f64, kind: Agreement) -> Self {
        let computed = computed / printed.scale;
        let names = [&printed.id[..], &printed.quantity, &printed.unit];
        let row = Self::shown(names, computed, computed.abs() * relative_error, kind);
        Self { printed: Some(printed.printed.clone()), verdict: Verdict::Differs, ..row }
    }

    /// A row that agrees or fails.
    pub fn required(mut self, holds: bool) -> Self {
        self.must_hold = true;
        self.verdict = if holds { Verdict::Holds } else { Verdict::Fails };
        self
    }

    /// A row that may differ, with its reason.
    pub(super) fn compared(mut self, holds: bool, reason: impl Into<String>) -> Self {
        self.verdict = if holds { Verdict::Holds } else { Verdict::Differs };
        self.reason = reason.into();
        self
    }

    pub(super) fn because(mut self, reason: impl Into<String>) -> Self {
        self.reason = reason.into();
        self
    }

    /// Computed ± numerical error, with the digits that are justified.
    pub fn computed_text(&self) -> String {
        with_error(self.computed, self.numerical_error, self.printed.as_deref().map_or(0, decimals))
    }
}

/// The rows of one table.
#[derive(Debug, Clone)]
pub struct Section {
    /// Heading.
    pub title: String,
    /// Paragraphs above the rows, in Markdown.
    pub notes: Vec<String>,
    /// Durations of the steps, for the terminal.
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
}

pub(super) fn timed<T, E: Into<Failure>>(work: impl FnOnce() -> Result<T, E>) -> Result<(T, f64), Failure> {
    let start = Instant::now();
    let result = work().map_err(Into::into)?;
    Ok((result, start.elapsed().as_secs_f64()))
}

/// Whether `value`, anywhere within its numerical error, rounds to the printed digits.
pub(super) fn rounds_to(printed: &str, value: f64, error: f64) -> bool {
    let round = |v: f64| format!("{v:.*}", decimals(printed));
    round(value - error) == printed && round(value + error) == printed
}

/// `value ± error`: as many decimals as the error justifies, at least `at_least`.
fn with_error(value: f64, error: f64, at_least: usize) -> String {
    if error == 0.0 {
        return plain(value);
    }
    let digits = (1.0 - error.log10().floor()).clamp(at_least as f64, 15.0) as usize;
    format!("{value:.digits$} ± {error:.1e}")
}

/// A count, or a number of no stated error to four digits.
fn plain(value: f64) -> String {
    if value.fract() == 0.0 {
        format!("{value:.0}")
    } else if value.abs() < 0.01 {
        format!("{value:.1e}")
    } else {
        format!("{value:.3}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_rounding_respects_printed_digits_and_the_error() {
        assert!(rounds_to("0.392", 0.39183723, 1e-7));
        assert!(rounds_to("193", 193.2, 0.1) && !rounds_to("193", 193.45, 0.1));
        assert!(!rounds_to("95.2", 95.2, 0.06) && rounds_to("-0.17", -0.1703, 1e-4));
        assert_eq!(with_error(95.2049940, 0.0000804, 1), "95.204994 ± 8.0e-5");
        assert_eq!(with_error(1101.566598648, 1e-10, 2), "1101.56659864800 ± 1.0e-10");
        assert_eq!(decimals("2.74e-6"), 2);
        assert_eq!((plain(3798.0).as_str(), plain(-4e-12).as_str(), plain(1.8834).as_str()), ("3798", "-4.0e-12", "1.883"));
    }
}
