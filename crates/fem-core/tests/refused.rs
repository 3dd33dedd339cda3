//! Input that does not fit is refused by an error that names the remedy.

use crate::common::isotropic;
use fem_core::{Constraints, Coupling, DofMap, Edge, Error, Factor, Form, Mesh, Problem, SparseMatrix, State, Transient};
use nalgebra::DMatrix;

const AXI: Form = Form::AXISYMMETRIC_ELASTICITY;

/// A cylinder of radius 1 and height 1, solid (bore 0) or hollow.
fn cylinder(bore: f64) -> Mesh {
    Mesh::rectangles(3, &[bore, 0.6, 1.0], &[0.0, 1.0], |i, _| Some(i)).expect("a mesh")
}

fn whole(unknowns: usize) -> DofMap {
    Constraints::new(unknowns).eliminate(&vec![true; unknowns])
}

/// u of a cylinder of glass and steel, heated by 1 K and held at one node along its axis.
fn heated(mesh: &Mesh, constraints: &mut Constraints) -> Result<Vec<f64>, Error> {
    let (mut laws, mut stresses) = (Vec::new(), Vec::new());
    for law in [isotropic(70e9, 0.17, 0.5e-6), isotropic(200e9, 0.3, 12e-6)] {
        let (stiffness, stress) = law.axisymmetric();
        laws.push(Some(stiffness));
        stresses.push(Some(stress));
    }
    let problem = Problem::new(mesh, AXI, mesh.order() + 1);
    constraints.hold(1)?;
    let map = constraints.eliminate(&problem.used(|_| true));
    let load = map.restrict(&problem.loads(&stresses)?[0]);
    let u = problem.factor(&map, &laws)?.solve(&[load])?;
    assert_eq!(problem.condense(&map, &laws).map(|c| c.unknowns()), Ok(map.reduced()));
    Ok(map.expand(&u[0]))
}

#[test]
fn bounds_an_axis_that_nothing_holds_is_refused() {
    let mesh = cylinder(0.0);
    let axis: Vec<usize> = (0..mesh.nodes().len()).filter(|&node| mesh.nodes()[node][0] == 0.0).collect();
    let free = heated(&mesh, &mut Constraints::new(2 * mesh.nodes().len())).expect_err("the axis is free");
    assert_eq!(free, Error::Axis { node: axis[0] });
    assert!(free.to_string().ends_with("hold u_r there with `Constraints::hold_axis`"), "{free}");

    let mut held = Constraints::new(2 * mesh.nodes().len());
    held.hold_axis(&mesh).expect("two unknowns for each node");
    let u = heated(&mesh, &mut held).expect("a solution");
    assert!(axis.iter().all(|node| u[2 * node] == 0.0));

    // one node of the axis is not all of it
    let mut partly = Constraints::new(2 * mesh.nodes().len());
    partly.hold(2 * axis[0]).expect("an unknown");
    assert_eq!(heated(&mesh, &mut partly), Err(Error::Axis { node: axis[1] }));
    // a tube has no axis to hold, and a region without a law does not touch it
    assert!(heated(&cylinder(0.2), &mut Constraints::new(2 * cylinder(0.2).nodes().len())).is_ok());
    let problem = Problem::new(&mesh, AXI, 4);
    let steel = Some(isotropic(200e9, 0.3, 0.0).axisymmetric().0);
    assert!(problem.stiffness(&whole(2 * mesh.nodes().len()), &[None, steel]).is_ok());
}

#[test]
fn bounds_a_map_of_another_form_is_refused() {
    let mesh = Mesh::rectangles(1, &[1.0, 2.0], &[0.0, 1.0], |_, _| Some(0)).expect("a mesh");
    let problem = Problem::new(&mesh, AXI, 2);
    let laws = [Some(isotropic(1.0, 0.3, 0.0).axisymmetric().0)];
    let expected = Error::Map { found: 4, needed: 8, components: 2 };
    assert!(expected.to_string().starts_with("the map has 4 unknowns, this form on this mesh has 8; "), "{expected}");
    let one = [Some(DMatrix::identity(1, 1))];
    let found = [
        problem.stiffness(&whole(4), &laws).err(),
        problem.factor(&whole(4), &laws).err(),
        problem.condense(&whole(4), &laws).err(),
        problem.condense_selective(&whole(4), &laws, &problem, &laws).err(),
        problem.mass(&whole(4), &one).err(),
        problem.condense_shifted(&whole(4), &laws, &one, 0.0, &[]).err(),
        Constraints::new(4).hold_axis(&mesh).err(),
    ];
    assert!(found.iter().all(|error| *error == Some(expected.clone())), "{found:?}");
}

