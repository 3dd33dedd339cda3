//! Fields in quotes.

/// Whether a text in quotes begins here.
pub(super) fn is_quoted(field: &str) -> bool {
    field.trim_start().starts_with('"')
}

/// The fields of a line that was split at every separator: a text in quotes is one field, without them. A quote that is not closed stays.
pub(super) fn unquoted(pieces: &[&str], separator: char) -> Vec<String> {
    let mut fields = Vec::new();
    let mut rest = pieces;
    while let Some(first) = rest.first() {
        let quoted = is_quoted(first).then(|| quoted_field(rest, separator)).flatten();
        let (field, count) = quoted.unwrap_or_else(|| ((*first).to_owned(), 1));
        fields.push(field);
        rest = &rest[count..];
    }
    fields
}

/// The field in quotes that `pieces` begin with, without its quotes, and of how many pieces it is.
fn quoted_field(pieces: &[&str], separator: char) -> Option<(String, usize)> {
    let mut quotes = 0;
    let last = pieces.iter().position(|piece| {
        quotes += piece.matches('"').count();
        quotes % 2 == 0
    })?;
    let whole = pieces[..=last].join(&separator.to_string());
    let inner = whole.trim().strip_prefix('"')?.strip_suffix('"')?;
    Some((inner.replace("\"\"", "\""), last + 1))
}
