//! An archive whose bytes follow from its content alone.

use flate2::{Compression, GzBuilder};
use proof::Failure;
use tar::{Builder, Header};

use crate::tools::DATE;

/// A file of an archive.
pub(super) struct Entry {
    path: String,
    bytes: Vec<u8>,
    executable: bool,
}

impl Entry {
    /// One that cannot be run.
    pub(super) fn new(path: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self { path: path.into(), bytes, executable: false }
    }

    /// One that can.
    pub(super) fn program(path: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self { executable: true, ..Self::new(path, bytes) }
    }
}

/// A tar.gz of the entries below the folder `name`: in the order of their paths, of one date, nobody's.
pub(super) fn packed(name: &str, entries: &[Entry]) -> Result<Vec<u8>, Failure> {
    let mut sorted: Vec<&Entry> = entries.iter().collect();
    sorted.sort_by(|a, b| a.path.cmp(&b.path));
    let mut tar = Builder::new(GzBuilder::new().write(Vec::new(), Compression::best()));
    for entry in sorted {
        let mut header = Header::new_gnu();
        header.set_size(entry.bytes.len() as u64);
        header.set_mode(if entry.executable { 0o755 } else { 0o644 });
        header.set_mtime(DATE);
        header.set_uid(0);
        header.set_gid(0);
        tar.append_data(&mut header, format!("{name}/{}", entry.path), entry.bytes.as_slice())?;
    }
    Ok(tar.into_inner()?.finish()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::GzDecoder;
    use std::io::Read;

    #[test]
    fn an_archive_depends_on_nothing_but_its_files() {
        let entry = |path: &str| if path == "b" { Entry::program } else { Entry::new }(path, path.as_bytes().to_vec());
        let bytes = packed("top", &["b", "a/c"].map(entry)).unwrap();
        assert_eq!(bytes, packed("top", &["a/c", "b"].map(entry)).unwrap(), "their order counts");
        assert_ne!(bytes, packed("top", &["a/c", "d"].map(entry)).unwrap());
        assert_eq!(bytes[4..8], [0; 4], "the gzip header has a date");
        let mut archive = tar::Archive::new(GzDecoder::new(bytes.as_slice()));
        let found: Vec<(String, u32, u64, String)> = archive
            .entries()
            .unwrap()
            .map(|entry| {
                let mut entry = entry.unwrap();
                let mut text = String::new();
                entry.read_to_string(&mut text).unwrap();
                let header = entry.header();
                (entry.path().unwrap().display().to_string(), header.mode().unwrap(), header.mtime().unwrap(), text)
            })
            .collect();
        let wanted = [("top/a/c", 0o644, "a/c"), ("top/b", 0o755, "b")];
        assert_eq!(found, wanted.map(|(path, mode, text)| (path.to_owned(), mode, DATE, text.to_owned())));
    }
}