#[test]
#[should_panic(expected = "a load of 3 entries for a map of 4 unknowns")]
fn bounds_a_short_load_is_a_mistake() {
    whole(4).restrict(&[1.0; 3]);
}

#[test]
#[should_panic(expected = "a solution of 5 entries for 4 reduced unknowns")]
fn bounds_a_long_solution_is_a_mistake() {
    whole(4).expand(&[1.0; 5]);
}

#[test]
fn bounds_a_boundary_mass_needs_a_scalar_form_and_its_elements() {
    let mesh = cylinder(0.5);
    let nodes = mesh.nodes().len();
    let said = |form: Form, unknowns: usize, element: usize| {
        let edges = [(element, Edge::XiHigh, 1.0)];
        let problem = Problem::new(&mesh, form, 4);
        let map = whole(unknowns);
        let shifted = || {
            let laws = vec![Some(DMatrix::identity(form.strains, form.strains)); 2];
            problem.condense_shifted(&map, &laws, &[Some(DMatrix::identity(1, 1)), Some(DMatrix::identity(1, 1))], 1.0, &edges)
        };
        let plain = problem.boundary_mass(&map, &edges).map(|_| ());
        assert_eq!(plain, shifted().map(|_| ()));
        assert_eq!(plain, problem.surface_load(&edges).map(|_| ()));
        plain.map_err(|error| error.to_string())
    };
    assert_eq!(said(Form::AXISYMMETRIC_DIFFUSION, nodes, 1), Ok(()));
    let beyond = said(Form::AXISYMMETRIC_DIFFUSION, nodes, 2);
    assert_eq!(beyond, Err("edges: element 2 is named, the mesh has 2, numbered from 0".into()));
    let elastic = said(AXI, 2 * nodes, 1).expect_err("an elastic form");
    assert!(elastic.contains("is of a scalar form, this one has 2 unknowns for each node; a pressure is"), "{elastic}");
}

#[test]
fn bounds_a_region_without_an_entry_and_a_quadrature_without_points_are_refused() {
    let mesh = cylinder(0.5);
    let map = whole(mesh.nodes().len());
    let laws = [Some(DMatrix::identity(2, 2))];
    let short = Problem::new(&mesh, Form::DIFFUSION, 4).stiffness(&map, &laws).expect_err("one law for two regions");
    assert!(short.to_string().starts_with("region 1 has no law: 1 law for 2 regions; "), "{short}");
    let none = Problem::new(&mesh, Form::DIFFUSION, 4).loads(&[]).expect_err("no law for two regions");
    assert!(none.to_string().starts_with("region 0 has no law: 0 laws for 2 regions; "), "{none}");

    let problem = Problem::new(&mesh, Form::DIFFUSION, 0);
    let laws = [laws[0].clone(), laws[0].clone()];
    assert_eq!(problem.stiffness(&map, &laws).err(), Some(Error::NoPoints));
    assert_eq!(problem.region_measures().err(), Some(Error::NoPoints));
}

/// The heat of a square of unit properties, its left side held at zero.
fn square() -> (DofMap, SparseMatrix, SparseMatrix) {
    let mesh = Mesh::rectangles(2, &[0.0, 1.0], &[0.0, 1.0], |_, _| Some(0)).expect("a mesh");
    let problem = Problem::new(&mesh, Form::DIFFUSION, 3);
    let mut constraints = Constraints::new(mesh.nodes().len());
    (0..mesh.nodes().len()).filter(|&i| mesh.nodes()[i][0] == 0.0).for_each(|i| constraints.hold(i).expect("a node"));
    let map = constraints.eliminate(&problem.used(|_| true));
    let capacity = problem.mass(&map, &[Some(DMatrix::identity(1, 1))]).expect("a mass");
    let conductivity = problem.stiffness(&map, &[Some(DMatrix::identity(2, 2))]).expect("a stiffness");
    (map, capacity, conductivity)
}

