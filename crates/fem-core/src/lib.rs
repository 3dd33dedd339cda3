//! High-order finite elements for thermo-elasticity and heat conduction in the plane and in bodies of revolution.
//!
//! One weak form, `∫ (B v)ᵀ D (B u)`, on curved quadrilaterals of any order: [`Form`] lists the strain operators (conduction and
//! antiplane shear, generalised plane strain, axisymmetric conduction and elasticity), [`material`] gives D, [`Constraints`]
//! eliminate periodic, mirror and rigid-motion conditions so that every system is symmetric positive definite, and [`Factor`]
//! is a sparse Cholesky factor whose residual is checked. [`Problem::mass`] and [`Problem::boundary_mass`] join the stiffness in a heat-like system
//! `C ẏ + K y = f`, which [`Transient`] follows in time; initial values get into its unknowns by [`DofMap::get`].
//!
//! SI units; Voigt order xx, yy, zz, yz, xz, xy with engineering shear; axisymmetric strains in the order rr, yy, hoop, ry.
//!
//! References: T. J. R. Hughes, *The Finite Element Method* (1987); G. Karniadakis and S. Sherwin, *Spectral/hp Element Methods*
//! (2005).
//!
//! ```
//! use fem_core::{Constraints, Form, Mesh, Problem};
//! use nalgebra::DMatrix;
//!
//! // heat flow through a square of conductivity 2 W/(m K), bottom at 0, heated by 3 W/m at the top
//! let nodes = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
//! let mesh = Mesh::new(1, nodes, vec![vec![0, 1, 2, 3]], vec![0])?;
//! let problem = Problem::new(&mesh, Form::DIFFUSION, 2);
//! let mut constraints = Constraints::new(4);
//! constraints.hold(0)?;
//! constraints.hold(1)?;
//! let map = constraints.eliminate(&problem.used(|_| true));
//! let factor = problem.factor(&map, &[Some(DMatrix::identity(2, 2) * 2.0)])?;
//! let t = map.expand(&factor.solve(&[map.restrict(&[0.0, 0.0, 1.5, 1.5])])?[0]);
//! assert!((t[3] - 1.5).abs() < 1e-12);
//! # Ok::<(), fem_core::Error>(())
//! ```

mod condensed;
mod constraints;
pub mod dense;
mod error;
mod form;
mod geometry;
mod linear;
pub mod material;
mod mesh;
pub mod polynomial;
mod problem;
mod rectangle;
mod sparse;
mod transient;

pub use condensed::Condensed;
pub use constraints::{Constraints, DofMap};
pub use error::Error;
pub use form::{Form, Operator};
pub use geometry::{Edge, ElementGeometry, Measure, ReferenceElement};
pub use linear::{BACKWARD_ERROR_LIMIT, Factor, PROBE_ERROR_LIMIT, SymbolicFactor};
pub use mesh::Mesh;
pub use problem::{Coupling, Problem};
pub use sparse::{Pattern, SparseMatrix};
pub use transient::{Effort, State, Transient};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
