//! Elements between curves: rings between rays, wedges of the matrix.

use super::delaunay::{Corner, Points};
use super::fill::Matrix;
use super::spacing::divisions;
use super::{Inclusion, Layout, LayoutError};
use std::collections::HashMap;

/// A curved mesh of a periodic cell.
///
/// Element node (i, j), i from the inner to the outer curve and j along them counter-clockwise, is `elements[e][j * (order + 1) + i]`.
/// Where the inner curve is a point (the middle of a fibre, the apex of a wedge) its nodes are all the same.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicMesh {
    /// Polynomial order of the elements.
    pub order: usize,
    /// Positions \[m\].
    pub nodes: Vec<[f64; 2]>,
    /// (order + 1)² node numbers each.
    pub elements: Vec<Vec<usize>>,
    /// Phase of each element.
    pub phases: Vec<usize>,
    /// Inclusion each element belongs to, none in the matrix.
    pub inclusions: Vec<Option<usize>>,
    /// Centre of each inclusion's innermost outline \[m\].
    pub centres: Vec<[f64; 2]>,
    /// Pairs of a node and another that is the same by periodicity.
    pub periodic: Vec<[usize; 2]>,
    /// Lattice vectors \[m\].
    pub lattice: [[f64; 2]; 2],
    /// Exact area of each phase \[m²\].
    pub phase_areas: Vec<f64>,
}

/// Nodes on the torus and the elements made of their copies.
struct Builder<'a> {
    layout: &'a Layout,
    /// positions on [0, 1] of an element's nodes along an edge
    fractions: Vec<f64>,
    /// position of each node in its own cell
    home: Vec<[f64; 2]>,
    /// edges of triangles: end points, shift of the second to the first
    edges: HashMap<(usize, usize, [i32; 2]), Vec<usize>>,
    elements: Vec<(Vec<Corner>, usize, Option<usize>)>,
}

/// Meshes the cell.
///
/// `lattice` holds the positions on [−1, 1] of an element's nodes along an edge, ends included, as for the regular cell. `fineness` 1 is
/// standard: two divisions in the length over which the film between two fibres widens; 2 has twice as many along every curve.
///
/// # Errors
/// [`LayoutError::Resolution`] if `fineness` is outside 0.5 … 8 or `lattice` does not increase from −1 to 1;
/// [`LayoutError::Triangulation`].
pub fn periodic_mesh(layout: &Layout, fineness: f64, lattice: &[f64]) -> Result<PeriodicMesh, LayoutError> {
    let ends = lattice.len() >= 2 && lattice[0] == -1.0 && lattice[lattice.len() - 1] == 1.0;
    if !ends || !lattice.windows(2).all(|w| w[0] < w[1]) {
        return Err(LayoutError::Resolution(format!("the element lattice must increase from -1 to 1, it is {lattice:?}")));
    }
    if !(0.5..=8.0).contains(&fineness) {
        return Err(LayoutError::Resolution(format!("fineness {fineness} must be between 0.5 and 8")));
    }
    let divisions: Vec<_> = (0..layout.inclusions().len()).map(|i| divisions(layout, i, fineness)).collect();
    let matrix = Matrix::new(layout, &divisions)?;
    let fractions = lattice.iter().map(|x| (1.0 + x) / 2.0).collect();
    let mut builder = Builder { layout, fractions, home: Vec::new(), edges: HashMap::new(), elements: Vec::new() };
    let hulls: Vec<_> =
        layout.inclusions().iter().zip(&divisions).enumerate().map(|(i, (inc, d))| builder.inclusion(i, inc, d)).collect();
    builder.matrix(&matrix, &hulls);
    Ok(builder.finish())
}

