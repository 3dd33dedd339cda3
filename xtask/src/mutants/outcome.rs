//! Outcomes of mutants, kept from run to run.

use std::collections::BTreeMap;

use proof::Failure;
use proof::files::{read, root, write};

/// Outcomes by mutant, a file for each crate, kept from run to run.
const KEPT: &str = "xtask/mutants/outcomes";

/// Outcome of a mutant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Outcome {
    /// A test failed, or took for ever, when it was first tried.
    Caught,
    /// A test that was written since fails.
    CaughtSince,
    Missed,
}

/// Mutants of a crate that were tried.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Tried {
    /// Mutants of the crate, those among them that do not compile.
    pub(super) all: usize,
    pub(super) unviable: usize,
    pub(super) outcomes: BTreeMap<String, Outcome>,
}

/// Outcomes of a crate as they were kept.
pub(super) fn kept(name: &str) -> Result<Tried, Failure> {
    let path = root().join(KEPT).join(name).with_extension("json");
    Ok(if path.exists() { serde_json::from_str(&read(&path)?)? } else { Tried::default() })
}

/// Keeps the outcomes of a crate.
pub(super) fn keep(name: &str, of: &Tried) -> Result<(), Failure> {
    write(&root().join(KEPT).join(name).with_extension("json"), &(serde_json::to_string_pretty(of)? + "\n"))
}
