//! Printed output against what a page shows of it.

/// Relative difference of two numbers that counts as none.
pub(super) const TOLERANCE: f64 = 1e-3;

/// Whether `actual` is what `expected` shows; `...` alone on a line stands for any lines, inside a line for any words. Blank lines and widths of
/// columns do not count. Otherwise the line (from 0) of `expected` that was not found, and what stood there instead.
pub(super) fn compare(expected: &str, actual: &str, tolerance: f64) -> Result<(), (usize, String)> {
    let lines = |text| str::lines(text).enumerate().filter(|(_, line)| !line.trim().is_empty());
    let (shown, printed): (Vec<_>, Vec<_>) = (lines(expected).collect(), lines(actual).map(|(_, line)| line).collect());
    let mut farthest = (0, 0);
    let same_line = |shown: &(usize, &str), printed: &&str| {
        let words = |line| str::split_whitespace(line).collect::<Vec<_>>();
        let same_word = |shown: &&str, printed: &&str| same(shown, printed, tolerance);
        matches(&words(shown.1), &words(printed), &|word| is_elision(word), &same_word, (0, 0), &mut (0, 0))
    };
    if matches(&shown, &printed, &|(_, line)| is_elision(line.trim()), &same_line, (0, 0), &mut farthest) {
        return Ok(());
    }
    let (at, stood) = farthest;
    let line = shown.get(at).map_or_else(|| expected.lines().count(), |(line, _)| *line);
    Err((line, printed.get(stood).map_or("the end of the output".to_owned(), |line| format!("`{}`", line.trim()))))
}

/// Whether `shown` from `at` on is `printed` from there on, what `elides` standing for any number of these; `farthest` is how far they agree.
fn matches<S, P>(
    shown: &[S],
    printed: &[P],
    elides: &dyn Fn(&S) -> bool,
    same: &dyn Fn(&S, &P) -> bool,
    at: (usize, usize),
    farthest: &mut (usize, usize),
) -> bool {
    if at.0 > farthest.0 {
        *farthest = at;
    }
    let (i, j) = at;
    match shown.get(i) {
        None => j == printed.len(),
        Some(one) if elides(one) => (j..=printed.len()).any(|j| matches(shown, printed, elides, same, (i + 1, j), farthest)),
        Some(one) => {
            printed.get(j).is_some_and(|other| same(one, other))
                && matches(shown, printed, elides, same, (i + 1, j + 1), farthest)
        }
    }
}

fn is_elision(word: &str) -> bool {
    matches!(word, "..." | "…")
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
