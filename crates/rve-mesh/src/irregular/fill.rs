//! Points of the matrix: on the outlines, and between them where these are far apart.

use super::delaunay::{Corner, Points};
use super::layout::shifts;
use super::{Layout, LayoutError};
use std::ops::Range;

/// Growth of the wanted edge length per distance from an outline.
const GROWTH: f64 = 0.4;
/// A triangle is too large if its circumscribed circle is larger than this many wanted edge lengths (0.58 if equilateral).
const LARGEST: f64 = 0.85;
/// New points stay this many wanted edge lengths from each other and from outlines.
const APART: f64 = 0.6;
/// Rounds of adding points; each halves what is too large.
const ROUNDS: usize = 40;

pub(super) struct Matrix {
    pub(super) positions: Vec<[f64; 2]>,
    /// Points of each inclusion's hull, in a row.
    pub(super) loops: Vec<Range<usize>>,
    pub(super) triangles: Vec<[Corner; 3]>,
}

impl Matrix {
    /// Triangulates the matrix between the hulls, divided at the parameters `divisions` of each inclusion.
    pub(super) fn new(layout: &Layout, divisions: &[Vec<f64>]) -> Result<Self, LayoutError> {
        let (mut positions, mut loops) = (Vec::new(), Vec::new());
        for (inclusion, ends) in layout.inclusions().iter().zip(divisions) {
            let first = positions.len();
            positions.extend(ends[..ends.len() - 1].iter().map(|&t| inclusion.hull().point(t)));
            loops.push(first..positions.len());
        }
        let size = Size::new(layout, &positions, &loops);
        for _ in 0..ROUNDS {
            let points = Points { positions: &positions, loops: &loops, lattice: layout.lattice() };
            let triangles = points.triangulate()?;
            let new = additions(layout, &points, &triangles, &size);
            if new.is_empty() {
                return Ok(Self { positions, loops, triangles });
            }
            positions.extend(new);
        }
        Err(LayoutError::Triangulation(format!("the triangles are still too large after {ROUNDS} rounds")))
    }
}

/// Wanted edge length as it grows from the outlines' divisions.
struct Size {
    /// middle and length of each division, in all cells around
    divisions: Vec<([f64; 2], f64)>,
}

impl Size {
    fn new(layout: &Layout, positions: &[[f64; 2]], loops: &[Range<usize>]) -> Self {
        let mut divisions = Vec::new();
        for range in loops {
            for k in range.clone() {
                let (p, q) = (positions[k], positions[if k + 1 == range.end { range.start } else { k + 1 }]);
                let length = (p[0] - q[0]).hypot(p[1] - q[1]);
                for by in shifts(1).map(|s| layout.vector(s)) {
                    divisions.push(([0, 1].map(|c| (p[c] + q[c]) / 2.0 + by[c]), length));
                }
            }
        }
        Self { divisions }
    }

    fn at(&self, p: [f64; 2]) -> f64 {
        let from = |(m, length): &([f64; 2], f64)| length + GROWTH * (p[0] - m[0]).hypot(p[1] - m[1]);
        self.divisions.iter().map(from).fold(f64::INFINITY, f64::min)
    }
}

/// Centres of the circles around triangles that are too large, the largest first, none too close to another point.
fn additions(layout: &Layout, points: &Points, triangles: &[[Corner; 3]], size: &Size) -> Vec<[f64; 2]> {
    let mut large = Vec::new();
    for triangle in triangles {
        let (centre, radius) = circle(triangle.map(|c| points.at(c)));
        let wanted = size.at(centre);
        if radius > LARGEST * wanted && is_clear(layout, centre, APART * wanted) {
            large.push((radius / wanted, centre, wanted));
        }
    }
    large.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1[0].total_cmp(&b.1[0])));
    let mut new: Vec<[f64; 2]> = Vec::new();
    for (_, centre, wanted) in large {
        let far = |p: &[f64; 2]| {
            shifts(1).all(|s| {
                let by = layout.vector(s);
                (p[0] + by[0] - centre[0]).hypot(p[1] + by[1] - centre[1]) > APART * wanted
            })
        };
        if new.iter().all(far) {
            new.push(centre);
        }
    }
    new
}

/// Whether `p` is in the matrix and further than `distance` from all inclusions.
fn is_clear(layout: &Layout, p: [f64; 2], distance: f64) -> bool {
    layout.inclusions().iter().all(|inclusion| {
        shifts(2).all(|s| {
            let hull = inclusion.hull().moved(layout.vector(s));
            let apart = (p[0] - hull.centre[0]).hypot(p[1] - hull.centre[1]);
            apart - hull.reach() > distance || hull.nearest(p).0 > distance
        })
    })
}

/// Centre and radius of the circle through three points.
fn circle([a, b, c]: [[f64; 2]; 3]) -> ([f64; 2], f64) {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let d = 2.0 * (u[0] * v[1] - u[1] * v[0]);
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    let [x, y] = [(v[1] * uu - u[1] * vv) / d, (u[0] * vv - v[0] * uu) / d];
    ([a[0] + x, a[1] + y], x.hypot(y))
}
