//! All tests of the crate in one program: linked once.

mod algebra;
mod common;
mod condensed;
mod exact;
mod factor;
mod mms;
mod patch;
mod refused;
mod transient;
