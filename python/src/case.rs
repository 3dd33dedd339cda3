//! Designs of coils and cells as Python's objects: a text that was checked, with what it describes.

use std::path::{Path, PathBuf};

use fogcoil::glossary::Note;
use fogcoil::input::{self, AnyCell, CoilCase};
use pyo3::prelude::*;
use pyo3::types::{PyMapping, PyString};

use crate::error::{InputError, UNSAVED, called, raised, warn};

/// A text with the path that messages call it and that its own paths are relative to.
#[derive(Clone)]
pub(crate) struct Text {
    pub(crate) path: PathBuf,
    pub(crate) text: String,
}

/// Suffix of the name of a file whose values were replaced.
const ALTERED: &str = " (altered)";

impl Text {
    /// A path, or a RON text: what starts with a bracket or has more than one line.
    pub(crate) fn new(source: &Bound<PyAny>, folder: Option<PathBuf>) -> PyResult<Self> {
        if let Ok(text) = source.cast::<PyString>() {
            let text: String = text.extract()?;
            if text.trim_start().starts_with('(') || text.contains('\n') {
                return Ok(Self { path: folder.unwrap_or_default().join(UNSAVED), text });
            }
        }
        let path: PathBuf = source.extract()?;
        if folder.is_some() {
            let message = format!("{}: a folder goes with a text, a file has its own; leave folder out", path.display());
            return Err(InputError::new_err(message));
        }
        Ok(Self { text: input::read_text(&path).map_err(raised)?, path })
    }

    fn get<'py>(&self, py: Python<'py>, field: &str) -> PyResult<Bound<'py, PyAny>> {
        let text = input::field_text(&self.path, &self.text, field).map_err(raised)?;
        Ok(match (text, text.parse::<i64>(), text.parse::<f64>()) {
            ("true" | "false", ..) => (text == "true").into_pyobject(py)?.to_owned().into_any(),
            (_, Ok(integer), _) => integer.into_pyobject(py)?.into_any(),
            (_, _, Ok(number)) => number.into_pyobject(py)?.into_any(),
            _ => text.into_pyobject(py)?.into_any(),
        })
    }

    fn replace(&self, changes: &Bound<PyMapping>) -> PyResult<Self> {
        let mut values = Vec::new();
        for item in changes.items()? {
            let (field, value): (String, Bound<PyAny>) = item.extract()?;
            values.push((field, ron(&value)?));
        }
        let text = input::with_fields(&self.path, &self.text, &values).map_err(raised)?;
        let mut name = self.path.file_name().unwrap_or_default().to_os_string();
        if name != UNSAVED && !name.to_string_lossy().ends_with(ALTERED) {
            name.push(ALTERED);
        }
        Ok(Self { path: self.path.with_file_name(name), text })
    }

    fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }
}

/// A value as RON: a number, a boolean, or a text that is RON already.
fn ron(value: &Bound<PyAny>) -> PyResult<String> {
    if let Ok(text) = value.cast::<PyString>() {
        return text.extract();
    }
    if let Ok(boolean) = value.extract::<bool>() {
        return Ok(boolean.to_string());
    }
    if let Ok(integer) = value.extract::<i64>() {
        return Ok(integer.to_string());
    }
    match value.extract::<f64>() {
        Ok(number) => Ok(format!("{number:?}")),
        Err(_) => Err(InputError::new_err(format!("{value} is no value; give a number, a boolean or RON text such as \"Left\""))),
    }
}

/// A coil file that was checked. Immutable.
#[pyclass(frozen, module = "fogcoil")]
pub(crate) struct Coil {
    text: Text,
    pub(crate) case: CoilCase,
}

impl Coil {
    fn checked(py: Python, text: Text) -> PyResult<Self> {
        let case = py.detach(|| input::check_coil(&text.path, &text.text)).map_err(raised)?;
        Ok(Self { text, case })
    }

    fn of(py: Python, text: Text) -> PyResult<Self> {
        let coil = Self::checked(py, text)?;
        warn(py, coil.case.warnings.iter().map(|warning| warning.clone().at(called(&coil.text.path))))?;
        Ok(coil)
    }

    /// The design that was found, beside the one that it was made from, of which the user has been warned already.
    pub(crate) fn beside(py: Python, other: &Path, text: String) -> PyResult<Self> {
        Self::checked(py, Text { path: other.with_file_name(UNSAVED), text })
    }
}

#[pymethods]
impl Coil {
    #[new]
    #[pyo3(signature = (source, folder=None))]
    fn new(py: Python, source: &Bound<PyAny>, folder: Option<PathBuf>) -> PyResult<Self> {
        Self::of(py, Text::new(source, folder)?)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.case.name
    }

    #[getter]
    fn text(&self) -> &str {
        &self.text.text
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.case.warnings.iter().map(Note::message).collect()
    }

    fn __getitem__<'py>(&self, py: Python<'py>, field: &str) -> PyResult<Bound<'py, PyAny>> {
        self.text.get(py, field)
    }

    /// The design with other values, `{"spool.hub_thickness_mm": 3.0}`; all are put in before it is checked.
    ///
    /// Values are numbers, booleans, or a string of RON: `{"winding.cw_climbs": "Left", "name": '"thin hub"'}`. A field that may be left
    /// out, and is, is added. Raises InputError.
    fn replace(&self, py: Python, changes: &Bound<PyMapping>) -> PyResult<Self> {
        Self::of(py, self.text.replace(changes)?)
    }

    fn __repr__(&self) -> String {
        format!("<Coil {:?} from {}>", self.case.name, called(&self.text.path).display())
    }

    fn __getnewargs__(&self) -> (&str, &Path) {
        (&self.text.text, self.text.folder())
    }
}

/// A cell file that was checked. Immutable.
#[pyclass(frozen, module = "fogcoil")]
pub(crate) struct Cell {
    text: Text,
    pub(crate) case: AnyCell,
}

impl Cell {
    fn of(text: Text) -> PyResult<Self> {
        let case = input::check_any_cell(&text.path, &text.text).map_err(raised)?;
        Ok(Self { text, case })
    }
}

#[pymethods]
impl Cell {
    #[new]
    #[pyo3(signature = (source, folder=None))]
    fn new(source: &Bound<PyAny>, folder: Option<PathBuf>) -> PyResult<Self> {
        Self::of(Text::new(source, folder)?)
    }

    #[getter]
    fn name(&self) -> &str {
        match &self.case {
            AnyCell::Regular(case, _) => &case.name,
            AnyCell::General(case) => &case.name,
        }
    }

    #[getter]
    fn text(&self) -> &str {
        &self.text.text
    }

    fn __getitem__<'py>(&self, py: Python<'py>, field: &str) -> PyResult<Bound<'py, PyAny>> {
        self.text.get(py, field)
    }

    /// The cell with other values, `{"pitch_um": 172.0}`; all are put in before it is checked. As `Coil.replace`.
    fn replace(&self, changes: &Bound<PyMapping>) -> PyResult<Self> {
        Self::of(self.text.replace(changes)?)
    }

    fn __repr__(&self) -> String {
        format!("<Cell {:?} from {}>", self.name(), called(&self.text.path).display())
    }

    fn __getnewargs__(&self) -> (&str, &Path) {
        (&self.text.text, self.text.folder())
    }
}
