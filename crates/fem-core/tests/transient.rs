//! TR-BDF2: order in time, an exact transient, error control.

use fem_core::{Constraints, Form, Mesh, Problem, State, Transient, polynomial::gauss_lobatto};
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// A rod of unit length and properties, held at zero at both ends, in one element of high order: θ = sin(πx) e^(−π²t) exactly.
fn rod(order: usize) -> (Transient, Vec<f64>) {
    let lattice = gauss_lobatto(order);
    let at = |k: usize| [(1.0 + lattice[k % (order + 1)]) / 2.0, (1.0 + lattice[k / (order + 1)]) / 2.0];
    let nodes: Vec<_> = (0..(order + 1) * (order + 1)).map(at).collect();
    let mesh = Mesh::new(order, nodes.clone(), vec![(0..nodes.len()).collect()], vec![0]).expect("mesh");
    let problem = Problem::new(&mesh, Form::DIFFUSION, order + 1);
    let mut constraints = Constraints::new(nodes.len());
    for i in (0..nodes.len()).filter(|&i| nodes[i][0] == 0.0 || nodes[i][0] == 1.0) {
        constraints.hold(i).expect("node");
    }
    let map = constraints.eliminate(&problem.used(|_| true));
    let capacity = problem.mass(&map, &[Some(DMatrix::identity(1, 1))]).expect("mass");
    let conductivity = problem.stiffness(&map, &[Some(DMatrix::identity(2, 2))]).expect("stiffness");
    let start = map.restrict(&nodes.iter().map(|p| (PI * p[0]).sin()).collect::<Vec<_>>());
    (Transient::new(capacity, conductivity).expect("system"), start)
}

fn state(start: &[f64]) -> State {
    // an eigenmode: its rate is known
    State { value: start.to_vec(), rate: start.iter().map(|v| -PI * PI * v).collect() }
}

fn error_at(steps: u32, until: f64) -> f64 {
    let (mut transient, start) = rod(12);
    let (mut now, load) = (state(&start), vec![0.0; start.len()]);
    for _ in 0..steps {
        now = transient.step(&now, &load, until / f64::from(steps)).expect("step").0;
    }
    let exact = (-PI * PI * until).exp();
    now.value.iter().zip(&start).map(|(v, s)| (v - exact * s).abs()).fold(0.0, f64::max)
}

#[test]
fn mms_temporal_order_is_two() {
    let errors: Vec<f64> = [8, 16, 32, 64].iter().map(|&n| error_at(n, 0.1)).collect();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.1, "order {order:.3} from errors {errors:?}");
    }
}

#[test]
fn exact_stiff_modes_are_damped_in_one_huge_step() {
    let (mut transient, start) = rod(6);
    let (next, _) = transient.step(&state(&start), &vec![0.0; start.len()], 1e6).expect("step");
    assert!(next.value.iter().all(|v| v.abs() < 1e-5), "L-stable: nothing is left of the mode");
}

#[test]
fn bounds_error_control_keeps_the_error_near_the_tolerance_with_few_factorisations() {
    let (mut transient, start) = rod(12);
    let mut halvings = 0;
    let end = transient.advance(&state(&start), &vec![0.0; start.len()], 0.5, 1e-6, &mut halvings).expect("run");
    let exact = (-PI * PI * 0.5).exp();
    let error = end.value.iter().zip(&start).map(|(v, s)| (v - exact * s).abs()).fold(0.0, f64::max);
    let effort = transient.effort();
    assert!(error < 1e-6 * effort.steps as f64, "{error:e} after {effort:?}");
    assert!(effort.factorisations <= 12 && effort.steps > 20, "{effort:?}");
    let mut again = 0;
    let impossible = transient.advance(&state(&start), &vec![0.0; start.len()], 0.5, 0.0, &mut again);
    assert!(impossible.is_err(), "no step has no error");
}

#[test]
fn exact_the_rate_of_a_load_is_that_of_the_capacity() {
    let (mut transient, start) = rod(4);
    // C⁻¹ (C v) = v, with C v from a combination that only the capacity knows: the rate of the mode's own load
    let rate = {
        let load = transient.capacity().multiply(&start);
        transient.rate_of_load(&load).expect("solve")
    };
    assert!(rate.iter().zip(&start).all(|(a, b)| (a - b).abs() < 1e-12));
}

#[test]
fn exact_plain_step_is_the_step_without_its_error_estimate() {
    let (mut transient, start) = rod(8);
    let load: Vec<f64> = start.iter().map(|v| 0.3 * v).collect();
    let (checked, _) = transient.step(&state(&start), &load, 0.02).expect("step");
    let plain = transient.plain_step(&state(&start), &load, 0.02).expect("step");
    for (a, b) in checked.value.iter().zip(&plain.value).chain(checked.rate.iter().zip(&plain.rate)) {
        assert!((a - b).abs() < 1e-11, "{a} against {b}");
    }
    assert!(transient.plain_step(&state(&start), &vec![f64::NAN; load.len()], 0.02).is_err(), "no state that is not finite");
}
