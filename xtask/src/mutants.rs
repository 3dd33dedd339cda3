//! `cargo xtask mutants`: every function of the crates that compute, answered wrongly or with an operator exchanged; which mutants the crate's own tests catch.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use proof::Failure;
use proof::files::{read, renew, root, write};
use proof::statistics::rate;
use serde_json::Value;

use crate::tools::{printed, tool, tool_with};

const RUNNER: [&str; 2] = ["cargo-mutants", "27.1.0"];
/// Runs tests one by one, so that the first that fails ends a mutant's trial.
const TESTER: [&str; 2] = ["cargo-nextest", "0.9.151"];
/// Without the part that fetches new versions of itself.
const TESTER_FLAGS: [&str; 3] = ["--no-default-features", "--features", "default-no-update"];
/// Crates whose tests share a model that takes longer to make than the tests take: one process for all.
const TOGETHER: [&str; 1] = ["mechanisms"];
const PAGE: &str = "docs/trust.md";
const MARKS: [&str; 2] = ["<!-- mutants: written by `cargo xtask mutants` -->", "<!-- mutants end -->"];
/// Outcomes by crate and mutant, kept from run to run.
const KEPT: &str = "xtask/mutants/outcomes.json";
/// Mutants that nothing can tell from the program, each with the reason: `name: reason` by line.
const ARGUED: &str = "xtask/mutants/argued.txt";
/// Statuses of the runner after all mutants were tried: caught, some missed, some endless.
const TRIED: [i32; 3] = [0, 2, 3];
/// Share of the mutants that must be caught.
const CAUGHT: f64 = 0.9;
/// Crates whose mutants are tried, each in so many parts of which one is tried: every twentieth mutant, say, in the order of files and lines.
const CRATES: [(&str, usize); 7] = [
    ("bias", 1),
    ("winding", 1),
    ("recording", 20),
    ("mechanisms", 40),
    ("diagnosis", 40),
    ("fem-core", 20),
    ("homogenization", 40),
];

/// Change the crates that compute, one operator or answer at a time, and count the changes that their tests catch
///
/// Of the larger crates a part of all changes is tried. Writes docs/trust.md and what came of each mutant, to which further runs add. Exit status 1 if less than 90 % are caught in a crate that was tried.
#[derive(Debug, clap::Args)]
pub(crate) struct Mutants {
    /// Crates [default: all]
    crates: Vec<String>,
    /// Try one of so many parts of each crate's mutants: another one with --part
    #[arg(long, value_name = "N", default_value_t = 1)]
    parts: usize,
    /// The part, from 0
    #[arg(long, value_name = "N", default_value_t = 0)]
    part: usize,
    /// Try again what was missed and is not argued away, after tests were written
    #[arg(long, conflicts_with_all = ["parts", "part"])]
    missed: bool,
}

/// Outcome of a mutant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
enum Outcome {
    /// A test failed, or took for ever, when it was first tried.
    Caught,
    /// A test that was written since fails.
    CaughtSince,
    Missed,
}

/// Outcomes by mutant, by crate.
type Outcomes = BTreeMap<String, BTreeMap<String, Outcome>>;

