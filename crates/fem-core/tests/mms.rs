//! Manufactured solutions: orders of convergence in h and p.

use crate::common::{Field, errors, mapped, on_boundary, solve};
use fem_core::{Constraints, Form, Mesh, Problem};
use nalgebra::{DMatrix, DVector};

/// How far a measured order may lie from the theoretical one.
const RATE_TOLERANCE: f64 = 0.15;

const WAVE: [f64; 2] = [2.3, 1.7];
const PHASE: f64 = 0.4;
const AMPLITUDE: [f64; 2] = [1.0, -0.6];

/// Values and gradients, component by component.
type Values = (Vec<f64>, Vec<[f64; 2]>);

/// A solution with what drives it.
struct Manufactured {
    form: Form,
    law: DMatrix<f64>,
    exact: fn([f64; 2]) -> Values,
    force: fn(&DMatrix<f64>, [f64; 2]) -> Vec<f64>,
}

fn wave(p: [f64; 2]) -> (f64, f64) {
    (WAVE[0] * p[0] + WAVE[1] * p[1] + PHASE).sin_cos()
}

/// u = U sin(a·x + φ) for each component.
fn plane_wave(p: [f64; 2]) -> Values {
    let (sin, cos) = wave(p);
    (AMPLITUDE.map(|u| u * sin).to_vec(), AMPLITUDE.map(|u| WAVE.map(|a| u * a * cos)).to_vec())
}

/// u_r = U r sin, u_y = U sin: the hoop strain is bounded at the axis.
fn swelling_wave([r, y]: [f64; 2]) -> Values {
    let ((sin, cos), [a, b], [ur, uy]) = (wave([r, y]), WAVE, AMPLITUDE);
    (vec![ur * r * sin, uy * sin], vec![[ur * (sin + a * r * cos), ur * r * b * cos], [uy * a * cos, uy * b * cos]])
}

/// −∇·(D ∇ sin) = (a·D a) sin.
fn heat_source(d: &DMatrix<f64>, p: [f64; 2]) -> Vec<f64> {
    let a = DVector::from_column_slice(&WAVE);
    vec![AMPLITUDE[0] * a.dot(&(d * &a)) * wave(p).0]
}

/// In a body of revolution there is −(D ∇T)_r / r besides.
fn heat_source_of_revolution(d: &DMatrix<f64>, p: [f64; 2]) -> Vec<f64> {
    let flux = (d[(0, 0)] * WAVE[0] + d[(0, 1)] * WAVE[1]) * wave(p).1;
    vec![heat_source(d, p)[0] - AMPLITUDE[0] * flux / p[0]]
}

/// −∇·(D B u) = BᵀD B U sin with the derivatives in B replaced by the wave numbers.
fn body_force(d: &DMatrix<f64>, p: [f64; 2]) -> Vec<f64> {
    let [a, b] = WAVE;
    let symbol = DMatrix::from_row_slice(3, 2, &[a, 0.0, 0.0, b, b, a]);
    let f = symbol.transpose() * d * &symbol * DVector::from_column_slice(&AMPLITUDE) * wave(p).0;
    f.as_slice().to_vec()
}

/// Equilibrium of a body of revolution, strains (rr, yy, hoop, ry) of [`swelling_wave`] differentiated by hand.
fn body_force_of_revolution(d: &DMatrix<f64>, [r, y]: [f64; 2]) -> Vec<f64> {
    let ((sin, cos), [a, b], [ur, uy]) = (wave([r, y]), WAVE, AMPLITUDE);
    let strain = [ur * (sin + a * r * cos), uy * b * cos, ur * sin, ur * r * b * cos + uy * a * cos];
    let by_r = [
        ur * (2.0 * a * cos - a * a * r * sin),
        -uy * a * b * sin,
        ur * a * cos,
        ur * b * cos - ur * r * a * b * sin - uy * a * a * sin,
    ];
    let by_y = [ur * (b * cos - a * b * r * sin), -uy * b * b * sin, ur * b * cos, -ur * r * b * b * sin - uy * a * b * sin];
    let [stress, by_r, by_y] = [strain, by_r, by_y].map(|e| d * DVector::from_column_slice(&e));
    let radial = by_r[0] + by_y[3] + (stress[0] - stress[2]) / r;
    let axial = by_r[3] + by_y[1] + stress[3] / r;
    vec![-radial, -axial]
}

