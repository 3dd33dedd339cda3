//! Recordings: checked, measured, diagnosed.

use std::path::{Path, PathBuf};

use fogcoil::glossary::Note;
use fogcoil::input::{self, RecordCase, RecordOptions};
use fogcoil::measure::{self as measuring, Prediction};
use fogcoil::tabular::{self, Column as Cells};
use fogcoil::{Error, batch as batches, calibrate as lots, check as checking, diagnose as diagnosis, recommend as tests};
use pyo3::prelude::*;

use crate::case::{Coil, Text};
use crate::compute::{Columns, cache};
use crate::error::{raised, warn};
use crate::found::Found;
use crate::watched::watched;

/// A record: the file, or what messages call it, and its columns if it is no file.
type Record = (PathBuf, Option<Columns>);

fn read((path, columns): &Record, meta: Option<&Path>, further: &[String]) -> Result<RecordCase, Error> {
    match columns {
        Some(columns) => Ok(input::check_record(path, input::Table::Columns(columns.clone()), meta, further)?),
        None => {
            let meta = meta.map(Path::to_owned);
            let options = RecordOptions { meta, further: further.to_vec(), ..RecordOptions::default() };
            Ok(input::read_record(path, &options)?)
        }
    }
}

fn all(records: &[Record], meta: Option<&Path>, further: &[String]) -> Result<Vec<RecordCase>, Error> {
    records.iter().map(|record| read(record, meta, further)).collect()
}

fn warnings(notes: &[Note]) -> Vec<Note> {
    notes.iter().filter(|note| note.is_warning()).cloned().collect()
}

fn prediction(coil: &Coil) -> Result<Prediction, Error> {
    Ok(Prediction::of(&coil.case.name, &coil.case.steady_sensitivity()?, &coil.case.sensitivity_band()?))
}

/// Is a record usable, and which noise is in it?
#[pyfunction]
pub(crate) fn check(py: Python, record: Record, meta: Option<PathBuf>) -> PyResult<Found> {
    watched(py, None, |_| {
        let case = read(&record, meta.as_deref(), &[])?;
        let analysis = checking::Analysis::new(&case);
        Ok(Found::new(&checking::json(&analysis), checking::text(&analysis)).with_picture(checking::svg(&analysis)))
    })
}

/// The figures of a record, with a design's prediction where there is one.
#[pyfunction]
pub(crate) fn measure(py: Python, record: Record, coil: Option<&Coil>, meta: Option<PathBuf>) -> PyResult<Found> {
    watched(py, None, |_| {
        let measured = measuring::measure(&read(&record, meta.as_deref(), &[])?)?;
        let predicted = coil.map(prediction).transpose()?;
        Ok(Found::new(&measuring::json(&measured, predicted.as_ref()), measuring::text(&measured, predicted.as_ref())))
    })
}

/// Further columns of records that mechanisms of a user's own name.
#[pyfunction]
pub(crate) fn further_columns(mechanisms: Vec<PathBuf>) -> PyResult<Vec<String>> {
    let read = || Ok::<_, Error>(input::read_mechanisms(&mechanisms)?.further_columns());
    read().map_err(raised)
}

/// A diagnosis with the prediction of the first record held out, and the extended design, where there are.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "as many as Python gives")]
pub(crate) fn diagnose(
    py: Python,
    coil: &Coil,
    fit: Vec<Record>,
    holdout: Vec<Record>,
    mechanisms: Vec<PathBuf>,
    meta: Option<PathBuf>,
    code: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Found, Option<Coil>)> {
    let (found, model) = watched(py, progress.as_ref(), |tell| {
        diagnosis::check_design(&coil.case, &coil.case.file)?;
        let asked = input::read_mechanisms(&mechanisms)?;
        let further = asked.further_columns();
        let records = |records: &[Record]| all(records, meta.as_deref(), &further);
        let (fit, holdout) = (records(&fit)?, records(&holdout)?);
        let weighed = asked.with_catalogue();
        let columns = diagnosis::of_columns(&fit, &holdout, &weighed);
        let outcome = diagnosis::diagnose(&coil.case, &weighed, &columns, &fit, &holdout, &cache(code), tell)?;
        let found = Found::new(&outcome.json(), outcome.text()).with_picture(outcome.picture());
        let numbers = |name, values: Vec<f64>| Cells::numbers(name, values.into_iter().map(Some).collect());
        let found = match outcome.predicted_rate() {
            None => found,
            Some([time, rate]) => {
                let columns = vec![numbers("time_s", time), numbers("rate_deg_per_h", rate)];
                found.with_table(tabular::Table { columns, about: Vec::new() })
            }
        };
        Ok((found, outcome.model().ok()))
    })?;
    Ok((found, model.map(|text| Coil::beside(py, &coil.case.file, text)).transpose()?))
}

