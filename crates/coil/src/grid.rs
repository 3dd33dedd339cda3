//! Tensor-product meshes of the half-plane, graded towards the edges of the coil where bonded materials make stresses singular.

use crate::layout::{CONTACT_SKIN, Domain, Layout, Region};
use crate::{Error, Side};
use fem_core::polynomial::{Lagrange, gauss_lobatto};
use fem_core::{Edge, Measure, Mesh, ReferenceElement};
use std::collections::HashMap;

/// Order and grading of a coil mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MeshFineness {
    /// Polynomial order of the elements, 1 to 20.
    pub order: usize,
    /// Geometric layers towards each edge of the coil, 0 to 20.
    pub layers: usize,
    /// Each layer's width as a fraction of the next one's distance from the edge, in 0.05 … 0.7.
    pub ratio: f64,
}

/// Whether a bond that can open is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Bonds {
    /// All bonds hold.
    Closed,
    /// The bond that can open is open.
    Opened,
}

/// Grading of a mesh on either side of an edge of the coil.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Grading {
    /// As many layers everywhere.
    Even,
    /// The grading that the coil's strain needs: the finest elements are as wide along the coil's long side as along its short one, where the
    /// resolution's layers are, and one layer wider in the spool, which is much the stiffer.
    Strain,
}

/// A tensor-product mesh with its element lines.
#[derive(Debug, Clone)]
pub struct Grid {
    mesh: Mesh,
    basis: Lagrange,
    regions: Vec<Region>,
    r_lines: Vec<f64>,
    y_lines: Vec<f64>,
    /// element number of each grid cell, column by column, if it is meshed
    cells: Vec<Option<usize>>,
    /// place of each node in the lattice: column + row × columns of nodes
    places: Vec<usize>,
}

/// Two lines closer than this are one \[m\]: far below any dimension a coil is made to.
pub(crate) const COINCIDENT: f64 = 1e-9;

/// One-dimensional shape functions at a coordinate, in one column or row of a grid.
#[derive(Debug, Clone)]
pub(crate) struct Along {
    /// Number of the column or row.
    pub(crate) cell: usize,
    /// Values.
    pub(crate) value: Vec<f64>,
    /// Derivatives along the coordinate \[1/m\].
    pub(crate) slope: Vec<f64>,
}

/// Intervals between lines that hold `x`, with its reference coordinate in each.
fn intervals(lines: &[f64], x: f64) -> Vec<(usize, f64)> {
    let holds = |k: &usize| lines[*k] - COINCIDENT <= x && x <= lines[*k + 1] + COINCIDENT;
    let local = |k: usize| (k, 2.0 * (x - lines[k]) / (lines[k + 1] - lines[k]) - 1.0);
    (0..lines.len() - 1).filter(holds).map(local).collect()
}

/// Sorted positions without repetitions.
pub(crate) fn distinct(mut positions: Vec<f64>) -> Vec<f64> {
    positions.sort_by(f64::total_cmp);
    positions.dedup_by(|a, b| (*a - *b).abs() < COINCIDENT);
    positions
}

/// Fractions of an interval, graded towards the ends that are marked.
fn fractions(layers: usize, ratio: f64, ends: [bool; 2]) -> Vec<f64> {
    let towards_zero = |width: f64| (0..layers).rev().map(move |k| width * ratio.powi(k as i32 + 1));
    match ends {
        [false, false] => vec![0.0],
        [true, false] => [0.0].into_iter().chain(towards_zero(1.0)).collect(),
        [false, true] => {
            let mut f: Vec<f64> = towards_zero(1.0).map(|x| 1.0 - x).collect();
            f.reverse();
            [0.0].into_iter().chain(f).collect()
        }
        [true, true] if layers == 0 => vec![0.0],
        [true, true] => {
            let low: Vec<f64> = [0.0].into_iter().chain(towards_zero(0.5)).collect();
            let high: Vec<f64> = low[1..].iter().rev().map(|x| 1.0 - x).collect();
            low.into_iter().chain([0.5]).chain(high).collect()
        }
    }
}

