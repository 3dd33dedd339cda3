//! A free ring wound of fibre does not stay round its fibres when it warms: stiff along the hoop and expansive across it, the
//! bore shrinks while the outside grows.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use fem_core::material::TransverselyIsotropic;
use fem_core::{Constraints, Error, Form, Mesh, Problem};

const ORDER: usize = 8;
const BORE: f64 = 43.5e-3;
const OUTSIDE: f64 = 48.825e-3;
const HEIGHT: f64 = 18.02e-3;

fn main() -> Result<(), Error> {
    let coil = TransverselyIsotropic {
        e_z: 14.5e9,
        e_r: 95.2e6,
        g_zr: 24.1e6,
        nu_zr: 0.392,
        nu_r: 0.979,
        alpha_z: 3.36e-6,
        alpha_r: 193e-6,
    }
    .law()?;
    let mesh = Mesh::rectangles(ORDER, &[BORE, OUTSIDE], &[0.0, HEIGHT], |_, _| Some(0))?;
    let (stiffness, thermal_stress) = coil.axisymmetric(); // the fibre is the hoop
    let problem = Problem::new(&mesh, Form::AXISYMMETRIC_ELASTICITY, ORDER + 1);
    let mut constraints = Constraints::new(2 * mesh.nodes().len());
    constraints.hold(1)?;
    let map = constraints.eliminate(&problem.used(|_| true));
    let load = map.restrict(&problem.loads(&[Some(thermal_stress)])?[0]);
    let u = map.expand(&problem.factor(&map, &[Some(stiffness)])?.solve(&[load])?[0]);

    let middle = (ORDER + 1) * (ORDER / 2);
    let [bore, outside] = [u[2 * middle] * 1e9, u[2 * (middle + ORDER)] * 1e9]; // nm per K
    let told = format!("{bore:.0} {outside:.0}");
    println!("movement of bore and outside [nm/K]: {told}");
    assert_eq!(told, "-280 600");
    Ok(())
}
