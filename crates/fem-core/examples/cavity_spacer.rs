//! An optical cavity: a spacer of glass that hardly expands, with mirrors of fused silica contacted to its ends. The mirrors expand more,
//! bend where the spacer holds them back, and so change the length of the cavity more than the spacer does. With δ a number of the
//! geometry, its expansion is α_spacer + 2 δ R/L (α_mirror − α_spacer) (T. Legero, T. Kessler and U. Sterr, *J. Opt. Soc. Am. B* 27, 914, 2010).

#![allow(clippy::print_stdout, reason = "the example is a program")]

use fem_core::material::Isotropic;
use fem_core::{Constraints, Error, Form, Mesh, Problem};

const ORDER: usize = 8;
const BORE: f64 = 5e-3;
const MIRROR: f64 = 12.7e-3;
const OUTSIDE: f64 = 16e-3;
const LENGTH: f64 = 100e-3;
const THICKNESS: f64 = 6.3e-3;

/// Expansion of the cavity's length on the axis \[1/K\]: half of it, its middle plane held.
fn expansion(spacer: Isotropic, mirror: Isotropic) -> Result<f64, Error> {
    let half = LENGTH / 2.0;
    // finer towards the contact, where the stress is
    let r = [0.0, BORE / 2.0, 0.9 * BORE, BORE, 1.1 * BORE, 0.9 * MIRROR, MIRROR, OUTSIDE];
    let y = [0.0, half - 20e-3, half - 5e-3, half - 1e-3, half, half + 1e-3, half + THICKNESS];
    let region = |i: usize, j: usize| match (r[i] < BORE, r[i] < MIRROR, y[j] < half) {
        (false, _, true) => Some(0),
        (_, true, false) => Some(1),
        _ => None,
    };
    let mesh = Mesh::rectangles(ORDER, &r, &y, region)?;
    let (stiffness, stress): (Vec<_>, Vec<_>) = [spacer.law()?.axisymmetric(), mirror.law()?.axisymmetric()].into_iter().unzip();

    let problem = Problem::new(&mesh, Form::AXISYMMETRIC_ELASTICITY, ORDER + 1);
    let mut constraints = Constraints::new(2 * mesh.nodes().len());
    constraints.hold_axis(&mesh)?;
    let at = |place: [f64; 2]| mesh.nodes().iter().position(|node| *node == place);
    for (node, _) in mesh.nodes().iter().enumerate().filter(|(_, [_, y])| *y == 0.0) {
        constraints.hold(2 * node + 1)?; // the middle plane
    }
    let map = constraints.eliminate(&problem.used(|_| true));
    let laws: Vec<_> = stiffness.into_iter().map(Some).collect();
    let load = map.restrict(&problem.loads(&stress.into_iter().map(Some).collect::<Vec<_>>())?[0]);
    let u = map.expand(&problem.condense(&map, &laws)?.solve(&[load])?[0]);
    Ok(at([0.0, half]).map_or(f64::NAN, |node| u[2 * node + 1] / half))
}

fn main() -> Result<(), Error> {
    let glass = |youngs_modulus, poisson_ratio, thermal_expansion| Isotropic { youngs_modulus, poisson_ratio, thermal_expansion };
    let (spacer, mirror) = (glass(67.6e9, 0.17, 0.01e-6), glass(72.7e9, 0.16, 0.5e-6));
    // of one glass the cavity expands as that glass does
    assert!((expansion(spacer, spacer)? / spacer.thermal_expansion - 1.0).abs() < 1e-9);

    let found = expansion(spacer, mirror)?;
    let delta =
        (found - spacer.thermal_expansion) * LENGTH / (2.0 * MIRROR * (mirror.thermal_expansion - spacer.thermal_expansion));
    let told = format!("{:.1}e-9 1/K, delta {delta:.2}", found * 1e9);
    println!("expansion of the cavity: {told}");
    assert_eq!(told, "54.3e-9 1/K, delta 0.36");
    Ok(())
}
