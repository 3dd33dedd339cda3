//! The program's answer on a unit, read back from its files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use fogcoil::cache::Cache;
use fogcoil::diagnose;
use fogcoil::input::{self, CoilCase, RecordCase, RecordOptions};
use serde::Deserialize;

use crate::{Failure, files};

/// Probability from which something is said to be there.
pub(crate) const MORE_THAN_NOT: f64 = 0.5;

/// Output of `fogcoil diagnose COIL --fit F --holdout H --json J --prediction P` on a unit: J, scored in part, and P.
pub(crate) type Written = [String; 2];

#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(crate) struct Answer {
    /// `none`, `recalibrate`, `explained` or `unknown`.
    pub(crate) verdict: String,
    /// Most probable first.
    pub(crate) mechanisms: Vec<Probable>,
    pub(crate) set: Vec<String>,
    pub(crate) parameters: BTreeMap<String, Fitted>,
    pub(crate) located: Place,
    /// The structure that was seen, in words.
    pub(crate) structure: Option<String>,
    #[serde(default)]
    pub(crate) holdout: Option<Held>,
    /// Constants of the design and the instruments as the records leave them.
    #[serde(default, rename = "unknowns")]
    pub(crate) constants: Vec<Constant>,
}

/// A constant as it is left.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(crate) struct Constant {
    pub(crate) name: String,
    pub(crate) value: f64,
    pub(crate) ci90: [f64; 2],
    /// In the drawing.
    pub(crate) drawing: f64,
}

/// Fit compared with the held-out record, whether it was accepted or not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
pub(crate) struct Held {
    pub(crate) rmse_model: f64,
    pub(crate) rmse_nominal: f64,
}

#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(crate) struct Probable {
    pub(crate) id: String,
    pub(crate) probability: f64,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
pub(crate) struct Fitted {
    pub(crate) value: f64,
    pub(crate) ci90: [f64; 2],
}

#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(crate) struct Place {
    pub(crate) stage: Option<String>,
}

/// Reads a record that can be used.
pub(crate) fn record(file: &Path) -> Result<RecordCase, Failure> {
    let record = input::read_record(file, &RecordOptions::default())?;
    record.require_usable()?;
    Ok(record)
}

/// Runs the diagnosis as `fogcoil diagnose` does.
pub(crate) fn answer_records(coil: &CoilCase, fitted: &[PathBuf], holdout: &Path, cache: &Cache) -> Result<Written, Failure> {
    let fitted = fitted.iter().map(|file| record(file)).collect::<Result<Vec<_>, _>>()?;
    let held_out = [record(holdout)?];
    let columns = diagnose::of_columns(&fitted, &held_out, mechanisms::CATALOGUE);
    let outcome = diagnose::diagnose(coil, mechanisms::CATALOGUE, &columns, &fitted, &held_out, cache, &|_| ())?;
    let prediction = outcome.prediction().ok_or_else(|| Failure(format!("{}: nothing is predicted", holdout.display())))?;
    Ok([format!("{}\n", outcome.json()), prediction])
}

/// Runs it for the unit in a folder.
pub(crate) fn of_unit(coil: &CoilCase, folder: &Path, cache: &Cache) -> Result<Written, Failure> {
    let [fitted, held_out] = records(folder);
    answer_records(coil, &[fitted], &held_out, cache)
}

/// The two files in `folder` that hold the answer of a unit: J, P.
pub(crate) fn paths(folder: &Path, unit: &str) -> [PathBuf; 2] {
    ["json", "csv"].map(|kind| folder.join(format!("{unit}.{kind}")))
}

/// The answer on a unit and the predicted rates, from the files in `folder`.
pub(crate) fn answered(folder: &Path, unit: &str) -> Result<(Answer, Vec<f64>), Failure> {
    let [json, prediction] = paths(folder, unit);
    Ok((serde_json::from_str(&files::read(&json)?)?, rates(&files::read(&prediction)?)?))
}

/// The two records of the unit in `folder`: the one that is fitted, and the one that is held out.
pub(crate) fn records(folder: &Path) -> [PathBuf; 2] {
    ["fit.csv", "holdout.csv"].map(|name| folder.join(name))
}

impl Answer {
    /// Mechanisms that are said to be there: the first if the verdict is `explained`, and every other more probable than not.
    pub(crate) fn named(&self) -> impl Iterator<Item = &str> {
        let explained = self.verdict == "explained";
        let said = self.mechanisms.iter().enumerate().filter(move |(n, m)| explained && (*n == 0 || m.probability >= 0.5));
        said.map(|(_, m)| m.id.as_str())
    }

    /// Of all mechanisms that are `like` something, together; those in a pair count each.
    pub(crate) fn probability(&self, like: impl Fn(&str) -> bool) -> f64 {
        self.mechanisms.iter().filter(|m| like(&m.id)).map(|m| m.probability).sum()
    }
}

/// The rates of a prediction, row by row \[deg/h\].
fn rates(prediction: &str) -> Result<Vec<f64>, Failure> {
    let rate = |line: &str| -> Option<f64> { line.split_once(',')?.1.parse().ok() };
    let read = |line| rate(line).ok_or_else(|| Failure(format!("a prediction has the row {line:?}")));
    prediction.lines().skip(1).map(read).collect()
}