fn cases() -> [Manufactured; 4] {
    let conduction = DMatrix::from_row_slice(2, 2, &[2.0, 0.5, 0.5, 1.0]);
    let plane = DMatrix::from_row_slice(3, 3, &[3.0, 1.0, 0.2, 1.0, 2.0, -0.1, 0.2, -0.1, 0.8]);
    #[rustfmt::skip]
    let revolved = DMatrix::from_row_slice(4, 4, &[
        3.0, 1.0, 0.7, 0.2,
        1.0, 2.0, 0.5, -0.1,
        0.7, 0.5, 5.0, 0.3,
        0.2, -0.1, 0.3, 0.8,
    ]);
    [
        Manufactured { form: Form::DIFFUSION, law: conduction.clone(), exact: plane_wave, force: heat_source },
        Manufactured { form: Form::PLANE_STRAIN, law: plane, exact: plane_wave, force: body_force },
        Manufactured { form: Form::AXISYMMETRIC_DIFFUSION, law: conduction, exact: plane_wave, force: heat_source_of_revolution },
        Manufactured {
            form: Form::AXISYMMETRIC_ELASTICITY,
            law: revolved,
            exact: swelling_wave,
            force: body_force_of_revolution,
        },
    ]
}

/// A square bent by a smooth map: all elements are curved and none is like another.
fn bent(order: usize, n: usize) -> Mesh {
    let bend = |[x, y]: [f64; 2]| [0.5 + x + 0.1 * (3.0 * y).sin(), y + 0.12 * (2.0 * x + 0.5).sin() * (0.3 + y)];
    mapped(order, [n, n], bend, |_| 0)
}

/// Errors (value, gradient) with exact boundary values and the interpolated force as load.
fn solve_case(case: &Manufactured, mesh: &Mesh) -> [f64; 2] {
    let c = case.form.components;
    let problem = Problem::new(mesh, case.form, mesh.order() + 2);
    let on = on_boundary(mesh);
    let prescribed = mesh.nodes().iter().zip(&on).flat_map(|(p, on)| {
        let (value, _) = (case.exact)(*p);
        (0..c).map(|i| on.then_some(value[i])).collect::<Vec<_>>()
    });
    let force: Vec<f64> = mesh.nodes().iter().flat_map(|p| (case.force)(&case.law, *p)).collect();
    let all = Constraints::new(force.len()).eliminate(&problem.used(|_| true));
    let load = problem.mass(&all, &[Some(DMatrix::identity(1, 1))]).expect("a mass matrix").multiply(&force);
    let u = solve(&problem, &[Some(case.law.clone())], &prescribed.collect::<Vec<_>>(), &load);
    let exact: Field = &case.exact;
    errors(mesh, case.form, &u, exact)
}

#[test]
fn mms_errors_fall_with_the_power_of_the_order() {
    for case in cases() {
        for (order, n) in [(1, 24), (2, 12), (3, 8), (4, 6)] {
            let coarse = solve_case(&case, &bent(order, n));
            let fine = solve_case(&case, &bent(order, 2 * n));
            let rate = |k: usize| (coarse[k] / fine[k]).log2();
            let (value, gradient) = (rate(0), rate(1));
            println!("{:?} order {order}: value {value:.3}, gradient {gradient:.3}", case.form.measure);
            assert!((value - (order as f64 + 1.0)).abs() < RATE_TOLERANCE, "order {order}: the value converges as h^{value:.3}");
            assert!((gradient - order as f64).abs() < RATE_TOLERANCE, "order {order}: the gradient converges as h^{gradient:.3}");
        }
    }
}

#[test]
fn mms_errors_fall_exponentially_with_the_order() {
    for case in cases() {
        let errors: Vec<f64> = [2, 4, 6, 8, 10].iter().map(|&order| solve_case(&case, &bent(order, 2))[1]).collect();
        println!("{errors:?}");
        for w in errors.windows(2) {
            assert!(w[1] < w[0] / 20.0, "two orders must gain a factor of 20: {errors:?}");
        }
        assert!(errors[4] < 1e-7, "{errors:?}");
    }
}
