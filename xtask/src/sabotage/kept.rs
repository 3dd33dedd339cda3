//! Outcomes that need not be found again.

use super::tree::TestRun;
use proof::Failure;
use proof::files::write;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Outcomes by the key of their sources, in a file.
pub(super) struct Kept {
    path: PathBuf,
    outcomes: BTreeMap<String, TestRun>,
}

impl Kept {
    /// Those in the file at `path`; none if it cannot be read.
    pub(super) fn open(path: PathBuf) -> Self {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        Self { path, outcomes: serde_json::from_str(&text).unwrap_or_default() }
    }

    /// The outcome kept under `key`, or what `find` finds, which is kept then.
    pub(super) fn or_find(&mut self, key: String, find: impl FnOnce() -> Result<TestRun, Failure>) -> Result<TestRun, Failure> {
        if let Some(outcome) = self.outcomes.get(&key) {
            return Ok(outcome.clone());
        }
        let outcome = find()?;
        self.outcomes.insert(key, outcome.clone());
        write(&self.path, &serde_json::to_string(&self.outcomes)?)?;
        Ok(outcome)
    }
}
