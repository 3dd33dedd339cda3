//! `cargo xtask sabotage`: breaks the cell's crates on purpose, one line at a time, and notes which tests see it.

mod list;
mod tree;

use list::{CRATES, LIST};
use proof::Failure;
use proof::files::{root, write};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Instant;
use tree::{TestRun, Tree};

/// The table, which `cargo xtask validate` takes over into docs/validation.md.
const PAGE: &str = "crates/proof/src/validation/sabotage.md";
/// Names of red tests that the table gives.
const SHOWN: usize = 3;

fn table(sound: &TestRun, outcomes: &[Option<TestRun>]) -> String {
    let mut table = format!(
        "Without sabotage all {} tests of {} pass. Documentation tests and those of other crates are not counted.\n\n\
        | sabotage | where | red tests |\n|---|---|---|\n",
        sound.count,
        CRATES.join(", ")
    );
    for (sabotage, outcome) in LIST.iter().zip(outcomes) {
        let place = sabotage.file.trim_start_matches("crates/");
        let _ = writeln!(table, "| {} | `{place}` | {} |", sabotage.name, outcome.as_ref().map_or("not run yet".into(), verdict));
    }
    table
}

fn verdict(outcome: &TestRun) -> String {
    let names: Vec<String> = outcome.red.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    match outcome.red.len() {
        0 => "**none: no test sees it**".into(),
        count => format!("{count}: {}{}", names.join(", "), if count > SHOWN { ", …" } else { "" }),
    }
}

/// Outcomes by the key of their sources, in a file.
struct Kept {
    path: PathBuf,
    outcomes: BTreeMap<String, TestRun>,
}

impl Kept {
    /// Those in the file at `path`; none if it cannot be read.
    fn open(path: PathBuf) -> Self {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        Self { path, outcomes: serde_json::from_str(&text).unwrap_or_default() }
    }

    /// The outcome kept under `key`, or what `find` finds, which is kept then.
    fn or_find(&mut self, key: String, find: impl FnOnce() -> Result<TestRun, Failure>) -> Result<TestRun, Failure> {
        if let Some(outcome) = self.outcomes.get(&key) {
            return Ok(outcome.clone());
        }
        let outcome = find()?;
        self.outcomes.insert(key, outcome.clone());
        write(&self.path, &serde_json::to_string(&self.outcomes)?)?;
        Ok(outcome)
    }
}

/// Breaks the crates in every way of the list, writes [`PAGE`], and says whether each was caught.
///
/// Outcomes for the same sources are kept in target/sabotage: a run that was stopped goes on.
pub(crate) fn run() -> Result<bool, Failure> {
    let (root, start) = (root(), Instant::now());
    let step = |what: &str| eprintln!("[{:5.0} s] {what}", start.elapsed().as_secs_f64());
    let broken = LIST.iter().map(|sabotage| sabotage.apply(&root)).collect::<Result<Vec<_>, _>>()?;
    let tree = Tree::copy(&root)?;
    let mut kept = Kept::open(root.join("target/sabotage/kept.json"));
    step("no sabotage");
    let sound = kept.or_find(tree.key(None), || tree.test(&CRATES))?;
    if !sound.red.is_empty() {
        return Err(Failure(format!("red without any sabotage: {}", sound.red.join(", "))));
    }
    let mut outcomes: Vec<Option<TestRun>> = vec![None; LIST.len()];
    for ((sabotage, text), place) in LIST.iter().zip(&broken).zip(0..) {
        step(sabotage.name);
        let outcome = kept.or_find(tree.key(Some(sabotage)), || tree.sabotaged(sabotage, text))?;
        eprintln!("          {}", verdict(&outcome));
        outcomes[place] = Some(outcome);
        write(&root.join(PAGE), &table(&sound, &outcomes))?;
    }
    step(&format!("{PAGE} is written; `cargo xtask validate` takes it over"));
    let caught = outcomes.iter().flatten().filter(|outcome| !outcome.red.is_empty()).count();
    println!("{caught} of {} sabotages are caught", LIST.len());
    Ok(caught == LIST.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each is there to be made, makes a difference, and stands for itself.
    #[test]
    fn the_list_fits_the_sources() {
        for (i, sabotage) in LIST.iter().enumerate() {
            let text = sabotage.apply(&root()).unwrap_or_else(|failure| panic!("{failure}"));
            assert!(text.contains(sabotage.replace) && sabotage.find != sabotage.replace, "{}", sabotage.name);
            assert!(sabotage.reach().iter().any(|name| sabotage.file.contains(name)), "{}", sabotage.name);
            assert!(LIST[..i].iter().all(|other| other.name != sabotage.name), "{}", sabotage.name);
            assert!(!sabotage.name.contains('|'), "{}", sabotage.name);
        }
    }
}
