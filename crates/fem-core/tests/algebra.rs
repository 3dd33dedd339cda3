//! Assembly and sparse algebra against dense matrices; the coupling against the load.

use crate::common::{Noise, distorted, isotropic, solve, stiffness, thermal_stress};
use fem_core::{Constraints, DofMap, Edge, Error, Form, Mesh, Pattern, Problem, ReferenceElement, SparseMatrix, material};
use nalgebra::{DMatrix, DVector};

fn dense(matrix: &SparseMatrix) -> DMatrix<f64> {
    let (starts, rows, values) = matrix.parts();
    let mut dense = DMatrix::zeros(matrix.rows(), matrix.columns());
    for column in 0..matrix.columns() {
        (starts[column]..starts[column + 1]).for_each(|k| dense[(rows[k], column)] += values[k]);
    }
    dense
}

/// The matrix T of u_full = T u_reduced.
fn transformation(map: &DofMap) -> DMatrix<f64> {
    let mut t = DMatrix::zeros(map.full(), map.reduced());
    (0..map.full()).filter_map(|i| map.get(i).map(|e| (i, e))).for_each(|(i, (j, factor))| t[(i, j)] = factor);
    t
}

fn constrained(mesh: &Mesh, components: usize, seed: u64) -> DofMap {
    let (n, mut noise) = (mesh.nodes().len() * components, Noise(seed));
    let mut pick = || ((noise.next() + 1.0) / 2.0 * n as f64) as usize;
    let mut constraints = Constraints::new(n);
    for k in 0..n / 6 {
        constraints.tie(pick(), pick(), if k % 2 == 0 { 1.0 } else { -1.0 }).expect("a tie");
        constraints.hold(pick()).expect("a hold");
    }
    constraints.eliminate(&vec![true; n])
}

fn random_elements(mesh: &Mesh, rows: usize, columns: usize) -> Vec<DMatrix<f64>> {
    let (mut noise, n) = (Noise(5), mesh.elements()[0].len());
    mesh.elements().iter().map(|_| DMatrix::from_fn(n * rows, n * columns, |_, _| noise.next())).collect()
}

/// Every element matrix scattered into a dense matrix of all unknowns.
fn scattered(mesh: &Mesh, elements: &[DMatrix<f64>], c: [usize; 2], active: impl Fn(usize) -> bool) -> DMatrix<f64> {
    let n = mesh.nodes().len();
    let mut full = DMatrix::zeros(n * c[0], n * c[1]);
    for (e, nodes) in mesh.elements().iter().enumerate().filter(|(e, _)| active(*e)) {
        let place = |local: usize, c: usize| nodes[local / c] * c + local % c;
        for j in 0..elements[e].ncols() {
            for i in 0..elements[e].nrows() {
                full[(place(i, c[0]), place(j, c[1]))] += elements[e][(i, j)];
            }
        }
    }
    full
}

#[test]
fn exact_assembly_is_the_constrained_sum_of_the_elements() {
    let mesh = distorted(2, 9);
    for (c, active) in [([2, 2], [true, true]), ([2, 1], [true, true]), ([1, 1], [false, true])] {
        let (rows, columns) = (constrained(&mesh, c[0], 3), constrained(&mesh, c[1], 4));
        let elements = random_elements(&mesh, c[0], c[1]);
        let is_active = |e: usize| active[mesh.regions()[e]];
        let expected = transformation(&rows).transpose() * scattered(&mesh, &elements, c, is_active) * transformation(&columns);
        let matrix = Pattern::rectangular(&mesh, &rows, &columns, is_active).assemble(&elements);
        assert!((dense(&matrix) - &expected).amax() < 1e-13);
        assert_eq!((matrix.rows(), matrix.columns()), expected.shape());
        assert!(matrix.stored() == matrix.parts().2.len() && matrix.stored() > 0);
    }
}

