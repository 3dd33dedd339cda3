//! Shape of the mesh: areas, circles, orientation, conformity.

use crate::common::{Case, EXTENTS, any_case, on_hexagon, polar};
use fem_core::{Form, Mesh, Problem};
use proptest::prelude::*;
use rve_mesh::{CellMesh, Extent, LatticeCell, Packing, Resolution};
use std::collections::HashMap;

fn areas(mesh: &CellMesh) -> Result<Vec<f64>, fem_core::Error> {
    let mesh = Mesh::new(mesh.order, mesh.nodes.clone(), mesh.elements.clone(), mesh.phases.clone())?;
    Problem::new(&mesh, Form::DIFFUSION, mesh.order() + 2).region_measures()
}

fn share(extent: Extent) -> f64 {
    match extent {
        Extent::Whole => 1.0,
        Extent::Quarter => 0.25,
    }
}

fn reference(order: usize, sectors: usize) -> Case {
    Case {
        cell: LatticeCell::hexagonal(170e-6, vec![40e-6, 56e-6, 82.5e-6]).expect("a cell"),
        resolution: Resolution { sectors, grading: 1.3, across: vec![1, 2, 1, 1] },
        order,
    }
}

/// Largest relative deviation of a phase's meshed area from π (R² − r²), or from what the circles leave of the hexagon.
fn area_error(case: &Case, extent: Extent) -> f64 {
    let meshed = areas(&case.mesh(extent)).expect("right-handed elements");
    let exact = case.cell.phase_areas();
    assert_eq!(meshed.len(), exact.len());
    meshed.iter().zip(exact).fold(0.0, |m: f64, (a, e)| m.max((a / (e * share(extent)) - 1.0).abs()))
}

#[test]
fn exact_phase_areas_follow_from_the_circles() {
    let areas = reference(1, 1).cell.phase_areas();
    let pi = std::f64::consts::PI;
    let rings = [1600.0 * pi, (3136.0 - 1600.0) * pi, (6806.25 - 3136.0) * pi, 28900.0 * 0.75_f64.sqrt() - 6806.25 * pi];
    for (area, exact) in areas.iter().zip(rings) {
        assert!((area / (exact * 1e-12) - 1.0).abs() < 1e-13);
    }
    assert!((areas[0] / reference(1, 1).cell.area() - 0.2008).abs() < 5e-5, "silica fraction of Table I");
}

/// An arc of 15° of order p misses its circle by about (15°)^(2p) / (2p)!; the thin film multiplies that.
#[test]
fn exact_areas_converge_to_the_circles_with_the_order() {
    for extent in EXTENTS {
        let errors: Vec<f64> = [1, 2, 4, 6, 8].iter().map(|&order| area_error(&reference(order, 2), extent)).collect();
        assert!(errors[0] > 1e-2, "straight edges cut corners: {errors:?}");
        for (error, bound) in errors[1..].iter().zip([1e-3, 1e-7, 1e-11, 1e-12]) {
            assert!(*error < bound, "{errors:?}");
        }
    }
}

#[test]
fn exact_counts_of_elements_and_nodes() {
    let case = reference(3, 2);
    for (extent, wedges) in [(Extent::Whole, 12), (Extent::Quarter, 3)] {
        let mesh = case.mesh(extent);
        assert_eq!(mesh.elements.len(), wedges * 2 * 5);
        let rays = wedges * 2 * 3 + usize::from(extent == Extent::Quarter);
        assert_eq!(mesh.nodes.len(), 1 + rays * 5 * 3);
        assert!(mesh.elements.iter().all(|e| e.len() == 16) && mesh.order == 3);
        let per_phase: Vec<usize> = (0..4).map(|p| mesh.phases.iter().filter(|q| **q == p).count()).collect();
        assert_eq!(per_phase, [1, 2, 1, 1].map(|n| n * wedges * 2));
    }
}

