//! How much of a winding is adhesive, and how thin its film gets: 165 µm fibres at a pitch of 170 µm.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use rve_mesh::{Error, Extent, LatticeCell, Resolution, mesh};

fn main() -> Result<(), Error> {
    let cell = LatticeCell::hexagonal(170e-6, vec![82.5e-6])?;
    let resolution = Resolution { sectors: 2, grading: 1.5, across: vec![1, 1] };
    let quarter = mesh(&cell, Extent::Quarter, &resolution, &[-1.0, 1.0])?;
    let radius = |node: &usize| quarter.nodes[*node][0].hypot(quarter.nodes[*node][1]);
    let outermost = quarter.symmetry.mirror_x.iter().chain(quarter.symmetry.inversions.iter().flatten());
    let film = outermost.map(radius).filter(|r| *r > 82.6e-6).fold(f64::INFINITY, f64::min) - 82.5e-6;
    let adhesive = cell.phase_areas()[1] / cell.area();
    println!("adhesive {:.2} %, thinnest film {:.2} um on each side", 100.0 * adhesive, 1e6 * film);
    assert!((film - 2.5e-6).abs() < 1e-12); // half of what lies between two fibres
    assert!((adhesive - 0.1457).abs() < 5e-5);
    Ok(())
}
