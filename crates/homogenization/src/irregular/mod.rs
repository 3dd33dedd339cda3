//! Cells without symmetry: any arrangement of elliptical or offset rings, voids and hollow cores, constituents orthotropic about z.
//!
//! [`Cell`] is a [`Layout`] and what its phases are made of; [`Cell::homogenize_to`] returns all of its effective response with numerical
//! errors, and the fluctuations behind it, from which [`crate::fields`] takes the strain at any point under any load.
//!
//! Periodicity is the only assumption. Voids carry no stress, count in the cell's area and have free surfaces.
//!
//! ```
//! use homogenization::irregular::{Cell, Inclusion, Layout, Outline, Phase, Solid};
//! use homogenization::{Constituent, Role};
//! use fem_core::material::Isotropic;
//!
//! let solid = |youngs_modulus, poisson_ratio, thermal_expansion, conductivity| {
//!     Constituent::new(Isotropic { youngs_modulus, poisson_ratio, thermal_expansion }, conductivity)
//! };
//! // glass in a square cell of epoxy, and a void beside it
//! let fibre = Inclusion { outlines: vec![Outline::circle([0.0, 0.0], 30e-6)], phases: vec![Some(1)] };
//! let void = Inclusion::void(Outline { centre: [50e-6, 50e-6], semi_axes: [15e-6, 8e-6], angle: 0.5 });
//! let phases = vec![
//!     Phase { name: "epoxy".into(), solid: Solid::isotropic(&solid(3e9, 0.38, 60e-6, 0.2))?, role: Role::Coating },
//!     Phase { name: "glass".into(), solid: Solid::isotropic(&solid(72e9, 0.17, 0.55e-6, 1.38))?, role: Role::Glass },
//! ];
//! let cell = Cell { layout: Layout::new([[100e-6, 0.0], [0.0, 100e-6]], vec![fibre, void], 0)?, phases };
//! let result = cell.homogenize_to(1e-3)?;
//! assert!(result.constants.e[2] > 0.28 * 72e9 && result.response.anisotropy > 0.01);
//! # Ok::<(), homogenization::Error>(())
//! ```

mod accuracy;
mod cell;
mod phase;
mod response;
mod solve;

pub use accuracy::HomogenizedCell;
pub use cell::Cell;
pub use phase::{Phase, Solid};
pub use response::{Directional, LOADS, Response, TEMPERATURE};
pub use rve_mesh::{Arrangement, Inclusion, Layout, LayoutError, Outline, PeriodicMesh, displace};
pub use solve::Solution;
