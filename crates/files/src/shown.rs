//! Names as a terminal shows them: a character that it would obey becomes its escape.

use std::path::Path;

/// A text of one line, with escapes for characters that a terminal would obey: controls, ends of lines, and changes of direction.
///
/// ```
/// assert_eq!(files::shown("a\u{1b}[2J\n\u{202e} b\u{fc}"), "a\\u{1b}[2J\\n\\u{202e} b\u{fc}");
/// ```
pub fn shown(text: &str) -> String {
    escaped(text, is_obeyed)
}

/// As [`shown`], of a text that has lines and tabulators of its own.
pub fn shown_lines(text: &str) -> String {
    escaped(text, |c| is_obeyed(c) && !matches!(c, '\n' | '\t'))
}

/// As [`shown`], of a path.
pub fn shown_path(path: &Path) -> String {
    shown(&path.to_string_lossy())
}

/// A JSON text in which a terminal finds nothing to obey: the escapes are JSON's, and mean the same.
pub fn shown_json(json: &str) -> String {
    // beyond ASCII's controls, which JSON escapes anyhow, all that is obeyed stands in strings and has four digits
    json.chars().fold(String::with_capacity(json.len()), |mut out, c| {
        if is_obeyed(c) && c != '\n' {
            out.push_str(&format!("\\u{:04x}", u32::from(c)));
        } else {
            out.push(c);
        }
        out
    })
}

fn escaped(text: &str, which: impl Fn(char) -> bool) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut out, c| {
        if which(c) {
            out.extend(c.escape_default());
        } else {
            out.push(c);
        }
        out
    })
}

/// Whether a character is a control, ends a line, or changes the direction of what follows.
fn is_obeyed(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stay_and_orders_are_shown() {
        assert_eq!(shown("Sp\u{fc}le \"7\" a\u{308} \u{5dfb}"), "Sp\u{fc}le \"7\" a\u{308} \u{5dfb}");
        assert_eq!(shown("a\u{1b}[2J\n\r\u{202e}"), "a\\u{1b}[2J\\n\\r\\u{202e}");
        assert_eq!(shown_lines("a\n\tb\r\u{9b}"), "a\n\tb\\r\\u{9b}");
    }

    #[test]
    fn json_means_the_same() {
        let value = serde_json::json!({ "name": "a\u{9b}\u{202e}\u{feff}\n" });
        let text = shown_json(&value.to_string());
        assert!(text.is_ascii());
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), value);
    }
}
