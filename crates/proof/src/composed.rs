//! `cargo xtask prove --composed`: units with laws that no library lists, and units with none; whether what is composed predicts.
//!
//! Constants of every unit lie anywhere within the tolerances, instruments are off. All are answered, and only then held against their truths.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use fogcoil::cache::Cache;
use fogcoil::diagnose;
use fogcoil::input::{self, CoilCase, RATE};
use serde_json::Value;

use crate::concealed::{Answer, Bound, Form, ScoreRow, each, failures, lines, markdown, mean, publish, record, rms, used};
use crate::files::{self, root};
use crate::generator::{DrawnUnit, DrawnUnits};
use crate::statistics::{median, rate};
use crate::{Failure, program};

const SEED: u64 = 1;
/// Signal-to-noise ratio, given the tolerances, above which a law is to be found.
const FOUND: f64 = 15.0;
/// Share of what the true law would gain that counts as found.
const HALF: f64 = 0.5;
/// Share by which a prediction is worse, or a law shows at all.
const MORE: f64 = 0.02;
/// Probability from which a name is given with confidence.
const CONFIDENT: f64 = 0.8;

/// A unit's answer beside its truth.
struct Case {
    name: String,
    /// Law and signal-to-noise ratio; `None` where nothing is concealed.
    law: Option<(String, f64)>,
    answer: Answer,
    /// Ids of the terms that were composed and accepted.
    terms: Vec<String>,
    /// Root mean squares of recorded less predicted in the record held out, each less its mean [deg/h].
    held: Held,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Held {
    /// By the design.
    nominal: f64,
    /// By the unit without its law.
    without: f64,
    /// By the unit with its law.
    truth: f64,
    /// By the answer.
    model: f64,
}

impl Held {
    /// Share of the law's gain that the answer has; `None` where the law hardly shows.
    fn gained(&self) -> Option<f64> {
        (self.without > (1.0 + MORE) * self.truth).then(|| (self.without - self.model) / (self.without - self.truth))
    }

    fn is_worse(&self) -> bool {
        self.model > (1.0 + MORE) * self.nominal
    }

    /// Predicts as well as the truth.
    fn is_as_good(&self) -> bool {
        self.model <= (1.0 + MORE) * self.truth
    }
}

impl Case {
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

/// Makes so many units, answers them and scores the answers; writes the section of docs/proof.md. Whether all scores are as asked.
pub(crate) fn run(units: usize) -> Result<bool, Failure> {
    let program = program::hash(&root())?;
    let cases = cases(units, &folder(), &program)?;
    let rows = summary(&cases);
    publish("composed", &program, &format!("{}\n{}", markdown(&rows), details(&cases)))?;
    println!("{}", lines(&rows));
    failures(&rows).for_each(|row| eprintln!("FAILS: {}: {}", row.group, row.quantity));
    Ok(failures(&rows).next().is_none())
}

fn cases(units: usize, folder: &Path, program: &str) -> Result<Vec<Case>, Failure> {
    let (clock, cache) = (Instant::now(), Cache::of_user());
    let coil = input::read_coil(&root().join("fixtures/coil-reference.ron"))?;
    let made = DrawnUnits::new(&coil.design)?;
    let numbers: Vec<usize> = (0..units).collect();
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
            let (start, [said, predicted]) = (Instant::now(), answer(&coil, &at, &cache)?);
            files::write_all(&[(prediction, predicted), (json, said)])?;
            eprintln!("[{:5.0} s] {name} is answered ({:.0} s)", clock.elapsed().as_secs_f64(), start.elapsed().as_secs_f64());
        }
        Ok(unit)
    })?;
    names.iter().zip(&drawn).map(|(name, unit)| case(name, unit, folder, &answers)).collect()
}

