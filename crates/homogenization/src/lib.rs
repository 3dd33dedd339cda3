//! Effective constants of coated fibres in adhesive, and the strain of the glass inside.
mod cell;
mod constants;
mod error;
mod homogenize;
mod solve;

pub use cell::{Constituent, FibreCell, Ring, Role};
pub use constants::Constants;
pub use error::Error;
pub use homogenize::{FreeCell, Homogenized, effective, free_cell, homogenize, homogenize_on};
pub use rve_mesh::{Extent, Resolution};
pub use solve::{Discretization, Effective};
