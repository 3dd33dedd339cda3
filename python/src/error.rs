//! Errors and warnings as Python's.

use std::ffi::CString;
use std::path::Path;

use fogcoil::glossary::Note;
use fogcoil::{Error, FileError, input};
use pyo3::exceptions::{PyRuntimeError, PyUserWarning, PyValueError};
use pyo3::{PyErr, PyResult, Python, create_exception};

create_exception!(
    fogcoil,
    InputError,
    PyValueError,
    "An input that cannot be used: what is wrong, where (file:line: field), and how to mend it."
);

/// Name of a text that is not the content of a file, in the folder to which its own paths are relative.
pub(crate) const UNSAVED: &str = "the text";

/// Name of a path in messages: a text is in no folder.
pub(crate) fn called(path: &Path) -> &Path {
    if path.file_name().is_some_and(|name| name == UNSAVED) { Path::new(UNSAVED) } else { path }
}

/// `InputError` where the user can mend it, else `RuntimeError`; the message is the program's.
pub(crate) fn raised(error: impl Into<Error>) -> PyErr {
    let error = error.into();
    let error = match error {
        Error::File(FileError::Input(at)) => input::InputError { file: called(&at.file).to_owned(), ..at }.into(),
        Error::File(FileError::Coil { file, source }) => FileError::Coil { file: called(&file).to_owned(), source }.into(),
        Error::File(FileError::Homogenization { file, source }) => {
            FileError::Homogenization { file: called(&file).to_owned(), source }.into()
        }
        other => other,
    };
    match error.exit_code() {
        2 => InputError::new_err(error.to_string()),
        _ => PyRuntimeError::new_err(error.to_string()),
    }
}

/// Warns of what is allowed but looks like a mistake.
pub(crate) fn warn(py: Python, all: impl IntoIterator<Item = Note>) -> PyResult<()> {
    let category = py.get_type::<PyUserWarning>();
    all.into_iter().try_for_each(|warning| {
        let message = warning.message().replace('\0', "");
        PyErr::warn(py, &category, &CString::new(message)?, 1)
    })
}
