//! `cargo xtask prove`: units that conceal something, diagnosed and then held against the truth.

mod answer;
mod baselines;
mod chain;
mod concealed;
mod program;
mod recommended;
mod report;
mod score;
mod statistics;
mod summary;
mod synthetic;
mod truth;

use std::path::PathBuf;

use crate::validate::Failure;
use score::Scored;

/// What is to be done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Command {
    /// Answer and score the open units: those named, else all.
    Open(Vec<String>),
    /// Answer the sealed units, once.
    Sealed,
    /// Answer them again elsewhere and compare.
    Again(PathBuf),
    /// Try what is recommended for every pair of mechanisms.
    Recommended,
    /// Make, answer and score units of the project's own generator.
    Synthetic(synthetic::Plan),
}

impl Command {
    /// # Errors
    /// Names the word that is not understood.
    pub(crate) fn parse(words: &[&str]) -> Result<Self, Failure> {
        match words {
            ["--sealed"] => return Ok(Self::Sealed),
            ["--recommended"] => return Ok(Self::Recommended),
            ["--sealed", "--again", folder] => return Ok(Self::Again(folder.into())),
            ["--synthetic", rest @ ..] => return Ok(Self::Synthetic(synthetic::Plan::parse(rest)?)),
            _ => {}
        }
        let mut cases = Vec::new();
        for pair in words.chunks(2) {
            let ["--case", number] = pair else { return Err(Failure(format!("`prove {}` is not a command", words.join(" ")))) };
            let case = format!("case_{:0>2}", number.trim_start_matches("case_"));
            if !cases.contains(&case) {
                cases.push(case);
            }
        }
        Ok(Self::Open(cases))
    }

    /// Runs it: whether everything is as asked.
    ///
    /// # Errors
    /// [`Failure`] says what went wrong.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        match self {
            Self::Open(cases) => open(cases),
            Self::Sealed => concealed::sealed(),
            Self::Recommended => recommended::run(),
            Self::Again(folder) => concealed::sealed_again(folder),
            Self::Synthetic(plan) => plan.run(),
        }
    }
}

/// Scores the open units; docs/proof.md is written when all were scored.
fn open(only: &[String]) -> Result<bool, Failure> {
    let program = program::hash(&concealed::root())?;
    let cases = concealed::open(only)?;
    let scored: Vec<Scored> = cases.iter().map(|case| case.scored.clone()).collect();
    let table = summary::summary(&scored);
    if only.is_empty() {
        report::publish("open", &program, &report::open(&cases, &table))?;
        eprintln!("docs/proof.md is written");
    } else {
        println!("{}", report::details(&cases));
    }
    println!("{}", report::lines(&table));
    for unit in &scored {
        let faults = report::faults(unit);
        if !faults.is_empty() {
            println!("{}: {}", unit.unit, faults.join("; "));
        }
    }
    let failures: Vec<_> = table.failures().collect();
    let asked = table.rows.iter().filter(|row| row.holds().is_some()).count();
    println!("\n{} of {asked} scores that were measured are as asked", asked - failures.len());
    failures.iter().for_each(|row| eprintln!("FAILS: {}: {}", row.group, row.quantity));
    Ok(failures.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands() {
        let open = |cases: &[&str]| Command::Open(cases.iter().map(|c| (*c).to_owned()).collect());
        assert_eq!(Command::parse(&[]).unwrap(), open(&[]));
        assert_eq!(Command::parse(&["--case", "3", "--case", "case_12", "--case", "03"]).unwrap(), open(&["case_03", "case_12"]));
        assert_eq!(Command::parse(&["--sealed"]).unwrap(), Command::Sealed);
        assert_eq!(Command::parse(&["--sealed", "--again", "x"]).unwrap(), Command::Again("x".into()));
        for bad in [&["--case"][..], &["3"], &["--sealed", "x"], &["--case", "3", "--sealed"]] {
            assert!(Command::parse(bad).is_err(), "{bad:?}");
        }
    }
}
