//! All tests of the crate in one program: linked once.

mod bounds;
mod closed_form;
mod common;
mod exact;
mod fields;
mod figures;
#[path = "../../recording/tests/common/figures.rs"]
mod figures_kit;
mod free_fibre;
mod identify;
mod irregular;
mod multipoles;
mod paper;
mod symmetry;
