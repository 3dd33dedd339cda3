//! `cargo xtask prove --composed`: units with laws that no library lists, and units with none; whether what is composed predicts.
//!
//! Constants of every unit lie anywhere within the tolerances, instruments are off. All are answered, and only then held against their truths.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use fogcoil::cache::Cache;
use fogcoil::input;
use serde_json::Value;

use crate::concealed::{Answer, Bound, CONFIDENT, Form, HeldOut, ScoreRow, each, failures, lines, markdown, publish};
use crate::files::{self, root};
use crate::generator::{DrawnUnit, DrawnUnits};
use crate::statistics::{median, rate};
use crate::three_records::{self, HoldOut};
use crate::{Failure, program};

const SEED: u64 = 1;
/// Signal-to-noise ratio, given the tolerances, above which a law is to be found.
const FOUND: f64 = 15.0;
/// Share of what the true law would gain that counts as found.
const HALF: f64 = 0.5;
/// Share of the noise up to which an error hardly shows.
const HARDLY: f64 = 0.02;

/// A unit's answer beside its truth.
struct Case {
    name: String,
    /// Law and signal-to-noise ratio; `None` where nothing is concealed.
    law: Option<(String, f64)>,
    answer: Answer,
    /// Ids of the terms that were composed and accepted.
    terms: Vec<String>,
    held: HeldOut,
    /// Root mean square of recorded less predicted by the unit without its law \[deg/h\].
    without: f64,
}

impl Case {
    /// Share of the law's gain that the answer has; `None` where the law hardly shows.
    fn gained(&self) -> Option<f64> {
        let HeldOut { model, truth, .. } = self.held;
        (self.without > (1.0 + HARDLY) * truth).then(|| (self.without - model) / (self.without - truth))
    }

    /// Predicts as well as the truth.
    fn is_as_good(&self) -> bool {
        self.held.model <= (1.0 + HARDLY) * self.held.truth
    }

    fn strong(&self) -> bool {
        self.law.as_ref().is_some_and(|(_, snr)| *snr > FOUND)
    }

    /// A mechanism of the library, none of which is there, named at this probability or more.
    fn names(&self, from: f64) -> bool {
        self.answer.mechanisms.iter().any(|m| m.probability >= from && !m.id.starts_with("unknown"))
    }

    fn quiet(&self) -> bool {
        matches!(self.answer.verdict.as_str(), "none" | "recalibrate")
    }
}

fn folder() -> PathBuf {
    root().join("target/prove/composed").join(SEED.to_string())
}

/// Makes so many units, or those of `only` by their numbers, answers them and scores the answers. All of them are written as the section of docs/proof.md,
/// some are printed. Whether all scores are as asked.
pub(crate) fn run(units: usize, only: &[usize]) -> Result<bool, Failure> {
    let program = program::hash(&root())?;
    let numbers = if only.is_empty() { (0..units).collect() } else { only.to_vec() };
    let cases = cases(&numbers, &folder(), &program)?;
    let rows = summary(&cases);
    if !only.is_empty() {
        println!("{}\n{}", details(&cases), lines(&rows));
        return Ok(failures(&rows).next().is_none());
    }
    publish("composed", &program, &format!("{}\n{}", markdown(&rows), details(&cases)))?;
    println!("{}", lines(&rows));
    failures(&rows).for_each(|row| eprintln!("FAILS: {}: {}", row.group, row.quantity));
    Ok(failures(&rows).next().is_none())
}

fn cases(numbers: &[usize], folder: &Path, program: &str) -> Result<Vec<Case>, Failure> {
    let (clock, cache) = (Instant::now(), Cache::of_user());
    let coil = input::read_coil(&root().join("fixtures/coil-reference.ron"))?;
    let made = DrawnUnits::new(&coil.design)?;
    let names: Vec<String> = numbers.iter().map(|n| format!("{n:04}")).collect();
    let answers = folder.join("answers").join(&program[..16]);
    let drawn = each(&names, |name| {
        let number: usize = name.parse()?;
        let unit = made.unit(&coil.design, SEED, number)?;
        let at = folder.join(name);
        let [first, second, third] = unit.records.clone();
        let text = [("run1.csv", first), ("run2.csv", second), ("holdout.csv", third), ("meta.ron", unit.meta.clone())];
        files::write_all(&text.map(|(file, text)| (at.join(file), text)))?;
        let [json, prediction] = ["json", "csv"].map(|kind| answers.join(format!("{name}.{kind}")));
        if !json.exists() {
            let (start, [said, predicted]) = (Instant::now(), three_records::answer(&coil, &at, &cache)?);
            files::write_all(&[(prediction, predicted), (json, said)])?;
            eprintln!("[{:5.0} s] {name} is answered ({:.0} s)", clock.elapsed().as_secs_f64(), start.elapsed().as_secs_f64());
        }
        Ok(unit)
    })?;
    names.iter().zip(&drawn).map(|(name, unit)| case(name, unit, folder, &answers)).collect()
}