impl Mutants {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        if let Some(name) = self.crates.iter().find(|name| CRATES.iter().all(|(known, _)| known != name)) {
            return Err(Failure(format!("{name}: no such crate; choose {}", CRATES.map(|(name, _)| name).join(", "))));
        }
        if self.part >= self.parts {
            return Err(Failure(format!("--part {} of {}: the last is {}", self.part, self.parts, self.parts.max(1) - 1)));
        }
        let kept = root().join(KEPT);
        let mut outcomes: Outcomes = if kept.exists() { serde_json::from_str(&read(&kept)?)? } else { Outcomes::new() };
        let reasons = read(&root().join(ARGUED))?;
        let argued = argued(&reasons);
        for (name, share) in CRATES.iter().filter(|(name, _)| self.crates.is_empty() || self.crates.iter().any(|c| c == name)) {
            let known = outcomes.entry((*name).into()).or_default();
            let which = if self.missed {
                let missed = known
                    .iter()
                    .filter(|(mutant, outcome)| **outcome == Outcome::Missed && !argued.contains_key(mutant.as_str()));
                missed.flat_map(|(mutant, _)| ["--re".to_owned(), format!("^{}$", regex_of(mutant))]).collect()
            } else {
                ["--sharding", "round-robin", "--shard", &format!("{}/{}", self.part * share, self.parts * share)]
                    .map(str::to_owned)
                    .to_vec()
            };
            if which.is_empty() {
                continue;
            }
            // lines move: a run of all leaves nothing of the runs before it
            if self.parts == 1 && !self.missed {
                known.clear();
            }
            for (mutant, outcome) in tried(name, &which)? {
                let before = known.get(&mutant).copied();
                let since = outcome == Outcome::Caught && matches!(before, Some(Outcome::Missed | Outcome::CaughtSince));
                known.insert(mutant, if since { Outcome::CaughtSince } else { outcome });
            }
            write(&kept, &(serde_json::to_string_pretty(&outcomes)? + "\n"))?;
        }
        let all = outcomes.keys().map(|name| Ok((name.clone(), all_of(name)?))).collect::<Result<_, Failure>>()?;
        let (text, sound) = table(&outcomes, &all, &argued);
        print!("{text}");
        renew(&root().join(PAGE), MARKS, &text)?;
        Ok(sound)
    }
}

/// The runner, with the tester in its reach.
fn runner() -> Result<Command, Failure> {
    let tester = tool_with(TESTER, &TESTER_FLAGS)?;
    let folder = Path::new(tester.get_program()).parent().map(Path::to_owned).unwrap_or_default();
    let others = std::env::var_os("PATH").unwrap_or_default();
    let reach = std::env::join_paths(std::iter::once(folder).chain(std::env::split_paths(&others)))?;
    let mut runner = tool(RUNNER)?;
    runner.arg("mutants").env("PATH", reach).current_dir(root());
    Ok(runner)
}

/// Number of the mutants of a crate, those among them that do not compile.
fn all_of(name: &str) -> Result<usize, Failure> {
    Ok(printed(runner()?.args(["--list", "--colors", "never", "--package", name]))?.lines().count())
}

/// The pattern that a text alone fits.
fn regex_of(text: &str) -> String {
    let mark = |c: char| if r"\.+*?()|[]{}^$#&-~".contains(c) { format!("\\{c}") } else { c.to_string() };
    text.chars().map(mark).collect()
}

/// Outcomes of some mutants of a crate, those aside that do not compile.
fn tried(name: &str, which: &[String]) -> Result<BTreeMap<String, Outcome>, Failure> {
    let into: PathBuf = root().join("target/mutants").join(name);
    std::fs::create_dir_all(&into)?;
    let mut runner = runner()?;
    runner
        .args([
            "--no-times",
            "--colors",
            "never",
            "--test-tool",
            if TOGETHER.contains(&name) { "cargo" } else { "nextest" },
            "--package",
            name,
            "--output",
        ])
        .arg(&into);
    let status = runner.args(which).args(["--", "--lib", "--tests"]).status()?;
    if !status.code().is_some_and(|code| TRIED.contains(&code)) {
        return Err(Failure(format!("the mutants of {name} were not tried ({status}): do its tests pass unchanged?")));
    }
    of_report(&into.join("mutants.out/outcomes.json"))
}

/// Mutants of the runner's report that were caught (a test failed, or took for ever) or missed.
fn of_report(path: &Path) -> Result<BTreeMap<String, Outcome>, Failure> {
    let report: Value = serde_json::from_str(&read(path)?)?;
    let of = |outcome: &Value| {
        let name = outcome["scenario"]["Mutant"]["name"].as_str()?.to_owned();
        match outcome["summary"].as_str()? {
            "CaughtMutant" | "Timeout" => Some((name, Outcome::Caught)),
            "MissedMutant" => Some((name, Outcome::Missed)),
            _ => None,
        }
    };
    let outcomes = report["outcomes"].as_array().ok_or_else(|| Failure(format!("{}: no outcomes", path.display())))?;
    Ok(outcomes.iter().filter_map(of).collect())
}

/// Reasons by mutant.
fn argued(text: &str) -> BTreeMap<&str, &str> {
    text.lines().filter_map(|line| line.split_once(" :: ")).map(|(name, reason)| (name.trim(), reason.trim())).collect()
}

