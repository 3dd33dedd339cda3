//! The constituents of a cell with their shares of its area.

use crate::{Error, FibreCell, Role};
use std::f64::consts::PI;

/// A constituent's moduli as plane problems use them, and its share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Phase {
    pub(crate) share: f64,
    /// Plane-strain bulk modulus λ + G \[Pa\].
    pub(crate) bulk: f64,
    pub(crate) shear: f64,
    /// First Lamé constant \[Pa\].
    pub(crate) lambda: f64,
    pub(crate) expansion: f64,
    pub(crate) conductivity: f64,
    /// Squared outer radius over that of the circle with the cell's area: the sum of the shares up to here.
    pub(crate) filled: f64,
    /// Whether the dehomogenisation row counts it.
    pub(crate) glass: bool,
}

impl Phase {
    pub(crate) fn thermal_stress(&self) -> f64 {
        self.expansion * (3.0 * self.lambda + 2.0 * self.shear)
    }
}

/// The phases from the inside out.
///
/// # Errors
/// [`Error`] names the constituent out of range, or that no ring is glass.
pub(crate) fn phases(cell: &FibreCell) -> Result<Vec<Phase>, Error> {
    let area = cell.packing.area(cell.pitch);
    let rings = cell.rings.iter().map(|r| (PI * r.outer_radius * r.outer_radius / area, r.constituent, r.role == Role::Glass));
    let mut phases: Vec<Phase> = Vec::with_capacity(cell.rings.len() + 1);
    for (i, (filled, c, glass)) in rings.chain([(1.0, cell.adhesive, false)]).enumerate() {
        c.law(|| cell.phase_name(i))?;
        let (lambda, shear) = (c.elastic.lame_lambda(), c.elastic.shear_modulus());
        let share = filled - phases.last().map_or(0.0, |p| p.filled);
        let (bulk, expansion) = (lambda + shear, c.elastic.thermal_expansion);
        phases.push(Phase { share, bulk, shear, lambda, expansion, conductivity: c.conductivity, filled, glass });
    }
    if phases.iter().any(|p| p.glass) { Ok(phases) } else { Err(Error::NoGlass) }
}