/// Element lines between `breaks`, graded towards `edges`; in a chamber the first and last interval are medium, graded towards the solids,
/// at whose corners the flow of heat is singular (without it the ramp lag is 0.2 % off, with it 3e-5).
///
/// With a `finest` width each edge gets the layers that reach it in the `coil`, and a width one layer wider beside it, in place of as
/// many layers everywhere.
fn lines(
    breaks: &[f64],
    edges: &[f64],
    coil: [f64; 2],
    domain: Domain,
    resolution: &MeshFineness,
    finest: Option<f64>,
) -> Vec<f64> {
    let edge = |x: f64| edges.iter().any(|e| (e - x).abs() < COINCIDENT);
    let medium = |i: usize| domain == Domain::Chamber && (i == 0 || i + 2 == breaks.len());
    let mut lines = Vec::new();
    for (i, w) in breaks.windows(2).enumerate() {
        let width = w[1] - w[0];
        let ends = [edge(w[0]) || (medium(i) && i > 0), edge(w[1]) || (medium(i) && i == 0)];
        let (layers, ratio) = match finest {
            // a skin is one element thick
            _ if width < 2.0 * CONTACT_SKIN => (0, resolution.ratio),
            None => (resolution.layers, resolution.ratio),
            Some(finest) => {
                let inside = coil[0] < w[0] + COINCIDENT && w[1] < coil[1] + COINCIDENT;
                let finest = if inside { finest } else { finest / resolution.ratio };
                let room = if ends == [true, true] { width / 2.0 } else { width };
                let layers = ((finest / room).ln() / resolution.ratio.ln()).round().max(0.0);
                (layers as usize, (finest / room).powf(1.0 / layers.max(1.0)))
            }
        };
        lines.extend(fractions(layers, ratio, ends).iter().map(|f| w[0] + f * width));
    }
    lines.extend(breaks.last());
    lines
}

impl Grid {
    /// Meshes `domain` of `layout`.
    ///
    /// # Errors
    /// [`Error::Resolution`] if a number is out of range.
    pub fn new(layout: &Layout, resolution: &MeshFineness, domain: Domain, bonds: Bonds) -> Result<Self, Error> {
        Self::graded(layout, resolution, Grading::Even, domain, bonds)
    }

    /// As [`Self::new`], with a grading.
    pub(crate) fn graded(
        layout: &Layout,
        resolution: &MeshFineness,
        grading: Grading,
        domain: Domain,
        bonds: Bonds,
    ) -> Result<Self, Error> {
        let MeshFineness { order, layers, ratio } = *resolution;
        if !(1..=20).contains(&order) || layers > 20 || !(0.05..=0.7).contains(&ratio) {
            let given = format!("order {order}, {layers} layers, ratio {ratio}");
            return Err(Error::Resolution(format!("{given}; needs order 1 to 20, at most 20 layers, ratio 0.05 to 0.7")));
        }
        let rectangles = || layout.solids.iter().chain((domain == Domain::Chamber).then_some(&layout.chamber));
        let coil = layout.solids[0];
        let tip = layout.lasting_bond.map(|(_, r)| r);
        // the far side of a skin is as much of an edge as the near one
        let far = |region: Region| layout.solids.iter().find(|s| s.region == region);
        let skin = far(Region::Contact).map(|s| s.r[0]);
        let r_edges: Vec<f64> = coil.r.into_iter().chain(tip).chain(skin).collect();
        let (left, right) = (far(Region::LeftContact).map(|s| s.y[0]), far(Region::RightContact).map(|s| s.y[1]));
        let y_edges: Vec<f64> = coil.y.into_iter().chain(left).chain(right).collect();
        let short = (coil.r[1] - coil.r[0]).min(coil.y[1] - coil.y[0]);
        let finest = (grading == Grading::Strain).then(|| short / 2.0 * ratio.powi(layers as i32));
        // where a bond opens the stress is sharpest: with a layer more the effect of a short opening is 0.3 % off, without it 2.5 %
        let resolution = &MeshFineness { layers: layers + usize::from(tip.is_some()), ..*resolution };
        let r = distinct(rectangles().flat_map(|s| s.r).chain(tip).collect());
        let y = distinct(rectangles().flat_map(|s| s.y).collect());
        let r_lines = lines(&r, &r_edges, coil.r, domain, resolution, finest);
        let y_lines = lines(&y, &y_edges, coil.y, domain, resolution, finest);
        Self::on_lines(layout, order, r_lines, y_lines, domain, bonds)
    }

