#![doc = include_str!("../README.md")]
//! # Conventions
//! The cell is the lattice's Wigner–Seitz hexagon or square around one fibre of any number of concentric rings, the rest filled with
//! adhesive. Elements lie between rays from the fibre axis and are refined towards the narrow parts of the adhesive film; all
//! nodes of an interface lie on its circle exactly, at any polynomial order. The mesh is plain data: positions \[m\], node
//! numbers, phases, and which boundary nodes the lattice's symmetry relates. The crate knows no finite-element method.
//!
//! Nearest neighbours lie along x; the cell has flat sides at x = ±p/2.

mod cell;
mod error;
mod irregular;
mod mesh;

pub use cell::{LatticeCell, Packing};
pub use error::Error;
pub use irregular::{Arrangement, Inclusion, LEAST_FILM, Layout, LayoutError, Outline, PeriodicMesh, displace, periodic_mesh};
pub use mesh::{CellMesh, Extent, Resolution, Symmetry, mesh};
