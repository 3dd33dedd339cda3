//! Periodic cells with any inclusions: areas, pairing, orientation, refusals.

use fem_core::{Measure, Mesh, ReferenceElement, polynomial};
use proptest::prelude::*;
use rve_mesh::{Arrangement, Inclusion, Layout, LayoutError, Outline, PeriodicMesh, displace, periodic_mesh};

fn meshed(layout: &Layout, order: usize, fineness: f64) -> PeriodicMesh {
    periodic_mesh(layout, fineness, &polynomial::gauss_lobatto(order)).expect("a mesh")
}

/// Phase areas by quadrature, which fails if an element is turned inside out.
fn areas(mesh: &PeriodicMesh) -> Vec<f64> {
    let m = Mesh::new(mesh.order, mesh.nodes.clone(), mesh.elements.clone(), mesh.phases.clone()).expect("arrays that fit");
    ReferenceElement::new(mesh.order, mesh.order + 2).region_measures(&m, Measure::Area).expect("elements the right way round")
}

fn check(mesh: &PeriodicMesh) {
    for (found, exact) in areas(mesh).iter().zip(&mesh.phase_areas) {
        assert!((found / exact - 1.0).abs() < 1e-6, "{found:e} {exact:e}");
    }
    let [a, b] = mesh.lattice;
    let area = a[0] * b[1] - a[1] * b[0];
    for [copy, first] in &mesh.periodic {
        let [x, y] = [0, 1].map(|c| mesh.nodes[*copy][c] - mesh.nodes[*first][c]);
        for steps in [(x * b[1] - y * b[0]) / area, (y * a[0] - x * a[1]) / area] {
            assert!((steps - steps.round()).abs() < 1e-9, "{steps}");
        }
    }
    // a closed surface without voids has as many sides as twice its elements have, and each side two elements
    let mut original: Vec<usize> = (0..mesh.nodes.len()).collect();
    mesh.periodic.iter().for_each(|[copy, first]| original[*copy] = *first);
    let (p, m) = (mesh.order, mesh.order + 1);
    let mut sides = std::collections::HashMap::new();
    for element in &mesh.elements {
        for inner in [[1, p - 1], [m + p, (p - 1) * m + p], [p * m + 1, p * m + p - 1], [m, (p - 1) * m]] {
            let mut side = inner.map(|k| original[element[k]]);
            side.sort_unstable();
            if side[0] != side[1] {
                *sides.entry(side).or_insert(0) += 1;
            }
        }
    }
    assert!(sides.values().all(|count| *count <= 2));
}

#[test]
fn exact_a_torus_without_voids_has_no_boundary() {
    let fibre = |x: f64, y: f64| Inclusion { outlines: vec![Outline::circle([x, y], 0.2)], phases: vec![Some(1)] };
    let layout = Layout::new([[1.0, 0.0], [0.3, 0.9]], vec![fibre(0.1, 0.2), fibre(0.6, 0.5)], 0).unwrap();
    let mesh = meshed(&layout, 3, 1.0);
    check(&mesh);
    let voids =
        Layout::new([[1.0, 0.0], [0.3, 0.9]], vec![fibre(0.1, 0.2), Inclusion::void(Outline::circle([0.6, 0.5], 0.2))], 0);
    let holed = meshed(&voids.unwrap(), 3, 1.0);
    check(&holed);
    assert!(holed.elements.len() < mesh.elements.len());
    // twice the fineness: more elements, the same areas
    let fine = meshed(&layout, 3, 2.0);
    check(&fine);
    assert!(fine.elements.len() > 2 * mesh.elements.len());
}

