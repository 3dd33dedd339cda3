//! When a simulation and a recording differ: locate the mismatch, name what was left out, prove it on a held-out recording.
//!
//! Knows nothing of what is modelled: a [`ForwardModel`] gives channels, uncertain constants, a library of mechanisms, and responses.

mod diagnose;
mod discriminate;
mod error;
mod fit;
mod flexible;
mod hold_out;
mod judged;
mod latent;
mod locate;
mod marginal;
mod model;
mod noise;
mod parameter;
mod posterior;
mod verdict;

pub use diagnose::{Candidate, Settings, diagnose};
pub use discriminate::{Plan, Separation, alternatives, fitted, separation};
pub use error::Error;
pub use fit::{Estimate, Fit, Hypothesis};
pub use flexible::{Rival, Structure};
pub use hold_out::{HeldOut, as_designed};
pub use latent::{Latent, Resolution, Stage};
pub use locate::{Block, Cell, FREQUENCIES, Spectrum, whiteness};
pub use model::{Active, Channel, ForwardModel, Mechanism, NoisePrior, Nuisance, Observation, Role, State};
pub use parameter::{Parameter, Prior};
pub use posterior::{Place, Posterior};
pub use verdict::{Diagnosis, Verdict};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
