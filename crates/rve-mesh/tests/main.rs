//! All tests of the crate in one program: linked once.

mod bounds;
mod common;
mod exact;
mod irregular;
mod symmetry;
