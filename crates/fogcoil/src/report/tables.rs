//! Tables of a page: facts, and columns of numbers; each with a caption.

use std::fmt::Write;

use crate::picture::escape;

/// Names and values, under a caption that only a screen reader says.
pub fn facts(out: &mut String, caption: &str, rows: &[(String, String)]) {
    let _ = writeln!(out, "<table class=\"facts\">\n<caption class=\"unseen\">{}</caption>\n<tbody>", escape(caption));
    for (name, value) in rows {
        let _ = writeln!(out, "<tr><th scope=\"row\">{}</th><td>{}</td></tr>", escape(name), escape(value));
    }
    out.push_str("</tbody>\n</table>\n");
}

/// A row of [`facts`].
pub fn row(name: &str, value: impl Into<String>) -> (String, String) {
    (name.to_owned(), value.into())
}

/// How the cells of a table are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cells {
    /// Short, never broken, to the right.
    Numbers,
    /// Words, broken where need be.
    Words,
}

/// A table with a caption and a head, in a box that scrolls where it is too wide; the first cell of a row names it.
pub fn grid(out: &mut String, caption: &str, cells: Cells, head: &[&str], rows: &[Vec<String>]) {
    let (caption, class) = (
        escape(&nice(caption)),
        match cells {
            Cells::Words if head.len() > 5 => "words many",
            Cells::Words => "words",
            Cells::Numbers => "data",
        },
    );
    let _ = write!(
        out,
        "<div class=\"scroll\" role=\"group\" tabindex=\"0\" aria-label=\"{caption}\">\n<table class=\"{class}\">\n<caption>{caption}</caption>\n\
         <thead>\n<tr>"
    );
    head.iter().for_each(|cell| {
        let _ = write!(out, "<th scope=\"col\">{}</th>", escape(&nice(cell)));
    });
    out.push_str("</tr>\n</thead>\n<tbody>\n");
    for row in rows {
        out.push_str("<tr>");
        for (n, cell) in row.iter().enumerate() {
            let tag = if n == 0 { "th scope=\"row\"" } else { "td" };
            let _ = write!(out, "<{tag}>{}</{}>", escape(&nice(cell)), &tag[..2]);
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody>\n</table>\n</div>\n");
}

/// Text for people in the page's signs: a true minus before a number, ° for deg.
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
    #[test]
    fn numbers_have_a_true_minus_and_names_their_hyphen() {
        let text = super::nice("file-3.csv: -7.1 to 4.8e-5 degC, rate-1");
        assert_eq!(text, "file-3.csv: \u{2212}7.1 to 4.8e\u{2212}5 °C, rate-1");
    }
}
