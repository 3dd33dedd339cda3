//! All units of a batch.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use progress::Step;
use rayon::prelude::*;
use serde_json::Value;

use super::finding::{Inputs, Read};
use super::kept::Kept;
use super::limits::{Judged, Limits};
use super::row::Row;
use super::serials::settle;
use super::units::Unit;
use crate::prepare::models;
use crate::{Error, program};

/// The task that makes the findings, as it is told.
pub const TASK: &str = "diagnosing units";

/// A batch.
pub struct Batch {
    /// The units by their names, and whether each keeps its limits.
    pub rows: Vec<(Row, Judged)>,
}

/// Measures, diagnoses and judges all units, those aside whose findings are in `folder` already; every other finding is kept there as soon as it is known.
///
/// # Errors
/// [`files::Error::Input`] of the first record that cannot be used; [`files::Error::Coil`] if the design cannot be modelled; [`files::Error::Output`] where
/// a finding cannot be kept.
pub fn run(
    inputs: &Inputs,
    units: &[Unit],
    limits: Option<&Limits>,
    folder: &Path,
    progress: &(dyn Fn(Step) + Sync),
) -> Result<Batch, Error> {
    progress(Step::begins("reading the records"));
    let program = program::hash(inputs.cache.code());
    let read: Vec<Read> = units.par_iter().map(|unit| inputs.read(unit, &program)).collect::<Result<_, _>>()?;
    let kept = Kept::within(folder)?;
    let found: Vec<Option<Value>> = read.iter().map(|unit| kept.load(&unit.name, &unit.key)).collect();
    if found.iter().any(Option::is_none) {
        models(inputs.case, inputs.cache, progress)?;
    }
    let done = AtomicUsize::new(found.iter().flatten().count());
    let tell = || progress(Step::counted(TASK, done.load(Ordering::Relaxed), read.len()));
    tell();
    let row = |(unit, found): (&Read, Option<Value>)| {
        let finding = match found {
            Some(finding) => finding,
            None => {
                let (finding, page) = inputs.find(unit, &|_| tell());
                let finding = kept.keep(&unit.name, &finding, page)?;
                done.fetch_add(1, Ordering::Relaxed);
                tell();
                finding
            }
        };
        let mut row = Row::of(&finding);
        row.lot = row.lot.or_else(|| unit.lot.clone());
        Ok(row)
    };
    let mut rows: Vec<Row> = read.par_iter().zip(found).map(row).collect::<Result<_, Error>>()?;
    settle(&mut rows);
    let judged = |row: Row| {
        let judged = limits.map_or(Judged::Unjudged, |limits| limits.judge(&row));
        (row, judged)
    };
    Ok(Batch { rows: rows.into_iter().map(judged).collect() })
}

impl Batch {
    /// Number of units that fail.
    pub fn failing(&self) -> usize {
        self.rows.iter().filter(|(_, judged)| matches!(judged, Judged::Fails(_))).count()
    }

    /// Number of units of which it is not known whether they keep the limits; none of them has passed.
    pub fn not_known(&self) -> usize {
        self.rows.iter().filter(|(_, judged)| matches!(judged, Judged::NotKnown(_))).count()
    }

    /// Its units.
    pub(super) fn units(&self) -> Vec<&Row> {
        self.rows.iter().map(|(row, _)| row).collect()
    }

    /// Units that could not be diagnosed, and why.
    pub fn problems(&self) -> impl Iterator<Item = (&str, &str)> {
        self.rows.iter().filter_map(|(row, _)| Some((row.unit.as_str(), row.problem.as_deref()?)))
    }
}
