//! Many designs, and constituents, from files of plans and targets.

use std::path::{Path, PathBuf};

use fogcoil::input;
use fogcoil::{identify as identifying, optimise as optimising, sweep as sweeping};
use pyo3::prelude::*;

use crate::case::{Coil, Text};
use crate::error::{raised, warn};
use crate::found::Found;
use crate::watched::watched;

#[pyfunction]
pub(crate) fn identify(
    py: Python,
    targets: &Bound<PyAny>,
    folder: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Found> {
    let Text { path, text } = Text::new(targets, folder)?;
    let case = input::check_targets(&path, &text).map_err(raised)?;
    watched(py, progress.as_ref(), |tell| {
        let found = identifying::identify(&case, tell)?;
        Ok(Found::new(&identifying::json(&case, &found), identifying::text(&case, &found)))
    })
}

/// A sweep, with a row for each design.
#[pyfunction]
pub(crate) fn sweep(
    py: Python,
    plan: &Bound<PyAny>,
    folder: Option<PathBuf>,
    code: PathBuf,
    progress: Option<Py<PyAny>>,
) -> PyResult<Found> {
    let Text { path, text } = Text::new(plan, folder)?;
    let plan = py.detach(|| sweeping::check_plan(&path, &text)).map_err(raised)?.of_code_in(code);
    warn(py, plan.variants.case.warnings.clone())?;
    watched(py, progress.as_ref(), |tell| {
        let rows = sweeping::run(&plan, sweeping::Share::WHOLE, None, tell)?;
        let summary = sweeping::Summary::of(&plan, &rows)?;
        let found = Found::new(&sweeping::json(&plan, &summary), sweeping::text(&plan, &summary));
        Ok(found.with_table(sweeping::table(&plan, &rows)).with_page(sweeping::report(&plan, &summary, &rows)))
    })
}

/// An optimisation, with a row for each design that was tried; and the optimum, where there is one.
#[pyfunction]
pub(crate) fn optimise(
    py: Python,
    plan: &Bound<PyAny>,
    folder: Option<PathBuf>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Found, Option<Coil>)> {
    let Text { path, text } = Text::new(plan, folder)?;
    let plan = py.detach(|| optimising::check_plan(&path, &text)).map_err(raised)?;
    warn(py, plan.variants.case.warnings.clone())?;
    let (found, best) = watched(py, progress.as_ref(), |tell| {
        let found = optimising::search(&plan, tell)?;
        let best = optimising::front(&found.all, &plan.minimise);
        let checked = best.first().map(|n| optimising::check(&plan, &found.all[*n])).transpose()?;
        let told =
            Found::new(&optimising::json(&plan, &found, checked.as_ref()), optimising::text(&plan, &found, checked.as_ref()));
        let told =
            told.with_table(optimising::table(&plan, &found)).with_page(optimising::report(&plan, &found, checked.as_ref()));
        Ok((told, checked.map(|checked| checked.file(&plan, &found.drawn))))
    })?;
    let drawing: &Path = &plan.variants.case.file;
    Ok((found, best.map(|text| Coil::beside(py, drawing, text)).transpose()?))
}
