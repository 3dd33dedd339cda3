//! Names as they are read.

use std::borrow::Cow;

use serde::{Deserialize, Deserializer};

/// Reads a name; what a terminal would obey becomes its escape.
pub(super) fn printable<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Cow::<str>::deserialize(deserializer).map(|name| escaped(&name))
}

fn escaped(name: &str) -> String {
    name.chars().fold(String::new(), |mut shown, c| {
        if is_obeyed(c) {
            shown.extend(c.escape_default())
        } else {
            shown.push(c)
        }
        shown
    })
}

/// Whether a character is a control, ends a line, or changes the direction of what follows.
fn is_obeyed(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn words_stay_and_orders_are_shown() {
        assert_eq!(escaped("Spüle \"7\" a\u{308} 巻"), "Spüle \"7\" a\u{308} 巻");
        assert_eq!(escaped("a\u{1b}[2J\n\r\u{202e}"), "a\\u{1b}[2J\\n\\r\\u{202e}");
    }
}
