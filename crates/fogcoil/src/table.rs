//! Aligned text for people.

use std::fmt::Write;

/// Rows of cells, the columns padded to the same width; every cell but the first and the last is right-aligned.
pub(crate) fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
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

/// A number with `digits` significant digits, in plain notation where that is short.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    let exponent = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    if !value.is_finite() || !(-4..7).contains(&exponent) {
        return format!("{value:.*e}", digits.saturating_sub(1));
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    format!("{value:.decimals$}")
}

/// An error estimate: two significant digits.
pub(crate) fn plus_minus(error: f64) -> String {
    if error == 0.0 { "± 0".into() } else { format!("± {error:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits() {
        let cases = [(14.4959, "14.496"), (95.2, "95.200"), (0.0274, "0.027400"), (1.5e-9, "1.5000e-9"), (0.0, "0.0000")];
        for (value, expected) in cases {
            assert_eq!(significant(value, 5), expected);
        }
        assert_eq!(significant(f64::NAN, 3), "NaN");
    }
}
