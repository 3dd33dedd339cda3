//! A bundle of copper wires in epoxy: heat across it, by a mesh of `rve-mesh`, and its temperature for ParaView by `vtu`. Copper and epoxy
//! exchanged, the two conductivities multiply to those of the constituents (Keller 1964): an exact check.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use fem_core::polynomial::gauss_lobatto;
use fem_core::{Constraints, Form, Mesh, Problem};
use nalgebra::DMatrix;
use rve_mesh::{CellMesh, Extent, LatticeCell, Packing, Resolution, mesh};
use vtu::{Array, Grid};

const PITCH: f64 = 100e-6; // m
const RADIUS: f64 = 40e-6;
const COPPER: f64 = 400.0; // W/(m K)
const EPOXY: f64 = 0.2;
const ORDER: usize = 6;

type Failure = Box<dyn std::error::Error>;

/// Conductivity of the lattice \[W/(m K)\], and the temperature of every node \[K\] where it rises by 1 K/m along x on average.
fn across(cell: &CellMesh, mesh: &Mesh, conductivities: [f64; 2]) -> Result<(f64, Vec<f64>), Failure> {
    let problem = Problem::new(mesh, Form::DIFFUSION, ORDER + 2);
    let mut constraints = Constraints::new(mesh.nodes().len());
    for &[node, partner] in &cell.symmetry.translations {
        constraints.tie(node, partner, 1.0)?; // of what is beside the even rise
    }
    constraints.hold(0)?;
    let map = constraints.eliminate(&problem.used(|_| true));
    let laws = conductivities.map(|k| Some(DMatrix::identity(2, 2) * k));
    let even = conductivities.map(|k| Some(DMatrix::from_column_slice(2, 1, &[-k, 0.0])));
    let load = problem.loads(&even)?.swap_remove(0);
    let beside = map.expand(&problem.factor(&map, &laws)?.solve(&[map.restrict(&load)])?[0]);

    let areas = problem.region_measures()?;
    let upper: f64 = areas.iter().zip(conductivities).map(|(area, k)| area * k).sum();
    let relief: f64 = load.iter().zip(&beside).map(|(f, t)| f * t).sum();
    let temperature = mesh.nodes().iter().zip(&beside).map(|(position, t)| position[0] + t).collect();
    Ok(((upper - relief) / (PITCH * PITCH), temperature))
}

fn main() -> Result<(), Failure> {
    let lattice = LatticeCell::new(Packing::Square, PITCH, vec![RADIUS])?;
    let resolution = Resolution { sectors: 2, grading: 1.3, across: vec![2, 3] };
    let cell = mesh(&lattice, Extent::Whole, &resolution, &gauss_lobatto(ORDER))?;
    let mesh = Mesh::new(cell.order, cell.nodes.clone(), cell.elements.clone(), cell.phases.clone())?;

    let (wires, temperature) = across(&cell, &mesh, [COPPER, EPOXY])?;
    let (holes, _) = across(&cell, &mesh, [EPOXY, COPPER])?;
    let error = wires * holes / (COPPER * EPOXY) - 1.0;
    assert!(error.abs() < 1e-6, "{error}");
    let told = format!("{wires:.4} W/(m K)");
    println!("across the wires: {told}");
    assert_eq!(told, "0.6200 W/(m K)");

    // a name, as wires.vtu, asks for a file with the temperature
    let Some(path) = std::env::args().nth(1) else { return Ok(()) };
    let phase = mesh.regions().iter().flat_map(|&region| vec![i32::from(region == 1); ORDER * ORDER]).collect();
    let grid = Grid {
        points: mesh.nodes().iter().map(|&[x, y]| [x, y, 0.0]).collect(),
        quadrilaterals: mesh.quadrilaterals(),
        of_points: vec![Array::scalar("temperature_k", temperature)],
        of_cells: vec![Array::whole("phase", phase)],
    };
    grid.write(&mut std::io::BufWriter::new(std::fs::File::create(&path)?))?;
    Ok(())
}
