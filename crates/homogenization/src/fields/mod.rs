//! Dehomogenisation: the strain and stress at every point of the cell under any macroscopic strain and temperature change.
//!
//! The macroscopic strain is the *total* one, free expansion included, as a model of the coil gives it. Both conventions of the local
//! strain are offered ([`Convention`]): total, as in the row M, and mechanical, the total less the free expansion of the phase, which is
//! what stresses it.
//!
//! ```
//! # use fem_core::material::Isotropic;
//! # use homogenization::{Constituent, FibreCell, Ring, Role};
//! use homogenization::fields::{Component, Convention, Fields, Load};
//! use homogenization::irregular::{Arrangement, Cell};
//!
//! # let solid = |youngs_modulus, poisson_ratio, thermal_expansion, conductivity| {
//! #     Constituent::new(Isotropic { youngs_modulus, poisson_ratio, thermal_expansion }, conductivity)
//! # };
//! # let glass = Ring { outer_radius: 62.5e-6, constituent: solid(72e9, 0.17, 0.55e-6, 1.38), role: Role::Glass };
//! # let fibre_cell = FibreCell::hexagonal(140e-6, vec![glass], solid(3e9, 0.38, 60e-6, 0.2));
//! let cell = Cell::of_fibres(&fibre_cell, &Arrangement::hexagonal(140e-6, 1, 1)?)?;
//! let solution = cell.solve(6, 1.0)?;
//! // held in all directions and heated by 10 K: the epoxy squeezes the glass
//! let fields = Fields::new(&solution, Load { temperature: 10.0, ..Load::default() });
//! let glass = &fields.summary()?[0];
//! let radial = glass.get(Component::MeanRadial, Convention::Total);
//! assert!(radial.mean < 0.0 && radial.least <= radial.mean && radial.mean <= radial.most);
//! # Ok::<(), homogenization::Error>(())
//! ```

mod component;
mod local;
mod sample;
mod summary;

pub use component::{Component, Convention};
pub use local::{Fields, Load, State};
pub use sample::Sample;
pub use summary::{PhaseStrain, Spread};
