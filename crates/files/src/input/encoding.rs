//! Text in other encodings than UTF-8, decoded while it is read.

use std::io::{self, Read};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Encoding {
    Utf8,
    Utf16Le,
    Utf16Be,
    Windows1252,
}

impl Encoding {
    /// Encodings with their names in map files.
    pub(super) const ALL: [(Self, &'static str); 4] =
        [(Self::Utf8, "utf-8"), (Self::Utf16Le, "utf-16le"), (Self::Utf16Be, "utf-16be"), (Self::Windows1252, "windows-1252")];

    pub(super) fn name(self) -> &'static str {
        Self::ALL.iter().find(|(encoding, _)| *encoding == self).map_or("", |(_, name)| name)
    }

    /// Encoding of a file that begins with `bytes`: by its mark, by zeros where Western letters have them in UTF-16, by bytes that are no UTF-8.
    pub(super) fn of(bytes: &[u8]) -> Self {
        let zeros = |first: usize| bytes.iter().skip(first).step_by(2).filter(|byte| **byte == 0).count();
        let mostly = |count: usize| 4 * count > bytes.len();
        match bytes {
            [0xff, 0xfe, ..] => Self::Utf16Le,
            [0xfe, 0xff, ..] => Self::Utf16Be,
            _ if mostly(zeros(1)) && !mostly(zeros(0)) => Self::Utf16Le,
            _ if mostly(zeros(0)) && !mostly(zeros(1)) => Self::Utf16Be,
            _ => match std::str::from_utf8(bytes) {
                // the last character may be cut
                Err(error) if error.error_len().is_some() => Self::Windows1252,
                _ => Self::Utf8,
            },
        }
    }
}

/// A source whose text comes out as UTF-8; UTF-8 itself passes unchanged, wrong or not.
pub(super) struct Decoded<R> {
    pub(super) source: R,
    encoding: Encoding,
    /// Read and not decoded.
    raw: Vec<u8>,
    /// Decoded, of which `given` bytes are given away.
    text: Vec<u8>,
    given: usize,
}

/// Bytes that are decoded at once.
const PIECE: usize = 1 << 14;

impl<R: Read> Decoded<R> {
    pub(super) fn new(source: R, encoding: Encoding) -> Self {
        Self { source, encoding, raw: Vec::new(), text: Vec::new(), given: 0 }
    }

    /// Decodes another piece; `false` at the end.
    fn advance(&mut self) -> io::Result<bool> {
        let mut piece = [0; PIECE];
        let count = self.source.read(&mut piece)?;
        self.raw.extend_from_slice(&piece[..count]);
        let text = match self.encoding {
            Encoding::Utf8 => return Ok(false),
            Encoding::Windows1252 => self.raw.drain(..).map(windows_1252).collect(),
            Encoding::Utf16Le => self.utf16(u16::from_le_bytes, count == 0),
            Encoding::Utf16Be => self.utf16(u16::from_be_bytes, count == 0),
        };
        (self.text, self.given) = (text.into_bytes(), 0);
        Ok(count > 0)
    }

    fn utf16(&mut self, unit: fn([u8; 2]) -> u16, end: bool) -> String {
        let mut units: Vec<u16> = self.raw.chunks_exact(2).map(|pair| unit([pair[0], pair[1]])).collect();
        // the second half of a pair comes with the next piece
        if !end && units.last().is_some_and(|last| (0xd800..0xdc00).contains(last)) {
            units.pop();
        }
        self.raw.drain(..2 * units.len());
        let mut text = String::from_utf16_lossy(&units);
        if end && !self.raw.is_empty() {
            text.push(char::REPLACEMENT_CHARACTER);
            self.raw.clear();
        }
        text
    }
}

impl<R: Read> Read for Decoded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.encoding == Encoding::Utf8 {
            return self.source.read(buffer);
        }
        while self.given == self.text.len() {
            if !self.advance()? && self.text.is_empty() {
                return Ok(0);
            }
        }
        let count = buffer.len().min(self.text.len() - self.given);
        buffer[..count].copy_from_slice(&self.text[self.given..self.given + count]);
        self.given += count;
        Ok(count)
    }
}

/// Latin-1 but for 0x80 to 0x9f (WHATWG Encoding Standard, index windows-1252).
fn windows_1252(byte: u8) -> char {
    const OTHERS: [u16; 32] = [
        0x20ac, 0x81, 0x201a, 0x192, 0x201e, 0x2026, 0x2020, 0x2021, 0x2c6, 0x2030, 0x160, 0x2039, 0x152, 0x8d, 0x17d, 0x8f,
        0x90, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014, 0x2dc, 0x2122, 0x161, 0x203a, 0x153, 0x9d, 0x17e, 0x178,
    ];
    let code = if (0x80..0xa0).contains(&byte) { OTHERS[usize::from(byte) - 0x80] } else { u16::from(byte) };
    char::from_u32(code.into()).unwrap_or(char::REPLACEMENT_CHARACTER)
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::{Decoded, Encoding};

    const TEXT: &str = "Zeit;T (°C);€ – 𝒯\n0;20,5;ok\n";

    fn utf16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    fn decoded(bytes: &[u8], encoding: Encoding) -> String {
        let mut text = String::new();
        Decoded::new(bytes, encoding).read_to_string(&mut text).unwrap();
        text
    }

    #[test]
    fn text_comes_back() {
        let long = TEXT.repeat(3000);
        for (encoding, bytes) in [
            (Encoding::Utf8, long.clone().into_bytes()),
            (Encoding::Utf16Le, utf16(&long, u16::to_le_bytes)),
            (Encoding::Utf16Be, utf16(&long, u16::to_be_bytes)),
        ] {
            assert_eq!(Encoding::of(&bytes), encoding);
            assert!(decoded(&bytes, encoding) == long, "{encoding:?}");
        }
        let western = b"T (\xb0C) \x80 \x96 \xfc\n";
        assert_eq!(
            (Encoding::of(western), decoded(western, Encoding::Windows1252).as_str()),
            (Encoding::Windows1252, "T (°C) € – ü\n")
        );
        // what is cut within a character
        assert_eq!(Encoding::of("20 °".as_bytes().split_last().unwrap().1), Encoding::Utf8);
        assert_eq!(decoded(&[0x41, 0, 0x42], Encoding::Utf16Le), "A\u{fffd}");
        assert_eq!(decoded(&[0xd8, 0x35], Encoding::Utf16Be), "\u{fffd}");
    }
}
