//! The tokens of a RON text, for [`FieldMap`](super::fields::FieldMap). It never fails: an unknown token is `Other`.

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Token<'a> {
    /// `(`, `[` or `{`.
    Open(u8),
    /// `)`, `]` or `}`.
    Close,
    Comma,
    Colon,
    Word(&'a str),
    /// A number, a string, or rubbish.
    Other,
}

/// Iterates over the tokens with their byte offsets.
pub(crate) struct Scanner<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Scanner<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    /// Byte offset behind the last token.
    pub(crate) fn position(&self) -> usize {
        self.at
    }

    fn rest(&self) -> &'a [u8] {
        self.text.as_bytes().get(self.at..).unwrap_or_default()
    }

    fn skip_while(&mut self, wanted: impl Fn(u8) -> bool) {
        self.at += self.rest().iter().take_while(|&&b| wanted(b)).count();
    }

    fn skip_blanks_and_comments(&mut self) {
        loop {
            let before = self.at;
            self.skip_while(|b| b.is_ascii_whitespace());
            if self.rest().starts_with(b"//") {
                self.skip_while(|b| b != b'\n');
            } else if self.rest().starts_with(b"/*") {
                self.skip_block_comment();
            }
            if self.at == before {
                return;
            }
        }
    }

    /// Block comments nest.
    fn skip_block_comment(&mut self) {
        let mut depth = 0_usize;
        while !self.rest().is_empty() {
            let step = match self.rest() {
                [b'/', b'*', ..] => {
                    depth += 1;
                    2
                }
                [b'*', b'/', ..] => {
                    depth -= 1;
                    2
                }
                _ => 1,
            };
            self.at += step;
            if depth == 0 {
                return;
            }
        }
    }

    fn skip_string(&mut self) {
        self.at += 1;
        loop {
            self.skip_while(|b| b != b'"' && b != b'\\');
            match self.rest() {
                [b'\\', _, ..] => self.at += 2,
                [] => return,
                _ => return self.at += 1,
            }
        }
    }

    /// Skips `r"…"`, `r#"…"#` and so on; false if there is none.
    fn skip_raw_string(&mut self) -> bool {
        let hashes = self.rest().iter().skip(1).take_while(|&&b| b == b'#').count();
        if self.rest().first() != Some(&b'r') || self.rest().get(1 + hashes) != Some(&b'"') {
            return false;
        }
        let end = format!("\"{}", "#".repeat(hashes));
        let body = self.at + 2 + hashes;
        self.at = self.text[body..].find(&end).map_or(self.text.len(), |found| body + found + end.len());
        true
    }
}

impl<'a> Iterator for Scanner<'a> {
    type Item = (usize, Token<'a>);

    fn next(&mut self) -> Option<Self::Item> {
        self.skip_blanks_and_comments();
        let start = self.at;
        let first = *self.rest().first()?;
        let token = match first {
            b'"' => {
                self.skip_string();
                return Some((start, Token::Other));
            }
            b'(' | b'[' | b'{' => Token::Open(first),
            b')' | b']' | b'}' => Token::Close,
            b',' => Token::Comma,
            b':' => Token::Colon,
            _ if self.skip_raw_string() => return Some((start, Token::Other)),
            _ if first.is_ascii_alphabetic() || first == b'_' => {
                self.skip_while(|b| b.is_ascii_alphanumeric() || b == b'_');
                return Some((start, Token::Word(&self.text[start..self.at])));
            }
            _ if first.is_ascii_digit() => {
                self.skip_while(|b| b.is_ascii_alphanumeric() || b"_.+-".contains(&b));
                return Some((start, Token::Other));
            }
            _ => Token::Other,
        };
        self.at += 1;
        Some((start, token))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_strings_and_numbers_hide_their_punctuation() {
        let text = "// a: (\n/* b /* c: */ ( */ d: \"(\\\": [\" r#\"e: \"(\"# 1.0e-6, F((µ))";
        let tokens: Vec<_> = Scanner::new(text).map(|(_, token)| token).filter(|t| *t != Token::Other).collect();
        let expected = [
            Token::Word("d"),
            Token::Colon,
            Token::Comma,
            Token::Word("F"),
            Token::Open(b'('),
            Token::Open(b'('),
            Token::Close,
            Token::Close,
        ];
        assert_eq!(tokens, expected);
    }

    #[test]
    fn unclosed_things_end_at_the_end() {
        for text in ["\"abc", "\"abc\\", "/* /* */", "r##\"x\"#", "//", "r", "\\"] {
            assert!(Scanner::new(text).count() <= 1, "{text}");
        }
    }
}
