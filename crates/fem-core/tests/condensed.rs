//! Condensation changes nothing but the work.

mod common;

use fem_core::{Constraints, Error, Form, Problem};
use nalgebra::DMatrix;

#[test]
fn exact_the_condensed_system_has_the_same_solution() {
    for order in [1, 2, 3, 6] {
        let mesh = common::distorted(order, 3);
        let problem = Problem::new(&mesh, Form::PLANE_STRAIN, order + 2);
        let mut constraints = Constraints::new(2 * mesh.nodes().len());
        for unknown in [0, 1, 2 * order + 1] {
            constraints.hold(unknown).expect("unknown");
        }
        // a tie with a sign, as symmetric cells have them
        let last = mesh.nodes().len() - 1;
        constraints.tie(2 * last, 2 * last + 1, -1.0).expect("unknowns");
        let map = constraints.eliminate(&problem.used(|_| true));
        let law = DMatrix::from_row_slice(3, 3, &[3.0, 1.0, 0.1, 1.0, 2.0, 0.0, 0.1, 0.0, 1.0]);
        let laws = vec![Some(law); mesh.region_count()];
        let condensed = problem.condense(&map, &laws).expect("condense");
        let full = problem.factor(&map, &laws).expect("factor");
        let loads: Vec<Vec<f64>> = (0..3).map(|k| (0..map.reduced()).map(|i| ((i * (k + 3)) as f64).sin()).collect()).collect();
        let (a, b) = (condensed.solve(&loads).expect("solve"), full.solve(&loads).expect("solve"));
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "order {order}: {a} against {b}");
        }
        let inner = mesh.elements().len() * 2 * (order - 1).pow(2);
        // besides them, what lies on a free edge of one element is eliminated too
        assert!(condensed.boundary_unknowns() + inner <= condensed.unknowns(), "order {order}");
    }
}

#[test]
fn bounds_a_body_that_is_not_held_is_refused() {
    let mesh = common::distorted(4, 2);
    let problem = Problem::new(&mesh, Form::PLANE_STRAIN, 6);
    let map = Constraints::new(2 * mesh.nodes().len()).eliminate(&problem.used(|_| true));
    let laws = vec![Some(DMatrix::identity(3, 3)); mesh.region_count()];
    assert!(matches!(problem.condense(&map, &laws), Err(Error::NotPositiveDefinite { .. })));
}
