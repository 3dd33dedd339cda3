//! Cells that tests and benches share.

#![allow(dead_code, reason = "each binary uses its part")]

use fem_core::material::Isotropic;
use homogenization::{Constants, Constituent, Discretization, Effective, Extent, FibreCell, Resolution, Ring, Role, effective};

/// E \[Pa\], ν, α \[1/K\], k \[W/(m K)\].
pub(crate) fn solid(youngs_modulus: f64, poisson_ratio: f64, thermal_expansion: f64, conductivity: f64) -> Constituent {
    Constituent::new(Isotropic { youngs_modulus, poisson_ratio, thermal_expansion }, conductivity)
}

fn ring(micrometres: f64, constituent: Constituent, role: Role) -> Ring {
    Ring { outer_radius: micrometres * 0.5e-6, constituent, role }
}

pub(crate) fn glass() -> Constituent {
    solid(70.2e9, 0.17, 0.55e-6, 1.38)
}

/// The dual-coated fibre whose constants round to the paper's Table I.
pub(crate) fn reference() -> FibreCell {
    FibreCell::hexagonal(
        170e-6,
        vec![
            ring(80.0, glass(), Role::Glass),
            ring(112.0, solid(2.0e6, 0.4998, 250e-6, 0.15), Role::Coating),
            ring(165.0, solid(870e6, 0.4118, 102.75e-6, 0.30), Role::Coating),
        ],
        solid(5.593e6, 0.49985, 250e-6, 0.45),
    )
}

/// Cells unlike the reference: thinner film, bare fibre in much epoxy, thick stiff coating with a separate core.
pub(crate) fn varied() -> [FibreCell; 3] {
    let thin = FibreCell { pitch: 167e-6, ..reference() };
    let bare = FibreCell::hexagonal(200e-6, vec![ring(125.0, glass(), Role::Glass)], solid(3e9, 0.38, 60e-6, 0.2));
    let thick = FibreCell::hexagonal(
        260e-6,
        vec![
            ring(9.0, solid(69e9, 0.18, 1.1e-6, 1.3), Role::Glass),
            ring(125.0, glass(), Role::Glass),
            ring(135.0, solid(5e6, 0.499, 200e-6, 0.2), Role::Coating),
            ring(245.0, solid(1.4e9, 0.40, 80e-6, 0.25), Role::Coating),
        ],
        solid(20e6, 0.495, 220e-6, 0.4),
    );
    [thin, bare, thick]
}

/// All of these.
pub(crate) fn cells() -> impl Iterator<Item = FibreCell> {
    varied().into_iter().chain([reference()])
}

/// A bare fibre of radius 0.38 pitch (52 % by area) in a matrix.
pub(crate) fn two_phase(fibre: Constituent, matrix: Constituent) -> FibreCell {
    FibreCell::hexagonal(1.0, vec![Ring { outer_radius: 0.38, constituent: fibre, role: Role::Glass }], matrix)
}

/// Two sectors per 30°, one element across each phase.
pub(crate) fn on(cell: &FibreCell, order: usize, extent: Extent) -> Discretization {
    Discretization { order, resolution: Resolution { sectors: 2, grading: 1.0, across: vec![1; cell.rings.len() + 1] }, extent }
}

pub(crate) fn solve(cell: &FibreCell, order: usize, extent: Extent) -> (Effective, Constants) {
    let effective = effective(cell, &on(cell, order, extent)).expect("a solution");
    let constants = effective.constants().expect("a regular stiffness");
    (effective, constants)
}
