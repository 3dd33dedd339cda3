//! The relations between boundary nodes are those of the lattice.

use crate::common::{any_case, on_hexagon};
use proptest::prelude::*;
use rve_mesh::{CellMesh, Extent};
use std::collections::HashSet;

/// Outer nodes: those on the hexagon.
fn outer(mesh: &CellMesh, pitch: f64) -> HashSet<usize> {
    (0..mesh.nodes.len()).filter(|n| on_hexagon(mesh.nodes[*n], pitch)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// A pair differs by a lattice vector (p cos 60°k, p sin 60°k), and no boundary node is left without a partner.
    #[test]
    fn symmetry_translations_are_lattice_vectors_and_cover_the_boundary(case in any_case(1..=7)) {
        let (mesh, p) = (case.mesh(Extent::Whole), case.cell.pitch());
        let mut sides = HashSet::new();
        for [a, b] in &mesh.symmetry.translations {
            let [dx, dy] = [0, 1].map(|c| mesh.nodes[*a][c] - mesh.nodes[*b][c]);
            let vector = |k: &usize| {
                let (sin, cos) = (*k as f64 * 60.0).to_radians().sin_cos();
                (dx - p * cos).hypot(dy - p * sin) < 1e-13 * p
            };
            let side = (0..6).find(vector);
            prop_assert!(side.is_some(), "({dx}, {dy}) is no lattice vector");
            sides.extend(side);
        }
        prop_assert_eq!(sides.len(), 3);
        let paired: HashSet<usize> = mesh.symmetry.translations.iter().flatten().copied().collect();
        prop_assert_eq!(paired, outer(&mesh, p));
        // each side once; its corners belong to two sides
        let along_a_side = mesh.symmetry.translations.len();
        prop_assert_eq!(along_a_side, 3 * (2 * case.resolution.sectors * case.order + 1));
        prop_assert!(mesh.symmetry.inversions.is_empty() && mesh.symmetry.mirror_x.is_empty() && mesh.symmetry.mirror_y.is_empty());
    }

    /// The middle of every pair is the middle of the slanted side, (p/4, √3 p/4); the mirrors are x = 0, x = p/2 and y = 0.
    #[test]
    fn symmetry_inversions_and_mirrors_sit_where_they_claim(case in any_case(1..=7)) {
        let (mesh, p) = (case.mesh(Extent::Quarter), case.cell.pitch());
        let at = |n: &usize| mesh.nodes[*n];
        let mut own = 0;
        for [a, b] in &mesh.symmetry.inversions {
            let middle = [0, 1].map(|c| (at(a)[c] + at(b)[c]) / 2.0);
            prop_assert!((middle[0] - p / 4.0).hypot(middle[1] - p * 3_f64.sqrt() / 4.0) < 1e-13 * p);
            own += usize::from(a == b);
        }
        prop_assert_eq!(own, 1);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-14 * p;
        let all = |claim: &dyn Fn([f64; 2]) -> bool| -> HashSet<usize> { (0..mesh.nodes.len()).filter(|n| claim(mesh.nodes[*n])).collect() };
        let set = |nodes: &[usize]| nodes.iter().copied().collect::<HashSet<_>>();
        prop_assert_eq!(set(&mesh.symmetry.mirror_x), all(&|[x, _]| close(x, 0.0) || close(x, p / 2.0)));
        prop_assert_eq!(set(&mesh.symmetry.mirror_y), all(&|[_, y]| close(y, 0.0)));
        // with the vertical side x = p/2 the slanted one makes up the rest of the hexagon
        let slanted: HashSet<usize> = mesh.symmetry.inversions.iter().flatten().copied().collect();
        let vertical = all(&|[x, _]| close(x, p / 2.0));
        prop_assert_eq!(slanted.union(&vertical).copied().collect::<HashSet<_>>(), outer(&mesh, p));
        prop_assert!(mesh.symmetry.translations.is_empty());
    }

    /// The first quarter of the whole mesh is the quarter mesh.
    #[test]
    fn symmetry_a_quarter_of_the_whole_is_the_quarter(case in any_case(1..=5)) {
        let [whole, quarter] = [Extent::Whole, Extent::Quarter].map(|e| case.mesh(e));
        let (sectors, layers) = (12 * case.resolution.sectors, whole.elements.len() / (12 * case.resolution.sectors));
        for layer in 0..layers {
            for sector in 0..sectors / 4 {
                let (w, q) = (layer * sectors + sector, layer * sectors / 4 + sector);
                prop_assert_eq!(whole.phases[w], quarter.phases[q]);
                for (a, b) in whole.elements[w].iter().zip(&quarter.elements[q]) {
                    prop_assert_eq!(whole.nodes[*a], quarter.nodes[*b]);
                }
            }
        }
    }

    /// A sixth of a turn maps the whole mesh's nodes onto themselves.
    #[test]
    fn symmetry_of_six_turns(case in any_case(1..=3)) {
        let (mesh, p) = (case.mesh(Extent::Whole), case.cell.pitch());
        let rays = mesh.nodes.len() - 1;
        let per_ring = 12 * case.resolution.sectors * case.order;
        let (sin, cos) = 60_f64.to_radians().sin_cos();
        for n in 0..rays {
            let (ring, ray) = (n / per_ring, n % per_ring);
            let [x, y] = mesh.nodes[1 + n];
            let turned = mesh.nodes[1 + ring * per_ring + (ray + per_ring / 6) % per_ring];
            prop_assert!((cos * x - sin * y - turned[0]).hypot(sin * x + cos * y - turned[1]) < 1e-13 * p);
        }
    }
}
