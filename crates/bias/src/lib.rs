//! Rotation that a fibre-optic gyroscope reports although it stands still, because its coil changes temperature and shape.
//!
//! Two waves travel the coil in opposite directions and meet a changing piece of fibre at different times unless it lies at the
//! middle; so each piece counts with L − 2z. For a coil of length L and Sagnac diameter D (Osunluk, Ogut and Ozbay, eqs. 1–3):
//!
//! ```text
//! Ω_S  = n/(L D) (∂n/∂T + n α) ∫ Ṫ (L − 2z) dz                 thermal phase (Shupe)
//! Ω_EO = n/(L D) ∫ (A ε̇_z − B ε̇_r) (L − 2z) dz                 elasto-optic phase (Mohr)
//! A = n (1 − n² p12 / 2),   B = n³ (p11 + p12) / 2,   Ω = Ω_S + Ω_EO
//! ```
//!
//! The fibre comes as [`Slice`]s over which the rates are constant; L − 2z is integrated exactly over each. [`bias()`] sums them
//! with compensation, because in a good winding the contributions cancel some hundred to one. A solver that needs the formula
//! turn by turn takes the [`Coefficients`]; a steady ramp turns a bias into a [`Sensitivity`].
//!
//! Conventions: SI units, rad/s; degrees per hour only through [`units`]. z runs from 0 at the outer end of the CCW half to L at
//! the outer end of the CW half. ε_z is the strain of the glass along the fibre, ε_r across it. Eq. (1) already holds the free
//! expansion α; [`StrainConvention`] says whether eq. (2) is fed with it again.
//!
//! References: D. M. Shupe, *Applied Optics* 19, 654 (1980); F. Mohr, *Proc. SPIE* 5502, 410 (2004); B. Osunluk, S. Ogut and
//! E. Ozbay, *Thermally Induced Bias Errors for a Fiber Coil with Practical Quadrupole Winding*.
//!
//! ```
//! use bias::{Optics, Sensitivity, Slice, StrainConvention, bias};
//!
//! let optics = Optics {
//!     refractive_index: 1.45,
//!     thermo_optic: 1.0e-5,
//!     thermal_expansion: 0.55e-6,
//!     p11: 0.121,
//!     p12: 0.270,
//!     sagnac_diameter: 92.325e-3,
//!     strain: StrainConvention::Total,
//! };
//! // the first metre of a 1000 m fibre warms by 1 °C/min and nothing strains
//! let rate = 1.0 / 60.0;
//! let slice = Slice { z_start: 0.0, z_end: 1.0, temperature_rate: rate, axial_strain_rate: 0.0, radial_strain_rate: 0.0 };
//! let sensitivity = Sensitivity::from_ramp(&bias(&optics, 1000.0, &[slice])?, rate)?;
//! assert_eq!(format!("{:.4}", sensitivity.total()), "0.5824"); // (deg/h)/(degC/min)
//! # Ok::<(), bias::Error>(())
//! ```

mod coefficients;
mod error;
mod optics;
mod rate;
mod sensitivity;
mod slice;
mod sum;
pub mod units;

pub use coefficients::Coefficients;
pub use error::Error;
pub use optics::{Optics, StrainConvention};
pub use rate::Bias;
pub use sensitivity::Sensitivity;
pub use slice::{LENGTH_SLACK, Slice, bias};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
