//! Heat flow in coil, spool and medium: matrices, drives, transients and reduced models.

mod drive;
mod full;
mod lag;
mod modal;
mod model;
mod reduced;

pub use drive::Drive;
pub use full::FullRun;
pub use lag::{RampLag, ramp_lag};
pub use modal::Interval;
pub use model::ThermalModel;
pub use reduced::{Reduced, ReducedOutput, Reduction};
