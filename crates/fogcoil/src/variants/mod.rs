//! Designs that differ from a drawing: numbers and choices of its coil file by their keys, numbers within their tolerances.
//!
//! A design is a point of the unit cube, a coordinate for every factor: [`Varied`] for a key, or the normal deviation of a number that has a tolerance.
//! A key is set in the text of the coil file, which is then read and checked like any other. A number within its tolerance is set in the design, where the
//! numbers that depend on it follow (G the transverse modulus, the thermometer the bore).

mod design;
mod factor;
mod follow;
mod group;
mod read;
mod value;
mod varied;

pub use design::{Drawing, Variant, Variants};
pub use factor::{Factor, Kind};
pub use follow::Dimensions;
pub use group::Group;
pub use read::{MOST_FACTORS, Others, variants};
pub use value::Value;
pub(crate) use varied::normal;
pub use varied::{Choice, Varied, each_once};
