//! All tests of the crate in one program: linked once.

mod allan;
mod check;
mod common;
mod condition;
mod exact_whitener;
mod held;
mod identify;
mod ramp;
