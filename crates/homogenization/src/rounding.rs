//! Effect of rounding on the constants: the cell is solved again with inputs that are a few roundings off, so that every rounding on the
//! way falls out differently. Cancellation wherever it is (thermal stresses of a nearly incompressible phase against the far smaller one of
//! the cell, a stack of rings of great contrast, the dense system) shows as spread.

use crate::cell::Constituent;
use crate::random::Random;
use crate::{Effective, FibreCell};
use nalgebra::Matrix3;

pub(crate) const CELLS: u64 = 3;
/// Factor on their largest distance, so few that all may lie close by chance.
pub(crate) const SPREAD: f64 = 6.0;
/// Largest change of an input, in roundings.
const ROUNDINGS: f64 = 4.0;
/// Roundings that add up in the best-conditioned constant: a few times what was seen when rings are split into rings of one material.
const LEAST: f64 = 128.0;

/// `cell` with every input a few roundings off, another way for each `seed`; Poisson's ratio, whose last digit near 1/2 is a different solid,
/// by one at most. Pitch and outermost radius stay, on which the lattice sums rest.
pub(crate) fn shaken(cell: &FibreCell, seed: u64) -> FibreCell {
    let mut random = Random::new(seed);
    let mut shake = |value: &mut f64, most: f64| *value *= 1.0 + (2.0 * random.uniform() - 1.0) * most * f64::EPSILON;
    let mut constituent = |c: &mut Constituent| {
        shake(&mut c.elastic.youngs_modulus, ROUNDINGS);
        shake(&mut c.elastic.poisson_ratio, 1.0);
        shake(&mut c.elastic.thermal_expansion, ROUNDINGS);
        shake(&mut c.conductivity, ROUNDINGS);
    };
    let mut shaken = cell.clone();
    shaken.rings.iter_mut().for_each(|ring| constituent(&mut ring.constituent));
    constituent(&mut shaken.adhesive);
    let inner = shaken.rings.len().saturating_sub(1);
    shaken.rings[..inner].iter_mut().for_each(|ring| shake(&mut ring.outer_radius, ROUNDINGS));
    shaken
}

/// The least relative error of a constant: it grows with the condition of the effective stiffness, scaled to a unit diagonal.
pub(crate) fn least(effective: &Effective) -> f64 {
    let c = effective.stiffness.fixed_view::<3, 3>(0, 0);
    let scaled = Matrix3::from_fn(|i, j| c[(i, j)] / (c[(i, i)] * c[(j, j)]).sqrt());
    let condition = scaled.try_inverse().map_or(f64::INFINITY, |inverse| scaled.norm() * inverse.norm());
    LEAST * f64::EPSILON * condition
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ring, Role};
    use fem_core::material::Isotropic;

    #[test]
    fn bounds_every_input_moves_and_by_a_few_roundings() {
        let constituent = |k: f64| {
            Constituent::new(Isotropic { youngs_modulus: 1e9 * k, poisson_ratio: 0.3, thermal_expansion: 1e-5 * k }, 0.2 * k)
        };
        let ring = |outer_radius, role| Ring { outer_radius, role, constituent: constituent(1.7) };
        let cell = FibreCell::hexagonal(170e-6, vec![ring(40e-6, Role::Glass), ring(80e-6, Role::Coating)], constituent(1.1));
        let inputs = |cell: &FibreCell| {
            let mut all: Vec<(f64, f64)> = Vec::new();
            for c in cell.rings.iter().map(|ring| &ring.constituent).chain([&cell.adhesive]) {
                let e = &c.elastic;
                all.extend([e.youngs_modulus, e.thermal_expansion, c.conductivity].map(|value| (value, ROUNDINGS)));
                all.push((e.poisson_ratio, 1.0));
            }
            all.push((cell.rings[0].outer_radius, ROUNDINGS));
            all
        };
        let mut farthest = vec![0.0_f64; inputs(&cell).len()];
        for seed in 0..64 {
            let shaken = shaken(&cell, seed);
            assert_eq!((shaken.pitch, shaken.rings[1].outer_radius), (cell.pitch, cell.rings[1].outer_radius));
            for ((far, (a, most)), (b, _)) in farthest.iter_mut().zip(inputs(&shaken)).zip(inputs(&cell)) {
                *far = far.max((a / b - 1.0).abs() / (most * f64::EPSILON));
            }
        }
        // half a rounding more by the last product, and as much by the quotient
        assert!(farthest.iter().all(|far| (0.5..=2.0).contains(far)), "{farthest:?}");
    }
}
