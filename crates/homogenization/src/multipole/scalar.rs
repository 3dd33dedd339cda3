//! Antiplane shear and conduction: the potential `Re F`, `F = g z + Σ B_n E_n`, with real coefficients under a load along x and
//! imaginary ones along y.

use super::stack::conduction;
use super::system::{Multipoles, solve};
use crate::{Error, FibreCell};
use nalgebra::DMatrix;

/// Effective constant along x (`sign` 1) or y (−1) from that of each phase.
///
/// A ring stack answers the regular part c_m of the harmonic m with `B_m = sign R_m c_m`; the mean gradient is `g + period B_1` along x
/// and `−g + period B_1` along y, and the multipoles of order one are what the flux differs by.
pub(super) fn effective(
    multipoles: &Multipoles,
    cell: &FibreCell,
    value: &dyn Fn(usize) -> f64,
    sign: f64,
) -> Result<f64, Error> {
    let rings: Vec<_> = cell.rings.iter().enumerate().map(|(i, ring)| (ring.outer_radius, value(i))).collect();
    let medium = value(rings.len());
    // unknowns: g, then B_n; the first row sets the mean gradient to 1
    let unknowns = 1 + multipoles.orders().count();
    let mut matrix = DMatrix::zeros(unknowns, unknowns);
    (matrix[(0, 0)], matrix[(0, 1)]) = (sign, multipoles.period);
    for (row, m) in multipoles.orders().enumerate() {
        let reflection = sign * conduction(m, &rings, medium);
        for (column, n) in multipoles.orders().enumerate() {
            matrix[(1 + row, 1 + column)] = f64::from(u8::from(n == m)) - reflection * multipoles.e[(n, m)];
        }
        if m == 1 {
            matrix[(1, 0)] = -reflection;
        }
    }
    let mut load = DMatrix::zeros(unknowns, 1);
    load[0] = 1.0;
    let solution = solve(matrix, &load, multipoles.order)?;
    Ok(medium * (1.0 - 2.0 * multipoles.period * solution[1]))
}
