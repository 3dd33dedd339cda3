//! Identity of an input's content, so that a report can name it.

use std::fmt;
use std::path::PathBuf;

use sha2::{Digest, Sha256};

/// A file's content by two hashes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fingerprint {
    /// The file, as it was named.
    pub file: PathBuf,
    /// Its length \[bytes\].
    pub bytes: u64,
    /// FNV-1a, 64 bits (Fowler, Noll and Vo): short; tells apart what was changed by accident, not on purpose.
    pub fnv1a: u64,
    /// SHA-256 (FIPS 180-4), as `sha256sum` prints it.
    pub sha256: String,
}

impl Fingerprint {
    /// Fingerprint of a content and its name.
    pub fn of(file: PathBuf, content: &[u8]) -> Self {
        let mut hash = Hash::new();
        hash.update(content);
        hash.fingerprint(file)
    }
}

/// Bytes of a hash in hexadecimal digits, as `sha256sum` prints them.
pub fn hexadecimal(hash: &[u8]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.fnv1a)
    }
}

/// The hashes of a content that comes in pieces.
pub(crate) struct Hash {
    /// Number of bytes so far.
    pub(crate) bytes: u64,
    fnv1a: u64,
    sha256: Sha256,
}

impl Hash {
    pub(crate) fn new() -> Self {
        Self { bytes: 0, fnv1a: 0xcbf2_9ce4_8422_2325, sha256: Sha256::new() }
    }

    pub(crate) fn update(&mut self, piece: &[u8]) {
        self.bytes += piece.len() as u64;
        self.sha256.update(piece);
        for byte in piece {
            self.fnv1a = (self.fnv1a ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Fingerprint of the content so far.
    pub(crate) fn fingerprint(&self, file: PathBuf) -> Fingerprint {
        let sha256 = hexadecimal(&self.sha256.clone().finalize());
        Fingerprint { file, bytes: self.bytes, fnv1a: self.fnv1a, sha256 }
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
        let abc = Fingerprint::of(PathBuf::new(), b"abc");
        assert_eq!(abc.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
        assert_eq!(abc.bytes, 3);
    }
}
