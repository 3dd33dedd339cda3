//! The constituents of a cell with their shares of its area.

use crate::{Constituent, Error, FibreCell, Ring, Role};
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
    let adhesive = (1.0, cell.adhesive, false);
    gathered(filling(&cell.rings, cell.packing.area(cell.pitch)).chain([adhesive]), |i| cell.phase_name(i))
}

/// The phases of a fibre in air, from the inside out; radii increase.
///
/// # Errors
/// As [`phases`].
pub(crate) fn phases_of_fibre(rings: &[Ring]) -> Result<Vec<Phase>, Error> {
    let outermost = rings.last().map_or(f64::NAN, |ring| ring.outer_radius);
    gathered(filling(rings, PI * outermost * outermost), |i| rings[i].name(i))
}

/// Share of `area` inside each ring, its constituent, and whether it is glass.
fn filling(rings: &[Ring], area: f64) -> impl Iterator<Item = (f64, Constituent, bool)> {
    rings.iter().map(move |r| (PI * r.outer_radius * r.outer_radius / area, r.constituent, r.role == Role::Glass))
}

fn gathered(
    filling: impl Iterator<Item = (f64, Constituent, bool)>,
    name: impl Fn(usize) -> String,
) -> Result<Vec<Phase>, Error> {
    let mut phases: Vec<Phase> = Vec::new();
    for (i, (filled, c, glass)) in filling.enumerate() {
        c.law(|| name(i))?;
        let (lambda, shear) = (c.elastic.lame_lambda(), c.elastic.shear_modulus());
        let share = filled - phases.last().map_or(0.0, |p| p.filled);
        let (bulk, expansion) = (lambda + shear, c.elastic.thermal_expansion);
        phases.push(Phase { share, bulk, shear, lambda, expansion, conductivity: c.conductivity, filled, glass });
    }
    if phases.iter().any(|p| p.glass) { Ok(phases) } else { Err(Error::NoGlass) }
}
