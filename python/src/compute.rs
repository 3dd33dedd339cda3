//! The computations. Every function frees the interpreter while it works.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use fogcoil::cache::Cache;
use fogcoil::homogenize as cells;
use fogcoil::input::{self, AnyCell, Between, ProfileCase, RecordCase, RecordOptions, at_temperature};
use fogcoil::measure::{self as measuring, Prediction};
use fogcoil::simulate::SimulatedRow;
use fogcoil::units::to_mm;
use fogcoil::{
    Error, compare as comparison, diagnose as diagnosis, sensitivity as ramp, simulate as runs, summary, wind as turns,
};
use progress::Step;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use serde_json::{Value, json};

use crate::case::{Cell, Coil};
use crate::columns::{Column, at_element, bytes, table};
use crate::error::{InputError, raised, warn};

/// Columns by name, as the bytes of their doubles.
type Columns<'py> = Vec<(&'static str, Bound<'py, PyByteArray>)>;

/// The effective constants as JSON.
#[pyfunction]
pub(crate) fn homogenize(py: Python, cell: &Cell, tolerance: f64, temperature_c: Option<f64>) -> PyResult<String> {
    let solve = || -> Result<Value, Error> {
        match &cell.case {
            AnyCell::Regular(case, _) => Ok(cells::json(case, &case.homogenize_to(tolerance)?)),
            AnyCell::General(case) => Ok(cells::general::json(&at_temperature(case, temperature_c, tolerance)?)),
        }
    };
    let tabulated = matches!(&cell.case, AnyCell::General(case) if case.temperatures().is_some());
    if temperature_c.is_some() && !tabulated {
        let problem = "no constituent is a table over temperature: the constants are the same at all; leave temperature_c out";
        return Err(InputError::new_err(problem));
    }
    py.detach(solve).map(|object| object.to_string()).map_err(raised)
}

/// The turn table: halves, layers, turns, and the columns of lengths.
#[pyfunction]
pub(crate) fn wind<'py>(py: Python<'py>, coil: &Coil) -> (Vec<&'static str>, Vec<usize>, Vec<usize>, Columns<'py>) {
    let all = coil.case.winding.turns();
    let columns = vec![
        ("y_mm", bytes(py, all.iter().map(|turn| to_mm(turn.y)))),
        ("r_mm", bytes(py, all.iter().map(|turn| to_mm(turn.r)))),
        ("z_start_m", bytes(py, all.iter().map(|turn| turn.z_start))),
        ("z_end_m", bytes(py, all.iter().map(|turn| turn.z_end))),
    ];
    let halves = all.iter().map(|turn| turns::name(turn.half)).collect();
    (halves, all.iter().map(|turn| turn.layer).collect(), all.iter().map(|turn| turn.turn).collect(), columns)
}

/// The steady sensitivity as JSON, with the errors of the parts.
#[pyfunction]
pub(crate) fn sensitivity(py: Python, coil: &Coil) -> PyResult<String> {
    let computed = || Ok::<_, fogcoil::FileError>((coil.case.steady_sensitivity()?, coil.case.sensitivity_band()?));
    let (result, band) = py.detach(computed).map_err(raised)?;
    let (mut object, errors) = (ramp::json(&coil.case, &result, &band), result.part_errors);
    object["part_error_estimates"] = json!({"shupe": errors.shupe, "eo_axial": errors.eo_axial, "eo_radial": errors.eo_radial});
    Ok(object.to_string())
}

/// Two designs compared, under a profile if there is one, as JSON.
#[pyfunction]
pub(crate) fn compare(
    py: Python,
    a: &Coil,
    b: &Coil,
    profile: Option<Vec<Column>>,
    between: &str,
    code: Option<PathBuf>,
) -> PyResult<String> {
    let read = |columns: Vec<Column>| -> PyResult<[ProfileCase; 2]> {
        Ok([checked_profile(py, a, &columns, &[], between)?, checked_profile(py, b, &columns, &[], between)?])
    };
    let profiles = profile.map(read).transpose()?;
    let run = || comparison::compare([&a.case, &b.case], profiles.as_ref(), &cache(code), &|_| ()).map(|c| comparison::json(&c));
    py.detach(run).map(|object| object.to_string()).map_err(raised)
}

/// The user's cache for models that the library in the file `code` makes; none without it.
fn cache(code: Option<PathBuf>) -> Cache {
    code.map_or(Cache::NONE, |file| Cache::of_user().of_code_in(file))
}

fn checked_profile(py: Python, coil: &Coil, columns: &[Column], further: &[String], between: &str) -> PyResult<ProfileCase> {
    let between = match between {
        "linear" => Between::Linear,
        "cubic" => Between::Cubic,
        other => return Err(InputError::new_err(format!("between: {other:?} is not known; give \"linear\" or \"cubic\""))),
    };
    let read = || {
        input::check_profile("profile".as_ref(), table(columns), &coil.case.design, further)
            .map_err(|error| at_element(error.into()))
    };
    let mut profile = py.detach(read).map_err(raised)?;
    profile.between = between;
    warn(py, profile.notes.clone())?;
    Ok(profile)
}

fn columns<'py>(py: Python<'py>, rows: &[SimulatedRow]) -> Columns<'py> {
    runs::COLUMNS.map(|(name, of)| (name, bytes(py, rows.iter().map(of)))).into()
}

/// A design's model for all designs that differ from it within a box. Immutable.
#[pyclass(frozen, module = "fogcoil")]
pub(crate) struct DesignBox(runs::DesignBox);

#[pymethods]
impl DesignBox {
    #[new]
    fn new(py: Python, coil: &Coil, code: Option<PathBuf>) -> PyResult<Self> {
        py.detach(|| runs::DesignBox::about(&coil.case, &cache(code), &|_| ())).map(Self).map_err(raised)
    }

