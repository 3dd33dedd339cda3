//! Identity of the program that answered: a hash over all its sources.

use std::path::{Path, PathBuf};

use fogcoil::input::hexadecimal;
use sha2::{Digest, Sha256};

use crate::{Failure, files};

/// The crate that is no part of the program: this one.
const PROOF: &str = "proof";

/// SHA-256 of the workspace's manifests, its lock file and the sources of its crates but this one, in the order of their paths: of each the path, a NUL,
/// its length in eight bytes (little-endian) and its content. [`Failure`] names the file that cannot be read.
pub fn hash(root: &Path) -> Result<String, Failure> {
    let mut sources: Vec<PathBuf> = vec!["Cargo.toml".into(), "Cargo.lock".into()];
    for krate in files::names(&root.join("crates"))?.iter().filter(|krate| *krate != PROOF) {
        let krate = Path::new("crates").join(krate);
        sources.push(krate.join("Cargo.toml"));
        let folder = krate.join("src");
        sources.extend(files::below(&root.join(&folder))?.into_iter().map(|file| folder.join(file)));
    }
    sources.sort();
    let mut hash = Sha256::new();
    for file in &sources {
        let path = root.join(file);
        let content = std::fs::read(&path).map_err(files::failed(&path))?;
        hash.update(file.to_string_lossy().replace('\\', "/"));
        hash.update([0]);
        hash.update((content.len() as u64).to_le_bytes());
        hash.update(&content);
    }
    Ok(hex(hash))
}

/// SHA-256 of a file, in digits. [`Failure`] names the file that cannot be read.
pub fn hash_of_file(file: &Path) -> Result<String, Failure> {
    Ok(hex(Sha256::new().chain_update(std::fs::read(file).map_err(files::failed(file))?)))
}

/// A digest in hexadecimal digits.
pub fn hex(hash: Sha256) -> String {
    hexadecimal(&hash.finalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_source_counts_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        std::fs::create_dir_all(root.join("crates/a/src/deep")).unwrap();
        for file in ["Cargo.toml", "Cargo.lock", "crates/a/Cargo.toml", "crates/a/src/lib.rs", "crates/a/src/deep/x.rs"] {
            std::fs::write(root.join(file), file).unwrap();
        }
        let first = hash(root).unwrap();
        assert_eq!((first.len(), hash(root).unwrap()), (64, first.clone()));
        std::fs::write(root.join("crates/a/README.md"), "words").unwrap();
        assert_eq!(hash(root).unwrap(), first);
        std::fs::write(root.join("crates/a/src/deep/x.rs"), "more").unwrap();
        let changed = hash(root).unwrap();
        assert_ne!(changed, first);
        std::fs::create_dir_all(root.join("crates/proof/src")).unwrap();
        std::fs::write(root.join("crates/proof/Cargo.toml"), "who scores is not who answers").unwrap();
        assert_eq!(hash(root).unwrap(), changed);
        std::fs::rename(root.join("crates/a/src/deep/x.rs"), root.join("crates/a/src/deep/y.rs")).unwrap();
        assert_ne!(hash(root).unwrap(), changed);
    }
}