/// What `fogcoil diagnose` writes of the unit whose records are in a folder.
fn answer(coil: &CoilCase, at: &Path, cache: &Cache) -> Result<[String; 2], Failure> {
    let fitted = ["run1.csv", "run2.csv"].map(|file| record(&at.join(file))).into_iter().collect::<Result<Vec<_>, _>>()?;
    let outcome = diagnose::diagnose(coil, mechanisms::CATALOGUE, &fitted, &[record(&at.join("holdout.csv"))?], cache, &|_| ())?;
    let prediction = outcome.prediction().ok_or_else(|| Failure("nothing is predicted".into()))?;
    Ok([format!("{}\n", outcome.json()), prediction])
}

fn case(name: &str, unit: &DrawnUnit, folder: &Path, answers: &Path) -> Result<Case, Failure> {
    let (answer, predicted) = crate::concealed::answered(answers, name)?;
    let json: Value = serde_json::from_str(&files::read(&answers.join(format!("{name}.json")))?)?;
    let accepted = json["composed"]["accepted"].as_bool() == Some(true);
    let terms = json["composed"]["terms"].as_array().into_iter().flatten().filter(|_| accepted);
    let terms = terms.filter_map(|term| Some(term["id"].as_str()?.to_owned())).collect();
    let recorded = used(&record(&folder.join(name).join("holdout.csv"))?, RATE)?;
    let left = |by: &[f64]| {
        let left: Vec<f64> = recorded.iter().zip(by).map(|(y, p)| y - p).collect();
        let offset = mean(left.iter().copied());
        rms(left.iter().map(|r| r - offset))
    };
    let [without, truth, model] = [&unit.rates[0], &unit.rates[1], &predicted].map(|rates| left(rates));
    // of many rows the answer's errors are those of means over some: the noise that both predictions lose by that is the same
    let lost = |rmse_model: f64| model.powi(2) - rmse_model.powi(2);
    let nominal = answer.holdout.map_or(f64::NAN, |h| (h.rmse_nominal.powi(2) + lost(h.rmse_model)).max(0.0).sqrt());
    let law = unit.concealed.as_ref().map(|c| (c.law.id.clone(), c.snr));
    Ok(Case { name: name.to_owned(), law, answer, terms, held: Held { nominal, without, truth, model } })
}

fn summary(cases: &[Case]) -> Vec<ScoreRow> {
    let share = |group, quantity, bound, of: &[&Case], is: &dyn Fn(&Case) -> bool| {
        let measured = rate(of.iter().filter(|case| is(case)).count(), of.len());
        ScoreRow { group, quantity, measured, form: Form::Percent, bound }
    };
    let (nulls, laws): (Vec<&Case>, Vec<&Case>) = cases.iter().partition(|case| case.law.is_none());
    let strong: Vec<&Case> = laws.iter().copied().filter(|case| case.strong()).collect();
    let shown: Vec<&Case> = strong.iter().copied().filter(|case| case.held.gained().is_some()).collect();
    let gains: Vec<f64> = shown.iter().filter_map(|case| case.held.gained()).collect();
    let (found, wrong) = ("laws above 15", Bound::AtMost(0.02));
    let all: Vec<&Case> = cases.iter().collect();
    vec![
        share(found, "half of the true law's gain, held out", Bound::AtLeast(0.7), &shown, &|c| {
            c.held.gained().is_some_and(|gained| gained >= HALF)
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
        share("laws", "that name predicts less well than the truth", wrong, &laws, &|c| {
            c.names(CONFIDENT) && !c.held.is_as_good()
        }),
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
    for Case { name, law, answer, terms, held } in cases {
        let what = match law {
            Some((law, snr)) => format!("{law} ({snr:.0})"),
            None if answer.verdict == "recalibrate" || answer.verdict == "none" => continue,
            None => "nothing".into(),
        };
        let named: Vec<String> =
            answer.mechanisms.iter().filter(|m| m.probability >= 0.2).map(|m| format!("{} {:.2}", m.id, m.probability)).collect();
        let [nominal, without, model] = [held.nominal, held.without, held.model].map(|h| h / held.truth);
        let gained = held.gained().map_or("shows hardly".to_owned(), |gained| format!("{gained:.2}"));
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
