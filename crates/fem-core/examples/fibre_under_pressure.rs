//! A coated fibre in the sea, as in a fibre hydrophone: the glass, far stiffer, bears what presses on the coating's ends, and shortens twice
//! as much as bare glass. Beside it Lamé's solution.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use fem_core::material::Isotropic;
use fem_core::{Constraints, Error, Form, Mesh, Problem, polynomial};
use nalgebra::{DMatrix, Matrix4, Vector4};

const ORDER: usize = 14;
const GLASS: f64 = 62.5e-6;
const COATING: f64 = 250e-6;
const LENGTH: f64 = 100e-6;
const PRESSURE: f64 = 1e6;

/// Axial strain of an infinitely long fibre by finite elements: a stretch of it between two planes that stay plane.
fn finite_elements(phases: [Isotropic; 2]) -> Result<f64, Error> {
    let (columns, lattice) = (2 * ORDER + 1, polynomial::gauss_lobatto(ORDER));
    let at = |i: usize| (1.0 + lattice[i]) / 2.0;
    let radius = |i: usize| {
        if i <= ORDER { GLASS * at(i) } else { GLASS + (COATING - GLASS) * at(i - ORDER) }
    };
    let nodes = (0..columns * (ORDER + 1)).map(|k| [radius(k % columns), LENGTH * at(k / columns)]).collect();
    let element = |first: usize| (0..(ORDER + 1).pow(2)).map(|k| first + k % (ORDER + 1) + columns * (k / (ORDER + 1))).collect();
    let mesh = Mesh::new(ORDER, nodes, vec![element(0), element(ORDER)], vec![0, 1])?;

    let mut stiffness = Vec::new();
    for phase in phases {
        stiffness.push(Some(phase.law()?.axisymmetric().0));
    }
    // pressure on all of the surface does the work of an even stress −p in the volume
    let pressure = DMatrix::from_column_slice(4, 1, &[-PRESSURE, -PRESSURE, -PRESSURE, 0.0]);
    let problem = Problem::new(&mesh, Form::AXISYMMETRIC_ELASTICITY, ORDER + 1);
    let mut constraints = Constraints::new(2 * mesh.nodes().len());
    let top = columns * ORDER;
    for i in 0..columns {
        constraints.hold(2 * i + 1)?;
        constraints.tie(2 * (top + i) + 1, 2 * top + 1, 1.0)?;
    }
    constraints.hold_axis(&mesh)?;
    let map = constraints.eliminate(&problem.used(|_| true));
    let load = map.restrict(&problem.loads(&[Some(pressure.clone()), Some(pressure)])?[0]);
    let u = map.expand(&problem.factor(&map, &stiffness)?.solve(&[load])?[0]);
    Ok(u[2 * top + 1] / LENGTH)
}

/// The same by Lamé: u = A r in the glass, C r + D / r in the coating, one axial strain.
fn lame([glass, coating]: [Isotropic; 2]) -> Option<f64> {
    let moduli = |m: Isotropic| (m.lame_lambda(), m.shear_modulus());
    let ((l1, g1), (l2, g2)) = (moduli(glass), moduli(coating));
    let (a, b) = (GLASS * GLASS, COATING * COATING);
    // unknowns A, C, D and the axial strain; D in units of a
    let rows = Matrix4::from_row_slice(
        &[
            [1.0, -1.0, -1.0, 0.0],                                 // radial displacement at the interface
            [2.0 * (l1 + g1), -2.0 * (l2 + g2), 2.0 * g2, l1 - l2], // radial stress there
            [0.0, 2.0 * (l2 + g2), -2.0 * g2 * a / b, l2],          // radial stress outside
            [2.0 * l1 * a, 2.0 * l2 * (b - a), 0.0, (l1 + 2.0 * g1) * a + (l2 + 2.0 * g2) * (b - a)], // axial force
        ]
        .concat(),
    );
    Some(rows.lu().solve(&Vector4::new(0.0, 0.0, -PRESSURE, -PRESSURE * b))?[3])
}

fn main() -> Result<(), Error> {
    let solid = |youngs_modulus, poisson_ratio| Isotropic { youngs_modulus, poisson_ratio, thermal_expansion: 0.0 };
    let glass = solid(72e9, 0.17);
    let bare = finite_elements([glass, glass])?;
    assert!((bare / (-PRESSURE * (1.0 - 2.0 * 0.17) / 72e9) - 1.0).abs() < 1e-9);

    let coated = [glass, solid(0.5e9, 0.47)];
    let strain = finite_elements(coated)?;
    let exact = lame(coated).unwrap_or(f64::NAN);
    assert!((strain / exact - 1.0).abs() < 1e-7, "{strain:e} {exact:e}");
    let told = format!("{:.3} {:.3}", bare * 1e6, strain * 1e6);
    println!("strain along the glass, bare and coated [1e-6 per MPa]: {told}");
    assert_eq!(told, "-9.167 -20.004");
    Ok(())
}
