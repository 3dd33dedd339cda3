//! `cargo xtask mutants`: every function of the crates that compute, answered wrongly or with an operator exchanged; which mutants the crate's own tests catch.

mod list;
mod outcome;
mod runner;
mod trial;
mod weave;
mod woven;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, mpsc};

use proof::Failure;
use proof::files::{read, renew, root};
use proof::statistics::rate;
use serde_json::Value;

use self::list::{Mutant, told};
use self::outcome::{Outcome, Tried, keep, kept};
use self::runner::runner;
use self::trial::Tests;
use self::woven::Woven;

/// Crates whose tests share a model that takes longer to make than the tests take: one process for all.
const TOGETHER: [&str; 1] = ["mechanisms"];
const PAGE: &str = "docs/trust.md";
const MARKS: [&str; 2] = ["<!-- mutants: written by `cargo xtask mutants` -->", "<!-- mutants end -->"];
/// Mutants that nothing can tell from the program, each with the reason: `name :: reason` by line.
const ARGUED: &str = "xtask/mutants/argued.txt";
/// Statuses of the runner after all mutants were tried: caught, some missed, some endless.
const TRIED: [i32; 3] = [0, 2, 3];
/// Share of the mutants that must be caught.
const CAUGHT: f64 = 0.9;
/// Crates whose mutants are tried, each in so many parts of which one is tried: every twentieth mutant, say, in the order of files and lines.
const CRATES: [(&str, usize); 7] = [
    ("bias", 1),
    ("winding", 1),
    ("recording", 1),
    ("mechanisms", 1),
    ("diagnosis", 1),
    ("fem-core", 20),
    ("homogenization", 40),
];
/// Outcomes are kept whenever so many are new.
const SAVED: usize = 20;
/// Trials between two lines that say how far it is.
const TOLD: usize = 100;

/// Change the crates that compute, one operator or answer at a time, and count the changes that their tests catch
///
/// All changes of a crate are built into one program, and each is switched on for the tests that reach it. Of the largest crates a part of all changes is tried.
/// Writes docs/trust.md and the outcome of each change, to which further runs add. Exit status 1 if less than 90 % are caught in a crate that was tried.
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
    /// Go on with a run that was stopped: try the changes that have no outcome yet
    #[arg(long, conflicts_with = "missed")]
    untried: bool,
    /// Leave out tests that take longer; a change that they alone could catch gets no outcome, unless it is argued away
    #[arg(long, value_name = "SECONDS")]
    slowest: Option<f64>,
    /// Trials at once
    #[arg(long, value_name = "N", default_value_t = 2)]
    jobs: usize,
}

/// Mutants by crate.
type Outcomes = BTreeMap<String, Tried>;

