//! Numbers as people read them.

/// A number with `digits` significant digits, in plain notation where that is short.
pub fn significant(value: f64, digits: usize) -> String {
    let exponent = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    if !value.is_finite() || !(-4..7).contains(&exponent) {
        return format!("{value:.*e}", digits.saturating_sub(1));
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    format!("{value:.decimals$}")
}

/// A number with a true minus sign, and none before a zero.
pub fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.chars().all(|c| "-0.".contains(c));
    if zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "\u{2212}") }
}

/// Text for people in a page's signs: a true minus before a number, ° for deg.
pub fn nice(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut before = [' '; 2];
    for (at, c) in text.char_indices() {
        let number = c == '-' && text[at + 1..].starts_with(|next: char| next.is_ascii_digit());
        // at the start of a word, or in an exponent
        let minus = !before[1].is_alphanumeric() || (before[1] == 'e' && before[0].is_ascii_digit());
        out.push(if number && minus { '\u{2212}' } else { c });
        before = [before[1], c];
    }
    out.replace("degC", "°C").replace("deg/h", "°/h")
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

    #[test]
    fn numbers_have_a_true_minus_and_names_their_hyphen() {
        let text = nice("file-3.csv: -7.1 to 4.8e-5 degC, rate-1");
        assert_eq!(text, "file-3.csv: \u{2212}7.1 to 4.8e\u{2212}5 °C, rate-1");
        assert_eq!([signed(-0.04, 1), signed(-0.06, 1)], ["0.0", "\u{2212}0.1"]);
    }
}
