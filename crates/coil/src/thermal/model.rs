//! The heat-flow model: capacity and conductivity matrices, and the steady temperature that each drive holds up.

use super::Drive;
use crate::grid::COINCIDENT;
use crate::{Bonds, Design, Domain, Error, Grid, Layout, MeshFineness, Region, Side};
use fem_core::{Constraints, DofMap, Edge, Factor, Form, Mesh, Problem, SparseMatrix};
use nalgebra::DMatrix;

/// Heat flow of a design in its chamber, discretised.
///
/// With drives u_k(t) the temperature is `T = Σ u_k φ_k + θ`: φ_k is the steady temperature under a unit of drive k alone and θ obeys
/// `C θ̇ + K θ = −Σ C φ_k u̇_k` with θ = 0 on the wall.
pub struct ThermalModel {
    grid: Grid,
    map: DofMap,
    capacity: SparseMatrix,
    conductivity: Factor,
    drives: Vec<Drive>,
    shapes: Vec<Vec<f64>>,
    stored: Vec<Vec<f64>>,
}

fn failed(source: fem_core::Error) -> Error {
    Error::Solve { part: "chamber", source }
}

/// Conductivity matrix \[W/(m K)\] and volumetric heat capacity \[J/(m³ K)\] of a region.
pub(crate) fn properties(design: &Design, region: Region) -> Option<(DMatrix<f64>, f64)> {
    let isotropic = |k: f64| DMatrix::identity(2, 2) * k;
    let (body, medium) = (&design.body, &design.surroundings);
    match region {
        Region::Coil => Some((isotropic(body.conductivity_r), body.density * body.specific_heat)),
        Region::Medium => Some((isotropic(medium.conductivity), medium.density * medium.specific_heat)),
        _ => {
            let m = design.spool.as_ref()?.material;
            let mut k = isotropic(m.conductivity);
            let heat = &design.heat;
            // across a skin its own resistance and that of the contact in series
            let across = |resistance: f64| 1.0 / (1.0 / m.conductivity + resistance / crate::layout::CONTACT_SKIN);
            match region {
                Region::Contact => k[(0, 0)] = across(heat.hub_resistance),
                Region::LeftContact => k[(1, 1)] = across(heat.flange_resistance(Side::Left)),
                Region::RightContact => k[(1, 1)] = across(heat.flange_resistance(Side::Right)),
                _ => {}
            }
            Some((k, m.density * m.specific_heat))
        }
    }
}

const REGIONS: [Region; Region::COUNT] = [
    Region::Coil,
    Region::Hub,
    Region::LeftFlange,
    Region::RightFlange,
    Region::Contact,
    Region::LeftContact,
    Region::RightContact,
    Region::Medium,
];

/// Per region number: conductivity and capacity.
type Laws = Vec<Option<DMatrix<f64>>>;

fn laws(design: &Design) -> (Laws, Laws) {
    let (mut conductivity, mut capacity) = (vec![None; Region::COUNT], vec![None; Region::COUNT]);
    for region in REGIONS {
        if let Some((k, c)) = properties(design, region) {
            conductivity[region as usize] = Some(k);
            capacity[region as usize] = Some(DMatrix::from_element(1, 1, c));
        }
    }
    (conductivity, capacity)
}

/// Drive of a node on the chamber wall, or `None` inside.
fn wall(layout: &Layout, drives: &[Drive], [r, y]: [f64; 2]) -> Option<Drive> {
    let end = |side: Side| if drives.contains(&Drive::EndWall(side)) { Drive::EndWall(side) } else { Drive::Chamber };
    let (chamber, at) = (layout.chamber, |x: f64, wall: f64| (x - wall).abs() < COINCIDENT);
    if at(y, chamber.y[0]) {
        Some(end(Side::Left))
    } else if at(y, chamber.y[1]) {
        Some(end(Side::Right))
    } else {
        at(r, chamber.r[1]).then_some(Drive::Chamber)
    }
}

/// Heat flow of a design whose drives grow as e^(rate t) together, with the chamber's wall and all mounts at 0: solved without a factor
/// of the whole, for a few right-hand sides.
pub(crate) struct Shifted {
    grid: Grid,
    map: DofMap,
}