#[test]
fn exact_products_and_sums_are_those_of_dense_matrices() {
    let mesh = distorted(2, 9);
    let (rows, columns) = (constrained(&mesh, 2, 3), constrained(&mesh, 1, 4));
    let pattern = Pattern::rectangular(&mesh, &rows, &columns, |_| true);
    let a = pattern.assemble(&random_elements(&mesh, 2, 1));
    let b = pattern.assemble(&random_elements(&mesh, 2, 1).iter().map(|m| m.map(|v| v * v - 0.3)).collect::<Vec<_>>());
    let mut noise = Noise(11);
    let x = DVector::from_fn(a.columns(), |_, _| noise.next());
    let y = DVector::from_fn(a.rows(), |_, _| noise.next());
    let agree = |found: Vec<f64>, exact: DVector<f64>| assert!((DVector::from_vec(found) - exact).amax() < 1e-13);
    agree(a.multiply(x.as_slice()), dense(&a) * &x);
    agree(a.multiply_transposed(y.as_slice()), dense(&a).transpose() * &y);
    agree(a.multiply_magnitudes(x.as_slice()), dense(&a).abs() * x.abs());
    let sum = SparseMatrix::combine(0.7, &a, -1.9, &b);
    assert!((dense(&sum) - (dense(&a) * 0.7 - dense(&b) * 1.9)).amax() < 1e-13);
}

const LAYERED: [fn(f64) -> f64; 2] = [|b| b, |b| -0.4 * b];

fn form_and_beta(form: Form) -> Vec<Option<DMatrix<f64>>> {
    let beta = [1.3, -0.7, 0.4, 0.9];
    LAYERED.iter().map(|f| Some(DMatrix::from_fn(form.strains, 1, |i, _| f(beta[i])))).collect()
}

const FORMS: [Form; 4] = [Form::DIFFUSION, Form::PLANE_STRAIN, Form::AXISYMMETRIC_DIFFUSION, Form::AXISYMMETRIC_ELASTICITY];

fn unconstrained(n: usize) -> DofMap {
    Constraints::new(n).eliminate(&vec![true; n])
}

/// The load is linear in the scalar field, so its derivative is the coupling; a field of ones is the uniform load.
#[test]
fn exact_coupling_is_the_derivative_of_the_load() {
    for form in FORMS {
        let mesh = distorted(3, 21);
        let n = mesh.nodes().len();
        let problem = Problem::new(&mesh, form, 6);
        let betas = form_and_beta(form);
        let coupling = problem.coupling(&betas).unwrap();
        let uniform = problem.loads(&betas).unwrap().remove(0);
        let ones = coupling.multiply(&vec![1.0; n]);
        assert!((DVector::from_vec(ones) - DVector::from_vec(uniform)).amax() < 1e-12);
    }
}

/// Virtual work of a linear displacement: its constant strain against β times the integral of the field.
#[test]
fn exact_coupling_to_a_field_that_varies() {
    let (form, mesh) = (Form::PLANE_STRAIN, distorted(4, 33));
    let betas = form_and_beta(form);
    let coupling = Problem::new(&mesh, form, 7).coupling(&betas).unwrap();
    let field: Vec<f64> = mesh.nodes().iter().map(|[x, y]| 1.0 + 3.0 * x - 2.0 * y).collect();
    let u: Vec<f64> = mesh.nodes().iter().flat_map(|[x, y]| [0.3 * x - 0.2 * y, 0.7 * x + 0.5 * y]).collect();
    let strain = [0.3, 0.5, 0.5];
    let work: f64 = coupling.multiply(&field).iter().zip(&u).map(|(f, u)| f * u).sum();
    let back: f64 = coupling.multiply_transposed(&u).iter().zip(&field).map(|(h, t)| h * t).sum();
    assert!((back / work - 1.0).abs() < 1e-13, "the transpose does the same work");
    let (reference, mut expected) = (ReferenceElement::new(4, 7), 0.0);
    for (e, region) in mesh.regions().iter().enumerate() {
        let g = reference.geometry(&mesh, e, form.measure).unwrap();
        let integral: f64 = (0..g.x.len()).map(|k| g.weight[k] * (1.0 + 3.0 * g.x[k] - 2.0 * g.y[k])).sum();
        let beta = betas[*region].as_ref().unwrap();
        expected += integral * (0..3).map(|i| strain[i] * beta[i]).sum::<f64>();
    }
    assert!((work / expected - 1.0).abs() < 1e-12, "{work} against {expected}");
}

