//! Designs within a box about a drawing, each in a moment.

use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Drive, Dynamics, MODEL_SAFETY, ParametricModel};
use progress::Step;

use super::rows::SimulatedRow;
use super::run::{course, run};
use crate::Error;
use crate::cache::Cache;
use crate::input::{CoilCase, ProfileCase};

/// A design's model for all designs that differ from it within a box of their constants and dimensions.
#[derive(Debug, Clone)]
pub struct DesignBox {
    model: ParametricModel,
}

/// Response of a design of a [`DesignBox`] to a profile.
#[derive(Debug, Clone)]
pub struct Varied {
    /// Rows of the result.
    pub rows: Vec<SimulatedRow>,
    /// Estimates, not bounds, of how far thermometer \[K\] and rate \[deg/h\] are anywhere from those of [`super::simulate`], which has the same mesh.
    pub errors: [f64; 2],
}

impl DesignBox {
    /// Three standard deviations of the tolerances of `case` to either side, and mounts, contacts and heaters as far as mechanisms go; from the
    /// cache if it is there. `progress` is told how far it is.
    ///
    /// # Errors
    /// [`files::Error::Coil`] if the design cannot be modelled.
    pub fn about(case: &CoilCase, cache: &Cache, progress: &(dyn Fn(Step) + Sync)) -> Result<Self, Error> {
        let all = Self { model: crate::prepare::models(case, cache, progress)?.parametric().clone() };
        // a heater of its own is no part of what a diagnosis needs
        if all.model.outside(&case.design).is_some() { all.including(case) } else { Ok(all) }
    }

    /// The box made anew, so wide that it holds `case`, too.
    ///
    /// # Errors
    /// As [`Self::about`].
    pub fn including(&self, case: &CoilCase) -> Result<Self, Error> {
        Ok(Self { model: self.model.including(&case.design, &|| ()).map_err(Error::of_coil(&case.file))? })
    }

    /// Runs a profile from rest at its first instant.
    ///
    /// # Errors
    /// As [`super::simulate`], and [`files::Error::Coil`] if the design lies outside the box or cannot be reached.
    pub fn simulate(&self, case: &CoilCase, profile: &ProfileCase) -> Result<Varied, Error> {
        if let Some(drive) = profile.drives.iter().find(|drive| !matches!(drive, Drive::Chamber | Drive::Heaters)) {
            return Err(Error::usage(format!(
                "a box of designs is driven by its chamber alone; leave out {drive:?} of the profile"
            )));
        }
        let [dynamics, coarser @ ..] = Dynamics::varied(&self.model, &case.design).map_err(Error::of_coil(&case.file))?;
        let rows = run(&dynamics, profile)?.into_iter().enumerate().map(|(n, r)| SimulatedRow::of(profile, n, r)).collect();
        let at = Error::of_coil(&profile.fingerprint.file);
        let [spool, rate] = dynamics.distance(&coarser, &course(profile)).map_err(at)?;
        if !(spool.is_finite() && rate.is_finite()) {
            return Err(Error::NotFinite { file: profile.fingerprint.file.clone(), time: profile.profile.time[0] });
        }
        Ok(Varied { rows, errors: [MODEL_SAFETY * spool, MODEL_SAFETY * DEG_PER_H_PER_RAD_PER_S * rate] })
    }
}
