//! Mechanisms that the nominal model of a fibre-optic-gyroscope coil leaves out, each at its physical place.
//!
//! [`Library`] holds reduced models of a design at chosen values of every mechanism's parameters; [`Prepared`] runs them under the
//! chamber of one recording; [`Gyro`] interpolates between them and is the forward model that [`diagnosis`] fits.

mod bond;
mod build;
mod catalogue;
mod chamber;
mod change;
mod constants;
mod course;
mod curvature;
mod design;
mod gyro;
mod heat_path;
mod heater;
mod instruments;
mod interpolation;
mod latent;
mod law_tools;
mod library;
mod mechanism;
mod passed;
mod record_to_bias;
mod series;
mod written;

pub use build::ranges;
pub use catalogue::{CATALOGUE, ON_REQUEST, find, usual_coefficient};
pub use chamber::Chamber;
pub use change::{Change, Per, Threshold};
pub use constants::{number_of, with_constant};
pub use course::{Delay, Parts, RATE, SPOOL};
pub use design::REFERENCE_C;
pub use gyro::{Gyro, InFull};
pub use heat_path::{AtWork, HeatPath};
pub use instruments::{Instrument, Instruments, USUAL_NOISE, reading_of};
pub use law_tools::Chain;
pub use library::{Library, Models};
pub use mechanism::{Digits, Effect, Extent, Facts, Mechanism, Naming, Offer, Readings, Scene, Sight, Stage, Steady};
pub use record_to_bias::{Prepared, thermometer_under};
pub use series::{lagged, middles, rates_per_hour};
pub use written::{Body, INPUTS, Input, Target, Written};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
