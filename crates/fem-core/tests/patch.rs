//! Fields in the space of the elements are reproduced on any mesh.

use crate::common::{
    annulus, coil, distorted, isotropic, nodal_error, on_boundary, solve, stiffness, strains_at_centres, thermal_stress,
};
use fem_core::{Form, Measure, Mesh, Problem};
use nalgebra::{DMatrix, DVector};

/// Rounding grows with the condition of the elements, about 1e-16 · 1e4 at order 8.
const ROUNDING: f64 = 1e-10;

fn meshes() -> Vec<Mesh> {
    let mut meshes: Vec<Mesh> = (1..=8).map(|order| distorted(order, order as u64)).collect();
    meshes.extend((1..=8).map(|order| annulus(order, &[0.7, 1.1, 1.6], 5)));
    meshes
}

fn boundary_values(mesh: &Mesh, components: usize, exact: impl Fn([f64; 2]) -> Vec<f64>) -> Vec<Option<f64>> {
    let on = on_boundary(mesh);
    let values = mesh.nodes().iter().zip(&on).flat_map(|(p, on)| exact(*p).into_iter().map(|v| on.then_some(v)));
    let values: Vec<_> = values.collect();
    assert_eq!(values.len(), mesh.nodes().len() * components);
    values
}

/// Gauss points that integrate the stress of such a field exactly against any test function on curved elements: the shape
/// functions, the element's map and, in a body of revolution, the radius are of the order p in each direction.
fn points(mesh: &Mesh, form: Form) -> usize {
    match form.measure {
        Measure::Area => mesh.order() + 1,
        Measure::Revolution => 3 * mesh.order() / 2 + 1,
    }
}

fn reproduces(mesh: &Mesh, form: Form, law: &DMatrix<f64>, exact: impl Fn([f64; 2]) -> Vec<f64>) {
    let problem = Problem::new(mesh, form, points(mesh, form));
    let prescribed = boundary_values(mesh, form.components, &exact);
    let laws = vec![Some(law.clone()); mesh.region_count()];
    let u = solve(&problem, &laws, &prescribed, &vec![0.0; prescribed.len()]);
    let error = nodal_error(mesh, &u, exact);
    assert!(error < ROUNDING, "order {}: {error:e}", mesh.order());
}

#[test]
fn patch_linear_temperature() {
    let law = DMatrix::from_row_slice(2, 2, &[2.0, 0.5, 0.5, 1.0]);
    for mesh in meshes() {
        reproduces(&mesh, Form::DIFFUSION, &law, |[x, y]| vec![0.3 - 1.7 * x + 0.9 * y]);
    }
}

#[test]
fn patch_linear_displacement_in_the_plane() {
    for law in [coil(), isotropic(2e6, 0.4998, 0.0)] {
        for mesh in meshes() {
            let linear = |[x, y]: [f64; 2]| vec![0.1 + 0.3 * x - 0.2 * y, -0.4 + 0.7 * x + 0.5 * y];
            reproduces(&mesh, Form::PLANE_STRAIN, &stiffness(Form::PLANE_STRAIN, &law), linear);
        }
    }
}

#[test]
fn patch_axial_heat_flow_in_a_body_of_revolution() {
    for mesh in (1..=8).map(|order| distorted(order, 40 + order as u64)) {
        let law = DMatrix::from_row_slice(2, 2, &[3.0, 0.0, 0.0, 0.5]);
        reproduces(&mesh, Form::AXISYMMETRIC_DIFFUSION, &law, |[_, y]| vec![2.0 - 0.6 * y]);
    }
}

#[test]
fn patch_uniform_swelling_and_stretching_of_a_body_of_revolution() {
    let form = Form::AXISYMMETRIC_ELASTICITY;
    for mesh in (1..=8).map(|order| distorted(order, 80 + order as u64)) {
        reproduces(&mesh, form, &stiffness(form, &isotropic(70e9, 0.33, 0.0)), |[r, y]| vec![0.4 * r, 0.2 - 0.9 * y]);
    }
}

/// A free isotropic body that warms by 1 K grows by α in all directions and is not stressed.
fn is_stress_free(mesh: &Mesh, form: Form, held: &[usize], z_strain: bool) {
    let (alpha, law) = (23.6e-6, isotropic(68.9e9, 0.33, 23.6e-6));
    let beta = thermal_stress(form, &law);
    let source = match z_strain {
        true => DMatrix::from_fn(3, 1, |i, _| beta[i] - law.stiffness[(crate::common::rows(form)[i], 2)] * alpha),
        false => beta.clone(),
    };
    let problem = Problem::new(mesh, form, points(mesh, form));
    let load = &problem.loads(&vec![Some(source.clone()); mesh.region_count()]).expect("a load")[0];
    let mut prescribed = vec![None; load.len()];
    for &i in held {
        prescribed[i] = Some(alpha * mesh.nodes()[i / 2][i % 2]);
    }
    let d = stiffness(form, &law);
    let u = solve(&problem, &vec![Some(d.clone()); mesh.region_count()], &prescribed, load);
    let error = nodal_error(mesh, &u, |[x, y]| vec![alpha * x, alpha * y]);
    assert!(error < ROUNDING, "order {}: {error:e}", mesh.order());
    for strain in strains_at_centres(&problem, form, &u) {
        let stress = &d * DVector::from_vec(strain) - &source;
        assert!(stress.amax() < ROUNDING * beta.amax(), "order {}: {stress}", mesh.order());
    }
}

#[test]
fn patch_a_free_isotropic_body_is_not_stressed_by_uniform_heat() {
    for mesh in meshes() {
        // node 0 in x and y, the last node of the first row in y: no rigid motion is left
        is_stress_free(&mesh, Form::PLANE_STRAIN, &[0, 1, 2 * mesh.order() + 1], true);
    }
    for mesh in (1..=8).map(|order| distorted(order, 120 + order as u64)) {
        is_stress_free(&mesh, Form::AXISYMMETRIC_ELASTICITY, &[1], false);
    }
}