impl Shifted {
    /// Meshes a layout of `design`.
    pub(crate) fn new(layout: &Layout, design: &Design, resolution: &MeshFineness) -> Result<Self, Error> {
        let domain = Domain::of_heat(design);
        let grid = Grid::new(layout, resolution, domain, Bonds::Closed)?;
        let nodes = grid.mesh().nodes().len();
        let mut constraints = Constraints::new(nodes);
        for (node, &place) in grid.mesh().nodes().iter().enumerate() {
            if domain == Domain::Chamber && wall(layout, &[], place).is_some() {
                constraints.hold(node).map_err(failed)?;
            }
        }
        let map = constraints.eliminate(&vec![true; nodes]);
        Ok(Self { grid, map })
    }

    /// The mesh.
    pub(crate) fn grid(&self) -> &Grid {
        &self.grid
    }

    /// (K + rate C)⁻¹ of heat loads at all nodes \[W\] → temperatures at all nodes \[K\].
    pub(crate) fn solve(&self, layout: &Layout, design: &Design, rate: f64, loads: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Error> {
        let mesh = self.grid.mesh();
        let problem = Problem::new(mesh, Form::AXISYMMETRIC_DIFFUSION, mesh.order() + 1);
        let (k, c) = laws(design);
        let edges: Vec<_> =
            surface_edges(design, layout, &self.grid, &[]).into_iter().map(|(e, edge, h, _)| (e, edge, h)).collect();
        let factor = problem.condense_shifted(&self.map, &k, &c, rate, &edges).map_err(failed)?;
        let loads: Vec<_> = loads.iter().map(|load| self.map.restrict(load)).collect();
        Ok(factor.solve(&loads).map_err(failed)?.iter().map(|x| self.map.expand(x)).collect())
    }
}

impl ThermalModel {
    /// Assembles and factorises. `drives` must hold [`Drive::Chamber`].
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn new(design: &Design, resolution: &MeshFineness, drives: &[Drive]) -> Result<Self, Error> {
        Self::on(&Layout::new(design)?, design, resolution, drives)
    }

    /// As [`Self::new`], on a layout of the design.
    pub(crate) fn on(layout: &Layout, design: &Design, resolution: &MeshFineness, drives: &[Drive]) -> Result<Self, Error> {
        if drives.first() != Some(&Drive::Chamber) {
            return Err(Error::Resolution("the first drive must be the chamber".into()));
        }
        let domain = Domain::of_heat(design);
        let grid = Grid::new(layout, resolution, domain, Bonds::Closed)?;
        let mesh = grid.mesh();
        let nodes = mesh.nodes().len();
        let all = Constraints::new(nodes).eliminate(&vec![true; nodes]);
        let on_wall: Vec<_> =
            mesh.nodes().iter().map(|&p| if domain == Domain::Chamber { wall(layout, drives, p) } else { None }).collect();
        let mut constraints = Constraints::new(nodes);
        for (node, _) in on_wall.iter().enumerate().filter(|(_, w)| w.is_some()) {
            constraints.hold(node).map_err(failed)?;
        }
        let map = constraints.eliminate(&vec![true; nodes]);
        let problem = Problem::new(mesh, Form::AXISYMMETRIC_DIFFUSION, mesh.order() + 1);
        let (k, c) = laws(design);
        let edges = surface_edges(design, layout, &grid, drives);
        let plain: Vec<_> = edges.iter().map(|(e, edge, h, _)| (*e, *edge, *h)).collect();
        let with_edges = |map: &DofMap| -> Result<SparseMatrix, Error> {
            let stiffness = problem.stiffness(map, &k).map_err(failed)?;
            Ok(SparseMatrix::combine(1.0, &stiffness, 1.0, &problem.edge_mass(map, &plain)))
        };
        let full = with_edges(&all)?;
        let conductivity = Factor::new(with_edges(&map)?).map_err(failed)?;
        let mut shapes = Vec::new();
        // a chamber, mounts included, at one temperature leaves that temperature everywhere: exact, no solve needed
        let alone = !drives.iter().any(|d| matches!(d, Drive::EndWall(_) | Drive::Mount(_)));
        for drive in drives {
            if alone && *drive == Drive::Chamber {
                shapes.push(vec![1.0; nodes]);
                continue;
            }
            let held: Vec<f64> = on_wall.iter().map(|w| f64::from(*w == Some(*drive))).collect();
            let mut load: Vec<f64> = full.multiply(&held).iter().map(|f| -f).collect();
            let at: Vec<_> = edges.iter().filter(|(_, _, _, d)| d == drive).map(|(e, edge, h, _)| (*e, *edge, *h)).collect();
            let source = problem.edge_mass(&all, &at).multiply(&vec![1.0; nodes]);
            load.iter_mut().zip(source).for_each(|(l, s)| *l += s);
            if *drive == Drive::Heaters {
                heat(design, mesh, &problem, &all, &mut load)?;
            }
            let inside = map.expand(&conductivity.solve(&[map.restrict(&load)]).map_err(failed)?[0]);
            shapes.push(inside.iter().zip(&held).map(|(i, h)| i + h).collect());
        }
        let capacity = problem.mass(&map, &c).map_err(failed)?;
        let everywhere = problem.mass(&all, &c).map_err(failed)?;
        let stored = shapes.iter().map(|shape: &Vec<f64>| map.restrict(&everywhere.multiply(shape))).collect();
        Ok(Self { grid, map, capacity, conductivity, drives: drives.to_vec(), shapes, stored })
    }

