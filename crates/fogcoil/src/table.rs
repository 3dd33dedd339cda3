//! Text for people: sentences, numbers and aligned tables.

use std::fmt::Write;

pub(crate) use charts::significant;

/// Rows of cells, the columns padded to the same width; every cell but the first and the last is right-aligned.
pub(crate) fn table(rows: &[impl AsRef<[String]>]) -> String {
    let rows: Vec<&[String]> = rows.iter().map(AsRef::as_ref).collect();
    let columns = rows.iter().map(|row| row.len()).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|c| c.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (i, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let _ = match i {
                0 => write!(line, "{cell:<width$}"),
                _ if i + 1 == columns => write!(line, "  {cell}"),
                _ => write!(line, "  {cell:>width$}"),
            };
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// The words with a capital at their beginning.
pub(crate) fn capital(words: &str) -> String {
    words.chars().take(1).flat_map(char::to_uppercase).chain(words.chars().skip(1)).collect()
}

/// Ln odds, `shown` as far as they are more than "certain": larger ones depend on the noise that a hypothesis was judged with.
pub(crate) fn odds(log_odds: f64, shown: impl Fn(f64) -> String) -> String {
    if log_odds >= 99.5 { "> 99".into() } else { shown(log_odds) }
}

/// Share of a number below which what stands beside it is rounding.
const ROUNDING: f64 = 1e-9;

/// A number that stands beside larger ones of its kind, the largest of them `scale`: nothing where it is but rounding of that.
pub(crate) fn beside(value: f64, scale: f64) -> f64 {
    if value.abs() < ROUNDING * scale.abs() { 0.0 } else { value }
}

/// An error estimate: two significant digits.
pub(crate) fn plus_minus(error: f64) -> String {
    if error == 0.0 { "± 0".into() } else { format!("± {error:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_beside_a_number_is_nothing() {
        assert_eq!([2.8e-12, -1.8e-15, 1e-8, -0.1].map(|value| beside(value, 5.67)), [0.0, 0.0, 1e-8, -0.1]);
        assert_eq!(beside(1e-20, 0.0), 1e-20);
    }
}
