//! Heat flow in coil, spool and medium: the lag behind the chamber in a steady ramp.

use crate::{Design, Domain, Error, Grid, Layout, Region, Resolution};
use fem_core::{Constraints, DofMap, Form, Problem};
use nalgebra::DMatrix;

/// How far each place lags behind the chamber wall when that has been warming at a constant rate for long.
///
/// The temperature is `T_wall(t) − lag · Ṫ` everywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct RampLag {
    /// At the centre of every turn, in the winding's order \[s\].
    pub turns: Vec<f64>,
    /// At the thermometer \[s\].
    pub sensor: f64,
    /// Unknowns of the system.
    pub unknowns: usize,
}

/// Conductivity and volumetric heat capacity of a region \[W/(m K), J/(m³ K)\].
fn properties(design: &Design, region: Region) -> Option<(f64, f64)> {
    let (body, medium) = (&design.body, &design.surroundings);
    match region {
        Region::Coil => Some((body.conductivity_r, body.density * body.specific_heat)),
        Region::Medium => Some((medium.conductivity, medium.density * medium.specific_heat)),
        Region::Spool => design.spool.as_ref().map(|s| (s.material.conductivity, s.material.density * s.material.specific_heat)),
    }
}

/// Holds the chamber wall: all nodes on the outer radius and on both ends.
fn held_at_the_wall(grid: &Grid, layout: &Layout) -> Result<DofMap, fem_core::Error> {
    let (nodes, wall) = (grid.mesh().nodes(), layout.chamber);
    let mut constraints = Constraints::new(nodes.len());
    for (node, [r, y]) in nodes.iter().enumerate() {
        if *r == wall.r[1] || *y == wall.y[0] || *y == wall.y[1] {
            constraints.hold(node)?;
        }
    }
    Ok(constraints.eliminate(&vec![true; nodes.len()]))
}

/// Solves `−∇·(k ∇lag) = ρ c` with no lag at the wall.
///
/// # Errors
/// [`Error`] names the dimension or property at fault, or the solve that failed.
pub fn ramp_lag(design: &Design, resolution: &Resolution) -> Result<RampLag, Error> {
    let winding = winding::wind(&design.winding)?;
    let layout = Layout::new(design)?;
    let grid = Grid::new(&layout, resolution, Domain::Chamber)?;
    let failed = |source| Error::Solve { part: "chamber", source };
    let mesh = grid.mesh();
    let map = held_at_the_wall(&grid, &layout).map_err(failed)?;
    let all = Constraints::new(mesh.nodes().len()).eliminate(&vec![true; mesh.nodes().len()]);
    let problem = Problem::new(mesh, Form::AXISYMMETRIC_DIFFUSION, mesh.order() + 1);
    let (mut conductivity, mut capacity) = (vec![None; mesh.region_count()], vec![None; mesh.region_count()]);
    for region in [Region::Coil, Region::Spool, Region::Medium] {
        if let Some((k, c)) = properties(design, region) {
            if let Some(slot) = conductivity.get_mut(region as usize) {
                *slot = Some(DMatrix::identity(2, 2) * k);
                capacity[region as usize] = Some(DMatrix::from_element(1, 1, c));
            }
        }
    }
    let source = problem.mass(&all, &capacity).map_err(failed)?.multiply(&vec![1.0; mesh.nodes().len()]);
    let factor = problem.factor(&map, &conductivity).map_err(failed)?;
    let lag = map.expand(&factor.solve(&[map.restrict(&source)]).map_err(failed)?[0]);
    let at = |r: f64, y: f64| -> Option<f64> {
        let &(element, xi, eta) = grid.locate(r, y).first()?;
        let [value, _, _] = problem.at_point(element, xi, eta);
        Some(value.iter().zip(&mesh.elements()[element]).map(|(v, &node)| v * lag[node]).sum())
    };
    let outside = |field: &str| Error::design(field, "lies outside the chamber; move it inside".into());
    Ok(RampLag {
        turns: winding.turns().iter().map(|t| at(t.r, t.y).ok_or_else(|| outside("winding"))).collect::<Result<_, _>>()?,
        sensor: at(design.sensor.radius, design.sensor.y).ok_or_else(|| outside("sensor"))?,
        unknowns: factor.unknowns(),
    })
}
