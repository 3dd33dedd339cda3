//! Models of a coil for the drives of a profile, built once.

use coil::{CHECKS, COARSER, Drive, Dynamics, STANDARD, STEADY, SectionFields, SteadySensitivity, TurnFields};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Error;
use crate::cache::{Cache, Source};
use crate::input::CoilCase;

/// A coil modelled for the drives of a profile.
#[derive(Debug, Clone)]
pub struct Model {
    pub(super) dynamics: Dynamics,
    /// The same coil on a coarser mesh.
    pub(super) coarser: Dynamics,
    pub(super) steady: SteadySensitivity,
    pub(super) source: Source,
}

/// Fields of a modelled coil, for any of its states.
#[derive(Debug, Clone)]
pub struct Fields {
    /// Temperature and strain of the glass at every turn.
    pub turns: TurnFields,
    /// Temperature and displacement everywhere in coil and spool.
    pub section: SectionFields,
}

/// Models a coil for the drives of a profile, or finds its model in `cache`.
///
/// # Errors
/// [`files::Error::Coil`] if the coil cannot be solved.
pub fn model(case: &CoilCase, drives: &[Drive], cache: &Cache) -> Result<Model, Error> {
    let (dynamics, source) = load_or_build(case, drives, cache, "dynamics", || Dynamics::new(&case.design, drives, &STANDARD))?;
    assembled(case, drives, cache, dynamics, source)
}

/// As [`model`], with the fields of turns and section for [`crate::figures`] and [`crate::section_files`]; those take 1 kB a turn and drive.
///
/// # Errors
/// As [`model`].
pub fn model_with_fields(case: &CoilCase, drives: &[Drive], cache: &Cache) -> Result<(Model, Fields), Error> {
    let build = || Dynamics::with_section(&case.design, drives, &STANDARD);
    let ((dynamics, turns, section), source) = load_or_build(case, drives, cache, "dynamics, turns and section", build)?;
    Ok((assembled(case, drives, cache, dynamics, source)?, Fields { turns, section }))
}

fn load_or_build<T: Serialize + DeserializeOwned>(
    case: &CoilCase,
    drives: &[Drive],
    cache: &Cache,
    purpose: &str,
    build: impl FnOnce() -> Result<T, coil::Error>,
) -> Result<(T, Source), Error> {
    let at = Error::of_coil(&case.file);
    cache.load_or_build(purpose, &(&case.design, drives, STANDARD, COARSER), || build().map_err(at))
}

fn assembled(case: &CoilCase, drives: &[Drive], cache: &Cache, dynamics: Dynamics, source: Source) -> Result<Model, Error> {
    let (coarser, _) = load_or_build(case, drives, cache, "coarser dynamics", || Dynamics::new(&case.design, drives, &COARSER))?;
    let key = (&case.design, STEADY, CHECKS);
    let (steady, of_steady) = cache.load_or_build("steady sensitivity", &key, || case.steady_sensitivity())?;
    Ok(Model { dynamics, coarser, steady, source: if of_steady == source { source } else { Source::Built } })
}
