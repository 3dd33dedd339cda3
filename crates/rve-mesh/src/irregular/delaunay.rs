//! Triangulation of the periodic plane outside the inclusions: the only module that names the triangulation library.

use super::LayoutError;
use super::arrange::SplitMix64;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};
use std::ops::Range;

/// A point of the torus in one of its copies: number and shift.
pub(super) type Corner = (usize, [i32; 2]);

/// Width over which cells are repeated around the one that is kept.
const REACH: i32 = 2;
/// Points are displaced by this fraction of the cell's width, all copies alike: points on a common circle, which regular lattices have,
/// are then connected alike in all copies.
const DISPLACEMENT: f64 = 1e-8;

/// Points outside inclusions, and those that lie in a row around each inclusion.
pub(super) struct Points<'a> {
    pub(super) positions: &'a [[f64; 2]],
    pub(super) loops: &'a [Range<usize>],
    pub(super) lattice: [[f64; 2]; 2],
}

impl Points<'_> {
    /// Position of a corner \[m\].
    pub(super) fn at(&self, (point, [i, j]): Corner) -> [f64; 2] {
        let p = self.positions[point];
        [0, 1].map(|c| p[c] + f64::from(i) * self.lattice[0][c] + f64::from(j) * self.lattice[1][c])
    }

    fn area(&self) -> f64 {
        self.lattice[0][0] * self.lattice[1][1] - self.lattice[0][1] * self.lattice[1][0]
    }

    fn inside_one_loop(&self, corners: &[Corner; 3]) -> bool {
        let shared = self.loops.iter().any(|l| corners.iter().all(|c| l.contains(&c.0)));
        shared && corners.iter().all(|c| c.1 == corners[0].1)
    }

    /// The triangles outside the inclusions, counter-clockwise, each once: its least corner is in the cell itself.
    pub(super) fn triangulate(&self) -> Result<Vec<[Corner; 3]>, LayoutError> {
        let width = self.area().sqrt();
        let mut corners = Vec::new();
        let (mut vertices, mut edges) = (Vec::new(), Vec::new());
        for shift in (-REACH..=REACH).flat_map(|i| (-REACH..=REACH).map(move |j| [i, j])) {
            let start = vertices.len();
            for point in 0..self.positions.len() {
                let p = self.at((point, shift));
                let moved = |c: usize| DISPLACEMENT * (SplitMix64::new((2 * point + c) as u64).unit() - 0.5);
                let [x, y] = [0, 1].map(|c| p[c] / width + moved(c));
                vertices.push(Vertex { place: Point2::new(x, y) });
                corners.push((point, shift));
            }
            for range in self.loops {
                let next = |k: usize| if k + 1 == range.end { range.start } else { k + 1 };
                edges.extend(range.clone().map(|k| [start + k, start + next(k)]));
            }
        }
        let failed = |detail: &str| LayoutError::Triangulation(detail.into());
        let mut conflicts = 0;
        let mesh = ConstrainedDelaunayTriangulation::<Vertex>::try_bulk_load_cdt(vertices, edges, |_| conflicts += 1)
            .map_err(|error| LayoutError::Triangulation(error.to_string()))?;
        if conflicts > 0 || mesh.num_vertices() != corners.len() {
            return Err(failed("outlines cross; move the inclusions apart"));
        }
        let mut triangles = Vec::new();
        for face in mesh.inner_faces() {
            let mut triangle = face.vertices().map(|v| corners[v.fix().index()]);
            let least = (0..3).min_by_key(|&k| triangle[k]).unwrap_or(0);
            triangle.rotate_left(least);
            if triangle[0].1 == [0, 0] && !self.inside_one_loop(&triangle) {
                triangles.push(triangle);
            }
        }
        triangles.sort_unstable();
        self.check(&triangles)?;
        Ok(triangles)
    }

    /// The triangles and the polygons they surround must fill the cell.
    fn check(&self, triangles: &[[Corner; 3]]) -> Result<(), LayoutError> {
        let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let polygon = |points: &[[f64; 2]]| -> f64 {
            let o = points[0];
            let from = |p: [f64; 2]| [p[0] - o[0], p[1] - o[1]];
            points.windows(2).map(|w| cross(from(w[0]), from(w[1])) / 2.0).sum()
        };
        let inclusions: f64 = self.loops.iter().map(|l| polygon(&self.positions[l.clone()])).sum();
        let matrix: f64 = triangles.iter().map(|t| polygon(&t.map(|c| self.at(c)))).sum();
        let share = (inclusions + matrix) / self.area();
        if (share - 1.0).abs() < 1e-6 {
            return Ok(());
        }
        Err(LayoutError::Triangulation(format!("the triangles fill {share:.6} of the cell")))
    }
}

struct Vertex {
    place: Point2<f64>,
}

impl HasPosition for Vertex {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        self.place
    }
}
