//! Curved meshes of periodic cells with any inclusions: fibres of elliptical or offset rings anywhere in the cell, voids, hollow cores.
//!
//! The cell is a torus, not a box: it has no boundary that a fibre could cross. Rings are meshed between rays as in the regular cell;
//! the matrix between the inclusions is a Delaunay triangulation of the periodic plane whose triangles are wedges with the apex at one
//! corner. Nodes are numbered on the torus, so copies of one node are paired by number, never by comparing coordinates.

mod arrange;
mod build;
mod delaunay;
mod error;
mod fill;
mod layout;
mod outline;
mod spacing;

pub use arrange::{Arrangement, displace};
pub use build::{PeriodicMesh, periodic_mesh};
pub use error::LayoutError;
pub use layout::{Inclusion, LEAST_FILM, Layout};
pub use outline::Outline;
