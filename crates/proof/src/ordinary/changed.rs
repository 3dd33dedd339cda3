//! `cargo xtask prove --ordinary --changed`: whether an answer stays the same where only offsets, units or sampling change.

use std::fmt::Write as _;

use fogcoil::cache::Cache;

use super::change::Change;
use super::{drawing, folder, name, named};
use crate::concealed::{Answer, Written, each, publish};
use crate::files::root;
use crate::statistics::rate;
use crate::three_records::{self, FITTED, HELD_OUT};
use crate::{Failure, program};

/// Share of changed records that must be answered alike.
const ALIKE: f64 = 0.97;

/// Verdict and set, the set in the order of names.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Said {
    verdict: String,
    set: Vec<String>,
}

impl Said {
    fn of(Answer { verdict, mut set, .. }: Answer) -> Self {
        set.sort();
        Self { verdict, set }
    }

    fn words(&self) -> String {
        if self.set.is_empty() { self.verdict.clone() } else { format!("{}: {}", self.verdict, self.set.join(", ")) }
    }
}

/// Answers on a unit as it is, and after each of the changes.
#[derive(Debug)]
struct Case {
    unit: String,
    first: Said,
    changed: [Said; Change::ALL.len()],
}

/// Answers open units, or those named, from records that are changed in ways that say nothing of the coil; writes the section of docs/proof.md when all
/// were answered. Whether verdict and set stay the same in 97 of 100.
pub(crate) fn run(only: &[String]) -> Result<bool, Failure> {
    let program = program::hash(&root())?;
    let (cache, into) = (Cache::of_user(), root().join("target/prove/changed"));
    let said = |[json, _]: Written| -> Result<Said, Failure> { Ok(Said::of(serde_json::from_str(&json)?)) };
    let cases = each(&named(only)?, |unit| {
        let first = said(three_records::answer(&drawing(unit)?, &folder().join(unit), &cache)?)?;
        let answer = |change: Change| -> Result<Said, Failure> {
            let at = into.join(change.folder()).join(name(unit));
            change.write(&[FITTED[0], FITTED[1], HELD_OUT], &folder().join(unit), &at)?;
            let said = said(three_records::answer(&change.drawing(drawing(unit)?), &at, &cache)?)?;
            let alike = if said == first { "the same".into() } else { format!("{} instead of {}", said.words(), first.words()) };
            eprintln!("{unit}, {}: {alike}", change.name());
            Ok(said)
        };
        let [a, b, c, d] = Change::ALL;
        Ok(Case { unit: unit.to_owned(), changed: [answer(a)?, answer(b)?, answer(c)?, answer(d)?], first })
    })?;
    let (holds, result) = result(&cases);
    if only.is_empty() {
        publish("changed", &program, &section(&cases, &result))?;
    }
    println!("{result}");
    Ok(holds)
}

/// Number of cases that are answered alike after a change.
fn alike(cases: &[Case], change: usize) -> usize {
    cases.iter().filter(|case| case.changed[change] == case.first).count()
}

/// Whether as many answers are the same as is asked, and the sentence that says so.
fn result(cases: &[Case]) -> (bool, String) {
    let hits = (0..Change::ALL.len()).map(|change| alike(cases, change)).sum();
    let Some(measured) = rate(hits, Change::ALL.len() * cases.len()) else { return (false, "No unit was asked for.".into()) };
    let holds = measured.value >= ALIKE;
    let [percent, low, high] = [measured.value, measured.interval[0], measured.interval[1]].map(|share| 100.0 * share);
    let asked = 100.0 * ALIKE;
    let verdict = if holds { "holds" } else { "FAILS" };
    let of = measured.cases;
    (
        holds,
        format!(
            "{hits} of {of} answers are the same, {percent:.0} % [{low:.0} % to {high:.0} %], asked {asked:.0} %: {verdict}."
        ),
    )
}

/// Number of cases that are answered alike after each change, and those that are not.
fn section(cases: &[Case], result: &str) -> String {
    let mut out = String::from("| change | answered alike |\n|---|---|\n");
    for (at, change) in Change::ALL.iter().enumerate() {
        let _ = writeln!(out, "| {} | {} of {} |", change.name(), alike(cases, at), cases.len());
    }
    let _ = write!(out, "\n{result}\n\n| unit | change | before | after |\n|---|---|---|---|\n");
    for case in cases {
        for (change, said) in Change::ALL.iter().zip(&case.changed).filter(|(_, said)| **said != case.first) {
            let _ = writeln!(out, "| {} | {} | {} | {} |", case.unit, change.name(), case.first.words(), said.words());
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_changed_is_counted_and_listed() {
        let said =
            |verdict: &str, set: &[&str]| Said { verdict: verdict.into(), set: set.iter().map(ToString::to_string).collect() };
        let first = || said("explained", &["air-path"]);
        let case = |last: Said| Case { unit: "A/open/U1".into(), first: first(), changed: [first(), first(), first(), last] };
        let cases = [case(first()), case(said("recalibrate", &[]))];
        let (holds, text) = result(&cases);
        assert!(!holds && text.starts_with("7 of 8 answers are the same, 88 % ["), "{text}");
        let all = section(&cases, &text);
        assert!(all.contains("| 10 deg/h more | 2 of 2 |") && all.contains("| every second row | 1 of 2 |"), "{all}");
        assert!(all.ends_with("| A/open/U1 | every second row | explained: air-path | recalibrate |\n"), "{all}");
        assert!(result(&cases[..1]).0 && !result(&[]).0);
        // another order of names is no other answer
        let answer = |set: [&str; 2]| Said::of(Answer { set: set.map(String::from).to_vec(), ..Answer::default() });
        assert_eq!(answer(["b", "a"]), answer(["a", "b"]));
    }
}
