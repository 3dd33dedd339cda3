//! Errors of a command.

use coil::{Design, Spool};
use mechanisms::Mechanism;
use std::path::{Path, PathBuf};

use crate::input::{self, InputError};

/// Errors of the program.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file cannot be used, solved or written, or the request contradicts itself or a file.
    #[error(transparent)]
    File(files::Error),
    /// Standard output cannot be written.
    #[error("standard output cannot be written: {0}")]
    Stdout(std::io::Error),
    /// No cell of a kind could be solved.
    #[error("{}: a kind of cells has none that can be solved; check its ranges", files::shown_path(file))]
    Identification {
        /// The file of targets.
        file: PathBuf,
    },
    /// A table cannot be written in the format that was asked for.
    #[error("the table cannot be written: {0}")]
    Table(String),
    /// Units of a batch have not passed.
    #[error("{}", not_passed(*failing, *not_known, *units))]
    Limits {
        /// Number of units that fail a limit.
        failing: usize,
        /// Number of units of which it is not known whether they keep the limits.
        not_known: usize,
        /// Number of all units.
        units: usize,
    },
    /// A diagnosis failed.
    #[error("the diagnosis failed: {0}")]
    Diagnosis(String),
    /// A simulation gave no number.
    #[error("{}: the response at {} s is not a finite number; this is the program's fault, please report it", files::shown_path(file), recording::Seconds(*time))]
    NotFinite {
        /// The profile.
        file: PathBuf,
        /// The instant \[s\].
        time: f64,
    },
}

/// Film \[W/(m² K)\] that hardly lets heat through.
const FAINT_FILM: f64 = 1e-3;
/// Distance of Poisson's ratio from 1/2, at which a solid is incompressible.
const INCOMPRESSIBLE: f64 = 1e-7;
/// Modulus of the spool beside the coil's across the fibre.
const SOFT: f64 = 1e-6;
/// Overhang of a flange beside the coil's radius.
const WIDE: f64 = 10.0;
/// Radius beside the hub's thickness.
const SLENDER: f64 = 1e4;

/// The number of a design, and how to mend it, that most likely keeps its equations from being solved, if one stands out.
fn outlier(design: &Design, part: &str) -> Option<(String, &'static str)> {
    if part == "chamber" {
        let faint = design.heat.film.is_some_and(|film| film < FAINT_FILM);
        return faint.then(|| ("heat.film_w_per_m2k".into(), "give the film's conductance in W/(m2 K), e.g. Some(10.0)"));
    }
    let Spool { material, hub_thickness, flanges, .. } = design.spool.as_ref()?;
    let wide = flanges.iter().position(|flange| flange.overhang > WIDE * design.body.outer_radius);
    if material.elastic.poisson_ratio > 0.5 - INCOMPRESSIBLE {
        Some(("spool.material.poisson_ratio".into(), "give the measured value, e.g. 0.33; of a solid it is clearly below 0.5"))
    } else if material.elastic.youngs_modulus < SOFT * design.body.elastic.e_r {
        Some(("spool.material.youngs_modulus_gpa".into(), "give the modulus in GPa, e.g. 68.9, or leave the spool out (None)"))
    } else if let Some(flange) = wide {
        Some((format!("spool.flanges[{flange}].overhang_mm"), "give the overhang beyond the coil in mm, e.g. 1.0"))
    } else if design.winding.inner_radius > SLENDER * hub_thickness {
        Some(("winding.inner_radius_mm".into(), "give the radius in mm, e.g. 43.5, and check spool.hub_thickness_mm"))
    } else {
        None
    }
}

/// Error of a design whose equations no factorisation solves: its numbers are too far apart.
fn unsolvable(file: &Path, part: &str) -> InputError {
    const FAR: &str = "too far apart to be solved in double precision";
    if let Some((field, remedy)) = input::read_coil(file).ok().and_then(|case| outlier(&case.design, part)) {
        return input::fault_in(file, &field, format!("this and the design's other numbers are {FAR}"), remedy.to_owned());
    }
    let (field, numbers) = match part {
        "chamber" => ("heat", "heat.film_w_per_m2k, heat.mounts, conductivities, and thicknesses"),
        "coil" => ("coil", "coil.material"),
        _ => ("spool", "the stiffness of spool.material beside coil.material, thicknesses, and spool.flanges.overhang_mm"),
    };
    let problem = format!("the design's numbers are {FAR}");
    let remedy = format!("check {numbers}");
    input::fault_in(file, field, problem, remedy)
}

impl From<files::Error> for Error {
    fn from(error: files::Error) -> Self {
        use coil::Error::Solve;
        use fem_core::Error::{Mesh, NotPositiveDefinite, Residual, Step};
        match error {
            files::Error::Coil {
                file,
                source: Solve { part, source: Mesh(_) | NotPositiveDefinite { .. } | Residual { .. } | Step { .. } },
            } => unsolvable(&file, part).into(),
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
    /// A contradictory request.
    pub fn usage(problem: impl Into<String>) -> Self {
        Self::File(files::Error::Usage(problem.into()))
    }

    /// A model's error as an error of its coil's file or of its drive.
    pub(crate) fn of_coil(file: &Path) -> impl Fn(coil::Error) -> Self + Copy {
        move |source| files::Error::Coil { file: file.to_owned(), source }.into()
    }

    /// A diagnosis's error as an error of the coil's file or of its own.
    pub(crate) fn of_diagnosis(file: &Path) -> impl Fn(diagnosis::Error) -> Self + Copy {
        move |error| match error {
            diagnosis::Error::Model(source) => match source.downcast::<coil::Error>() {
                Ok(source) => Self::of_coil(file)(*source),
                Err(other) => Self::Diagnosis(other.to_string()),
            },
            other => Self::Diagnosis(other.to_string()),
        }
    }

    /// The same for a diagnosis with mechanisms of a user's own, whose laws may give no number somewhere.
    pub(crate) fn of_diagnosis_with(file: &Path, mechanisms: &[&dyn Mechanism]) -> impl Fn(diagnosis::Error) -> Self + Clone {
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
        use homogenization::Error::{Accuracy, Tolerance};
        match self {
            Self::File(Homogenization { source: Accuracy { .. } | Tolerance(_), .. }) => 2,
            Self::File(Coil { source: Design { .. } | Profile { .. } | Record(_) | Winding(_) | Bias(_), .. }) => 2,
            Self::File(Homogenization { .. } | Coil { .. }) => 1,
            Self::File(_) | Self::Identification { .. } => 2,
            Self::Stdout(_) | Self::Limits { .. } | Self::Table(_) | Self::Diagnosis(_) | Self::NotFinite { .. } => 1,
        }
    }
}

/// Units that have not passed, in words.
fn not_passed(failing: usize, not_known: usize, units: usize) -> String {
    let does = if failing == 1 { "does" } else { "do" };
    let fails = (failing > 0).then(|| format!("{failing} of {units} units {does} not keep the limits"));
    let (are, they_have) = if not_known == 1 { ("is", "it has") } else { ("are", "they have") };
    let unknown = || {
        format!("{not_known} of {units} units {are} not known to keep the limits: {they_have} not passed; see the column reason")
    };
    fails.into_iter().chain((not_known > 0).then(unknown)).collect::<Vec<_>>().join("; ")
}
