//! Printed output against what a page shows of it.

/// Relative difference of two numbers that counts as none.
pub(super) const TOLERANCE: f64 = 1e-3;

/// Whether `actual` is what `expected` shows; `...` alone on a line stands for any lines, inside a line for any words. Blank lines and widths of
/// columns do not count. Otherwise the line (from 0) of `expected` that was not found, and what stood there instead.
pub(super) fn compare(expected: &str, actual: &str, tolerance: f64) -> Result<(), (usize, String)> {
    let lines = |text| str::lines(text).enumerate().filter(|(_, line)| !line.trim().is_empty());
    let (shown, printed): (Vec<_>, Vec<_>) = (lines(expected).collect(), lines(actual).map(|(_, line)| line).collect());
    let mut farthest = (0, 0);
    if lines_match(&shown, &printed, tolerance, (0, 0), &mut farthest) {
        return Ok(());
    }
    let (at, stood) = farthest;
    let line = shown.get(at).map_or_else(|| expected.lines().count(), |(line, _)| *line);
    Err((line, printed.get(stood).map_or("the end of the output".to_owned(), |line| format!("`{}`", line.trim()))))
}

fn lines_match(
    shown: &[(usize, &str)],
    printed: &[&str],
    tolerance: f64,
    at: (usize, usize),
    farthest: &mut (usize, usize),
) -> bool {
    if at.0 > farthest.0 {
        *farthest = at;
    }
    let (i, j) = at;
    match shown.get(i) {
        None => j == printed.len(),
        Some((_, line)) if is_elision(line.trim()) => {
            (j..=printed.len()).any(|j| lines_match(shown, printed, tolerance, (i + 1, j), farthest))
        }
        Some((_, line)) => {
            let words = |line: &'_ str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
            printed.get(j).is_some_and(|actual| words_match(&words(line), &words(actual), tolerance))
                && lines_match(shown, printed, tolerance, (i + 1, j + 1), farthest)
        }
    }
}

fn is_elision(word: &str) -> bool {
    matches!(word, "..." | "…")
}

fn words_match(shown: &[String], printed: &[String], tolerance: f64) -> bool {
    match shown.split_first() {
        None => printed.is_empty(),
        Some((word, rest)) if is_elision(word) => (0..=printed.len()).any(|n| words_match(rest, &printed[n..], tolerance)),
        Some((word, rest)) => printed
            .split_first()
            .is_some_and(|(first, others)| same(word, first, tolerance) && words_match(rest, others, tolerance)),
    }
}

/// Whether two words are equal but for their numbers, and these close.
fn same(shown: &str, printed: &str, tolerance: f64) -> bool {
    let (a, b) = (pieces(shown), pieces(printed));
    a.len() == b.len()
        && a.iter().zip(&b).all(|pair| match pair {
            (Piece::Number(a), Piece::Number(b)) => (a - b).abs() <= tolerance * a.abs().max(b.abs()),
            (Piece::Text(a), Piece::Text(b)) => a == b,
            _ => false,
        })
}

enum Piece<'a> {
    Number(f64),
    Text(&'a str),
}

/// A word, cut where numbers begin and end.
fn pieces(word: &str) -> Vec<Piece<'_>> {
    let (mut pieces, mut rest) = (Vec::new(), word);
    while !rest.is_empty() {
        let start = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
        let signed = start - usize::from(rest[..start].ends_with(['-', '+']));
        if signed > 0 {
            pieces.push(Piece::Text(&rest[..signed]));
        }
        let of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | 'E' | '+' | '-');
        let most = rest[start..].find(|c| !of_number(c)).map_or(rest.len(), |n| start + n);
        let number = (start + 1..=most).rev().find_map(|end| Some((end, rest[signed..end].parse().ok()?)));
        match number.filter(|_| start < rest.len()) {
            Some((end, number)) => {
                pieces.push(Piece::Number(number));
                rest = &rest[end..];
            }
            None => break,
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_may_differ_a_little_and_words_not_at_all() {
        let actual = "length  1101.5666 m\n\nS = -2.7335±1.4e-3, good\nrest\nend\n";
        for shown in [actual, "length 1101.6 m\n...\nend", "...\nS = -2.734±1.4e-3, ...\nrest\nend", "…"] {
            assert_eq!(compare(shown, actual, TOLERANCE), Ok(()), "{shown}");
        }
        for (shown, line) in [
            ("length 1104.0 m\n...", 0),
            ("length 1101.5666 m\nS = 2.7335±1.4e-3, good\n...", 1),
            ("...\nS = -2.7335±1.4e-3, bad\n...", 1),
            ("...\nrest", 2),
            ("...\nrest\nend\nmore", 3),
        ] {
            assert_eq!(compare(shown, actual, TOLERANCE).map_err(|(line, _)| line), Err(line), "{shown}");
        }
    }
}
