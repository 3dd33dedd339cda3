//! The cell by multipoles: exact in the rings, exponentially convergent in the film between the fibres.
//!
//! Inside a fibre every field is a sum of angular harmonics, and what concentric rings answer to one is a small matrix (`stack`). In the
//! adhesive the fields are those of multipoles at all fibres' axes: periodic functions E_n and H_n with the poles `(a/z)^n`, whose
//! regular parts are sums over the lattice (`lattice`). What is left is one small dense system for the strengths of the multipoles up
//! to an order; what it leaves out falls off with the order as the images of a fibre in its neighbours do ([`decay`]).
//!
//! Lord Rayleigh, *Phil. Mag.* 34, 481 (1892); R. C. McPhedran and D. R. McKenzie, *Proc. R. Soc. A* 359, 45 (1978); E. I. Grigolyuk and
//! L. A. Fil'shtinskii, *Perforated Plates and Shells* (1970); N. I. Muskhelishvili, *Some Basic Problems of the Mathematical Theory of
//! Elasticity* (1953).

mod lattice;
mod plane;
mod scalar;
mod stack;
mod system;

pub use system::HIGHEST_ORDER;
pub(crate) use system::Multipoles;

use crate::cell::Phases;
use crate::{Effective, Error, FibreCell};

impl Multipoles {
    /// Effective response of `cell`, which may differ from the one these are made for in all but its lattice and outermost radius.
    ///
    /// # Errors
    /// As [`multipoles`].
    pub(crate) fn effective(&self, cell: &FibreCell) -> Result<Effective, Error> {
        let phases = Phases::new(cell)?;
        let mut effective = Effective::begun(&phases);
        plane::add(self, cell, &phases, &mut effective)?;
        for (axis, sign) in [1.0, -1.0].into_iter().enumerate() {
            let of = |values: &dyn Fn(usize) -> f64| scalar::effective(self, cell, values, sign);
            effective.stiffness[(4 - axis, 4 - axis)] = of(&|i| phases.laws[i].stiffness[(4, 4)])?;
            effective.conductivity[(axis, axis)] = of(&|i| phases.conductivities[i])?;
        }
        Ok(effective)
    }
}

/// By how much the strengths of multipoles fall from one order to the next: the last image of a fibre in its neighbour lies at d with
/// `d (p − d) = a²`, and its field falls as `(d / (p − d))^n`.
pub(crate) fn decay(cell: &FibreCell) -> f64 {
    let root = (1.0 - (2.0 * cell.outermost() / cell.pitch).powi(2)).sqrt();
    (1.0 - root) / (1.0 + root)
}

/// Effective response of `cell` with multipoles up to `order` (made odd).
///
/// # Errors
/// [`Error`] names the constituent or the geometry at fault; [`Error::Multipoles`] if a solution leaves a residual or `order` is above
/// [`HIGHEST_ORDER`].
pub fn multipoles(cell: &FibreCell, order: usize) -> Result<Effective, Error> {
    cell.outline()?;
    Multipoles::new(cell, order)?.effective(cell)
}