impl Builder<'_> {
    fn order(&self) -> usize {
        self.fractions.len() - 1
    }

    fn node(&mut self, position: [f64; 2]) -> usize {
        self.home.push(position);
        self.home.len() - 1
    }

    /// Meshes an inclusion; returns the nodes of its hull.
    fn inclusion(&mut self, number: usize, inclusion: &Inclusion, divisions: &[f64]) -> Vec<usize> {
        let parameters: Vec<f64> = divisions
            .windows(2)
            .flat_map(|w| self.fractions[1..].iter().map(|f| w[0] + f * (w[1] - w[0])).collect::<Vec<_>>())
            .collect();
        // the end of each division comes last, the start of the first is the end of the last
        let count = parameters.len();
        let fractions = self.fractions.clone();
        let mut inner: Option<Vec<usize>> = None;
        for (ring, (outline, phase)) in inclusion.outlines.iter().zip(&inclusion.phases).enumerate() {
            let inside = |t: f64| if ring == 0 { outline.centre } else { inclusion.outlines[ring - 1].point(t) };
            let mut levels = vec![inner.unwrap_or_default()];
            if ring == 0 && phase.is_some() {
                levels[0] = vec![self.node(outline.centre); count];
            }
            // an empty disc has nodes on its outline only
            let across = if phase.is_some() { &fractions[1..] } else { &fractions[fractions.len() - 1..] };
            for f in across {
                let position = |&t: &f64| {
                    let (a, b) = (inside(t), outline.point(t));
                    [0, 1].map(|c| a[c] + f * (b[c] - a[c]))
                };
                levels.push(parameters.iter().map(|t| self.node(position(t))).collect());
            }
            if let Some(phase) = phase {
                self.rows(&levels, *phase, number);
            }
            inner = levels.pop();
        }
        inner.unwrap_or_default()
    }

    /// Elements between closed levels of nodes.
    fn rows(&mut self, levels: &[Vec<usize>], phase: usize, inclusion: usize) {
        let (order, count) = (self.order(), levels[0].len());
        for first in (0..count).step_by(order) {
            let along = |j: usize| (first + j + count - 1) % count;
            let corners = (0..=order).flat_map(|j| (0..=order).map(move |i| (i, j))).map(|(i, j)| (levels[i][along(j)], [0, 0]));
            self.elements.push((corners.collect(), phase, Some(inclusion)));
        }
    }

    fn matrix(&mut self, matrix: &Matrix, hulls: &[Vec<usize>]) {
        let order = self.order();
        let points = Points { positions: &matrix.positions, loops: &matrix.loops, lattice: self.layout.lattice() };
        // node of each point
        let mut nodes: Vec<usize> = Vec::new();
        for (range, hull) in matrix.loops.iter().zip(hulls) {
            nodes.extend((0..range.len()).map(|k| hull[(k * order + hull.len() - 1) % hull.len()]));
        }
        for position in &matrix.positions[nodes.len()..] {
            nodes.push(self.node(*position));
        }
        for triangle in &matrix.triangles {
            let arc = (0..3).find_map(|k| {
                let arc = self.arc(matrix, hulls, triangle[(k + 1) % 3], triangle[(k + 2) % 3])?;
                Some((k, arc))
            });
            let apex = arc.as_ref().map_or(0, |(k, _)| *k);
            let [a, b, c] = [0, 1, 2].map(|k| triangle[(apex + k) % 3]);
            let base = arc.map_or_else(|| self.edge(&points, &nodes, b, c), |(_, arc)| arc);
            let (low, high) = (self.edge(&points, &nodes, a, b), self.edge(&points, &nodes, a, c));
            self.wedge((nodes[a.0], a.1), &low, &high, &base);
        }
    }

    /// Nodes from `b` to `c` along the hull they are neighbours on, clockwise around it.
    fn arc(&self, matrix: &Matrix, hulls: &[Vec<usize>], b: Corner, c: Corner) -> Option<Vec<Corner>> {
        let (range, hull) = matrix.loops.iter().zip(hulls).find(|(range, _)| range.contains(&b.0))?;
        if b.1 != c.1 || !range.contains(&c.0) || (c.0 - range.start + 1) % range.len() != b.0 - range.start {
            return None;
        }
        let (order, count) = (self.order(), hull.len());
        let start = (b.0 - range.start) * order + 2 * count - 1;
        Some((0..=order).map(|q| (hull[(start - q) % count], b.1)).collect())
    }

    /// Nodes of the straight edge from `b` to `c`, made when it is first asked for.
    fn edge(&mut self, points: &Points, nodes: &[usize], b: Corner, c: Corner) -> Vec<Corner> {
        let (from, to) = (b.min(c), b.max(c));
        let apart = [0, 1].map(|k| to.1[k] - from.1[k]);
        let key = (from.0, to.0, apart);
        if !self.edges.contains_key(&key) {
            let (p, q) = (points.at((from.0, [0, 0])), points.at((to.0, apart)));
            let inner: Vec<f64> = self.fractions[1..self.order()].to_vec();
            let made = inner.iter().map(|f| self.node([0, 1].map(|k| p[k] + f * (q[k] - p[k])))).collect();
            self.edges.insert(key, made);
        }
        let mut all = vec![(nodes[from.0], from.1)];
        all.extend(self.edges[&key].iter().map(|&node| (node, from.1)));
        all.push((nodes[to.0], to.1));
        if from != b {
            all.reverse();
        }
        all
    }

    /// A wedge of the matrix from its apex to its base, `low` and `high` the edges to the base's ends.
    fn wedge(&mut self, apex: Corner, low: &[Corner], high: &[Corner], base: &[Corner]) {
        let order = self.order();
        let middle = self.position(apex);
        let mut corners = Vec::with_capacity((order + 1) * (order + 1));
        for j in 0..=order {
            let outer = self.position(base[j]);
            for i in 0..=order {
                let fraction = self.fractions[i];
                corners.push(match (i, j) {
                    (0, _) => apex,
                    (_, 0) => low[i],
                    (_, j) if j == order => high[i],
                    (i, j) if i == order => base[j],
                    _ => (self.node([0, 1].map(|c| middle[c] + fraction * (outer[c] - middle[c]))), [0, 0]),
                });
            }
        }
        self.elements.push((corners, self.layout.matrix(), None));
    }

    fn position(&self, (node, shift): Corner) -> [f64; 2] {
        let by = self.layout.vector(shift);
        [self.home[node][0] + by[0], self.home[node][1] + by[1]]
    }

    /// Numbers the copies that elements use.
    fn finish(self) -> PeriodicMesh {
        let mut numbers = HashMap::new();
        let mut original = vec![None; self.home.len()];
        let (mut nodes, mut periodic) = (Vec::new(), Vec::new());
        let (mut elements, mut phases, mut inclusions) = (Vec::new(), Vec::new(), Vec::new());
        for (corners, phase, inclusion) in &self.elements {
            let mut number = |corner: &Corner| {
                *numbers.entry(*corner).or_insert_with(|| {
                    let new = nodes.len();
                    nodes.push(self.position(*corner));
                    match original[corner.0] {
                        None => original[corner.0] = Some(new),
                        Some(first) => periodic.push([new, first]),
                    }
                    new
                })
            };
            elements.push(corners.iter().map(&mut number).collect());
            phases.push(*phase);
            inclusions.push(*inclusion);
        }
        let (lattice, phase_areas) = (self.layout.lattice(), self.layout.phase_areas());
        let centres = self.layout.inclusions().iter().map(|i| i.outlines[0].centre).collect();
        let order = self.order();
        PeriodicMesh { order, nodes, elements, phases, inclusions, centres, periodic, lattice, phase_areas }
    }
}
