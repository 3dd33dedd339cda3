//! What the nominal model of a fibre-optic-gyroscope coil may leave out, each at its physical place.
//!
//! [`Library`] holds reduced models of a design at chosen values of every mechanism's parameters; [`Prepared`] runs them under the
//! chamber of one recording; [`Gyro`] interpolates between them and is the forward model that [`diagnosis`] fits.

mod build;
mod catalogue;
mod constants;
mod design;
mod gyro;
mod instruments;
mod interpolation;
mod latent;
mod law_tools;
mod library;
mod mechanism;
mod passed;
mod record_to_bias;

pub use build::ranges;
pub use catalogue::{CATALOGUE, find};
pub use constants::{number_of, with_constant};
pub use design::REFERENCE_C;
pub use gyro::{Gyro, RATE, SPOOL};
pub use instruments::{USUAL_NOISE, reading_of};
pub use law_tools::Chain;
pub use library::{Library, Models};
pub use mechanism::{
    Change, Digits, Effect, Extent, Facts, HeatPath, Mechanism, Naming, Offer, Readings, Scene, Sight, Stage, Steady, lagged,
    middles, rates_per_hour,
};
pub use record_to_bias::{Delay, Parts, Prepared};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
