//! Constants of a coil's constituents by the literature, before anything is measured; ranges hold 90 %.
//!
//! - Silica: fused silica is known to a percent (N. P. Bansal and R. H. Doremus, *Handbook of Glass Properties*, 1986); drawn fibre is a
//!   little softer, and dopants move its expansion.
//! - Soft primary and hard secondary acrylates: data sheets and patents of UV-cured coatings (in-situ modulus of primaries 0.5 to
//!   5 MPa, of secondaries 0.5 to 2 GPa), expansions as measured by Nakajima et al., *Furukawa Review* 34 (2007).
//! - Any single coating: from silicone rubber to polyimide.
//! - Adhesives of gyroscope coils: from silicones of about 1 MPa to epoxies of about 3 GPa, with and without filler (A. Cordova et al.,
//!   US 5 371 593 and US 5 546 482).
//! - Bulk modulus of rubbers: that of the liquid, 1.5 to 5 GPa (J. E. Mark, *Physical Properties of Polymers Handbook*, 2007).
//!
//! The ranges are judgements of ordinary materials, made once for all cells; they were not fitted to any.

use super::{MaterialPrior, Prior, Volume};

/// Kinds of constituents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Fused silica, drawn.
    Silica,
    /// Soft primary acrylate.
    SoftPrimary,
    /// Hard secondary acrylate.
    HardSecondary,
    /// Any single coating.
    AnyCoating,
    /// Any adhesive.
    Adhesive,
}

impl Kind {
    /// Its priors.
    pub const fn prior(self) -> MaterialPrior {
        const fn volume(low: f64, high: f64) -> Volume {
            Volume::BulkModulus(Prior::log(low, high))
        }
        const fn ratio(low: f64, high: f64) -> Volume {
            Volume::PoissonRatio(Prior::linear(low, high))
        }
        let (modulus, volume, expansion, conductivity) = match self {
            Self::Silica => ([70e9, 74e9], ratio(0.16, 0.18), [0.45e-6, 0.65e-6], [1.33, 1.43]),
            Self::SoftPrimary => ([0.5e6, 5e6], volume(1.5e9, 5e9), [150e-6, 350e-6], [0.13, 0.25]),
            Self::HardSecondary => ([0.5e9, 2e9], ratio(0.34, 0.43), [50e-6, 150e-6], [0.15, 0.35]),
            Self::AnyCoating => ([0.5e6, 5e9], volume(1.5e9, 5e9), [30e-6, 350e-6], [0.13, 0.35]),
            Self::Adhesive => ([1e6, 3e9], volume(1.5e9, 6e9), [50e-6, 350e-6], [0.15, 1.0]),
        };
        MaterialPrior {
            youngs_modulus: Prior::log(modulus[0], modulus[1]),
            volume,
            thermal_expansion: Prior::log(expansion[0], expansion[1]),
            conductivity: Prior::log(conductivity[0], conductivity[1]),
        }
    }
}
