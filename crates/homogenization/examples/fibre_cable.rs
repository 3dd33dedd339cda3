//! How much a bundle of many ordinary telecom fibres (125 µm glass, 245 µm coating) in resin expands more than its glass, and why: the
//! coating is soft across the fibre but pulls along it. A cell repeats for ever, so this is the inside of a bundle; for one fibre in air see
//! `single_fibre.rs`.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use fem_core::material::Isotropic;
use homogenization::{Constituent, Error, FibreCell, Ring, Role, homogenize};

fn solid(youngs_modulus: f64, poisson_ratio: f64, thermal_expansion: f64, conductivity: f64) -> Constituent {
    Constituent::new(Isotropic { youngs_modulus, poisson_ratio, thermal_expansion }, conductivity)
}

fn main() -> Result<(), Error> {
    let ring = |diameter: f64, constituent, role| Ring { outer_radius: diameter / 2.0, constituent, role };
    let cable = FibreCell {
        packing: homogenization::Packing::Hexagonal,
        pitch: 250e-6,
        rings: vec![
            ring(125e-6, solid(72e9, 0.17, 0.55e-6, 1.38), Role::Glass),
            ring(190e-6, solid(1.5e6, 0.4997, 220e-6, 0.17), Role::Coating),
            ring(245e-6, solid(1.2e9, 0.40, 80e-6, 0.22), Role::Coating),
        ],
        adhesive: solid(0.9e9, 0.40, 90e-6, 0.20),
    };
    let alpha = homogenize(&cable)?.constants.alpha_z;
    let told = format!("{:.2}e-6 1/K", alpha * 1e6);
    println!("expansion along the fibres: {told}");
    assert_eq!(told, "3.08e-6 1/K");
    Ok(())
}
