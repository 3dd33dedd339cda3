//! Place of every turn of a fibre coil, and its stretch of the fibre.
//!
//! A [`Spec`] names a pattern and its dimensions; [`wind`] lays the fibre and returns a [`Winding`]: one [`Turn`] per loop, in
//! order along the fibre, each with its centre (r, y) in the coil's cross-section and its span (`z_start`, `z_end`) of the fibre.
//!
//! Turns touch on an orthocyclic (hexagonal) lattice of pitch p. Layer i = 1, 2, … from the inside and turn j = 1, 2, … from −y
//! sit at
//!
//! ```text
//! r_i = inner_radius + p/2 + (i − 1) p √3/2
//! y_j = (j − 1/2) p   in odd layers,      y_j = j p   in even layers, whose turns rest in the grooves
//! ```
//!
//! and a turn of layer i takes 2π r_i of fibre: turns are rings, not helices, and the steps from ring to ring and from layer to layer take
//! no fibre. The pitch is the outer diameter of the fibre, because turns touch. The bias of a gyroscope weights each point of the fibre by L − 2z (Shupe 1980),
//! so a turn's share is W = ∫ (L − 2z) dz over its span, and the moments Σ W rⁱ yʲ say which temperature and strain fields a
//! pattern lets through: the octupole cancels more of them than the quadrupole, the quadrupole more than the dipole.
//!
//! In the *practical* quadrupole a half that passes a layer it does not own lays one turn there, at its own end of the coil: the
//! first turn of every layer belongs to one half, the last to the other. That lets the fibre climb, and costs axial symmetry.
//!
//! Conventions: SI units. y = 0 is the coil's left face. z runs from the outer end of the CCW half (0), or of its bare tail, to
//! the outer end of the CW half (L). The halves meet inside, in layer 1; where each lays whole layers of its own, between its own
//! innermost layer and the other's, 1 and 2.
//!
//! References: D. M. Shupe, *Applied Optics* 19, 654 (1980); N. J. Frigo, *Proc. SPIE* 412, 268 (1983), the quadrupole;
//! B. Osunluk, S. Ogut and E. Ozbay, *Thermally Induced Bias Errors for a Fiber Coil with Practical Quadrupole Winding*, Fig. 3
//! and Table III.
//!
//! ```
//! use winding::{ClimbSide, Half, Pattern, Spec, Tails, TurnLength, wind};
//!
//! let winding = wind(&Spec {
//!     pattern: Pattern::PracticalQuadrupole,
//!     layers: 36,
//!     turns_odd_layers: 106,
//!     turns_even_layers: 105,
//!     inner_radius: 43.5e-3,
//!     pitch: 0.170e-3,
//!     start: 0.0,
//!     end: None,
//!     cw_climbs: ClimbSide::Right,
//!     turn_length: TurnLength::True,
//!     tails: Tails { cw: 0.0, ccw: 0.0 },
//!     defect: None,
//! })?;
//! assert_eq!(format!("{:.4}", winding.length()), "1101.5666"); // m
//! assert_eq!(winding.count(Half::Cw), 1899);
//! assert_eq!(format!("{:.2}", 1e3 * winding.mean_diameter()), "92.32"); // mm
//! # Ok::<(), winding::Error>(())
//! ```

mod check;
mod error;
mod pattern;
mod spec;
mod turn;
mod winding;

pub use check::MAX_TURNS;
pub use error::Error;
pub use spec::{ClimbSide, Half, LayerDefect, Pattern, Spec, Tails, TurnLength};
pub use turn::Turn;
pub use winding::{Winding, wind};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
