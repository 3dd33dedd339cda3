//! The coil in time and under heat against closed forms: composite cylinder, thermal stress of rings, energy, order of the stepping.

mod courses;
mod cylinder;
mod energy;
mod rings;
mod stepping;

use coil::MeshFineness;
use fem_core::{Mesh, polynomial};

const QUICK: MeshFineness = crate::common::QUICK.resolution;

/// A tube's wall in (r, y): one region between each two of `lines`, one element high.
fn wall(order: usize, lines: &[f64], height: f64) -> Mesh {
    let lattice = polynomial::gauss_lobatto(order);
    let cells = lines.len() - 1;
    let width = cells * order + 1;
    let r = |a: usize| {
        let cell = (a / order).min(cells - 1);
        lines[cell] + (lines[cell + 1] - lines[cell]) * (1.0 + lattice[a - cell * order]) / 2.0
    };
    let nodes = (0..width * (order + 1)).map(|k| [r(k % width), height * (1.0 + lattice[k / width]) / 2.0]).collect();
    let element = |e: usize| (0..(order + 1).pow(2)).map(|k| k / (order + 1) * width + e * order + k % (order + 1)).collect();
    Mesh::new(order, nodes, (0..cells).map(element).collect(), (0..cells).collect()).expect("mesh")
}