impl Mutants {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        if let Some(name) = self.crates.iter().find(|name| CRATES.iter().all(|(known, _)| known != name)) {
            return Err(Failure(format!("{name}: no such crate; choose {}", CRATES.map(|(name, _)| name).join(", "))));
        }
        if self.part >= self.parts {
            return Err(Failure(format!("--part {} of {}: the last is {}", self.part, self.parts, self.parts.max(1) - 1)));
        }
        let reasons = read(&root().join(ARGUED))?;
        let argued = argued(&reasons);
        for (name, share) in CRATES.iter().filter(|(name, _)| self.crates.is_empty() || self.crates.iter().any(|c| c == name)) {
            let woven = woven::woven(name)?;
            let mut of = kept(name)?;
            // functions change
            let keys: BTreeSet<&str> = woven.mutants.iter().map(|mutant| mutant.key.as_str()).collect();
            of.outcomes.retain(|key, _| keys.contains(key.as_str()));
            (of.all, of.unviable) = (woven.mutants.len(), woven.unviable.len());
            let chosen = |id: &usize| {
                let key = woven.mutants[*id].key.as_str();
                match of.outcomes.get(key) {
                    _ if woven.unviable.contains(id) => false,
                    outcome if self.missed => outcome == Some(&Outcome::Missed) && !argued.contains_key(told(key)),
                    Some(_) if self.untried => false,
                    _ => id % (self.parts * share) == self.part * share,
                }
            };
            let chosen: Vec<usize> = (0..woven.mutants.len()).filter(chosen).collect();
            let (alone, together): (Vec<usize>, Vec<usize>) = chosen.into_iter().partition(|id| woven.alone.contains(id));
            eprintln!("{name}: {} mutants in one program, {} alone", together.len(), alone.len());
            let mut new = 0;
            let mut add = |mutant: &Mutant, outcome: Outcome| {
                let old = of.outcomes.get(&mutant.key);
                let since = outcome == Outcome::Caught && matches!(old, Some(Outcome::Missed | Outcome::CaughtSince));
                of.outcomes.insert(mutant.key.clone(), if since { Outcome::CaughtSince } else { outcome });
                new += 1;
                if new % SAVED == 0 { keep(name, &of) } else { Ok(()) }
            };
            self.all_tried(&woven, &together, &argued, &mut add)?;
            if !alone.is_empty() {
                let which = |&id: &usize| ["--re".to_owned(), format!("^{}$", regex_of(&woven.mutants[id].name))];
                let which: Vec<String> = alone.iter().flat_map(which).collect();
                let outcomes = tried(name, &which)?;
                for mutant in alone.iter().map(|&id| &woven.mutants[id]) {
                    outcomes.get(&mutant.name).map_or(Ok(()), |&outcome| add(mutant, outcome))?;
                }
            }
            keep(name, &of)?;
        }
        let outcomes = CRATES.map(|(name, _)| Ok((name.to_owned(), kept(name)?))).into_iter().collect::<Result<_, Failure>>()?;
        let (text, sound) = table(&outcomes, &argued);
        print!("{text}");
        renew(&root().join(PAGE), MARKS, &text)?;
        Ok(sound)
    }

    /// Tries mutants that one program holds, function by function.
    fn all_tried(
        &self,
        woven: &Woven,
        chosen: &[usize],
        argued: &BTreeMap<&str, &str>,
        add: &mut impl FnMut(&Mutant, Outcome) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let scratch = root().join("target/mutants/reached");
        let slowest = self.slowest.unwrap_or(f64::INFINITY);
        let tests = Tests::measured(woven.programs.clone(), &woven.hash, self.jobs, slowest, &scratch)?;
        let mut functions = BTreeMap::<(&str, &str), Vec<usize>>::new();
        for &id in chosen {
            functions.entry((&woven.mutants[id].file, &woven.mutants[id].function)).or_default().push(id);
        }
        let mut functions: Vec<Vec<usize>> = functions.into_values().collect();
        functions.sort_by_key(|ids| ids.iter().any(|id| tests.makes(*id)));
        let queue = Mutex::new(functions.into_iter());
        let (sender, results) = mpsc::channel();
        std::thread::scope(|scope| {
            for _ in 0..self.jobs.max(1) {
                let (sender, tests, queue) = (sender.clone(), &tests, &queue);
                scope.spawn(move || {
                    while let Some(ids) = queue.lock().ok().and_then(|mut queue| queue.next()) {
                        let mut killers = BTreeMap::new();
                        for id in ids {
                            let outcome = tests.outcome(id, slowest, &mut killers);
                            if sender.send((id, outcome)).is_err() {
                                return;
                            }
                        }
                    }
                });
            }
            drop(sender);
            let mut left = 0;
            for (n, (id, outcome)) in results.iter().enumerate() {
                let (mutant, outcome) = (&woven.mutants[id], outcome?);
                if outcome != Some(Outcome::Caught) {
                    left += 1;
                    println!("{}: {}", if outcome.is_none() { "open" } else { "missed" }, mutant.name);
                }
                if (n + 1) % TOLD == 0 || n + 1 == chosen.len() {
                    eprintln!("{} of {}, {left} not caught", n + 1, chosen.len());
                }
                let argued = argued.contains_key(told(&mutant.key)).then_some(Outcome::Missed);
                outcome.or(argued).map_or(Ok(()), |outcome| add(mutant, outcome))?;
            }
            Ok(())
        })
    }
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
fn table(outcomes: &Outcomes, argued: &BTreeMap<&str, &str>) -> (String, bool) {
    let mut text = String::from(
        "\n| crate | mutants | do not compile | tried | caught | caught by tests written since | argued away | left | caught when first tried, of all that could be [90 % interval] |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    let (mut sound, mut left) = (true, BTreeSet::new());
    for (name, _) in CRATES {
        let Some(tried) = outcomes.get(name) else { continue };
        let of = |wanted: Outcome| {
            tried.outcomes.iter().filter(move |(_, outcome)| **outcome == wanted).map(|(mutant, _)| mutant.as_str())
        };
        let (caught, since) = (of(Outcome::Caught).count(), of(Outcome::CaughtSince).count());
        let (argued, survivors): (Vec<&str>, Vec<&str>) =
            of(Outcome::Missed).map(told).partition(|mutant| argued.contains_key(mutant));
        let could = caught + since + survivors.len();
        let Some(share) = rate(caught, could) else { continue };
        sound &= (caught + since) as f64 >= CAUGHT * could as f64;
        let [low, high] = share.interval.map(|end| 100.0 * end);
        let _ = writeln!(
            text,
            "| `{name}` | {} | {} | {} | {caught} | {since} | {} | {} | {:.1} % [{low:.1} to {high:.1} %] |",
            tried.all,
            tried.unviable,
            tried.outcomes.len(),
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
    use proof::files::write;

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
        let outcomes = BTreeMap::from([("bias".to_owned(), Tried { all: 40, unviable: 1, outcomes: tried })]);
        let (text, sound) = table(&outcomes, &argued("b :: no result depends on it\nno line of this kind"));
        assert!(
            text.contains("| `bias` | 40 | 1 | 4 | 2 | 0 | 1 | 1 | 66.7 % [")
                && text.contains("- `e`")
                && !text.contains("- `b`"),
            "{text}"
        );
        assert!(!sound);
        assert!(table(&outcomes, &argued("b :: x\ne :: y")).1);
        // a test written since catches it: nothing is left, and the share of those first tried stays
        let mut since = outcomes;
        since.values_mut().for_each(|tried| tried.outcomes.extend([("e".to_owned(), Outcome::CaughtSince)]));
        let (text, sound) = table(&since, &argued("b :: no result depends on it"));
        assert!(text.contains("| `bias` | 40 | 1 | 4 | 2 | 1 | 1 | 0 | 66.7 % [") && sound, "{text}");
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