/// The recommended test, with its profile.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "as many as Python gives")]
pub(crate) fn recommend(
    py: Python,
    coil: &Coil,
    between: Vec<String>,
    records: Vec<Record>,
    limits: [f64; 4],
    mechanisms: Vec<PathBuf>,
    meta: Option<PathBuf>,
    code: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Found> {
    let (found, notes) = watched(py, progress.as_ref(), |tell| {
        diagnosis::check_design(&coil.case, &coil.case.file)?;
        let asked = input::read_mechanisms(&mechanisms)?;
        let records = all(&records, meta.as_deref(), &asked.further_columns())?;
        let [coldest, hottest, fastest, hours] = limits;
        let limits = tests::Limits { coldest, hottest, fastest, hours };
        let result = tests::recommend(&coil.case, &asked.with_catalogue(), &between, &records, &limits, &cache(code), tell)?;
        let found = Found::new(&tests::json(&result), tests::text(&result)).with_picture(tests::svg(&result));
        Ok((found.with_table(result.profiles[0].programme.table()), tests::notes(&coil.case, &records)))
    })?;
    warn(py, warnings(&notes))?;
    Ok(found)
}

/// Common constants of a lot, with the lot's design.
#[pyfunction]
pub(crate) fn calibrate(
    py: Python,
    coil: &Coil,
    units: Vec<Vec<Record>>,
    meta: Option<PathBuf>,
    code: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Found, Coil)> {
    let (found, model, notes) = watched(py, progress.as_ref(), |tell| {
        diagnosis::check_design(&coil.case, &coil.case.file)?;
        let units = units.iter().map(|records| all(records, meta.as_deref(), &[])).collect::<Result<Vec<_>, _>>()?;
        let outcome = lots::calibrate(&coil.case, &units, &cache(code), tell)?;
        Ok((Found::new(&outcome.json(), outcome.text()), outcome.file()?, outcome.notes().to_vec()))
    })?;
    warn(py, warnings(&notes))?;
    Ok((found, Coil::beside(py, &coil.case.file, model)?))
}

/// A batch, with a row for each unit: the number of failing units, and the units that could not be diagnosed.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "as many as Python gives")]
pub(crate) fn batch(
    py: Python,
    coil: &Coil,
    records: Vec<PathBuf>,
    out: PathBuf,
    limits: Option<&Bound<PyAny>>,
    mechanisms: Vec<PathBuf>,
    meta: Option<PathBuf>,
    map: Option<PathBuf>,
    code: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Found> {
    let limits = limits.map(|source| Text::new(source, None)).transpose()?;
    watched(py, progress.as_ref(), |tell| {
        diagnosis::check_design(&coil.case, &coil.case.file)?;
        let asked = input::read_mechanisms(&mechanisms)?;
        let options = RecordOptions { map, meta, further: asked.further_columns(), ..RecordOptions::default() };
        let units = batches::units(&records, &out)?;
        let limits = limits.map(|Text { path, text }| batches::check_limits(&path, &text)).transpose()?;
        let (cache, prediction) = (cache(code), prediction(coil)?);
        let inputs =
            batches::Inputs { case: &coil.case, asked: &asked, options: &options, cache: &cache, prediction: &prediction };
        let batch = batches::run(&inputs, &units, limits.as_ref(), &out, tell)?;
        let object = serde_json::json!({
            "units": batch.rows.len(),
            "failing": batch.failing(),
            "problems": batch.problems().collect::<std::collections::BTreeMap<_, _>>(),
        });
        let found = Found::new(&object, batches::text(&batch)).with_table(batches::table(&batch));
        Ok(found.with_page(batches::report(&inputs, limits.as_ref(), &batch)))
    })
}
