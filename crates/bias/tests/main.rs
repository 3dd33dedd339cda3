//! All tests of the crate in one program: linked once.

mod common;
mod exact;
mod symmetry;
