//! One reduced model of a coil for every design within a box of parameters: a reduced basis.
//!
//! Heat flow M(θ) Ṫ + K(θ) T and mechanics A(θ) u = B(θ) T are sums of integrals over rectangles of the section with factors that are explicit
//! in the design. Full solutions at designs of the box span the fields; on them a new design is a sum of small matrices, one symmetric
//! eigenproblem, and one adjoint solve for the parts of the bias.

mod build;
mod effort;
mod heat;
mod model;
mod parameter;
mod project;
mod range;
mod section;
mod slopes;
#[cfg(feature = "serde")]
mod stored;
mod strip;
mod structure;
mod tolerance;
mod turns;

pub use effort::{Effort, MODULI};
pub use model::{FieldsOn, MODEL_SAFETY, ParametricModel, Projected};
pub use parameter::{Parameter, Tolerance};
pub use range::Range;

pub use slopes::{Courses, Slopes};
pub use tolerance::{Number, Tolerances};