#[test]
fn bounds_steps_in_time_with_arguments_out_of_range_are_refused() {
    let (map, capacity, conductivity) = square();
    let n = map.reduced();
    let mut transient = Transient::new(capacity, conductivity).expect("a system");
    let state = State { value: vec![1.0; n], rate: vec![0.0; n] };
    let mut said = |interval: f64, tolerance: f64, mut halvings: u32| {
        let end = transient.advance(&state, &vec![0.0; n], interval, tolerance, &mut halvings);
        end.map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!((said(0.1, 1e-3, 30), said(0.0, 1e-3, 0)), (Ok(()), Ok(())));
    for halvings in [31, 64, u32::MAX] {
        let text = format!("{halvings} halvings of the interval are given; they must be at most 30");
        assert_eq!(said(0.1, 1e-3, halvings), Err(text));
    }
    for tolerance in [0.0, -1e-3, f64::NAN] {
        assert_eq!(said(0.1, tolerance, 0), Err(format!("the tolerance is {tolerance}; it must be above 0")));
    }
    for interval in [-0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(said(interval, 1e-3, 0), Err(format!("the interval is {interval} s; it must be finite and at least 0")));
    }
}

#[test]
fn bounds_loads_and_states_of_another_length_are_refused() {
    let (map, capacity, conductivity) = square();
    let n = map.reduced();
    let mut transient = Transient::new(capacity, conductivity).expect("a system");
    for (value, rate, load, name) in
        [(n - 1, n, n, "state's value"), (n, n + 1, n, "state's rate"), (n, n, 0, "load"), (n, n, n + 1, "load")]
    {
        let found = [value, rate, load].into_iter().find(|&length| length != n).expect("a length");
        let text = format!("the {name} has a length of {found}, the system has {n} unknowns; give one entry for each");
        let state = State { value: vec![1.0; value], rate: vec![0.0; rate] };
        let load = vec![0.0; load];
        let errors = [
            transient.step(&state, &load, 0.1).err(),
            transient.plain_step(&state, &load, 0.1).err(),
            transient.advance(&state, &load, 0.1, 1e-3, &mut 0).err(),
        ];
        assert!(errors.iter().all(|error| error.as_ref().is_some_and(|error| error.to_string() == text)), "{errors:?}");
    }
    let error = transient.rate_of_load(&[1.0]).expect_err("a short load").to_string();
    assert!(error.starts_with("the load has a length of 1, "), "{error}");
    let state = State { value: vec![1.0; n], rate: vec![0.0; n] };
    for step in [-1.0, f64::NAN] {
        let error = transient.plain_step(&state, &vec![0.0; n], step).expect_err("no step").to_string();
        assert_eq!(error, format!("the step is {step} s; it must be finite and at least 0"));
        assert_eq!(transient.step(&state, &vec![0.0; n], step).expect_err("no step").to_string(), error);
    }
}

#[test]
fn bounds_matrices_of_different_systems_are_refused() {
    let (_, capacity, conductivity) = square();
    let mesh = Mesh::rectangles(1, &[0.0, 1.0, 2.0], &[0.0, 1.0], |i, _| Some(i)).expect("a mesh");
    let problem = Problem::new(&mesh, Form::DIFFUSION, 2);
    let map = whole(6);
    let [all, partly] = [Some(DMatrix::identity(1, 1)), None]
        .map(|second| problem.mass(&map, &[Some(DMatrix::identity(1, 1)), second]).expect("a mass"));
    let error = Transient::new(all.clone(), conductivity).expect_err("6 and 6 unknowns of other patterns").to_string();
    assert_eq!(
        error,
        "the capacity and the conductivity have entries in different places; make both of one map, a law in the same regions"
    );
    assert_eq!(Transient::new(all.clone(), partly).expect_err("a region without a law").to_string(), error);
    let small = Problem::new(&mesh, Form::DIFFUSION, 2).mass(
        &{
            let mut held = Constraints::new(6);
            held.hold(0).expect("a node");
            held.eliminate(&[true; 6])
        },
        &[Some(DMatrix::identity(1, 1)), Some(DMatrix::identity(1, 1))],
    );
    let error = Transient::new(capacity, small.expect("a mass")).expect_err("6 and 5 unknowns").to_string();
    assert_eq!(error, "the capacity is 6 × 6, the conductivity 5 × 5; make both of one map");
}

#[test]
fn bounds_a_load_that_is_not_finite_is_not_the_factor_s_fault() {
    let (map, _, conductivity) = square();
    let factor = Factor::new(conductivity).expect("a factor");
    let mut load = vec![1.0; map.reduced()];
    load[2] = f64::NAN;
    let error = factor.solve(&[load]).expect_err("no number").to_string();
    assert_eq!(
        error,
        "a solve with 6 unknowns gave a number that is not finite: its load has one, or is too large; check the load"
    );
}

#[test]
fn bounds_a_region_number_without_a_count_is_refused() {
    let mesh = |region: usize| Mesh::rectangles(1, &[0.0, 1.0], &[0.0, 1.0], |_, _| Some(region));
    assert_eq!(mesh(7).map(|mesh| mesh.region_count()), Ok(8));
    let expected = Error::Mesh(format!("element 0 is of region {}; number the regions from 0", usize::MAX));
    assert_eq!(mesh(usize::MAX), Err(expected));
}

fn coupling() -> Coupling {
    let mesh = Mesh::rectangles(1, &[0.0, 1.0], &[0.0, 1.0], |_, _| Some(0)).expect("a mesh");
    Problem::new(&mesh, Form::DIFFUSION, 2).coupling(&[Some(DMatrix::from_element(2, 1, 1.0))]).expect("a coupling")
}

#[test]
#[should_panic(expected = "a field of 5 values for 4 nodes")]
fn bounds_a_long_field_is_a_mistake() {
    coupling().multiply(&[1.0; 5]);
}

#[test]
#[should_panic(expected = "a displacement of 5 entries, not 4")]
fn bounds_a_long_displacement_is_a_mistake() {
    coupling().multiply_transposed(&[1.0; 5]);
}

#[test]
fn bounds_breaks_that_do_not_increase_are_refused() {
    let mesh = |order, x: &[f64]| Mesh::rectangles(order, x, &[0.0, 1.0], |_, _| Some(0));
    assert!(mesh(1, &[0.0, 1.0]).is_ok());
    for (order, x) in [(0, &[0.0, 1.0][..]), (1, &[0.0]), (1, &[]), (1, &[0.0, 0.0]), (1, &[1.0, 0.0]), (1, &[0.0, f64::NAN])] {
        assert!(matches!(mesh(order, x), Err(Error::Mesh(_))), "{order} {x:?}");
    }
}

/// Positions, materials and holes of rectangles: their nodes are shared, and the areas are those of the cells.
#[test]
fn exact_rectangles_between_breaks() {
    let region = |i: usize, j: usize| if (i, j) == (1, 0) { None } else { Some(i) };
    let mesh = Mesh::rectangles(4, &[0.1, 0.3, 0.7], &[-1.0, 0.2, 0.9], region).expect("a mesh");
    // 9 × 9 places, less those of the hole that it does not share
    assert_eq!((mesh.elements().len(), mesh.nodes().len()), (3, 81 - 4 * 4));
    let areas = Problem::new(&mesh, Form::DIFFUSION, 5).region_measures().expect("areas");
    assert!((areas[0] - 0.2 * 1.9).abs() < 1e-14 && (areas[1] - 0.4 * 0.7).abs() < 1e-14, "{areas:?}");
    assert!(mesh.nodes().contains(&[0.3, 0.2]) && mesh.nodes().contains(&[0.7, 0.9]));
}

/// The small quadrilaterals of a mesh cover what its elements do, and go round the same way.
#[test]
fn exact_small_quadrilaterals_cover_the_mesh() {
    let mesh = Mesh::rectangles(3, &[0.0, 0.3, 0.7], &[-1.0, 0.2], |i, _| Some(i)).expect("a mesh");
    let twice_area = |corners: &[usize; 4]| -> f64 {
        let point = |k: usize| mesh.nodes()[corners[k % 4]];
        (0..4).map(|k| point(k)[0] * point(k + 1)[1] - point(k + 1)[0] * point(k)[1]).sum()
    };
    let small = mesh.quadrilaterals();
    assert_eq!(small.len(), 2 * 9);
    assert!(small.iter().all(|corners| twice_area(corners) > 0.0));
    let area = |of: &[[usize; 4]]| of.iter().map(twice_area).sum::<f64>() / 2.0;
    assert!((area(&small[..9]) - 0.3 * 1.2).abs() < 1e-14 && (area(&small[9..]) - 0.4 * 1.2).abs() < 1e-14);
}