/// Ring of nodes (radial position) at which each phase ends.
fn ends(case: &Case) -> Vec<usize> {
    let ends = case.resolution.across.iter().scan(0, |sum, n| {
        *sum += n * case.order;
        Some(*sum)
    });
    ends.collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// All interface nodes on their circle, all outer nodes on the hexagon, to rounding.
    #[test]
    fn exact_nodes_lie_on_circles_and_on_the_hexagon(case in any_case(1..=8)) {
        for extent in EXTENTS {
            let mesh = case.mesh(extent);
            let rays = (mesh.nodes.len() - 1) / ends(&case).last().expect("phases");
            prop_assert_eq!(mesh.nodes[0], [0.0, 0.0]);
            for (phase, end) in ends(&case).into_iter().enumerate() {
                for node in &mesh.nodes[1 + (end - 1) * rays..1 + end * rays] {
                    match case.cell.radii().get(phase) {
                        Some(radius) => prop_assert!((polar(*node).0 / radius - 1.0).abs() < 1e-14),
                        None => prop_assert!(on_hexagon(*node, case.cell.pitch())),
                    }
                }
            }
        }
    }

    /// Right-handed at every quadrature point (or the areas would be refused), phases of the right size.
    #[test]
    fn exact_elements_are_right_handed_and_fill_their_phase(case in any_case(4..=8)) {
        for extent in EXTENTS {
            let error = area_error(&case, extent);
            prop_assert!(error < 2e-3, "{:e}", error);
            let total: f64 = areas(&case.mesh(extent)).unwrap().iter().sum();
            prop_assert!((total / (case.cell.area() * share(extent)) - 1.0).abs() < 1e-12, "the hexagon's sides are straight");
        }
    }

    /// Every element edge belongs to two elements that agree on its nodes, or lies on the outline.
    #[test]
    fn exact_neighbours_share_all_nodes_of_their_edge(case in any_case(1..=4)) {
        for extent in EXTENTS {
            let (mesh, p) = (case.mesh(extent), case.order);
            let mut edges: HashMap<Vec<usize>, usize> = HashMap::new();
            for element in &mesh.elements {
                for side in 0..4 {
                    let at = |k: usize| element[[k, p * (p + 1) + k, k * (p + 1), k * (p + 1) + p][side]];
                    let mut nodes: Vec<usize> = (0..=p).map(at).collect();
                    nodes.sort_unstable();
                    if nodes[0] != nodes[p] {
                        *edges.entry(nodes).or_default() += 1;
                    }
                }
            }
            for (nodes, count) in edges {
                let outline = nodes.iter().all(|n| on_hexagon(mesh.nodes[*n], case.cell.pitch()))
                    || (extent == Extent::Quarter
                        && [0, 1].iter().any(|c| nodes.iter().all(|n| mesh.nodes[*n][*c].abs() < 1e-15 * case.cell.pitch())));
                prop_assert_eq!(count, if outline { 1 } else { 2 });
            }
        }
    }
}

/// The square cell: areas, right-handed elements, and boundary nodes related as its lattice demands.
#[test]
fn exact_square_cell() {
    let cell = LatticeCell::new(Packing::Square, 2.0, vec![0.4, 0.9]).expect("a cell");
    for extent in EXTENTS {
        let case =
            Case { cell: cell.clone(), resolution: Resolution { sectors: 2, grading: 1.3, across: vec![1, 1, 1] }, order: 8 };
        assert!(area_error(&case, extent) < 1e-11);
        let CellMesh { nodes, symmetry, .. } = case.mesh(extent);
        let on = |claim: &dyn Fn([f64; 2]) -> bool| (0..nodes.len()).filter(|n| claim(nodes[*n])).count();
        let close = |a: f64, b: f64| (a - b).abs() < 1e-13;
        if extent == Extent::Quarter {
            for (mirror, axis) in [(&symmetry.mirror_x, 0), (&symmetry.mirror_y, 1)] {
                assert!(mirror.iter().all(|n| close(nodes[*n][axis], 0.0) || close(nodes[*n][axis], 1.0)));
                let distinct: std::collections::HashSet<_> = mirror.iter().collect();
                assert_eq!(distinct.len(), on(&|p| close(p[axis], 0.0) || close(p[axis], 1.0)));
            }
            assert!(symmetry.inversions.is_empty() && symmetry.translations.is_empty());
        } else {
            let translated = |[a, b]: &[usize; 2]| [0, 1].map(|c| (nodes[*a][c] - nodes[*b][c]).abs());
            assert!(symmetry.translations.iter().map(translated).all(|[x, y]| close(x.max(y), 2.0) && close(x.min(y), 0.0)));
            let paired: std::collections::HashSet<_> = symmetry.translations.iter().flatten().collect();
            assert_eq!(paired.len(), on(&|p| close(p[0].abs().max(p[1].abs()), 1.0)));
        }
    }
}
