//! Computations about a design: cells, windings, ramps, profiles. Every function frees the interpreter while it works.

use std::path::PathBuf;

use fogcoil::cache::Cache;
use fogcoil::homogenize as cells;
use fogcoil::input::{self, AnyCell, Between, ProfileCase, at_temperature};
use fogcoil::{
    compare as comparison, explain as explaining, figures, glossary, picture, sensitivity as ramp, simulate as runs, summary,
    templates, trim as trimming, wind as turns,
};
use pyo3::prelude::*;
use serde_json::json;

use crate::case::{Cell, Coil, Text};
use crate::error::{InputError, raised, warn};
use crate::found::Found;
use crate::table::Table;
use crate::watched::watched;

/// Names and numbers of columns.
pub(crate) type Columns = Vec<(String, Vec<f64>)>;

/// The figure of a simulation that shows it in a notebook.
const COURSE: &str = "bias";

#[pyfunction]
pub(crate) fn homogenize(py: Python, cell: &Cell, tolerance: f64, temperature_c: Option<f64>) -> PyResult<Found> {
    let tabulated = matches!(&cell.case, AnyCell::General(case) if case.temperatures().is_some());
    if temperature_c.is_some() && !tabulated {
        let problem = "no constituent is a table over temperature: the constants are the same at all; leave temperature_c out";
        return Err(InputError::new_err(problem));
    }
    watched(py, None, |_| match &cell.case {
        AnyCell::Regular(case, _) => {
            let result = case.homogenize_to(tolerance)?;
            Ok(Found::new(&cells::json(case, &result), cells::text(case, &result)))
        }
        AnyCell::General(case) => {
            let result = at_temperature(case, temperature_c, tolerance)?;
            Ok(Found::new(&cells::general::json(&result), cells::general::text(&result, case)))
        }
    })
}

/// The winding, with its turn table.
#[pyfunction]
pub(crate) fn wind(coil: &Coil) -> Found {
    let case = &coil.case;
    let drawn = picture::svg(&case.name, &case.winding);
    Found::new(&turns::json(case), turns::text(case)).with_table(turns::turns(&case.winding)).with_picture(drawn)
}

/// The steady sensitivity, with the errors of its parts.
#[pyfunction]
pub(crate) fn sensitivity(py: Python, coil: &Coil) -> PyResult<Found> {
    watched(py, None, |_| {
        let case = &coil.case;
        let (result, band) = (case.steady_sensitivity()?, case.sensitivity_band()?);
        let (mut object, errors) = (ramp::json(case, &result, &band), result.part_errors);
        object["part_error_estimates"] =
            json!({"shupe": errors.shupe, "eo_axial": errors.eo_axial, "eo_radial": errors.eo_radial});
        Ok(Found::new(&object, ramp::text(case, &result, &band, false)).with_picture(figures::section(case)))
    })
}

/// Trimming, with the remaining sensitivity for each number of turns cut off.
#[pyfunction]
pub(crate) fn trim(py: Python, coil: &Coil, profile: Option<Columns>, between: &str) -> PyResult<Found> {
    let profile = profile.map(|columns| checked_profile(py, coil, columns, &[], between)).transpose()?;
    watched(py, None, |_| {
        let found = trimming::trim(&coil.case, profile.as_ref())?;
        let table = trimming::turns_cut_off(&found);
        Ok(Found::new(&trimming::json(&found), trimming::text(&coil.case, &found)).with_table(table))
    })
}

/// Two designs compared, under a profile if there is one.
#[pyfunction]
pub(crate) fn compare(
    py: Python,
    a: &Coil,
    b: &Coil,
    profile: Option<Columns>,
    between: &str,
    code: Option<PathBuf>,
) -> PyResult<Found> {
    let read = |columns: Columns| -> PyResult<[ProfileCase; 2]> {
        Ok([checked_profile(py, a, columns.clone(), &[], between)?, checked_profile(py, b, columns, &[], between)?])
    };
    let profiles = profile.map(read).transpose()?;
    watched(py, None, |tell| {
        let c = comparison::compare([&a.case, &b.case], profiles.as_ref(), &cache(code), tell)?;
        Ok(Found::new(&comparison::json(&c), comparison::text(&c)).with_page(comparison::report(&c)))
    })
}

