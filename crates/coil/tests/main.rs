//! All tests of the crate in one program: linked once.

mod band;
mod common;
mod design;
mod dynamics;
mod exact;
mod fields;
mod inverse;
mod parametric;
mod section;
mod sensitivity;
mod trim;