/// The table and the survivors; whether enough are caught everywhere.
fn table(outcomes: &Outcomes, all: &BTreeMap<String, usize>, argued: &BTreeMap<&str, &str>) -> (String, bool) {
    let mut text = String::from(
        "\n| crate | mutants | tried | caught | caught by tests written since | argued away | left | caught when first tried, of all that could be [90 % interval] |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    let (mut sound, mut left) = (true, BTreeSet::new());
    for (name, _) in CRATES {
        let Some(tried) = outcomes.get(name) else { continue };
        let of =
            |wanted: Outcome| tried.iter().filter(move |(_, outcome)| **outcome == wanted).map(|(mutant, _)| mutant.as_str());
        let (caught, since) = (of(Outcome::Caught).count(), of(Outcome::CaughtSince).count());
        let (argued, survivors): (Vec<&str>, Vec<&str>) = of(Outcome::Missed).partition(|mutant| argued.contains_key(mutant));
        let could = caught + since + survivors.len();
        let Some(share) = rate(caught, could) else { continue };
        sound &= (caught + since) as f64 >= CAUGHT * could as f64;
        let [low, high] = share.interval.map(|end| 100.0 * end);
        let _ = writeln!(
            text,
            "| `{name}` | {} | {} | {caught} | {since} | {} | {} | {:.1} % [{low:.1} to {high:.1} %] |",
            all.get(name).copied().unwrap_or_default(),
            tried.len(),
            argued.len(),
            survivors.len(),
            100.0 * share.value
        );
        left.extend(survivors);
    }
    if !left.is_empty() {
        text += "\n<details><summary>Mutants that no test catches</summary>\n\n";
        left.iter().for_each(|mutant| text += &format!("- `{mutant}`\n"));
        text += "\n</details>\n";
    }
    (text, sound)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn caught_missed_and_argued_mutants_are_counted() {
        let folder = tempfile::tempdir().unwrap();
        let report = folder.path().join("outcomes.json");
        let mutant =
            |name: &str, summary: &str| format!(r#"{{"scenario": {{"Mutant": {{"name": "{name}"}}}}, "summary": "{summary}"}}"#);
        let all = [("a", "CaughtMutant"), ("b", "MissedMutant"), ("c", "Timeout"), ("d", "Unviable"), ("e", "MissedMutant")];
        let all = all.map(|(name, summary)| mutant(name, summary)).join(", ");
        write(&report, &format!(r#"{{"outcomes": [{{"scenario": "Baseline", "summary": "Success"}}, {all}]}}"#)).unwrap();
        let tried = of_report(&report).unwrap();
        assert_eq!(tried.len(), 4);
        let outcomes = BTreeMap::from([("bias".to_owned(), tried)]);
        let all = BTreeMap::from([("bias".to_owned(), 40)]);
        let (text, sound) = table(&outcomes, &all, &argued("b :: no result depends on it\nno line of this kind"));
        assert!(
            text.contains("| `bias` | 40 | 4 | 2 | 0 | 1 | 1 | 66.7 % [") && text.contains("- `e`") && !text.contains("- `b`"),
            "{text}"
        );
        assert!(!sound);
        assert!(table(&outcomes, &all, &argued("b :: x\ne :: y")).1);
        // a test written since catches it: nothing is left, and the share of those first tried stays
        let mut since = outcomes;
        since.values_mut().for_each(|tried| tried.extend([("e".to_owned(), Outcome::CaughtSince)]));
        let (text, sound) = table(&since, &all, &argued("b :: no result depends on it"));
        assert!(text.contains("| `bias` | 40 | 4 | 2 | 1 | 1 | 0 | 66.7 % [") && sound, "{text}");
    }

    #[test]
    fn a_mutant_is_found_by_its_own_pattern_alone() {
        let name = "crates/a/src/b.rs:22:71: replace * with / in C<'_>::d -> Option<f64>";
        let pattern = regex_of(name);
        assert!(
            pattern.ends_with(r"replace \* with / in C<'_>::d \-> Option<f64>") && pattern.starts_with(r"crates/a/src/b\.rs:22"),
            "{pattern}"
        );
    }
}
