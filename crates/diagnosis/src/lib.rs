#![doc = include_str!("../README.md")]

mod compose;
mod discriminate;
mod error;
mod fit;
mod hold_out;
mod latent;
mod locate;
mod lot;
mod marginal;
mod model;
mod noise;
mod parameter;
mod posterior;
mod prove;
mod rival;
mod search;
mod settle;
mod structure;
mod verdict;

pub use compose::{Breadth, Composed, Earlier, compose, compose_within, gained_by_noise_of, in_place_of};
pub use discriminate::{Plan, Separation, fitted, separation};
pub use error::{Error, Failure};
pub use fit::{Fit, Hypothesis, Sampled, Samples, alternatives, expected, sampled};
pub use hold_out::{HeldOut, as_designed, designed_residuals};
pub use latent::{MemberResolution, Stage};
pub use locate::{Block, Cell, FREQUENCIES, Spectrum, whiteness};
pub use lot::{Believed, Known, Lot, Said};
pub use model::{Active, Channel, ForwardModel, Latent, NoisePrior, Nuisance, Observation, Omission, Role, State};
pub use parameter::{Parameter, Prior};
pub use posterior::{Estimate, Place, Posterior};
pub use prove::{Proof, prove, proven};
pub use rival::Rival;
pub use search::{Settings, diagnose, diagnose_settled};
pub use settle::{Settled, settled};
pub use structure::Structure;
pub use verdict::{Candidate, Contradiction, Diagnosis, Judged, Judgement, Ruling, SURE, Verdict};
