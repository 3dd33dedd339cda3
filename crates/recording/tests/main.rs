//! All tests of the crate in one program: linked once.

mod allan;
mod check;
mod common;
mod condition;
mod exact_whitener;
mod figures;
mod held;
mod identify;
mod lines;
mod outliers;
mod ramp;
