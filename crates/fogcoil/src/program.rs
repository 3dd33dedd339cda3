//! Identity of the program that computed kept results: results of another build do not count as this one's, even with the same version.

use std::env;
use std::fs::File;
use std::io;
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::input::hexadecimal;

/// SHA-256 of the file that holds this code (`None`: the executable), the same on every machine that runs it; of the version alone where it cannot be read.
pub(crate) fn hash(code: Option<&Path>) -> String {
    let mut hash = Sha256::new().chain_update(concat!("fogcoil ", env!("CARGO_PKG_VERSION")));
    if let Ok(mut file) = code.map_or_else(env::current_exe, |file| Ok(file.to_owned())).and_then(File::open) {
        // what cannot be read to its end is a program of its own
        let _ = io::copy(&mut file, &mut Update(&mut hash));
    }
    hexadecimal(&hash.finalize())
}

/// Takes in what is written.
struct Update<'a>(&'a mut Sha256);

impl io::Write for Update<'_> {
    fn write(&mut self, piece: &[u8]) -> io::Result<usize> {
        self.0.update(piece);
        Ok(piece.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_executable_is_in_it() {
        let version = Sha256::digest(concat!("fogcoil ", env!("CARGO_PKG_VERSION")));
        assert_eq!(hash(None), hash(env::current_exe().ok().as_deref()));
        assert_ne!(hash(None), hexadecimal(&version));
        assert_eq!(hash(Some("no such file".as_ref())), hexadecimal(&version));
    }
}