    fn on_lines(
        layout: &Layout,
        order: usize,
        r_lines: Vec<f64>,
        y_lines: Vec<f64>,
        domain: Domain,
        bonds: Bonds,
    ) -> Result<Self, Error> {
        let lattice = gauss_lobatto(order);
        let (columns, rows) = (r_lines.len() - 1, y_lines.len() - 1);
        let width = columns * order + 1;
        let along = |lines: &[f64], k: usize| {
            let cell = (k / order).min(lines.len() - 2);
            let xi = lattice[k - cell * order];
            if xi == 1.0 {
                // a + (b − a) is not always b
                return lines[cell + 1];
            }
            lines[cell] + (lines[cell + 1] - lines[cell]) * (1.0 + xi) / 2.0
        };
        let opened = |[r, y]: [f64; 2]| match (bonds, layout.lasting_bond) {
            (Bonds::Opened, Some((side, lasting))) => {
                let face = layout.solids[0].y[usize::from(side == Side::Right)];
                (y - face).abs() < COINCIDENT && r > lasting + COINCIDENT
            }
            _ => false,
        };
        // coil nodes on an opened bond are apart from the flange's: a second set of numbers
        let lattice_points = width * (rows * order + 1);
        let mut number = vec![usize::MAX; 2 * lattice_points];
        let (mut nodes, mut places, mut elements, mut regions) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut cells = vec![None; columns * rows];
        for (cell, slot) in cells.iter_mut().enumerate() {
            let (i, j) = (cell % columns, cell / columns);
            let middle = [(r_lines[i] + r_lines[i + 1]) / 2.0, (y_lines[j] + y_lines[j + 1]) / 2.0];
            let Some(region) = layout.region_in(domain, middle[0], middle[1]) else { continue };
            let mut element = Vec::with_capacity((order + 1) * (order + 1));
            for k in 0..(order + 1) * (order + 1) {
                let (a, b) = (i * order + k % (order + 1), j * order + k / (order + 1));
                let position = [along(&r_lines, a), along(&y_lines, b)];
                let apart = region == Region::Coil && opened(position);
                let node = &mut number[b * width + a + if apart { lattice_points } else { 0 }];
                if *node == usize::MAX {
                    *node = nodes.len();
                    nodes.push(position);
                    places.push(b * width + a);
                }
                element.push(*node);
            }
            *slot = Some(elements.len());
            elements.push(element);
            regions.push(region);
        }
        let codes = regions.iter().map(|r| *r as usize).collect();
        let mesh = Mesh::new(order, nodes, elements, codes).map_err(|source| Error::Solve { part: "structure", source })?;
        Ok(Self { mesh, basis: Lagrange::gauss_lobatto(order), regions, r_lines, y_lines, cells, places })
    }

    /// The mesh; its region numbers are `Region as usize`.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Region of each element.
    pub fn regions(&self) -> &[Region] {
        &self.regions
    }

    /// Elements that hold (r, y), with its reference coordinates (ξ, η) in each: one inside an element, two on a line, four on a
    /// corner, none outside the mesh.
    pub fn locate(&self, r: f64, y: f64) -> Vec<(usize, f64, f64)> {
        let (columns, rows) = (intervals(&self.r_lines, r), intervals(&self.y_lines, y));
        let hits = rows.iter().flat_map(|&(j, eta)| columns.iter().map(move |&(i, xi)| (i, j, xi, eta)));
        hits.filter_map(|(i, j, xi, eta)| Some((self.element(i, j)?, xi, eta))).collect()
    }

    /// Element lines along r and along y \[m\].
    pub(crate) fn lines(&self) -> [&[f64]; 2] {
        [&self.r_lines, &self.y_lines]
    }

    /// Place of each node in the lattice of nodes, whether all of it is meshed or not: column + row × columns of nodes.
    pub(crate) fn places(&self) -> &[usize] {
        &self.places
    }

    /// The element in a column (along r) and a row (along y) of the grid, if it is meshed.
    pub(crate) fn element(&self, column: usize, row: usize) -> Option<usize> {
        self.cells[row * (self.r_lines.len() - 1) + column]
    }

    /// Shape functions along r in the columns that hold `r`.
    pub(crate) fn columns(&self, r: f64) -> Vec<Along> {
        self.along(&self.r_lines, r)
    }

    /// Shape functions along y in the rows that hold `y`.
    pub(crate) fn rows(&self, y: f64) -> Vec<Along> {
        self.along(&self.y_lines, y)
    }

    fn along(&self, lines: &[f64], x: f64) -> Vec<Along> {
        let functions = |(cell, xi): (usize, f64)| {
            let (value, mut slope) = self.basis.evaluate(xi);
            slope.iter_mut().for_each(|d| *d *= 2.0 / (lines[cell + 1] - lines[cell]));
            Along { cell, value, slope }
        };
        intervals(lines, x).into_iter().map(functions).collect()
    }

    /// Slope of each shape function along a side of −1 … 1, at each node of the side.
    pub(crate) fn slopes(&self) -> Vec<Vec<f64>> {
        gauss_lobatto(self.mesh.order()).into_iter().map(|xi| self.basis.evaluate(xi).1).collect()
    }

