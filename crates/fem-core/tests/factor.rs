//! The factor: what it refuses, and that it repeats its bits.

use crate::common::{Noise, distorted, isotropic, on_boundary, stiffness};
use fem_core::{
    BACKWARD_ERROR_LIMIT, Constraints, DofMap, Error, Factor, Form, Mesh, Pattern, Problem, SparseMatrix, SymbolicFactor,
};
use nalgebra::DMatrix;

/// One element of nine nodes: any 9 × 9 matrix can be assembled on it.
fn any_matrix(entry: impl Fn(usize, usize) -> f64) -> SparseMatrix {
    let nodes = (0..9).map(|k| [(k % 3) as f64, (k / 3) as f64]).collect();
    let mesh = Mesh::new(2, nodes, vec![(0..9).collect()], vec![0]).expect("a square");
    let map = Constraints::new(9).eliminate(&[true; 9]);
    Pattern::new(&mesh, &map, |_| true).assemble(&[DMatrix::from_fn(9, 9, entry)])
}

fn definite(i: usize, j: usize) -> f64 {
    if i == j { 4.0 + i as f64 } else { 1.0 / (1.0 + (i + j) as f64) }
}

fn elastic(mesh: &Mesh, held: bool) -> (DofMap, SparseMatrix) {
    let form = Form::PLANE_STRAIN;
    let problem = Problem::new(mesh, form, mesh.order() + 2);
    let mut constraints = Constraints::new(2 * mesh.nodes().len());
    if held {
        let boundary = on_boundary(mesh);
        (0..boundary.len()).filter(|i| boundary[*i]).for_each(|i| constraints.hold(2 * i).expect("an unknown"));
        constraints.hold(1).expect("an unknown");
    }
    let map = constraints.eliminate(&problem.used(|_| true));
    let laws = [(70e9, 0.2), (2e6, 0.4998)].map(|(e, nu)| Some(stiffness(form, &isotropic(e, nu, 0.0))));
    let matrix = problem.stiffness(&map, &laws).expect("a stiffness");
    (map, matrix)
}

#[test]
fn exact_factor_solves_a_stiff_system_to_rounding() {
    let matrix = elastic(&distorted(6, 3), true).1;
    let mut noise = Noise(1);
    let known: Vec<f64> = (0..matrix.columns()).map(|_| noise.next()).collect();
    let b = matrix.multiply(&known);
    let factor = Factor::new(matrix.clone()).unwrap();
    let x = &factor.solve(std::slice::from_ref(&b)).unwrap()[0];
    let scale = matrix.multiply_magnitudes(x).iter().fold(0.0_f64, |m, v| m.max(*v));
    let residual = matrix.multiply(x).iter().zip(&b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(residual / scale < BACKWARD_ERROR_LIMIT / 100.0, "{:e}", residual / scale);
    assert_eq!((factor.unknowns(), factor.matrix()), (matrix.rows(), &matrix));
}

#[test]
fn bounds_an_asymmetric_matrix_leaves_a_residual() {
    assert!(Factor::new(any_matrix(definite)).is_ok());
    // of a smaller asymmetry the refinement step leaves nothing that matters
    for asymmetry in [1.0, 1e-2, 1e-3] {
        let wrong = any_matrix(|i, j| definite(i, j) + if (i, j) == (2, 5) { asymmetry } else { 0.0 });
        let error = Factor::new(wrong).expect_err("an asymmetric matrix");
        assert!(matches!(error, Error::Residual { backward_error, .. } if backward_error > BACKWARD_ERROR_LIMIT), "{error}");
    }
}

#[test]
fn bounds_an_indefinite_matrix_is_refused() {
    for diagonal in [-1.0, 0.0] {
        let matrix = any_matrix(|i, j| if (i, j) == (4, 4) { diagonal } else { definite(i, j) });
        assert!(matches!(Factor::new(matrix), Err(Error::NotPositiveDefinite { unknowns: 9, .. })));
    }
}

/// Rounding can leave a singular matrix with positive pivots, and then its backward error is small as well.
#[test]
fn bounds_a_body_that_nothing_holds_is_refused() {
    for order in 1..=6 {
        for seed in 0..6 {
            let mesh = distorted(order, seed);
            let (_, matrix) = elastic(&mesh, false);
            assert!(matches!(Factor::new(matrix), Err(Error::NotPositiveDefinite { .. })), "elastic, order {order}, seed {seed}");
            let problem = Problem::new(&mesh, Form::DIFFUSION, order + 2);
            let map = Constraints::new(mesh.nodes().len()).eliminate(&problem.used(|_| true));
            let warm = problem.factor(&map, &[Some(DMatrix::identity(2, 2)), Some(DMatrix::identity(2, 2) * 3.0)]);
            assert!(matches!(warm, Err(Error::NotPositiveDefinite { .. })), "diffusion, order {order}, seed {seed}");
        }
    }
}

#[test]
fn bounds_what_is_not_a_number_is_an_error() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in [(0, 0), (4, 4), (7, 2), (8, 8)] {
            let matrix = any_matrix(|i, j| if (i, j) == place || (j, i) == place { bad } else { definite(i, j) });
            assert!(Factor::new(matrix).is_err(), "{bad} at {place:?}");
        }
        let factor = Factor::new(any_matrix(definite)).unwrap();
        let mut rhs = vec![1.0; 9];
        rhs[3] = bad;
        assert!(matches!(factor.solve(&[rhs]), Err(Error::Residual { .. })));
    }
}

#[test]
fn bounds_a_rectangular_matrix_is_refused_and_an_empty_one_is_not() {
    let mesh = distorted(1, 0);
    let n = mesh.nodes().len();
    let map = Constraints::new(n).eliminate(&vec![true; n]);
    let none = Constraints::new(n).eliminate(&vec![false; n]);
    let zeros = vec![DMatrix::zeros(4, 4); 9];
    assert!(Factor::new(Pattern::rectangular(&mesh, &map, &none, |_| true).assemble(&zeros)).is_err());
    let empty = Factor::new(Pattern::new(&mesh, &none, |_| true).assemble(&zeros)).unwrap();
    assert_eq!(empty.solve(&[vec![]]).unwrap(), vec![Vec::<f64>::new()]);
    let factor = Factor::new(any_matrix(definite)).unwrap();
    assert!(factor.solve(&[]).unwrap().is_empty());
    assert_eq!(factor.solve(&[vec![0.0; 9]]).unwrap(), vec![vec![0.0; 9]]);
}

#[test]
#[should_panic(expected = "Pattern")]
fn bounds_a_matrix_of_another_pattern_panics() {
    let mesh = distorted(2, 3);
    let symbolic = SymbolicFactor::new(&elastic(&mesh, true).1).unwrap();
    let _ = symbolic.factor(elastic(&mesh, false).1);
}

#[test]
fn exact_repeated_runs_give_the_same_bits() {
    let run = || {
        let (_, matrix) = elastic(&distorted(6, 3), true);
        let loads: Vec<Vec<f64>> = (1..4).map(|k| (0..matrix.rows()).map(|i| ((i * k) as f64).sin()).collect()).collect();
        let symbolic = SymbolicFactor::new(&matrix).unwrap();
        let first = symbolic.factor(matrix.clone()).unwrap().solve(&loads).unwrap();
        let second = Factor::new(matrix).unwrap().solve(&loads).unwrap();
        assert_eq!(first, second);
        first
    };
    let first = run();
    std::thread::scope(|scope| {
        let others: Vec<_> = (0..2).map(|_| scope.spawn(run)).collect();
        others.into_iter().for_each(|other| assert_eq!(other.join().unwrap(), first));
    });
}