#[test]
fn symmetry_stiffness_and_mass_are_symmetric_and_mass_adds_up_to_the_measure() {
    for form in FORMS {
        let (mesh, c) = (distorted(3, 17), form.components);
        let problem = Problem::new(&mesh, form, 6);
        let map = unconstrained(mesh.nodes().len() * c);
        let law = Some(DMatrix::from_fn(form.strains, form.strains, |i, j| if i == j { 3.0 } else { 0.4 }));
        let stiffness = dense(&problem.stiffness(&map, &[law.clone(), law]).unwrap());
        assert!((&stiffness - stiffness.transpose()).amax() < 1e-12 * stiffness.amax());
        let capacity = |c: f64| Some(DMatrix::from_element(1, 1, c));
        let mass = dense(&problem.mass(&map, &[capacity(2.0), capacity(5.0)]).unwrap());
        assert!((&mass - mass.transpose()).amax() < 1e-15);
        let measures = problem.region_measures().unwrap();
        assert!((mass.sum() / ((2.0 * measures[0] + 5.0 * measures[1]) * c as f64) - 1.0).abs() < 1e-12);
        assert!((0..c).all(|i| mass[(i, (i + 1) % c)] == 0.0 || c == 1), "components must not mix");
    }
}

/// Other numbers of nodes and elements: the same field at the same places.
#[test]
fn symmetry_renumbering_nodes_and_elements_moves_no_field() {
    let form = Form::PLANE_STRAIN;
    let mesh = distorted(4, 17);
    let n = mesh.nodes().len();
    // a step that shares no factor with n visits every number once
    let step = (2..).find(|step: &usize| (2..=n).all(|d| !n.is_multiple_of(d) || !step.is_multiple_of(d))).expect("a step");
    let number = |node: usize| (node * step + 5) % n;
    let mut nodes = vec![[0.0; 2]; n];
    mesh.nodes().iter().enumerate().for_each(|(node, position)| nodes[number(node)] = *position);
    let elements = mesh.elements().iter().rev().map(|element| element.iter().map(|&node| number(node)).collect()).collect();
    let other = Mesh::new(mesh.order(), nodes, elements, mesh.regions().iter().rev().copied().collect()).expect("a mesh");

    let constituents = [isotropic(1.0, 0.3, 1e-3), isotropic(50.0, 0.2, 1e-4)];
    let laws = constituents.each_ref().map(|law| Some(stiffness(form, law)));
    let stresses = constituents.each_ref().map(|law| Some(thermal_stress(form, law)));
    let solved = |mesh: &Mesh, held: [usize; 2]| {
        let problem = Problem::new(mesh, form, 6);
        let mut prescribed = vec![None; 2 * n];
        [2 * held[0], 2 * held[0] + 1, 2 * held[1] + 1].into_iter().for_each(|i| prescribed[i] = Some(0.0));
        solve(&problem, &laws, &prescribed, &problem.loads(&stresses).expect("a load")[0])
    };
    let held = [0, mesh.order()];
    let (plain, renumbered) = (solved(&mesh, held), solved(&other, held.map(number)));
    let largest = plain.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
    for node in 0..n {
        let [a, b] = [0, 1].map(|i| (plain[2 * node + i] - renumbered[2 * number(node) + i]).abs());
        assert!(largest > 1e-5 && a.max(b) < 1e-11 * largest, "{node}: {a} {b} of {largest}");
    }
}

/// ∫ N h N ds over all four sides of a rectangle: its length, or the area of its surface of revolution.
#[test]
fn exact_edge_masses_add_up_to_the_surface() {
    let (inner, outer, height, h) = (1.0, 2.0, 1.0, 0.7);
    let pi = std::f64::consts::PI;
    let surface = [2.0 * (outer - inner + height), 2.0 * pi * ((inner + outer) * height + outer * outer - inner * inner)];
    for (form, surface) in [Form::DIFFUSION, Form::AXISYMMETRIC_DIFFUSION].into_iter().zip(surface) {
        let mesh = crate::common::mapped(3, [2, 2], |[x, y]| [inner + (outer - inner) * x, height * y], |_| 0);
        let edges = [(0, Edge::XiLow), (2, Edge::XiLow), (1, Edge::XiHigh), (3, Edge::XiHigh)];
        let edges = edges.into_iter().chain([(0, Edge::EtaLow), (1, Edge::EtaLow), (2, Edge::EtaHigh), (3, Edge::EtaHigh)]);
        let edges: Vec<_> = edges.map(|(e, edge)| (e, edge, h)).collect();
        let n = mesh.nodes().len();
        let mass = dense(&Problem::new(&mesh, form, 5).edge_mass(&unconstrained(n), &edges));
        assert!((mass.sum() / (h * surface) - 1.0).abs() < 1e-12);
        let on = crate::common::on_boundary(&mesh);
        assert!((0..n).all(|i| on[i] == (mass[(i, i)] != 0.0)), "only the boundary's nodes");
    }
}

