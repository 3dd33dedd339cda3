//! Why a command did not finish.

use mechanisms::Mechanism;
use std::path::{Path, PathBuf};

use crate::input::{self, InputError};

/// Errors of the program.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file cannot be used, solved or written, or what was asked for contradicts itself or a file.
    #[error(transparent)]
    File(files::Error),
    /// Standard output cannot be written.
    #[error("standard output cannot be written: {0}")]
    Stdout(std::io::Error),
    /// No cell of a kind could be solved.
    #[error("{}: a kind of cells has none that can be solved; check its ranges", file.display())]
    Identification {
        /// The file of targets.
        file: PathBuf,
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

/// What to say of a design whose equations no factorisation solves: its numbers are too far apart.
fn unsolvable(file: &Path, part: &str) -> InputError {
    let (field, numbers) = match part {
        "chamber" => ("heat", "heat.film_w_per_m2k, heat.mounts, conductivities, and thicknesses"),
        "coil" => ("coil", "coil.material"),
        _ => ("spool", "the stiffness of spool.material beside coil.material, thicknesses, and spool.flanges.overhang_mm"),
    };
    let problem = "the design's numbers are too far apart to be solved in double precision".to_owned();
    let remedy = format!("check {numbers}");
    input::fault_in(file, field, problem, remedy)
}

impl From<files::Error> for Error {
    fn from(error: files::Error) -> Self {
        use coil::Error::Solve;
        use fem_core::Error::NotPositiveDefinite;
        match error {
            files::Error::Coil { file, source: Solve { part, source: NotPositiveDefinite { .. } } } => {
                unsolvable(&file, part).into()
            }
            other => Self::File(other),
        }
    }
}

impl From<InputError> for Error {
    fn from(error: InputError) -> Self {
        Self::File(error.into())
    }
}

impl Error {
    /// What was asked for contradicts itself.
    pub fn usage(problem: impl Into<String>) -> Self {
        Self::File(files::Error::Usage(problem.into()))
    }

    /// What a model says, as an error of its coil's file or of what drives it.
    pub(crate) fn of_coil(file: &Path) -> impl Fn(coil::Error) -> Self + Copy {
        move |source| files::Error::Coil { file: file.to_owned(), source }.into()
    }

    /// What a diagnosis says, as an error of the coil's file or of its own.
    pub(crate) fn of_diagnosis(file: &Path) -> impl Fn(diagnosis::Error<coil::Error>) -> Self + Copy {
        move |error| match error {
            diagnosis::Error::Model(source) => Self::of_coil(file)(source),
            other => Self::Diagnosis(other.to_string()),
        }
    }

    /// The same of a diagnosis with mechanisms of a user's own: a law of theirs may be no number somewhere.
    pub(crate) fn of_diagnosis_with(
        file: &Path,
        mechanisms: &[&dyn Mechanism],
    ) -> impl Fn(diagnosis::Error<coil::Error>) -> Self + Clone {
        let own: Vec<String> =
            mechanisms.iter().map(|m| m.facts().id.to_owned()).filter(|id| mechanisms::find(id).is_none()).collect();
        let file = file.to_owned();
        move |error| match error {
            diagnosis::Error::NotFinite if !own.is_empty() => Self::usage(format!(
                "--mechanism: a law of {} is no finite number somewhere within its priors; bound it, e.g. by max(...), or narrow the priors",
                own.join(", ")
            )),
            other => Self::of_diagnosis(&file)(other),
        }
    }

    /// Exit status: 2 where the user can mend it (arguments, case files, paths), 1 where the program failed.
    pub fn exit_code(&self) -> u8 {
        use coil::Error::{Bias, Design, Profile, Record, Winding};
        use files::Error::{Coil, Homogenization};
        match self {
            Self::File(Homogenization { source: homogenization::Error::Accuracy { .. }, .. }) => 2,
            Self::File(Coil { source: Design { .. } | Profile { .. } | Record(_) | Winding(_) | Bias(_), .. }) => 2,
            Self::File(Homogenization { .. } | Coil { .. }) => 1,
            Self::File(_) | Self::Identification { .. } => 2,
            Self::Stdout(_) | Self::Diagnosis(_) | Self::NotFinite { .. } => 1,
        }
    }
}
