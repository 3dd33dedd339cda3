//! `cargo xtask prove`: units that conceal something, diagnosed and then held against the truth.

mod answer;
mod answers;
mod baselines;
mod chain;
mod inseparable;
mod recommended;
mod report;
mod score;
mod summary;
mod synthetic;

use std::path::PathBuf;

use clap::Args;

use crate::files::root;
use crate::{Failure, composed, ordinary, program};
use score::Scored;

pub(crate) use answer::{Answer, Constant, MORE_THAN_NOT, Written, answer_records, answered, record};
#[cfg(test)]
pub(crate) use answer::{Fitted, Probable};
pub(crate) use answers::{PROGRAM, each, write};
pub(crate) use chain::{mean, rms, used};
pub(crate) use report::{lines, markdown, publish, short};
pub(crate) use score::{CONFIDENT, HeldOut, Parameter};
pub(crate) use summary::{Bound, Form, ScoreRow, failures};

/// Diagnose units that conceal something, and hold the answers against the truth
///
/// Writes docs/proof.md. Exit status 1 if a score is not as asked.
#[derive(Debug, Args)]
pub struct Prove {
    /// An open unit by its number, instead of all of fixtures/concealed/open
    #[arg(long = "case", value_name = "NN", value_parser = case, group = "units")]
    cases: Vec<String>,
    /// Ordinary units of three drawings, fixtures/ordinary, instead; with --sealed, its sealed ones, once
    #[arg(long, conflicts_with_all = ["cases", "recommended", "synthetic", "again"])]
    ordinary: bool,
    /// Whether what says nothing of the coil leaves the answers to ordinary units as they are: offsets, units, sampling
    #[arg(long, requires = "ordinary", conflicts_with = "sealed")]
    changed: bool,
    /// Of the ordinary open units one by its name
    #[arg(long = "unit", value_name = "NAME", requires = "ordinary", conflicts_with = "sealed")]
    names: Vec<String>,
    /// Answer the sealed units, once
    #[arg(long, group = "units")]
    sealed: bool,
    /// Answer the sealed units again, into DIR, and compare with the answers that are there
    #[arg(long, value_name = "DIR", requires = "sealed")]
    again: Option<PathBuf>,
    /// Units of which one thing is ordinary that was once taken for a fault
    #[arg(long, group = "units", conflicts_with = "ordinary")]
    rows: bool,
    /// The intervals of ten ordinary units against a sampler's
    #[arg(long, group = "units", conflicts_with = "ordinary")]
    posteriors: bool,
    /// Whether what is recommended tells mechanisms apart
    #[arg(long, group = "units")]
    recommended: bool,
    /// Units of the project's own generator, kept in target/prove, where a run that was stopped goes on
    #[arg(long, group = "units")]
    synthetic: bool,
    /// Units with laws that no library lists, constants anywhere within their tolerances: whether a law is composed that predicts
    #[arg(long, group = "units", conflicts_with = "ordinary")]
    composed: bool,
    /// How many of those; every second one conceals nothing
    #[arg(long = "drawn", value_name = "N", requires = "composed", default_value_t = 120)]
    drawn: usize,
    /// Of those one by its number, printed instead of written
    #[arg(long = "number", value_name = "N", requires = "composed", conflicts_with = "drawn")]
    numbers: Vec<usize>,
    #[command(flatten)]
    plan: synthetic::Plan,
}

fn case(number: &str) -> Result<String, std::num::ParseIntError> {
    let number: u8 = number.trim_start_matches("case_").parse()?;
    Ok(format!("case_{number:02}"))
}

impl Prove {
    /// Runs it: whether everything is as asked. [`Failure`] says what went wrong.
    pub fn run(mut self) -> Result<bool, Failure> {
        if self.ordinary {
            return match (self.sealed, self.changed) {
                (true, _) => ordinary::sealed(),
                (_, true) => ordinary::changed(&self.names),
                _ => ordinary::open(&self.names),
            };
        }
        if self.posteriors {
            return ordinary::posteriors();
        }
        if self.rows {
            return ordinary::rows();
        }
        if self.composed {
            return composed::run(self.drawn, &self.numbers);
        }
        if self.synthetic {
            return synthetic::run(&self.plan);
        }
        if self.recommended {
            return recommended::run();
        }
        if self.sealed {
            return self.again.map_or_else(answers::sealed, |folder| answers::sealed_again(&folder));
        }
        self.cases.sort();
        self.cases.dedup();
        open(&self.cases)
    }
}

/// Scores the open units; docs/proof.md is written when all were scored.
fn open(only: &[String]) -> Result<bool, Failure> {
    let program = program::hash(&root())?;
    let cases = answers::open(only)?;
    let scored: Vec<Scored> = cases.iter().map(|case| case.scored.clone()).collect();
    let rows = summary::summary(&scored);
    if only.is_empty() {
        report::publish("open", &program, &report::open(&cases, &rows))?;
        eprintln!("docs/proof.md is written");
    } else {
        println!("{}", report::details(&cases));
    }
    println!("{}", report::lines(&rows));
    for unit in &scored {
        let faults = report::faults(unit);
        if !faults.is_empty() {
            println!("{}: {}", unit.unit, faults.join("; "));
        }
    }
    let failures: Vec<_> = summary::failures(&rows).collect();
    let asked = rows.iter().filter(|row| row.holds().is_some()).count();
    println!("\n{} of {asked} scores that were measured are as asked", asked - failures.len());
    failures.iter().for_each(|row| eprintln!("FAILS: {}: {}", row.group, row.quantity));
    Ok(failures.is_empty())
}

#[cfg(test)]
mod tests {
    use super::case;

    #[test]
    fn a_case_has_its_number_in_two_digits() {
        assert_eq!(["3", "03", "case_12"].map(|number| case(number).unwrap()), ["case_03", "case_03", "case_12"]);
        assert!(["", "x", "case_", "-1"].iter().all(|number| case(number).is_err()));
    }
}
