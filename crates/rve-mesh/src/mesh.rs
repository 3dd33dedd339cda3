//! Structured curved quadrilaterals between rays from the fibre axis.

use crate::{Error, LatticeCell, Packing};

/// Part of the hexagon or square that is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// All of it; opposite sides are translations of each other.
    Whole,
    /// The quarter x, y ≥ 0: mirror planes at x = 0, y = 0 and x = p/2, and for the hexagon the point symmetry of the lattice about
    /// the middle of the slanted side, for the square another mirror plane at y = p/2.
    Quarter,
}

/// Resolution of the cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolution {
    /// Elements per wedge between the film's narrowest part and the next corner (30° of the hexagon, 45° of the square), ≥ 1.
    pub sectors: usize,
    /// Their angles are `wedge (i / sectors)^grading` from the narrowest part: above 1 refines the thin film. In 0.2 … 5.
    pub grading: f64,
    /// Elements across each phase: the rings from the inside out, last the film. Each ≥ 1.
    pub across: Vec<usize>,
}

/// A curved, graded mesh of the cell with its symmetry.
///
/// Element node (i, j), i along the radius and j along the angle, is `elements[e][j * (order + 1) + i]`. The innermost ring's
/// elements are wedges whose inner edge is the fibre axis: all its nodes are node 0.
#[derive(Debug, Clone, PartialEq)]
pub struct CellMesh {
    /// Polynomial order of the elements.
    pub order: usize,
    /// Positions \[m\]; the fibre axis is the origin and node 0.
    pub nodes: Vec<[f64; 2]>,
    /// (order + 1)² node numbers each.
    pub elements: Vec<Vec<usize>>,
    /// Phase of each element: the rings from 0 inside, last the adhesive.
    pub phases: Vec<usize>,
    /// Relations of the boundary nodes by the lattice's symmetry.
    pub symmetry: Symmetry,
}

/// Boundary nodes that the lattice's symmetry relates.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Symmetry {
    /// Node pairs that differ by a lattice vector (whole cell).
    pub translations: Vec<[usize; 2]>,
    /// Node pairs that differ by a half turn about a lattice point of symmetry (quarter cell); the centre is paired with itself.
    pub inversions: Vec<[usize; 2]>,
    /// Nodes on mirror planes x = const (quarter cell).
    pub mirror_x: Vec<usize>,
    /// Nodes on mirror planes y = const (quarter cell).
    pub mirror_y: Vec<usize>,
}

/// Nodes on a grid of rays and rings. Ring 0 is the axis.
struct Grid {
    /// angles of the rays \[rad\] and direction of the cell's side they meet \[rad\]
    rays: Vec<(f64, f64)>,
    /// (phase, fraction across it), from the first ring outside the axis
    rings: Vec<(usize, f64)>,
    closed: bool,
}

impl Grid {
    fn node(&self, ray: usize, ring: usize) -> usize {
        if ring == 0 { 0 } else { 1 + (ring - 1) * self.rays.len() + if self.closed { ray % self.rays.len() } else { ray } }
    }

    fn positions(&self, cell: &LatticeCell) -> Vec<[f64; 2]> {
        let mut nodes = vec![[0.0, 0.0]];
        for &(phase, fraction) in &self.rings {
            let inner = if phase == 0 { 0.0 } else { cell.radii()[phase - 1] };
            for &(angle, side) in &self.rays {
                let outer = cell.radii().get(phase).copied().unwrap_or_else(|| cell.pitch() / 2.0 / (angle - side).cos());
                let r = inner + fraction * (outer - inner);
                nodes.push([r * angle.cos(), r * angle.sin()]);
            }
        }
        nodes
    }
}

/// More nodes than any computer solves for.
const MOST_NODES: f64 = 1e8;

fn check(cell: &LatticeCell, resolution: &Resolution, lattice: &[f64]) -> Result<(), Error> {
    let bad = |text: String| Err(Error::Resolution(text));
    let phases = cell.radii().len() + 1;
    if resolution.across.len() != phases || resolution.across.contains(&0) {
        return bad(format!("`across` must give a number of at least 1 for each of the {phases} phases"));
    }
    if resolution.sectors == 0 || !(0.2..=5.0).contains(&resolution.grading) {
        return bad(format!("{} sectors of grading {}; needs at least 1 and 0.2 to 5", resolution.sectors, resolution.grading));
    }
    let ends = lattice.len() >= 2 && lattice[0] == -1.0 && lattice[lattice.len() - 1] == 1.0;
    if !ends || lattice.windows(2).any(|w| w[0].partial_cmp(&w[1]) != Some(std::cmp::Ordering::Less)) {
        return bad(format!("the element lattice must increase from -1 to 1, it is {lattice:?}"));
    }
    let across: f64 = resolution.across.iter().map(|n| *n as f64).sum();
    let order = (lattice.len() - 1) as f64;
    let nodes = (2 * cell.packing().sides()) as f64 * resolution.sectors as f64 * across * order * order;
    if nodes > MOST_NODES {
        return bad(format!(
            "a whole cell of {nodes:.1e} nodes is too large; needs fewer sectors or elements across, {MOST_NODES:e} at most"
        ));
    }
    Ok(())
}

