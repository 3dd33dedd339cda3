//! Findings that are kept, unit by unit: `units/NAME.json` and its page `units/NAME.html` in the folder of a batch.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::units::Unit;
use crate::output::{Content, write_files};
use crate::{Error, FileError};

/// Folder of a batch's findings.
pub(super) struct Kept {
    folder: PathBuf,
}

/// Folder of the units in the folder of a batch.
const UNITS: &str = "units";

/// The page of a unit, from the batch's folder.
pub(super) fn page(unit: &str) -> String {
    format!("{UNITS}/{unit}.html")
}

/// The folder of the units' findings in the folder of a batch.
pub fn kept_in(batch: &Path) -> PathBuf {
    batch.join(UNITS)
}

/// Files that the findings of some units are kept in, in the folder of a batch.
pub fn kept_files(batch: &Path, units: &[Unit]) -> Vec<PathBuf> {
    let file = |unit: &Unit, end: &str| kept_in(batch).join(format!("{}.{end}", unit.name));
    units.iter().flat_map(|unit| ["json", "html"].map(|end| file(unit, end))).collect()
}

/// Units that are kept in the folder of a batch beside some, by their names.
pub fn kept_beside(batch: &Path, units: &[Unit]) -> Vec<String> {
    let all = fs::read_dir(kept_in(batch)).into_iter().flatten().flatten().map(|entry| entry.path());
    let findings = all.filter(|path| path.extension().is_some_and(|end| end == "json"));
    let named = findings.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()));
    let mut others: Vec<String> = named.filter(|name| units.iter().all(|unit| unit.name != *name)).collect();
    others.sort();
    others
}

impl Kept {
    /// Findings in the folder of a batch, which is created.
    ///
    /// # Errors
    /// [`files::Error::Output`] where it cannot be made.
    pub(super) fn within(batch: &Path) -> Result<Self, Error> {
        let folder = kept_in(batch);
        let failed = |source| Error::File(FileError::Output { file: folder.clone(), source });
        fs::create_dir_all(&folder).map_err(failed)?;
        Ok(Self { folder })
    }

    fn file(&self, unit: &str, end: &str) -> PathBuf {
        self.folder.join(format!("{unit}.{end}"))
    }

    /// The finding of a unit with this key; with its page where it was diagnosed.
    pub(super) fn load(&self, unit: &str, key: &str) -> Option<Value> {
        let text = fs::read_to_string(self.file(unit, "json")).ok()?;
        let finding: Value = serde_json::from_str(&text).ok()?;
        let whole = finding["key"] == key && (finding["diagnosis"].is_null() || self.file(unit, "html").is_file());
        whole.then_some(finding)
    }

    /// Keeps the finding of a unit, its page first, and gives it back as it will be read.
    ///
    /// # Errors
    /// [`files::Error::Output`] names the file that cannot be written.
    pub(super) fn keep(&self, unit: &str, finding: &Value, page: Option<String>) -> Result<Value, Error> {
        let (json, html) = (self.file(unit, "json"), self.file(unit, "html"));
        let text = finding.to_string();
        if let Some(page) = page {
            write_files(&[(&html, Content::Text(page))])?;
        }
        let read = serde_json::from_str(&text).map_err(|error| Error::Diagnosis(error.to_string()))?;
        write_files(&[(&json, Content::Text(text + "\n"))])?;
        Ok(read)
    }
}
