//! Models of a coil for the drives of a profile, built once.

use coil::{CHECKS, COARSER, Drive, Dynamics, STANDARD, STEADY, SteadySensitivity, TurnFields};
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

/// Models a coil for the drives of a profile, or finds its model in `cache`.
///
/// # Errors
/// [`files::Error::Coil`] if the coil cannot be solved.
pub fn model(case: &CoilCase, drives: &[Drive], cache: &Cache) -> Result<Model, Error> {
    let (dynamics, source) = load_or_build(case, drives, cache, "dynamics", || Dynamics::new(&case.design, drives, &STANDARD))?;
    assembled(case, drives, cache, dynamics, source)
}

/// As [`model`], with temperature and strain of every turn for [`crate::figures`]; those take 1 kB a turn and drive.
///
/// # Errors
/// As [`model`].
pub fn model_with_fields(case: &CoilCase, drives: &[Drive], cache: &Cache) -> Result<(Model, TurnFields), Error> {
    let build = || Dynamics::with_fields(&case.design, drives, &STANDARD);
    let ((dynamics, fields), source) = load_or_build(case, drives, cache, "dynamics and fields", build)?;
    Ok((assembled(case, drives, cache, dynamics, source)?, fields))
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
