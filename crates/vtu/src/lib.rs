//! Fields on quadrilaterals as VTK's XML files, for ParaView and whatever else reads them.
//!
//! A [`Grid`] is one unstructured grid (`.vtu`): points, quadrilaterals, and [`Array`]s of values at either. A [`Series`] (`.pvd`) lists
//! grids with their instants. Numbers are text with eight digits; a value that is not a number is written `NaN`, which ParaView leaves
//! blank. The caller chooses the units and says them in the arrays' names.
//!
//! Reference: *VTK File Formats*, Kitware, XML unstructured grids, version 1.0.

mod array;
mod grid;
mod series;

pub use array::{Array, Values};
pub use grid::Grid;
pub use series::{Entry, Series};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
