//! Cells that the tests share.

#![allow(dead_code, reason = "each test binary uses its part")]

use fem_core::polynomial::gauss_lobatto;
use proptest::prelude::*;
use rve_mesh::{CellMesh, Extent, LatticeCell, Resolution, mesh};

/// A cell with what it takes to mesh it.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) cell: LatticeCell,
    pub(crate) resolution: Resolution,
    pub(crate) order: usize,
}

impl Case {
    pub(crate) fn mesh(&self, extent: Extent) -> CellMesh {
        mesh(&self.cell, extent, &self.resolution, &gauss_lobatto(self.order)).expect("a valid resolution")
    }
}

pub(crate) const EXTENTS: [Extent; 2] = [Extent::Whole, Extent::Quarter];

/// Cells of one to five rings from hair-thin to nearly touching, any pitch, any grading, orders from `orders`.
pub(crate) fn any_case(orders: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = Case> {
    let rings = prop::collection::vec((1e-3..1.0_f64, 1_usize..=3), 1..=5);
    (rings, 1e-3..1.0_f64, 1e-6..1e-2_f64, (1_usize..=4, 0.4..2.5_f64, 1_usize..=2), orders).prop_map(
        |(rings, film, pitch, (sectors, grading, across_film), order)| {
            let total: f64 = rings.iter().map(|(width, _)| width).sum::<f64>() + film;
            let mut radius = 0.0;
            let grow = |(width, _): &(f64, usize)| {
                radius += width / total * pitch / 2.0;
                radius
            };
            let radii = rings.iter().map(grow).collect();
            let across = rings.iter().map(|(_, n)| *n).chain([across_film]).collect();
            Case {
                cell: LatticeCell::hexagonal(pitch, radii).expect("a valid cell"),
                resolution: Resolution { sectors, grading, across },
                order,
            }
        },
    )
}

/// The same relation for every node: its polar radius and angle.
pub(crate) fn polar([x, y]: [f64; 2]) -> (f64, f64) {
    (x.hypot(y), y.atan2(x))
}

/// Whether a point lies on the boundary of the hexagon of pitch `p`: its largest projection on the six sides' normals is p/2.
pub(crate) fn on_hexagon([x, y]: [f64; 2], p: f64) -> bool {
    let normal = |k: usize| (k as f64 * 60.0).to_radians();
    let reach = (0..6).map(|k| x * normal(k).cos() + y * normal(k).sin()).fold(f64::NEG_INFINITY, f64::max);
    (reach - p / 2.0).abs() < 1e-13 * p
}
