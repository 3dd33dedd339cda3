#![doc = include_str!("../README.md")]
//! # Cells
//! A [`FibreCell`] is one fibre of concentric rings (glass, coatings) with the adhesive around it, repeated on an orthocyclic
//! (hexagonal) or a square lattice. On the scale of the coil it is a homogeneous solid, under hexagonal packing transversely isotropic
//! about the fibre, under square packing tetragonal ([`Effective::shear_moduli_across`]). [`homogenize`]
//! returns its [`Constants`] (Young's and shear moduli, Poisson's ratios, expansions, conductivities), the row M that leads back
//! from the coil's strain to the glass's, and the numerical error of each.
//!
//! A cell repeats for ever: its constants are those of fibres that are surrounded by many others. They are not those of a cable of a few
//! fibres, most of which lie at its surface. [`free_fibre`] is the other end: one coated fibre alone in air.
//!
//! # Equations
//! The displacement of the cell is `u = ε̄ x + w` with the macroscopic strain ε̄ and a fluctuation w that repeats from cell to
//! cell. Nothing varies along the fibre (generalised plane strain: ε_zz = ε̄_zz), so all unknowns live in the cross-section:
//!
//! ```text
//! ∇·σ = 0,   σ = C(x) (ε̄ + ε(w)) − β(x) ΔT,   β = C α,   w periodic               for ε̄ = xx, yy, zz, xy and for ΔT
//! ∇·(G(x) (γ̄ + ∇w)) = 0                                                            for γ̄ = xz, yz
//! ∇·(k(x) (∇T̄ + ∇w)) = 0                                                           for ∇T̄ along x and y
//! ```
//!
//! Cell averages of the stress give the stiffness and the thermal stress, `⟨σ⟩ = C̄ ε̄ − β̄ ΔT`; their inverse gives the constants
//! and `ᾱ = C̄⁻¹ β̄`. Along the fibre the conductivity is the area mean. The mean strain of the glass gives the dehomogenisation
//! row, with the *total* macroscopic strain and ε_r = (ε_xx + ε_yy)/2:
//!
//! ```text
//! ⟨ε_r⟩_glass = m_rx ε̄_xx + m_ry ε̄_yy + m_rz ε̄_zz + m_rt ΔT
//! ```
//!
//! # Method
//! [`homogenize_to`] works by multipoles ([`multipoles`]): in concentric rings the angular harmonics are solved exactly, in the adhesive
//! the fields of multipoles at all fibres' axes converge exponentially with their order, the slower the thinner the film. Neither mesh nor
//! incompressibility enters; the error is estimated from a lower order and from inputs a few roundings off.
//!
//! [`homogenize_on`] works by finite elements, curved quadrilaterals of high order (`rve-mesh`, `fem-core`), and shares nothing with the
//! multipoles but the constituents' laws: each checks the other. [`Extent::Quarter`] uses the mirror and point symmetry of the lattice;
//! [`Extent::Whole`] assumes none but periodicity. Each constant is compared with its own value two orders higher.
//! [`Integration::Reduced`] keeps low orders from locking.
//!
//! # Conventions
//! SI units. z is the fibre, x points to a nearest neighbour; Voigt order xx, yy, zz, yz, xz, xy with engineering shear. In a coil
//! z is the hoop, and both the radial and the axial direction are transverse. Poisson's ratios: `nu_zr = −ε_r/ε_z` under stress
//! along z, `nu_rz = nu_zr e_r/e_z`. Beware of `e_r/(1 − nu_r − 2 nu_zr nu_rz)`, twice the plane-strain bulk modulus: near nu_r = 1 it needs
//! more digits of Poisson's ratio than tables print.
//!
//! References: R. Hill, *J. Mech. Phys. Solids* 12, 199 (1964); V. M. Levin, *Mech. Solids* 2, 58 (1967); P. M. Suquet,
//! *Elements of homogenization for inelastic solid mechanics* (1987); B. Osunluk, S. Ogut and E. Ozbay, *Thermally Induced Bias
//! Errors for a Fiber Coil with Practical Quadrupole Winding*, Tables I and II.

pub mod bounds;
mod cell;
mod constants;
mod error;
mod fibre;
pub mod fields;
mod homogenize;
pub mod identify;
pub mod irregular;
mod multipole;
mod random;
mod rounding;
mod solve;

pub use cell::{Constituent, FibreCell, Ring, Role};
pub use constants::Constants;
pub use error::Error;
pub use fibre::{FreeFibre, free_fibre};
pub use homogenize::{
    FreeCell, Homogenized, NEGLIGIBLE, SAFETY, TOLERANCE, effective, effective_with, free_cell, homogenize, homogenize_on,
    homogenize_to,
};
pub use multipole::{HIGHEST_ORDER, multipoles};
pub use rve_mesh::{Extent, Packing, Resolution};
pub use solve::{Discretization, Effective, Integration};