    /// Element beside each meshed cell in a direction.
    fn neighbour(&self, cell: usize, edge: Edge) -> Option<usize> {
        let columns = self.r_lines.len() - 1;
        let (i, j) = (cell % columns, cell / columns);
        let beside = match edge {
            Edge::XiLow => (i > 0).then(|| cell - 1),
            Edge::XiHigh => (i + 1 < columns).then_some(cell + 1),
            Edge::EtaLow => (j > 0).then(|| cell - columns),
            Edge::EtaHigh => (cell + columns < self.cells.len()).then_some(cell + columns),
        };
        beside.and_then(|cell| self.cells[cell])
    }

    /// Edges without a neighbour, off the axis: (element, edge, region).
    pub(crate) fn free_edges(&self) -> Vec<(usize, Edge, Region)> {
        let mut edges = Vec::new();
        for (cell, element) in self.cells.iter().enumerate().filter_map(|(cell, e)| e.map(|e| (cell, e))) {
            for edge in [Edge::XiLow, Edge::XiHigh, Edge::EtaLow, Edge::EtaHigh] {
                let on_axis = edge == Edge::XiLow && self.r_lines[cell % (self.r_lines.len() - 1)] == 0.0;
                if self.neighbour(cell, edge).is_none() && !on_axis {
                    edges.push((element, edge, self.regions[element]));
                }
            }
        }
        edges
    }

    /// Whether an edge of an element lies on y = `at`.
    pub(crate) fn touches(&self, element: usize, edge: Edge, at: f64) -> bool {
        let nodes = &self.mesh.elements()[element];
        let corner = if edge == Edge::EtaHigh { nodes[nodes.len() - 1] } else { nodes[0] };
        (self.mesh.nodes()[corner][1] - at).abs() < COINCIDENT
    }

    /// For each node of this mechanical mesh the node of the thermal mesh at its place: the thermal mesh holds them all.
    pub(crate) fn shared_nodes(&self, thermal: &Grid) -> Result<Vec<usize>, Error> {
        // a tenth of a nanometre: far above rounding, far below any element
        let key = |p: [f64; 2]| p.map(|x| (x * 1e10).round() as i64);
        let index: HashMap<_, usize> = thermal.mesh.nodes().iter().enumerate().map(|(i, &p)| (key(p), i)).collect();
        let of = |p: &[f64; 2]| {
            let missing = || Error::Resolution(format!("the thermal mesh lacks the mechanical node at {p:?} m"));
            index.get(&key(*p)).copied().ok_or_else(missing)
        };
        self.mesh.nodes().iter().map(of).collect()
    }

    /// Mean over the coil's volume, as a functional of a nodal field.
    pub(crate) fn coil_mean(&self) -> Result<Vec<f64>, Error> {
        let mesh = &self.mesh;
        let reference = ReferenceElement::new(mesh.order(), mesh.order() + 1);
        let mut mean = vec![0.0; mesh.nodes().len()];
        for (e, _) in self.regions.iter().enumerate().filter(|(_, region)| **region == Region::Coil) {
            let geometry = reference.geometry(mesh, e, Measure::Revolution);
            let geometry = geometry.map_err(|source| Error::Solve { part: "structure", source })?;
            for (a, &node) in mesh.elements()[e].iter().enumerate() {
                mean[node] += reference.value.row(a).iter().zip(&geometry.weight).map(|(n, w)| n * w).sum::<f64>();
            }
        }
        let volume: f64 = mean.iter().sum();
        mean.iter_mut().for_each(|m| *m /= volume);
        Ok(mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_the_coil_s_mean_is_over_its_volume() {
        let [a, b] = [0.03, 0.05];
        let coil = crate::Rectangle { region: Region::Coil, r: [a, b], y: [0.0, 0.02] };
        let chamber = crate::Rectangle { region: Region::Medium, r: [0.0, 0.06], y: [-0.01, 0.03] };
        let layout = Layout { solids: vec![coil], chamber, bore: a, gaps: Vec::new(), lasting_bond: None };
        let resolution = MeshFineness { order: 3, layers: 1, ratio: 0.2 };
        let grid = Grid::new(&layout, &resolution, Domain::Chamber, Bonds::Closed).unwrap();
        let mean: f64 = grid.coil_mean().unwrap().iter().zip(grid.mesh().nodes()).map(|(m, [r, _])| m * r).sum();
        let exact = 2.0 / 3.0 * (b.powi(3) - a.powi(3)) / (b * b - a * a);
        assert!((mean / exact - 1.0).abs() < 1e-12, "{mean} against {exact}");
    }
}
