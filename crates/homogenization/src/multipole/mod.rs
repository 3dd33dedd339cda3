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

use crate::cell::Phases;
use crate::{Effective, Error, FibreCell};
use lattice::LatticeSums;
use nalgebra::{DMatrix, Matrix2, Matrix6, SMatrix, Vector6};
use std::f64::consts::PI;

/// Highest order that the binomial factors of the lattice sums allow.
pub const HIGHEST_ORDER: usize = 401;
/// Largest residual of a solution relative to the sizes of matrix, solution and load.
const RESIDUAL_LIMIT: f64 = 1e-12;

/// Multipoles of odd orders on a lattice of circles of unit radius: the regular parts of E_n and H_n.
pub(crate) struct Multipoles {
    order: usize,
    /// `e[n][m]`: coefficient of z^m in E_n
    e: DMatrix<f64>,
    /// the same of H_n
    h: DMatrix<f64>,
    /// `E_1(z + Q) − E_1(z) = period · Q̄`
    period: f64,
    /// `H_1(z + Q) − H_1(z) = −Q̄ E_1′(z) + shear_period · Q`
    shear_period: f64,
}

impl Multipoles {
    /// Up to `order` (made odd) on the lattice of `cell` around its outermost radius.
    ///
    /// # Errors
    /// [`Error::Multipoles`] if `order` is above [`HIGHEST_ORDER`].
    pub(crate) fn new(cell: &FibreCell, order: usize) -> Result<Self, Error> {
        let order = order | 1;
        if order > HIGHEST_ORDER {
            return Err(Error::Multipoles { order, detail: format!("the highest order is {HIGHEST_ORDER}") });
        }
        let radius = cell.outermost() / cell.pitch;
        let sums = LatticeSums::new(cell.packing, 2 * order + 4);
        let size = order + 3;
        let mut multipoles = Self {
            order,
            e: DMatrix::zeros(size, size),
            h: DMatrix::zeros(size, size),
            period: PI * radius * radius / sums.area,
            shear_period: sums.shear_period * radius * radius,
        };
        for n in (1..=order).step_by(2) {
            let mut binomial = n as f64; // C(n + m − 1, m)
            for m in 1..=order + 2 {
                if m % 2 == 1 {
                    multipoles.e[(n, m)] = -binomial * sums.s(n + m) * radius.powi((n + m) as i32);
                    let next = binomial * (n + m) as f64; // n C(n + m, m)
                    multipoles.h[(n, m)] = next * sums.t(n + m + 1) * radius.powi((n + m) as i32);
                }
                binomial *= (n + m) as f64 / (m + 1) as f64;
            }
        }
        Ok(multipoles)
    }

    /// The same up to `order` (made odd) only, if that is lower.
    pub(crate) fn lowered(self, order: usize) -> Self {
        Self { order: self.order.min(order | 1), ..self }
    }

    /// Effective response of `cell`, which may differ from the one these are made for in all but its lattice and outermost radius.
    ///
    /// # Errors
    /// As [`multipoles`].
    pub(crate) fn effective(&self, cell: &FibreCell) -> Result<Effective, Error> {
        let phases = Phases::new(cell)?;
        let mut effective = Effective {
            stiffness: Matrix6::zeros(),
            thermal_stress: Vector6::zeros(),
            conductivity: Matrix2::zeros(),
            conductivity_z: phases.mean(|i| phases.conductivities[i]),
            glass_strain: SMatrix::zeros(),
            unknowns: 0,
            area_error: 0.0,
        };
        plane::add(self, cell, &phases, &mut effective)?;
        for (axis, sign) in [1.0, -1.0].into_iter().enumerate() {
            let of = |values: &dyn Fn(usize) -> f64| scalar::effective(self, cell, values, sign);
            effective.stiffness[(4 - axis, 4 - axis)] = of(&|i| phases.laws[i].stiffness[(4, 4)])?;
            effective.conductivity[(axis, axis)] = of(&|i| phases.conductivities[i])?;
        }
        Ok(effective)
    }

    fn failed(&self, detail: &str) -> Error {
        Error::Multipoles { order: self.order, detail: detail.into() }
    }

    /// Odd numbers up to the order.
    fn orders(&self) -> impl Iterator<Item = usize> + Clone + use<> {
        (1..=self.order).step_by(2)
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

/// Solves a dense system and checks the residual.
fn solve(matrix: DMatrix<f64>, loads: &DMatrix<f64>, order: usize) -> Result<DMatrix<f64>, Error> {
    let failed = |detail: String| Error::Multipoles { order, detail };
    let solution = matrix.clone().lu().solve(loads).ok_or_else(|| failed("the system is singular".into()))?;
    let size = matrix.amax() * solution.amax() + loads.amax();
    let residual = (&matrix * &solution - loads).amax() / size;
    if residual < RESIDUAL_LIMIT { Ok(solution) } else { Err(failed(format!("a residual of {residual:.1e} is left"))) }
}
