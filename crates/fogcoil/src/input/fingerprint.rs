//! Which content an input had, so that a report can name it.

use std::fmt;
use std::path::PathBuf;

/// A file's content in 64 bits: FNV-1a (Fowler, Noll and Vo). It tells apart what was changed by accident, not on purpose.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fingerprint {
    /// The file, as it was named.
    pub file: PathBuf,
    /// Its length \[bytes\].
    pub bytes: u64,
    /// FNV-1a, 64 bits.
    pub fnv1a: u64,
}

impl Fingerprint {
    pub(crate) fn of(file: PathBuf, content: &[u8]) -> Self {
        let mut hash = Fnv1a::new();
        hash.update(content);
        Self { file, bytes: content.len() as u64, fnv1a: hash.value() }
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.fnv1a)
    }
}

/// The hash of a content that comes in pieces.
pub(crate) struct Fnv1a(u64);

impl Fnv1a {
    pub(crate) fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(crate) fn update(&mut self, piece: &[u8]) {
        for byte in piece {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    pub(crate) fn value(&self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_test_vectors() {
        for (content, expected) in [("", "cbf29ce484222325"), ("a", "af63dc4c8601ec8c"), ("foobar", "85944171f73967e8")] {
            assert_eq!(Fingerprint::of(PathBuf::new(), content.as_bytes()).to_string(), expected);
        }
    }
}