    fn including(&self, py: Python, coil: &Coil) -> PyResult<Self> {
        py.detach(|| self.0.including(&coil.case)).map(Self).map_err(raised)
    }

    /// The columns of the result, and the estimated errors of thermometer and rate.
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        coil: &Coil,
        profile: Vec<Column>,
        between: &str,
    ) -> PyResult<(Columns<'py>, [f64; 2])> {
        let profile = checked_profile(py, coil, &profile, &[], between)?;
        let varied = py.detach(|| self.0.simulate(&coil.case, &profile)).map_err(raised)?;
        Ok((columns(py, &varied.rows), varied.errors))
    }
}

/// The columns of the result, and its summary as JSON.
#[pyfunction]
pub(crate) fn simulate<'py>(
    py: Python<'py>,
    coil: &Coil,
    profile: Vec<Column>,
    between: &str,
    mechanisms: Vec<PathBuf>,
    code: Option<PathBuf>,
) -> PyResult<(Columns<'py>, String)> {
    let own = input::read_simulated(&mechanisms).map_err(raised)?;
    let further = input::further_columns(&own);
    let (case, profile) = (&coil.case, checked_profile(py, coil, &profile, &further, between)?);
    let run = || {
        let cache = cache(code);
        let model = runs::model(case, &profile.drives, &cache)?;
        let mut simulation = runs::simulate(case, &profile, &model)?;
        simulation.add(&own, &cache, &|_| ())?;
        let object = summary::json(&simulation).to_string();
        Ok((simulation.rows().collect::<Vec<_>>(), object))
    };
    let (rows, object) = py.detach(run).map_err(|error: Error| raised(error))?;
    Ok((columns(py, &rows), object))
}

/// A record: the file, or what messages call it, and its columns if it is no file.
type Record = (PathBuf, Option<Vec<Column>>);

fn read((path, columns): &Record, meta: Option<&Path>, further: &[String]) -> Result<RecordCase, Error> {
    match columns {
        Some(columns) => input::check_record(path, table(columns), meta, further).map_err(|error| at_element(error.into())),
        None => {
            let meta = meta.map(Path::to_owned);
            let options = RecordOptions { meta, further: further.to_vec(), ..RecordOptions::default() };
            Ok(input::read_record(path, &options)?)
        }
    }
}

/// The figures of a record as JSON, with a design's prediction where there is one.
#[pyfunction]
pub(crate) fn measure(py: Python, record: Record, coil: Option<&Coil>, meta: Option<PathBuf>) -> PyResult<String> {
    let run = || -> Result<String, Error> {
        let measured = measuring::measure(&read(&record, meta.as_deref(), &[])?)?;
        let predict = |coil: &Coil| -> Result<Prediction, Error> {
            Ok(Prediction::of(&coil.case.name, &coil.case.steady_sensitivity()?, &coil.case.sensitivity_band()?))
        };
        let prediction = coil.map(predict).transpose()?;
        Ok(measuring::json(&measured, prediction.as_ref()).to_string())
    };
    py.detach(run).map_err(raised)
}

/// The outcome as JSON and in words, the prediction of the first record held out, and the extended design, where there is one.
type Diagnosed<'py> = (String, String, Option<Columns<'py>>, Option<Coil>);

/// Further columns of records that mechanisms of a user's own name.
#[pyfunction]
pub(crate) fn further_columns(mechanisms: Vec<PathBuf>) -> PyResult<Vec<String>> {
    let read = || Ok::<_, Error>(input::read_mechanisms(&mechanisms)?.further_columns());
    read().map_err(raised)
}

/// Diagnosis of a unit's records against its design.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "as many as Python gives")]
pub(crate) fn diagnose<'py>(
    py: Python<'py>,
    coil: &Coil,
    fit: Vec<Record>,
    holdout: Vec<Record>,
    mechanisms: Vec<PathBuf>,
    meta: Option<PathBuf>,
    code: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Diagnosed<'py>> {
    let said = |Step { task, done }: Step| -> PyResult<()> {
        Python::attach(|py| {
            py.check_signals()?;
            progress.as_ref().map_or(Ok(()), |call| call.call1(py, (task, done)).map(drop))
        })
    };
    // the first exception of the callback is raised at the end: a diagnosis cannot be stopped half way
    let raised_by_callback = OnceLock::new();
    let run = || -> Result<_, Error> {
        diagnosis::check_design(&coil.case, &coil.case.file)?;
        let asked = input::read_mechanisms(&mechanisms)?;
        let further = asked.further_columns();
        let all = |records: &[Record]| {
            records.iter().map(|record| read(record, meta.as_deref(), &further)).collect::<Result<Vec<_>, _>>()
        };
        let note = |step: Step| {
            if let Err(error) = said(step) {
                let _ = raised_by_callback.set(error);
            }
        };
        let outcome =
            diagnosis::diagnose(&coil.case, &asked.with_catalogue(), &all(&fit)?, &all(&holdout)?, &cache(code), &note)?;
        let prediction = outcome.predicted_rate();
        Ok((outcome.json().to_string(), outcome.text(), prediction, outcome.model().ok()))
    };
    let result = py.detach(run);
    if let Some(error) = raised_by_callback.into_inner() {
        return Err(error);
    }
    let (object, text, prediction, model) = result.map_err(raised)?;
    let prediction = prediction.map(|[time, rate]| vec![("time_s", bytes(py, time)), ("rate_deg_per_h", bytes(py, rate))]);
    Ok((object, text, prediction, model.map(|text| coil.extended(py, text)).transpose()?))
}
