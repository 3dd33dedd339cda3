//! Errors of reading and writing files.

use std::path::PathBuf;

use crate::input::InputError;
use crate::shown_path;

/// Errors of reading and writing. Complete on purpose: a program gives each its exit status.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The request contradicts itself or the file.
    #[error("{0}")]
    Usage(String),
    /// A result cannot be written.
    #[error("{}: cannot be written: {source}; give a path in a folder that exists and is writable", shown_path(file))]
    Output {
        /// The file.
        file: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// A cell could not be solved.
    #[error("{}: {source}", shown_path(file))]
    Homogenization {
        /// The cell file.
        file: PathBuf,
        /// The fault.
        source: homogenization::Error,
    },
    /// A coil could not be solved.
    #[error("{}: {source}", shown_path(file))]
    Coil {
        /// The coil file.
        file: PathBuf,
        /// The fault.
        source: coil::Error,
    },
}