/// Far from the fibre of a tall cell the triangles are as wide as the cell: a point is joined to its own copies, and to two copies of
/// another, by edges that are not the same.
#[test]
fn exact_a_cell_narrower_than_its_triangles() {
    let fibre = Inclusion { outlines: vec![Outline::circle([0.0, 0.0], 0.2)], phases: vec![Some(1)] };
    for skew in [0.0, 0.3] {
        for fineness in [0.5, 1.0] {
            let mesh = meshed(&Layout::new([[1.0, 0.0], [skew, 8.0]], vec![fibre.clone()], 0).unwrap(), 3, fineness);
            check(&mesh);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Whatever the layout accepts is meshed, all elements the right way round.
    #[test]
    fn bounds_any_layout_that_is_accepted_is_meshed(
        skew in -0.6..0.6_f64,
        height in 0.6..1.5_f64,
        shapes in prop::collection::vec((0.0..3.0_f64, 0.0..3.0_f64, 0.03..0.45_f64, 0.3..1.0_f64, 0.0..3.2_f64, 0.3..0.8_f64, any::<bool>()), 1..5),
    ) {
        let lattice = [[1.0, 0.0], [skew, height]];
        let mut accepted: Option<(Layout, Vec<Inclusion>)> = None;
        for (x, y, a, ratio, angle, core, void) in shapes {
            let hull = Outline { centre: [x, y], semi_axes: [a, a * ratio], angle };
            let inner = Outline { centre: [x + 0.5 * (1.0 - core) * a * ratio, y], semi_axes: [core * a * ratio; 2], angle: 0.0 };
            let next = if void { Inclusion::void(hull) } else { Inclusion { outlines: vec![inner, hull], phases: vec![Some(1), Some(2)] } };
            let mut all = accepted.as_ref().map_or_else(Vec::new, |(_, all)| all.clone());
            all.push(next);
            if let Ok(layout) = Layout::new(lattice, all.clone(), 0) {
                accepted = Some((layout, all));
            }
        }
        if let Some((layout, _)) = accepted {
            let mesh = meshed(&layout, 4, 1.0);
            for (found, exact) in areas(&mesh).iter().zip(&mesh.phase_areas).filter(|(_, exact)| **exact > 0.0) {
                prop_assert!((found / exact - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn bounds_displaced_fibres_keep_their_films(seed in any::<u64>(), columns in 1..5_usize, rows in 1..5_usize, square in any::<bool>()) {
        let regular = if square { Arrangement::square(1.0, columns, rows) } else { Arrangement::hexagonal(1.0, columns, rows) }.unwrap();
        let displaced = displace(&regular, 0.45, 0.2, 0.01, seed).unwrap();
        let inclusions = displaced.centres.iter().map(|c| Inclusion { outlines: vec![Outline::circle(*c, 0.455)], phases: vec![Some(0)] });
        // films of at least 0.01 at radius 0.45: of 0 and more at 0.455
        match Layout::new(displaced.lattice, inclusions.collect(), 1) {
            Err(LayoutError::Overlap { film, .. }) => prop_assert!(film > -1e-12),
            other => prop_assert!(other.is_ok()),
        }
        for (place, home) in displaced.centres.iter().zip(&regular.centres) {
            prop_assert!((place[0] - home[0]).hypot(place[1] - home[1]) <= 0.2);
        }
    }
}

#[test]
fn bounds_refusals_name_what_is_wrong() {
    let circle = |x: f64, r: f64| Outline::circle([x, 0.0], r);
    let fibre = |x: f64, r: f64| Inclusion { outlines: vec![circle(x, r)], phases: vec![Some(1)] };
    let square = [[1.0, 0.0], [0.0, 1.0]];
    let refused = |inclusions: Vec<Inclusion>| Layout::new(square, inclusions, 0).unwrap_err();
    assert!(matches!(refused(vec![fibre(0.0, 0.5)]), LayoutError::Overlap { first: 0, second: 0, .. }));
    assert!(matches!(refused(vec![fibre(0.0, 0.3), fibre(0.5, 0.3)]), LayoutError::Overlap { first: 0, second: 1, .. }));
    // across the cell's edge
    assert!(matches!(refused(vec![fibre(0.05, 0.2), fibre(0.9, 0.2)]), LayoutError::Overlap { first: 0, second: 1, .. }));
    assert!(matches!(refused(vec![]), LayoutError::Empty));
    assert!(matches!(refused(vec![fibre(f64::NAN, 0.2)]), LayoutError::Outline { inclusion: 0, ring: 0 }));
    let ring = |x: f64| Inclusion { outlines: vec![circle(x, 0.1), circle(0.0, 0.2)], phases: vec![Some(1), Some(2)] };
    assert!(matches!(refused(vec![ring(0.15)]), LayoutError::Nesting { inclusion: 0, ring: 0, .. }));
    let hollow = Inclusion { phases: vec![None, Some(2)], ..ring(0.05) };
    assert!(Layout::new(square, vec![hollow], 0).is_ok());
    let empty_shell = Inclusion { phases: vec![Some(1), None], ..ring(0.05) };
    assert!(matches!(refused(vec![empty_shell]), LayoutError::Phases(0)));
    let flat = Layout::new([[1.0, 0.0], [2.0, 0.0]], vec![fibre(0.0, 0.1)], 0);
    assert!(matches!(flat, Err(LayoutError::Lattice(_))));
    let layout = Layout::new(square, vec![fibre(0.0, 0.2)], 0).unwrap();
    assert!(periodic_mesh(&layout, 0.1, &[-1.0, 1.0]).is_err() && periodic_mesh(&layout, 1.0, &[-1.0, 0.0]).is_err());
}

#[test]
fn bounds_arrangements_and_displacements_of_nothing_are_refused() {
    let regular = Arrangement::hexagonal(1.0, 2, 2).unwrap();
    let refused = [
        (Arrangement::hexagonal(1.0, 0, 0), "columns = 0, but it must be at least 1"),
        (Arrangement::hexagonal(1.0, 1001, 1000), "columns times rows = 1001000, but it must be a million at most"),
        (
            Arrangement::square(1.0, 1 << 33, 1 << 33),
            "columns times rows = 73786976294838210000, but it must be a million at most",
        ),
        (Arrangement::square(1.0, 1, 0), "rows = 0, but it must be at least 1"),
        (Arrangement::square(f64::NAN, 1, 1), "pitch = NaN, but it must be finite and greater than 0 m"),
        (displace(&regular, 0.4, f64::NAN, 0.01, 1), "most = NaN, but it must be finite and 0 m or more"),
        (displace(&regular, 0.4, -0.1, 0.01, 1), "most = -0.1, but it must be finite and 0 m or more"),
        (displace(&regular, f64::NAN, 0.1, 0.01, 1), "radius = NaN, but it must be finite and greater than 0 m"),
        (displace(&regular, 0.4, 0.1, f64::NAN, 1), "film = NaN, but it must be finite"),
    ];
    for (result, said) in refused {
        assert_eq!(result.map_err(|error| error.to_string()), Err(said.into()));
    }
    assert_eq!(displace(&regular, 0.4, 0.0, 0.01, 1), Ok(regular));
}
