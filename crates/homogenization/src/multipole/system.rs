//! The multipoles on a lattice, and the dense systems for their strengths.

use super::lattice::LatticeSums;
use crate::{Error, FibreCell};
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// Highest order that the binomial factors of the lattice sums allow.
pub const HIGHEST_ORDER: usize = 401;
/// Largest residual of a solution relative to the sizes of matrix, solution and load.
const RESIDUAL_LIMIT: f64 = 1e-12;

/// Multipoles of odd orders on a lattice of circles of unit radius: the regular parts of E_n and H_n.
pub(crate) struct Multipoles {
    pub(super) order: usize,
    /// `e[n][m]`: coefficient of z^m in E_n
    pub(super) e: DMatrix<f64>,
    pub(super) h: DMatrix<f64>,
    /// `E_1(z + Q) − E_1(z) = period · Q̄`
    pub(super) period: f64,
    /// `H_1(z + Q) − H_1(z) = −Q̄ E_1′(z) + shear_period · Q`
    pub(super) shear_period: f64,
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

    pub(super) fn failed(&self, detail: &str) -> Error {
        Error::Multipoles { order: self.order, detail: detail.into() }
    }

    pub(super) fn orders(&self) -> impl Iterator<Item = usize> + Clone + use<> {
        (1..=self.order).step_by(2)
    }
}

/// Solves a dense system and checks the residual.
pub(super) fn solve(matrix: DMatrix<f64>, loads: &DMatrix<f64>, order: usize) -> Result<DMatrix<f64>, Error> {
    let failed = |detail: String| Error::Multipoles { order, detail };
    let solution = matrix.clone().lu().solve(loads).ok_or_else(|| failed("the system is singular".into()))?;
    let size = matrix.amax() * solution.amax() + loads.amax();
    let residual = (&matrix * &solution - loads).amax() / size;
    if residual < RESIDUAL_LIMIT { Ok(solution) } else { Err(failed(format!("a residual of {residual:.1e} is left"))) }
}
