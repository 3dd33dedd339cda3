//! Why a command did not finish.

use std::path::{Path, PathBuf};

use crate::input::InputError;

/// Errors of the program.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A case file cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The arguments contradict each other.
    #[error("{0}")]
    Usage(String),
    /// A result cannot be written.
    #[error("{}: cannot be written: {source}; give a path in a folder that exists and is writable", file.display())]
    Output {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Standard output cannot be written.
    #[error("standard output cannot be written: {0}")]
    Stdout(std::io::Error),
    /// A cell could not be solved.
    #[error("{}: {source}", file.display())]
    Homogenization {
        /// The cell file.
        file: PathBuf,
        /// What went wrong.
        source: homogenization::Error,
    },
    /// No cell of a kind could be solved.
    #[error("{}: a kind of cells has none that can be solved; check its ranges", file.display())]
    Identification {
        /// The file of targets.
        file: PathBuf,
    },
    /// A coil could not be solved.
    #[error("{}: {source}", file.display())]
    Coil {
        /// The coil file.
        file: PathBuf,
        /// What went wrong.
        source: coil::Error,
    },
    /// A diagnosis failed.
    #[error("the diagnosis failed: {0}")]
    Diagnosis(String),
    /// A simulation gave no number.
    #[error("{}: the response at {time} s is not a finite number; this is the program's fault, please report it", file.display())]
    NotFinite {
        /// The profile.
        file: PathBuf,
        /// The instant \[s\].
        time: f64,
    },
}

impl From<files::Error> for Error {
    fn from(error: files::Error) -> Self {
        match error {
            files::Error::Input(error) => Self::Input(error),
            files::Error::Usage(text) => Self::Usage(text),
            files::Error::Output { file, source } => Self::Output { file, source },
            files::Error::Homogenization { file, source } => Self::Homogenization { file, source },
            files::Error::Coil { file, source } => Self::Coil { file, source },
        }
    }
}

impl Error {
    /// What a model says, as an error of its coil's file or of what drives it.
    pub(crate) fn of_coil(file: &Path) -> impl Fn(coil::Error) -> Self + Copy {
        move |source| Self::Coil { file: file.to_owned(), source }
    }

    /// What a diagnosis says, as an error of the coil's file or of its own.
    pub(crate) fn of_diagnosis(file: &Path) -> impl Fn(diagnosis::Error<coil::Error>) -> Self + Copy {
        move |error| match error {
            diagnosis::Error::Model(source) => Self::of_coil(file)(source),
            other => Self::Diagnosis(other.to_string()),
        }
    }

    /// Exit status: 2 where the user can mend it (arguments, case files, paths), 1 where the program failed.
    pub fn exit_code(&self) -> u8 {
        use coil::Error::{Bias, Design, Profile, Record, Winding};
        match self {
            Self::Input(_) | Self::Usage(_) | Self::Output { .. } | Self::Identification { .. } => 2,
            Self::Homogenization { source: homogenization::Error::Accuracy { .. }, .. } => 2,
            Self::Coil { source: Design { .. } | Profile { .. } | Record(_) | Winding(_) | Bias(_), .. } => 2,
            Self::Stdout(_) | Self::Diagnosis(_) | Self::Homogenization { .. } | Self::Coil { .. } | Self::NotFinite { .. } => 1,
        }
    }
}