/// The response to a profile, with its columns.
#[pyfunction]
pub(crate) fn simulate(
    py: Python,
    coil: &Coil,
    profile: Columns,
    between: &str,
    mechanisms: Vec<PathBuf>,
    code: Option<PathBuf>,
) -> PyResult<Found> {
    let own = input::read_simulated(&mechanisms).map_err(raised)?;
    let further = input::further_columns(&own);
    let (case, profile) = (&coil.case, checked_profile(py, coil, profile, &further, between)?);
    watched(py, None, |tell| {
        let cache = cache(code);
        let model = runs::model(case, &profile.drives, &cache)?;
        let mut simulation = runs::simulate(case, &profile, &model)?;
        simulation.add(&own, &cache, tell)?;
        let drawn = figures::documents(&simulation, None, &[]).into_iter().find(|(id, _)| *id == COURSE);
        let found = Found::new(&summary::json(&simulation), summary::text(&simulation));
        Ok(found.with_table(simulation.table()).with_picture(drawn.map(|(_, svg)| svg)))
    })
}

/// A design's model for all designs that differ from it within a box.
#[pyclass(frozen, module = "fogcoil")]
pub(crate) struct DesignBox(runs::DesignBox);

#[pymethods]
impl DesignBox {
    #[new]
    fn new(py: Python, coil: &Coil, code: Option<PathBuf>) -> PyResult<Self> {
        watched(py, None, |tell| runs::DesignBox::about(&coil.case, &cache(code), tell)).map(Self)
    }

    fn including(&self, py: Python, coil: &Coil) -> PyResult<Self> {
        watched(py, None, |_| self.0.including(&coil.case)).map(Self)
    }

    /// The columns of the result, and the estimated errors of thermometer and rate.
    fn simulate(&self, py: Python, coil: &Coil, profile: Columns, between: &str) -> PyResult<(Table, [f64; 2])> {
        let profile = checked_profile(py, coil, profile, &[], between)?;
        let varied = py.detach(|| self.0.simulate(&coil.case, &profile)).map_err(raised)?;
        Ok((runs::table(&varied.rows).into(), varied.errors))
    }
}

/// The changes of a design that would give a measured sensitivity.
#[pyfunction]
pub(crate) fn explain_sensitivity(
    py: Python,
    coil: &Coil,
    measured: f64,
    signed: bool,
    code: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Found> {
    watched(py, progress.as_ref(), |tell| {
        fogcoil::diagnose::check_design(&coil.case, &coil.case.file)?;
        let found = explaining::explain(&coil.case, measured, !signed, &cache(code), tell)?;
        Ok(Found::new(&explaining::json(&found), explaining::text(&coil.case, &found)))
    })
}

/// The meaning of an id; of all without one.
#[pyfunction]
pub(crate) fn explain_id(id: Option<&str>) -> PyResult<Found> {
    let Some(id) = id else { return Ok(Found::new(&glossary::list_json(), glossary::list())) };
    let entry = glossary::look_up(id).map_err(|near| {
        InputError::new_err(format!("{id}: is no id of a mechanism, a warning or a note; nearest: {}", near.join(", ")))
    })?;
    Ok(Found::new(&entry.json(), entry.text()))
}

/// The meaning of a mechanism of a user's own.
#[pyfunction]
pub(crate) fn explain_mechanism(source: &Bound<PyAny>) -> PyResult<Found> {
    let Text { path, text } = Text::new(source, None)?;
    let case = input::check_mechanism(&path, text).map_err(raised)?;
    Ok(Found::new(&glossary::own_json(&case), glossary::own_text(&case)))
}

/// A commented file to start from.
#[pyfunction]
pub(crate) fn template(kind: &str) -> PyResult<&'static str> {
    let found = templates::ALL.iter().find(|(name, _)| *name == kind).map(|(_, text)| *text);
    found.ok_or_else(|| {
        let kinds: Vec<&str> = templates::ALL.iter().map(|(name, _)| *name).collect();
        InputError::new_err(format!("kind: {kind:?} is not known; give one of {}", kinds.join(", ")))
    })
}

/// The user's cache for models that the library in the file `code` makes; none without it.
pub(crate) fn cache(code: Option<PathBuf>) -> Cache {
    code.map_or(Cache::NONE, |file| Cache::of_user().of_code_in(file))
}

fn checked_profile(py: Python, coil: &Coil, columns: Columns, further: &[String], between: &str) -> PyResult<ProfileCase> {
    let between = match between {
        "linear" => Between::Linear,
        "cubic" => Between::Cubic,
        other => return Err(InputError::new_err(format!("between: {other:?} is not known; give \"linear\" or \"cubic\""))),
    };
    let read = || input::check_profile("profile".as_ref(), input::Table::Columns(columns), &coil.case.design, further);
    let mut profile = py.detach(read).map_err(raised)?;
    profile.between = between;
    warn(py, profile.notes.clone())?;
    Ok(profile)
}
