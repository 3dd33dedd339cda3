//! Noise: its model, its whitening, and its identification.

mod data;
mod derived;
mod fitted;
mod identify;
mod model;
mod regression;
mod whitener;

pub use data::Series;
pub use fitted::{Fitted, fitted, fitted_within};
pub use identify::{Bounds, Candidate, NoiseEstimate, Parameter, StandardErrors, Term, identify, residual};
pub use model::NoiseModel;
pub use whitener::Whitener;
