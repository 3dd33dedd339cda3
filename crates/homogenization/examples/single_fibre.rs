//! Expansion of a telecom fibre (125 µm glass, 245 µm coating) alone in air, as one of an interferometer: modulus, expansion, and
//! the phase of the light per K. In a bundle of many it expands less or more, as the resin has it (`fibre_cable.rs`).

#![allow(clippy::print_stdout, reason = "the example is a program")]

use fem_core::material::Isotropic;
use homogenization::{Constituent, Error, Ring, Role, free_fibre};

fn solid(youngs_modulus: f64, poisson_ratio: f64, thermal_expansion: f64) -> Constituent {
    Constituent::new(Isotropic { youngs_modulus, poisson_ratio, thermal_expansion }, 0.2)
}

fn main() -> Result<(), Error> {
    let ring = |diameter: f64, constituent, role| Ring { outer_radius: diameter / 2.0, constituent, role };
    let fibre = free_fibre(&[
        ring(125e-6, solid(72e9, 0.17, 0.55e-6), Role::Glass),
        ring(190e-6, solid(1.5e6, 0.4997, 220e-6), Role::Coating),
        ring(245e-6, solid(1.2e9, 0.40, 80e-6), Role::Coating),
    ])?;
    // phase of light per K, relative to that of the length: n = 1.45, ∂n/∂T = 1.0e-5 1/K, p11 = 0.121, p12 = 0.270
    let (n, p11, p12, alpha) = (1.45_f64, 0.121, 0.270, 0.55e-6);
    let [along, across] = [fibre.expansion - alpha, fibre.glass_radial_strain - alpha];
    let path = 1.0e-5 + n * fibre.expansion - n.powi(3) / 2.0 * ((p11 + p12) * across + p12 * along);
    let told =
        format!("{:.2}e-6 1/K, {:.1} GPa, {:.2}e-6 1/K", fibre.expansion * 1e6, fibre.youngs_modulus * 1e-9, path / n * 1e6);
    println!("expansion, modulus, phase: {told}");
    assert_eq!(told, "2.48e-6 1/K, 19.2 GPa, 9.05e-6 1/K");
    Ok(())
}
