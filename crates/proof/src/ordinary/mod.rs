//! `cargo xtask prove --ordinary`: units as they come, of three drawings, read by imperfect instruments.
//!
//! Answered from the drawing with its usual tolerances, all of them, and only then held against their truths.

mod change;
mod changed;
mod posteriors;
mod rows;
mod score;
mod truth;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use fogcoil::cache::Cache;
use fogcoil::input::{self, CoilCase};

use crate::concealed::{Answer, HeldOut, PROGRAM, Written, answered, each, failures, lines, markdown, publish, write};
use crate::files::{self, root};
use crate::three_records::{self, HoldOut};
use crate::{Failure, program};
use score::{Scored, score, summary};
use truth::{Kind, Truth};

pub(crate) use changed::run as changed;
pub(crate) use posteriors::run as posteriors;
pub(crate) use rows::run as rows;

fn folder() -> PathBuf {
    root().join("fixtures/ordinary")
}

/// Units of the drawings in a folder, `DESIGN/SET/UNIT`, by their paths.
fn units(set: &str) -> Result<Vec<String>, Failure> {
    let mut all = Vec::new();
    for design in files::names(&folder())? {
        let from = folder().join(&design).join(set);
        if from.is_dir() {
            all.extend(files::names(&from)?.into_iter().map(|unit| format!("{design}/{set}/{unit}")));
        }
    }
    Ok(all)
}

fn drawing(unit: &str) -> Result<CoilCase, Failure> {
    let design = unit.split('/').next().unwrap_or_default();
    Ok(input::read_coil(&folder().join(design).join("drawing.ron"))?)
}

/// The last part of a unit's path.
fn name(unit: &str) -> &str {
    unit.rsplit('/').next().unwrap_or(unit)
}

/// Answers units, one after another: a diagnosis takes both cores where it can.
fn answers(names: &[String]) -> Result<Vec<Written>, Failure> {
    let (clock, cache) = (Instant::now(), Cache::of_user());
    each(names, |unit| {
        let start = Instant::now();
        let written = three_records::answer(&drawing(unit)?, &folder().join(unit), &cache)?;
        eprintln!("[{:5.0} s] {unit} is answered ({:.0} s)", clock.elapsed().as_secs_f64(), start.elapsed().as_secs_f64());
        Ok(written)
    })
}

/// The open units, or those named.
fn named(only: &[String]) -> Result<Vec<String>, Failure> {
    let all = units("open")?;
    if let Some(missing) = only.iter().find(|unit| !all.iter().any(|known| name(known) == *unit)) {
        let known: Vec<&str> = all.iter().map(|unit| name(unit)).collect();
        return Err(Failure(format!("there is no open unit {missing}; there are {}", known.join(", "))));
    }
    Ok(all.into_iter().filter(|unit| only.is_empty() || only.iter().any(|n| n == name(unit))).collect())
}

/// A unit with all that is said of it.
struct Case {
    unit: String,
    truth: Truth,
    answer: Answer,
    scored: Scored,
}

/// Answers the open units, or those named, into `target/prove/ordinary`, then opens the truths and scores; docs/proof.md is written when all were
/// answered. Whether every score is as asked.
pub(crate) fn open(only: &[String]) -> Result<bool, Failure> {
    let program = program::hash(&root())?;
    let paths = named(only)?;
    let names: Vec<String> = paths.iter().map(|unit| name(unit).to_owned()).collect();
    let into = root().join("target/prove/ordinary");
    write(&into, &names, &answers(&paths)?, None)?;
    eprintln!("all answers are in {}; the truths are opened", into.display());
    let cases = paths.iter().map(|unit| case(unit, &into)).collect::<Result<Vec<_>, _>>()?;
    let rows = summary(&cases.iter().map(|case| case.scored.clone()).collect::<Vec<_>>());
    if only.is_empty() {
        let text = format!("{}\n{}", markdown(&rows), details(&cases));
        publish("ordinary", &program, &text)?;
        eprintln!("docs/proof.md is written");
    } else {
        println!("{}", details(&cases));
    }
    println!("{}", lines(&rows));
    failures(&rows).for_each(|row| eprintln!("FAILS: {}: {}", row.group, row.quantity));
    Ok(failures(&rows).next().is_none())
}

fn case(unit: &str, answers: &Path) -> Result<Case, Failure> {
    let at = folder().join(unit);
    let truth = Truth::read(&at.join("truth.ron"))?;
    let (answer, predicted) = answered(answers, name(unit))?;
    let held = HoldOut::of(&at)?.judge(&answer, &predicted, truth.holdout_noise_rms_deg_per_h)?;
    let scored = score(&truth, &answer, held, drawing(unit)?.design.sensor.lag);
    Ok(Case { unit: unit.to_owned(), truth, answer, scored })
}

/// Answers the sealed units into `fixtures/ordinary/answers`, once.
pub(crate) fn sealed() -> Result<bool, Failure> {
    let into = folder().join("answers");
    if into.exists() {
        return Err(Failure(format!("{}: the sealed units have been answered, and are answered once", into.display())));
    }
    let paths = units("sealed")?;
    let program = program::hash(&root())?;
    let files = answers(&paths)?;
    if program::hash(&root())? != program {
        return Err(Failure("a source changed while the units were answered; nothing is written".into()));
    }
    let names: Vec<String> = paths.iter().map(|unit| name(unit).to_owned()).collect();
    write(&into, &names, &files, Some(&program))?;
    println!("{} sealed units are answered in {}; the program is in {PROGRAM}", names.len(), into.display());
    Ok(true)
}

/// Unit by unit.
fn details(cases: &[Case]) -> String {
    let mut out = String::from(
        "| unit | what it is (SNR with tolerances free) | said, with probability | set | held out, over the noise | drawing's | not as it should be |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for Case { unit, truth, answer, scored } in cases {
        let is = |effect: &truth::Effect| {
            let like =
                if effect.inseparable.is_empty() { String::new() } else { format!(", like {}", effect.inseparable.join(", ")) };
            let seen = if effect.detectable { "" } else { ", tolerances can do it" };
            format!("{} ({:.0} of {:.0}{like}{seen})", effect.id, effect.snr_given_tolerances, effect.snr)
        };
        let what: Vec<String> = truth.effects.iter().map(is).collect();
        let what = if scored.kind == Kind::Good { "good".into() } else { what.join(", ") };
        let likely = answer.mechanisms.iter().filter(|m| m.probability >= 0.05).take(3);
        let names: Vec<String> = likely.map(|m| format!("{} {:.2}", m.id, m.probability)).collect();
        let said = if names.is_empty() { answer.verdict.clone() } else { format!("{}: {}", answer.verdict, names.join(", ")) };
        let HeldOut { nominal, model, truth } = scored.held;
        let _ = writeln!(
            out,
            "| {unit} | {what} | {said} | {} | {:.2} | {:.1} | {} |",
            answer.set.join(", "),
            model / truth,
            nominal / truth,
            scored.faults().join("; ")
        );
    }
    out
}
