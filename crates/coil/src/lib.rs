//! coil
mod design;
mod error;
mod grid;
mod layout;
mod model;
mod sensitivity;
mod thermal;

pub use design::{Body, Contact, Dehomogenization, Design, Flange, Sensor, Side, Solid, Spool, Surroundings};
pub use error::Error;
pub use grid::{Domain, Grid, Resolution};
pub use layout::{Layout, Rectangle, Region};
pub use model::{BiasOperator, Model, TurnStrain};
pub use sensitivity::{COARSE, FINE, SAFETY, SteadySensitivity, steady_sensitivity};
pub use thermal::{RampLag, ramp_lag};
