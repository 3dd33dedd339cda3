//! Heat flow in coil, spool and medium: matrices, drives, transients and reduced models.

mod drive;
mod full;
mod lag;
mod modal;
mod model;
mod outputs;
mod reduced;
mod state;
mod steps;

pub use drive::Drive;
pub use full::FullRun;
pub use lag::{RampLag, ramp_lag};
pub use model::ThermalModel;
pub(crate) use model::{Shifted, properties};
pub use outputs::{Output, Outputs};
pub use reduced::{Reduced, Reduction};
pub(crate) use state::dot;
pub use state::{Step, ThermalState};
pub use steps::Steps;
