//! What the nominal model of a fibre-optic-gyroscope coil may leave out, each at its physical place.
//!
//! [`Library`] holds reduced models of a design at chosen values of every mechanism's parameters; [`Prepared`] runs them under the
//! chamber of one recording; [`Gyro`] interpolates between them and is the forward model that [`diagnosis`] fits.

mod beyond;
mod catalogue;
mod change;
mod gyro;
mod interpolation;
mod latent;
mod laws;
mod library;
mod nuisances;
mod record;

pub use change::{
    POLYMER_FRACTION, with_air, with_glass_transition, with_heater, with_hub_resistance, with_mount, with_opening, with_polymer,
    with_relaxation, with_tail,
};
pub use gyro::{Gyro, Located, RATE, REFERENCE_C, SPOOL};
pub use library::Library;
pub use record::Prepared;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