fn case(name: &str, unit: &DrawnUnit, folder: &Path, answers: &Path) -> Result<Case, Failure> {
    let (answer, predicted) = crate::concealed::answered(answers, name)?;
    let json: Value = serde_json::from_str(&files::read(&answers.join(format!("{name}.json")))?)?;
    let accepted = json["composed"]["accepted"].as_bool() == Some(true);
    let terms = json["composed"]["terms"].as_array().into_iter().flatten().filter(|_| accepted);
    let terms = terms.filter_map(|term| Some(term["id"].as_str()?.to_owned())).collect();
    let recorded = HoldOut::of(&folder.join(name))?;
    let [without, truth] = [&unit.rates[0], &unit.rates[1]].map(|rates| recorded.left(rates));
    let held = recorded.judge(&answer, &predicted, truth?)?;
    let law = unit.concealed.as_ref().map(|c| (c.law.id.clone(), c.snr));
    Ok(Case { name: name.to_owned(), law, answer, terms, held, without: without? })
}

fn summary(cases: &[Case]) -> Vec<ScoreRow> {
    let share = |group, quantity, bound, of: &[&Case], is: &dyn Fn(&Case) -> bool| {
        let measured = rate(of.iter().filter(|case| is(case)).count(), of.len());
        ScoreRow { group, quantity, measured, form: Form::Percent, bound }
    };
    let (nulls, laws): (Vec<&Case>, Vec<&Case>) = cases.iter().partition(|case| case.law.is_none());
    let strong: Vec<&Case> = laws.iter().copied().filter(|case| case.strong()).collect();
    let shown: Vec<&Case> = strong.iter().copied().filter(|case| case.gained().is_some()).collect();
    let gains: Vec<f64> = shown.iter().filter_map(|case| case.gained()).collect();
    let (found, wrong) = ("laws above 15", Bound::AtMost(0.02));
    let all: Vec<&Case> = cases.iter().collect();
    vec![
        share(found, "half of the true law's gain, held out", Bound::AtLeast(0.7), &shown, &|c| {
            c.gained().is_some_and(|gained| gained >= HALF)
        }),
        ScoreRow {
            group: found,
            quantity: "share of that gain, median",
            measured: median(&gains),
            form: Form::Number,
            bound: Bound::Open,
        },
        share(found, "a law composed and accepted", Bound::Open, &strong, &|c| !c.terms.is_empty()),
        share("laws", "a name with confidence", wrong, &laws, &|c| c.names(CONFIDENT)),
        share("laws", "that name predicts less well than the truth", wrong, &laws, &|c| c.names(CONFIDENT) && !c.is_as_good()),
        share("nothing concealed", "something composed or named", Bound::AtMost(0.01), &nulls, &|c| {
            !c.quiet() || !c.terms.is_empty() || c.names(0.5)
        }),
        share("all", "held-out prediction made worse", Bound::AtMost(0.0), &all, &|c| c.held.is_worse()),
    ]
}

/// Unit by unit, those that conceal a law.
fn details(cases: &[Case]) -> String {
    let mut out = String::from(
        "| unit | law (SNR given the tolerances) | said | composed and accepted | held out, over the noise: design, without the law, answer | share of the gain |\n\
         |---|---|---|---|---|---|\n",
    );
    for case in cases {
        let Case { name, law, answer, terms, held, without } = case;
        let what = match law {
            Some((law, snr)) => format!("{law} ({snr:.0})"),
            None if answer.verdict == "recalibrate" || answer.verdict == "none" => continue,
            None => "nothing".into(),
        };
        let named: Vec<String> =
            answer.mechanisms.iter().filter(|m| m.probability >= 0.2).map(|m| format!("{} {:.2}", m.id, m.probability)).collect();
        let [nominal, without, model] = [held.nominal, *without, held.model].map(|h| h / held.truth);
        let gained = case.gained().map_or("shows hardly".to_owned(), |gained| format!("{gained:.2}"));
        let _ = writeln!(
            out,
            "| {name} | {what} | {} {} | {} | {nominal:.2}, {without:.2}, {model:.2} | {gained} |",
            answer.verdict,
            named.join(", "),
            terms.join(" + "),
        );
    }
    out
}