/// Angles of the element boundaries from a side's middle to the corner, in units of the wedge.
fn breaks(resolution: &Resolution) -> Vec<f64> {
    (0..=resolution.sectors).map(|i| (i as f64 / resolution.sectors as f64).powf(resolution.grading)).collect()
}

fn rays(packing: Packing, resolution: &Resolution, lattice: &[f64], extent: Extent) -> Vec<(f64, f64)> {
    let (wedges, closed) = match extent {
        Extent::Whole => (2 * packing.sides(), true),
        Extent::Quarter => (packing.sides() / 2, false),
    };
    let rising = breaks(resolution);
    let mut rays = Vec::new();
    for wedge in 0..wedges {
        let side = (2.0 * packing.wedge() * wedge.div_ceil(2) as f64).to_radians();
        for i in 0..resolution.sectors {
            // odd wedges run from a corner back to the narrowest part
            let (from, to) = if wedge % 2 == 0 {
                (rising[i], rising[i + 1])
            } else {
                (1.0 - rising[resolution.sectors - i], 1.0 - rising[resolution.sectors - i - 1])
            };
            let first = usize::from(!(rays.is_empty()));
            for xi in &lattice[first..] {
                let angle = (packing.wedge() * (wedge as f64 + from + (to - from) * (1.0 + xi) / 2.0)).to_radians();
                rays.push((angle, side));
            }
        }
    }
    if closed {
        rays.pop();
    }
    rays
}

fn rings(resolution: &Resolution, lattice: &[f64]) -> Vec<(usize, f64)> {
    let mut rings = Vec::new();
    for (phase, &divisions) in resolution.across.iter().enumerate() {
        for k in 0..divisions {
            rings.extend(lattice[1..].iter().map(|eta| (phase, (k as f64 + (1.0 + eta) / 2.0) / divisions as f64)));
        }
    }
    rings
}

fn symmetry(packing: Packing, grid: &Grid, extent: Extent) -> Symmetry {
    let outer = grid.rings.len();
    let sides = packing.sides();
    let mut symmetry = Symmetry::default();
    match extent {
        Extent::Whole => {
            let along = grid.rays.len() / sides;
            for side in 0..sides / 2 {
                for offset in 0..=along {
                    // a node `offset` past one end of a side meets the one as far before the other end of the opposite side
                    let here = grid.node(sides * along + side * along + offset - along / 2, outer);
                    let there = grid.node(sides * along + (side + sides / 2) * along + along / 2 - offset, outer);
                    symmetry.translations.push([here, there]);
                }
            }
        }
        Extent::Quarter => {
            let wedges = sides / 2;
            let along = (grid.rays.len() - 1) / wedges;
            symmetry.mirror_y = (0..=outer).map(|ring| grid.node(0, ring)).collect();
            symmetry.mirror_x = (0..=outer).map(|ring| grid.node(wedges * along, ring)).collect();
            symmetry.mirror_x.extend((0..=along).map(|ray| grid.node(ray, outer)));
            match packing {
                Packing::Hexagonal => {
                    let pair = |d: usize| [grid.node(2 * along - d, outer), grid.node(2 * along + d, outer)];
                    symmetry.inversions = (0..=along).map(pair).collect();
                }
                Packing::Square => symmetry.mirror_y.extend((along..=2 * along).map(|ray| grid.node(ray, outer))),
            }
        }
    }
    symmetry
}

/// Meshes the cell.
///
/// `lattice` holds the positions on [−1, 1] of an element's nodes along one edge, ends included; its length minus one is the
/// polynomial order (`[-1.0, 0.0, 1.0]` gives quadratic elements; Gauss–Lobatto points suit high orders). Every node of a
/// ring's edge lies on its circle to rounding.
///
/// # Errors
/// [`Error::Resolution`] if a number of divisions, the grading or the lattice is out of range, or the whole cell would have more than 10⁸ nodes.
pub fn mesh(cell: &LatticeCell, extent: Extent, resolution: &Resolution, lattice: &[f64]) -> Result<CellMesh, Error> {
    check(cell, resolution, lattice)?;
    let order = lattice.len() - 1;
    let closed = extent == Extent::Whole;
    let grid = Grid { rays: rays(cell.packing(), resolution, lattice, extent), rings: rings(resolution, lattice), closed };
    let sectors = (grid.rays.len() - usize::from(!closed)) / order;
    let (mut elements, mut phases) = (Vec::new(), Vec::new());
    for layer in 0..grid.rings.len() / order {
        for sector in 0..sectors {
            let node = |k: usize| grid.node(sector * order + k / (order + 1), layer * order + k % (order + 1));
            elements.push((0..(order + 1) * (order + 1)).map(node).collect());
            phases.push(grid.rings[layer * order].0);
        }
    }
    Ok(CellMesh { order, nodes: grid.positions(cell), elements, phases, symmetry: symmetry(cell.packing(), &grid, extent) })
}