    /// The mesh.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Free unknowns: all nodes but those on the wall.
    pub fn map(&self) -> &DofMap {
        &self.map
    }

    /// Its drives, in the order of shapes and stored heats.
    pub fn drives(&self) -> &[Drive] {
        &self.drives
    }

    /// C on the free unknowns \[J/K\].
    pub fn capacity(&self) -> &SparseMatrix {
        &self.capacity
    }

    /// K on the free unknowns, factorised \[W/K\].
    pub fn conductivity(&self) -> &Factor {
        &self.conductivity
    }

    /// C φ_k on the free unknowns, the wall's nodes included in φ_k \[J per unit of drive\].
    pub fn stored(&self) -> &[Vec<f64>] {
        &self.stored
    }

    /// φ_k at all nodes, in the order of the drives \[K per unit of drive\].
    pub fn shapes(&self) -> &[Vec<f64>] {
        &self.shapes
    }
}

/// Element edges that exchange heat through a surface coefficient, with the drive at their other side.
fn surface_edges(design: &Design, layout: &Layout, grid: &Grid, drives: &[Drive]) -> Vec<(usize, Edge, f64, Drive)> {
    let mut edges = Vec::new();
    if let Some(film) = design.heat.film {
        // a gap is closed where it ends: a slit of 0.2 mm
        let of_solids = grid.free_edges().into_iter().filter(|(.., region)| *region != Region::Medium);
        edges.extend(of_solids.map(|(e, edge, _)| (e, edge, film, Drive::Chamber)));
    }
    for mount in &design.heat.mounts {
        let region = Region::end(design, mount.side);
        let Some(end) = layout.solids.iter().find(|s| s.region == region) else { continue };
        let (outer, wanted) = match mount.side {
            Side::Left => (end.y[0], Edge::EtaLow),
            Side::Right => (end.y[1], Edge::EtaHigh),
        };
        let own = Drive::Mount(mount.side);
        let drive = if drives.contains(&own) { own } else { Drive::Chamber };
        let on_face = |e: &usize| grid.regions()[*e] == region && grid.touches(*e, wanted, outer);
        edges.extend((0..grid.regions().len()).filter(on_face).map(|e| (e, wanted, mount.conductance, drive)));
    }
    edges
}

/// Adds the heaters' power to a load, spread evenly over their ends of the spool.
fn heat(design: &Design, mesh: &Mesh, problem: &Problem, all: &DofMap, load: &mut [f64]) -> Result<(), Error> {
    let volumes = problem.region_measures().map_err(failed)?;
    for heater in &design.heat.heaters {
        let region = Region::end(design, heater.side) as usize;
        let mut density = vec![None; Region::COUNT];
        density[region] = Some(DMatrix::from_element(1, 1, heater.power / volumes[region]));
        let source = problem.mass(all, &density).map_err(failed)?.multiply(&vec![1.0; mesh.nodes().len()]);
        load.iter_mut().zip(source).for_each(|(l, s)| *l += s);
    }
    Ok(())
}
