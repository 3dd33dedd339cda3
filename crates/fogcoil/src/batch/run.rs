//! All units of a batch.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use progress::Step;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::finding::{Inputs, Read};
use super::kept::Kept;
use super::limits::{Judged, Limits};
use super::row::Row;
use super::serials::{settle, warn_of_copies};
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
/// [`files::Error::Input`] of the first record if no unit's records can be used: of some that cannot, their rows tell the problem; [`files::Error::Coil`] if the design cannot be modelled; [`files::Error::Output`] where
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
    let (read, unusable) = apart(units, units.par_iter().map(|unit| inputs.read(unit, &program)).collect())?;
    if let Some(first) = unusable.first() {
        let (count, all, first) = (unusable.len(), units.len(), &first.unit);
        progress(Step::begins(&format!(
            "going on without {count} of {all} units, whose records cannot be used ({first} the first)"
        )));
    }
    let kept = Kept::within(folder)?;
    let found: Vec<Option<Value>> = read.iter().map(|unit| kept.load(&unit.name, &unit.key)).collect();
    let already = found.iter().flatten().count();
    if already > 0 {
        progress(Step::begins(&format!("{already} of {} units have findings that are kept", read.len())));
    }
    if already < read.len() {
        models(inputs.case, inputs.cache, progress)?;
    }
    let done = AtomicUsize::new(already);
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
    rows.extend(unusable);
    rows.sort_by(|a, b| a.unit.cmp(&b.unit));
    settle(&mut rows);
    warn_of_copies(&mut rows);
    let judged = |row: Row| {
        let judged = limits.map_or(Judged::Unjudged, |limits| limits.judge(&row));
        (row, judged)
    };
    Ok(Batch { rows: rows.into_iter().map(judged).collect() })
}

/// The units whose records can be used, and the rows of the others.
///
/// # Errors
/// That of the first if none can.
fn apart(units: &[Unit], read: Vec<Result<Read, Error>>) -> Result<(Vec<Read>, Vec<Row>), Error> {
    if read.iter().any(Result::is_ok) {
        let (mut usable, mut unusable) = (Vec::new(), Vec::new());
        for (unit, read) in units.iter().zip(read) {
            match read {
                Ok(read) => usable.push(read),
                Err(error) => unusable.push(row_of(unit, &error)),
            }
        }
        return Ok((usable, unusable));
    }
    Ok((read.into_iter().collect::<Result<_, _>>()?, Vec::new()))
}

/// The row of a unit whose records cannot be used.
fn row_of(unit: &Unit, error: &Error) -> Row {
    let files: Vec<String> = unit.fits.iter().chain(&unit.holdouts).map(|file| file.display().to_string()).collect();
    let mut row = Row::of(&json!({"unit": unit.name, "files": files, "problem": error.to_string()}));
    row.lot.clone_from(&unit.lot);
    row
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
