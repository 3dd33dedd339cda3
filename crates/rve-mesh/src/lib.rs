//! Structured curved meshes of coated fibres on an orthocyclic (hexagonal) or square lattice.
//!
//! The cell is the lattice's Wigner–Seitz hexagon or square around one fibre of any number of concentric rings, the rest filled with
//! adhesive. Elements lie between rays from the fibre axis and are refined towards the narrow parts of the adhesive film; all
//! nodes of an interface lie on its circle exactly, at any polynomial order. The mesh is plain data: positions \[m\], node
//! numbers, phases, and which boundary nodes the lattice's symmetry relates. The crate knows no finite-element method.
//!
//! Nearest neighbours lie along x; the cell has flat sides at x = ±p/2.
//!
//! ```
//! use rve_mesh::{Extent, LatticeCell, Resolution, mesh};
//!
//! // an 80 µm cladding in a 165 µm coating at a pitch of 170 µm
//! let cell = LatticeCell::hexagonal(170e-6, vec![40e-6, 82.5e-6])?;
//! let resolution = Resolution { sectors: 2, grading: 1.3, across: vec![1, 2, 1] };
//! let quadratic = mesh(&cell, Extent::Whole, &resolution, &[-1.0, 0.0, 1.0])?;
//! assert_eq!(quadratic.elements.len(), 12 * 2 * 4);
//! let glass_fraction = cell.phase_areas()[0] / cell.area();
//! assert!((glass_fraction - 0.2008).abs() < 5e-5);
//! # Ok::<(), rve_mesh::Error>(())
//! ```

mod cell;
mod error;
mod irregular;
mod mesh;

pub use cell::{LatticeCell, Packing};
pub use error::Error;
pub use irregular::{Arrangement, Inclusion, LEAST_FILM, Layout, LayoutError, Outline, PeriodicMesh, displace, periodic_mesh};
pub use mesh::{CellMesh, Extent, Resolution, Symmetry, mesh};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
