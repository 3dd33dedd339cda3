//! Noise: its model, its whitening, and its identification.

mod data;
mod identify;
mod model;
mod regression;
mod whitener;

pub use identify::{Bounds, Candidate, NoiseEstimate, Series, StandardErrors, Term, identify, residual};
pub use model::NoiseModel;
pub use whitener::Whitener;
