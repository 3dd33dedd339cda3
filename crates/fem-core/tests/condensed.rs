//! Condensation changes nothing but the work.

use fem_core::{Constraints, Error, Form, Problem};
use nalgebra::DMatrix;

#[test]
fn exact_the_condensed_system_has_the_same_solution() {
    for order in [1, 2, 3, 6] {
        let mesh = crate::common::distorted(order, 3);
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
    }
}

#[test]
fn bounds_a_body_that_is_not_held_is_refused() {
    let mesh = crate::common::distorted(4, 2);
    let problem = Problem::new(&mesh, Form::PLANE_STRAIN, 6);
    let map = Constraints::new(2 * mesh.nodes().len()).eliminate(&problem.used(|_| true));
    let laws = vec![Some(DMatrix::identity(3, 3)); mesh.region_count()];
    assert!(matches!(problem.condense(&map, &laws), Err(Error::NotPositiveDefinite { .. })));
}

#[test]
fn exact_one_element_is_solved_inside() {
    let mesh = crate::common::mapped(4, [1, 1], |x| x, |_| 0);
    let problem = Problem::new(&mesh, Form::DIFFUSION, 5);
    let mut constraints = Constraints::new(mesh.nodes().len());
    constraints.hold(0).expect("unknown");
    let map = constraints.eliminate(&problem.used(|_| true));
    let laws = [Some(DMatrix::identity(2, 2))];
    let condensed = problem.condense(&map, &laws).expect("condense");
    let load: Vec<f64> = (0..map.reduced()).map(|i| (i as f64).cos()).collect();
    let (a, b) = (
        condensed.solve(std::slice::from_ref(&load)).expect("solve"),
        problem.factor(&map, &laws).expect("factor").solve(&[load]),
    );
    let b = b.expect("solve");
    assert!(a[0].iter().zip(&b[0]).all(|(a, b)| (a - b).abs() < 1e-11), "{a:?} against {b:?}");
    let mut spoilt = vec![1.0; map.reduced()];
    spoilt[3] = f64::NAN;
    assert!(matches!(condensed.solve(&[spoilt]), Err(Error::Residual { .. })));
}

/// Two bodies that do not touch, elements that take no part, more elements than a tree of one level holds, many loads at once.
#[test]
fn exact_a_gap_of_inactive_elements_and_many_loads_change_nothing() {
    let mesh = crate::common::mapped(3, [9, 5], |[x, y]| [1.0 + x, 0.4 * y + 0.1 * x * x], |column| usize::from(column == 4));
    let problem = Problem::new(&mesh, Form::AXISYMMETRIC_ELASTICITY, 5);
    let law = crate::common::stiffness(Form::AXISYMMETRIC_ELASTICITY, &crate::common::coil());
    let laws = [Some(law), None];
    let mut constraints = Constraints::new(2 * mesh.nodes().len());
    for corner in [0, 9 * 3] {
        constraints.hold(2 * corner + 1).expect("unknown");
    }
    let map = constraints.eliminate(&problem.used(|region| region == 0));
    let (condensed, full) = (problem.condense(&map, &laws).expect("condense"), problem.factor(&map, &laws).expect("factor"));
    let loads: Vec<Vec<f64>> = (0..12).map(|k| (0..map.reduced()).map(|i| ((i * (k + 3)) as f64).sin()).collect()).collect();
    let (a, b) = (condensed.solve(&loads).expect("solve"), full.solve(&loads).expect("solve"));
    for (a, b) in a.iter().zip(&b) {
        let size = b.iter().fold(0.0f64, |m, b| m.max(b.abs()));
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-8 * size));
    }
}

/// Two parts of a law, integrated alike, are the law; integrated with too few points one part is softer.
#[test]
fn exact_selective_integration_sums_two_parts() {
    let order = 3;
    let mesh = crate::common::distorted(order, 2);
    let [full, fewer] = [order + 2, order].map(|points| Problem::new(&mesh, Form::PLANE_STRAIN, points));
    let mut constraints = Constraints::new(2 * mesh.nodes().len());
    [0, 1, 2 * order + 1].into_iter().for_each(|unknown| constraints.hold(unknown).expect("unknown"));
    let map = constraints.eliminate(&full.used(|_| true));
    let all = |law: DMatrix<f64>| vec![Some(law); mesh.region_count()];
    let dilatation = DMatrix::from_row_slice(3, 3, &[1e4, 1e4, 0.0, 1e4, 1e4, 0.0, 0.0, 0.0, 0.0]);
    let rest = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(vec![2.0, 2.0, 1.0]));
    let load: Vec<f64> = (0..map.reduced()).map(|i| (i as f64).sin()).collect();
    let energy = |factor: fem_core::Condensed| -> f64 {
        factor.solve(std::slice::from_ref(&load)).expect("solve")[0].iter().zip(&load).map(|(u, f)| u * f).sum()
    };
    let whole = energy(full.condense(&map, &all(&dilatation + &rest)).expect("condense"));
    let [same, softer] = [&full, &fewer].map(|problem| {
        energy(full.condense_selective(&map, &all(rest.clone()), problem, &all(dilatation.clone())).expect("condense"))
    });
    assert!((same / whole - 1.0).abs() < 1e-9, "{same} against {whole}");
    assert!(softer > 1.001 * whole, "{softer} against {whole}");
}