#[test]
fn bounds_constants_of_the_wrong_shape_are_refused() {
    let mesh = distorted(1, 2);
    let n = mesh.nodes().len();
    let problem = Problem::new(&mesh, Form::PLANE_STRAIN, 2);
    let map = unconstrained(2 * n);
    let law = |r: usize, c: usize| Some(DMatrix::<f64>::identity(r, c));
    let refused = |result: Result<SparseMatrix, Error>, region: usize| {
        assert!(matches!(result, Err(Error::Law { region: r, .. }) if r == region));
    };
    refused(problem.stiffness(&map, &[law(3, 3), law(2, 2)]), 1);
    refused(problem.mass(&map, &[law(3, 3), None]), 0);
    assert!(matches!(problem.coupling(&[law(3, 2), None]), Err(Error::Law { region: 0, .. })));
    assert!(matches!(problem.loads(&[None, law(4, 1)]), Err(Error::Law { region: 1, .. })));
}

#[test]
fn bounds_broken_meshes_are_refused() {
    let square = || vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let new = |order, nodes, element: Vec<usize>, regions| Mesh::new(order, nodes, vec![element], regions);
    assert!(new(1, square(), vec![0, 1, 2, 3], vec![0]).is_ok());
    assert!(new(0, square(), vec![0], vec![0]).is_err());
    assert!(new(1, square(), vec![0, 1, 2], vec![0]).is_err());
    assert!(new(1, square(), vec![0, 1, 2, 4], vec![0]).is_err());
    assert!(new(1, square(), vec![0, 1, 2, 3], vec![]).is_err());
    assert!(new(1, vec![[f64::NAN, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]], vec![0, 1, 2, 3], vec![0]).is_err());
    let area = |mesh: &Mesh, form| Problem::new(mesh, form, 3).region_measures();
    let inverted = new(1, square(), vec![1, 0, 3, 2], vec![0]).unwrap();
    assert!(matches!(area(&inverted, Form::DIFFUSION), Err(Error::Mesh(_))));
    // the area of a square of 1e200 m overflows
    let huge = new(1, square().iter().map(|p| p.map(|x| x * 1e200)).collect(), vec![0, 1, 2, 3], vec![0]).unwrap();
    assert!(matches!(area(&huge, Form::DIFFUSION), Err(Error::Mesh(_))));
    // a body of revolution may touch its axis, not cross it
    let touching = new(1, square(), vec![0, 1, 2, 3], vec![0]).unwrap();
    assert!((area(&touching, Form::AXISYMMETRIC_DIFFUSION).unwrap()[0] - std::f64::consts::PI).abs() < 1e-14);
    let crossing = new(1, square().iter().map(|p| [p[0] - 0.5, p[1]]).collect(), vec![0, 1, 2, 3], vec![0]).unwrap();
    assert!(matches!(area(&crossing, Form::AXISYMMETRIC_DIFFUSION), Err(Error::Mesh(_))));
}

#[test]
fn bounds_materials_out_of_range_are_named() {
    let solid = material::Isotropic { youngs_modulus: 1e9, poisson_ratio: 0.3, thermal_expansion: 1e-6 };
    for (bad, name) in [
        (material::Isotropic { youngs_modulus: -1.0, ..solid }, "youngs_modulus"),
        (material::Isotropic { poisson_ratio: 0.5, ..solid }, "poisson_ratio"),
        (material::Isotropic { poisson_ratio: f64::NAN, ..solid }, "poisson_ratio"),
        (material::Isotropic { thermal_expansion: f64::INFINITY, ..solid }, "thermal_expansion"),
    ] {
        assert!(matches!(bad.law(), Err(Error::Material { field, .. }) if field == name));
    }
}
