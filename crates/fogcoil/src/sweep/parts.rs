//! Rows that are computed, kept range by range until the table is whole.
//!
//! A file of a range is named by the hash of the inputs of its rows; it holds a SHA-256 over that hash, the range and the rows, and the rows (postcard,
//! doubles bit for bit). A file that is cut short, spoilt or of another plan does not count, and its rows are computed again.

use std::fs;
use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::row::Row;
use crate::{Error, FileError};

/// Bytes of a SHA-256.
const CHECK: usize = 32;
/// End of a file's name.
const END: &str = "part";

/// A folder of computed rows.
#[derive(Debug, Clone)]
pub struct Parts {
    folder: PathBuf,
    hash: String,
}

impl Parts {
    /// Parts beside `table`: `TABLE.parts`, of rows that follow from the inputs with this `hash`.
    pub fn beside(table: &Path, hash: String) -> Self {
        let mut name = table.file_name().unwrap_or_default().to_owned();
        name.push(".parts");
        Self { folder: table.with_file_name(name), hash }
    }

    /// Folder of the parts.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn path(&self, range: &Range<usize>) -> PathBuf {
        self.folder.join(format!("{}-{:08}-{:08}.{END}", &self.hash[..16], range.start, range.end))
    }

    /// Beginning of the name of a file that is being written: of this plan alone.
    fn begun(&self) -> String {
        format!(".fogcoil-{}-", &self.hash[..16])
    }

    fn check(&self, range: &Range<usize>, rows: &[u8]) -> Vec<u8> {
        let name = format!("{} {} {}\n", self.hash, range.start, range.end);
        Sha256::new().chain_update(name).chain_update(rows).finalize().to_vec()
    }

    /// The rows of a range, if they are there and whole.
    pub fn load(&self, range: &Range<usize>) -> Option<Vec<Row>> {
        let bytes = fs::read(self.path(range)).ok()?;
        let (check, rows) = bytes.split_at_checked(CHECK)?;
        if check != self.check(range, rows) {
            return None;
        }
        postcard::from_bytes(rows).ok().filter(|rows: &Vec<Row>| rows.len() == range.len())
    }

    /// Keeps the rows of a range: under another name first, so that no reader sees half a file.
    ///
    /// # Errors
    /// [`files::Error::Output`] names the file that cannot be written.
    pub fn keep(&self, range: &Range<usize>, rows: &[Row]) -> Result<(), Error> {
        let path = self.path(range);
        let failed = |source: std::io::Error| Error::File(FileError::Output { file: path.clone(), source });
        let rows = postcard::to_stdvec(rows).map_err(|error| failed(std::io::Error::other(error)))?;
        fs::create_dir_all(&self.folder).map_err(failed)?;
        let mut file = tempfile::Builder::new().prefix(&self.begun()).tempfile_in(&self.folder).map_err(failed)?;
        file.write_all(&self.check(range, &rows)).and_then(|()| file.write_all(&rows)).map_err(failed)?;
        file.persist(&path).map(drop).map_err(|error| failed(error.error))
    }

    /// Removes the rows of some ranges and what a killed run left half-written of this plan, and the folder if nothing else is in it.
    pub fn clear(&self, ranges: impl Iterator<Item = Range<usize>>) {
        for range in ranges {
            // what stays is only in the way
            let _ = fs::remove_file(self.path(&range));
        }
        let begun = self.begun();
        for file in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            if file.file_name().to_string_lossy().starts_with(&begun) {
                let _ = fs::remove_file(file.path());
            }
        }
        let _ = fs::remove_dir(&self.folder);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(count: usize) -> Vec<Row> {
        let row = |n: usize| Row { values: vec![None], outputs: vec![Some(0.1 * n as f64)], problem: None };
        (0..count).map(row).collect()
    }

    #[test]
    fn only_whole_rows_of_the_same_plan_and_range_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let table = folder.path().join("t.csv");
        let parts = Parts::beside(&table, "a".repeat(64));
        assert_eq!(parts.load(&(0..3)), None);
        parts.keep(&(0..3), &rows(3)).unwrap();
        assert_eq!(parts.load(&(0..3)), Some(rows(3)));
        // another plan's file under this one's name
        let other = Parts::beside(&table, "b".repeat(64));
        fs::copy(parts.path(&(0..3)), other.path(&(0..3))).unwrap();
        fs::copy(parts.path(&(0..3)), parts.path(&(3..6))).unwrap();
        assert_eq!((other.load(&(0..3)), parts.load(&(3..6))), (None, None));
        let sound = fs::read(parts.path(&(0..3))).unwrap();
        for length in 0..sound.len() {
            fs::write(parts.path(&(0..3)), &sound[..length]).unwrap();
            assert_eq!(parts.load(&(0..3)), None, "{length} bytes");
        }
        // a run that was killed between writing and renaming
        fs::write(parts.folder().join(parts.begun() + "x"), [0]).unwrap();
        other.clear(std::iter::once(0..3));
        assert!(parts.folder().exists(), "another plan's rows stay");
        assert!(parts.folder().join(parts.begun() + "x").exists(), "and what it is writing");
        parts.clear([0..3, 3..6].into_iter());
        assert!(!parts.folder().exists());
    }
}
