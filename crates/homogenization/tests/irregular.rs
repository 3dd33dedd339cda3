//! The route without symmetry: against the structured one, and against exact relations.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::common::{glass, reference, solid, varied};
use approx::assert_relative_eq;
use fem_core::material::{Orthotropic, ThermoElastic};
use homogenization::irregular::{
    Arrangement, Cell, Inclusion, Layout, Outline, PeriodicMesh, Phase, Response, Solid, Solution, displace,
};
use homogenization::{Constituent, Error, FibreCell, Packing, Role, homogenize};
use nalgebra::{Matrix2, Matrix6, Vector6};

fn phase(name: &str, solid: Solid, role: Role) -> Phase {
    Phase { name: name.into(), solid, role }
}

fn isotropic(constituent: &Constituent) -> Solid {
    Solid::isotropic(constituent).unwrap()
}

fn epoxy() -> Constituent {
    solid(3e9, 0.38, 60e-6, 0.2)
}

/// Wood-like, turned by 0.6 rad about z.
fn wood() -> Solid {
    let law = Orthotropic {
        e_x: 1.1e9,
        e_y: 0.7e9,
        e_z: 12e9,
        g_yz: 0.8e9,
        g_xz: 0.9e9,
        g_xy: 0.1e9,
        nu_yz: 0.021,
        nu_xz: 0.027,
        nu_xy: 0.55,
        alpha_x: 40e-6,
        alpha_y: 30e-6,
        alpha_z: 4e-6,
    };
    let conductivity = Matrix2::new(0.3, 0.0, 0.0, 0.2);
    Solid { law: law.law().unwrap(), conductivity, conductivity_z: 0.5, density: None, specific_heat: None }.turned(0.6)
}

/// Ellipses, an offset core and, if wanted, a void in a skew cell.
fn skew(offset: [f64; 2], void: bool) -> Layout {
    let at = |x: f64, y: f64| [x + offset[0], y + offset[1]];
    let ellipse = Outline { centre: at(0.0, 0.0), semi_axes: [0.42, 0.25], angle: 0.5 };
    let core = Outline { centre: at(0.05, -0.03), semi_axes: [0.14, 0.11], angle: 1.1 };
    let round = Outline { centre: at(0.75, 0.5), semi_axes: [0.2, 0.15], angle: -0.4 };
    let second = if void { Inclusion::void(round) } else { Inclusion { outlines: vec![round], phases: vec![Some(1)] } };
    let first = Inclusion { outlines: vec![core, ellipse], phases: vec![Some(0), Some(1)] };
    Layout::new([[1.3, 0.1], [0.4, 1.0]], vec![first, second], 2).unwrap()
}

fn skew_cell(offset: [f64; 2], void: bool) -> Cell {
    let phases = vec![
        phase("core", isotropic(&glass()), Role::Glass),
        phase("shell", wood(), Role::Coating),
        phase("matrix", isotropic(&epoxy()), Role::Coating),
    ];
    Cell { layout: skew(offset, void), phases }
}

/// Largest difference of stiffness, thermal stress and conductivity, each relative to the largest entry.
fn difference(a: &Response, b: &Response) -> f64 {
    let relative = |d: f64, size: f64| d / size;
    relative((a.stiffness - b.stiffness).amax(), b.stiffness.amax())
        .max(relative((a.thermal_stress - b.thermal_stress).amax(), b.thermal_stress.amax()))
        .max(relative((a.conductivity - b.conductivity).amax(), b.conductivity.amax()))
        .max(relative((a.glass_strain - b.glass_strain).amax(), 1.0))
}

/// The regular cell, by another mesh, without the use of its symmetry.
#[test]
fn exact_agreement_with_the_structured_route() {
    for cell in crate::common::cells() {
        let c = homogenize(&cell).unwrap().constants;
        let irregular =
            Cell::of_fibres(&cell, &Arrangement::hexagonal(cell.pitch, 1, 1).unwrap()).unwrap().homogenize_to(1e-5).unwrap();
        let d = irregular.constants;
        for (structured, found) in [
            ([c.e_r, c.e_r, c.e_z], d.e),
            ([c.g_zr, c.g_zr, c.g_r], d.g),
            ([c.nu_zr, c.nu_zr, c.nu_r], d.nu),
            ([c.alpha_r, c.alpha_r, c.alpha_z], [d.alpha[0], d.alpha[1], d.alpha[2]]),
            ([c.k_r, c.k_r, c.k_z], [d.k[0], d.k[1], d.k[2]]),
            ([c.m_rx, c.m_ry, c.m_rz], [d.m[0], d.m[1], d.m[2]]),
            ([c.k_plane_strain, c.m_rt, c.m_rt], [d.k_plane_strain, d.m[4], d.m[4]]),
        ] {
            for (structured, found) in structured.into_iter().zip(found) {
                assert_relative_eq!(found, structured, max_relative = 1e-6);
            }
        }
        assert!(irregular.response.anisotropy < 1e-6, "{:e}", irregular.response.anisotropy);
        for (name, error) in irregular.relative_error {
            assert!(error < 1e-5, "{name}: {error:e}");
        }
        let t = irregular.response.transversely_isotropic().unwrap();
        for ((name, found), (_, structured)) in t.named().into_iter().zip(c.named()) {
            assert!((found / structured - 1.0).abs() < 1e-6, "{name}: {found:e} {structured:e}");
        }
    }
}

/// Square packing: the same numbers, and as far from isotropic as the structured route says.
#[test]
fn exact_agreement_in_square_packing() {
    let cell = FibreCell { packing: Packing::Square, ..reference() };
    let structured = homogenize(&cell).unwrap();
    let found = Cell::of_fibres(&cell, &Arrangement::square(cell.pitch, 1, 1).unwrap()).unwrap().solve(6, 1.0).unwrap().response;
    let reference = structured.effective.stiffness;
    assert!((found.stiffness - reference).amax() < 1e-5 * reference.amax());
    assert_relative_eq!(found.stiffness[(5, 5)], reference[(5, 5)], max_relative = 1e-4);
    assert_relative_eq!(found.constants().unwrap().e[0], structured.constants.e_r, max_relative = 1e-4);
    // C66 and (C11 − C12)/2 are a and b: their mean over all turns is (a + b)/2, so the difference is |a − b|/(a + b)
    let [a, b] = structured.effective.shear_moduli_across();
    assert_relative_eq!(found.anisotropy, (a - b).abs() / (a + b), max_relative = 1e-3);
}

/// Four fibres are one: the cell may hold several repetitions.
#[test]
fn symmetry_several_fibres_are_one() {
    let cell = &varied()[1];
    let solve = |columns, rows| {
        let arrangement = Arrangement::hexagonal(cell.pitch, columns, rows).unwrap();
        Cell::of_fibres(cell, &arrangement).unwrap().solve(6, 1.0).unwrap().response
    };
    let one = solve(1, 1);
    for (columns, rows) in [(2, 2), (1, 3)] {
        assert!(difference(&solve(columns, rows), &one) < 1e-6);
    }
}

/// A cell of one solid, orthotropic and turned, whatever the shapes in it.
#[test]
fn exact_cell_of_one_material_is_that_material() {
    let mut cell = skew_cell([0.0; 2], false);
    cell.phases.iter_mut().for_each(|p| p.solid = wood());
    let found = cell.solve(4, 1.0).unwrap().response;
    let law = wood().law;
    assert!((found.stiffness - law.stiffness).amax() < 1e-10 * law.stiffness.amax());
    assert!((found.thermal_stress - law.thermal_stress).amax() < 1e-10 * law.thermal_stress.amax());
    assert!((found.conductivity - wood().conductivity).amax() < 1e-10);
    for strain in &found.phase_strain {
        assert!((strain.fixed_view::<6, 6>(0, 0) - Matrix6::identity()).amax() < 1e-10);
        assert!(strain.column(6).amax() < 1e-14);
    }
}

/// Where the cell begins does not matter.
#[test]
fn symmetry_moving_all_inclusions_changes_nothing() {
    for void in [false, true] {
        let here = skew_cell([0.0; 2], void).solve(5, 1.0).unwrap().response;
        let there = skew_cell([0.37, -5.21], void).solve(5, 1.0).unwrap().response;
        assert!(difference(&there, &here) < 1e-9, "{:e}", difference(&there, &here));
        assert!((here.stiffness - here.stiffness.transpose()).amax() < 1e-12 * here.stiffness.amax());
        assert!(here.anisotropy > 1e-3);
    }
}

/// Turning the whole cell turns its response.
#[test]
fn symmetry_turning_the_cell_turns_its_response() {
    let cell = skew_cell([0.0; 2], true);
    let (angle, turn) = (0.8_f64, |p: [f64; 2]| {
        let (s, c) = 0.8_f64.sin_cos();
        [c * p[0] - s * p[1], s * p[0] + c * p[1]]
    });
    let turned = |o: &Outline| Outline { centre: turn(o.centre), semi_axes: o.semi_axes, angle: o.angle + angle };
    let inclusions = cell
        .layout
        .inclusions()
        .iter()
        .map(|i| Inclusion { outlines: i.outlines.iter().map(turned).collect(), phases: i.phases.clone() });
    let layout = Layout::new(cell.layout.lattice().map(turn), inclusions.collect(), 2).unwrap();
    let mut phases = cell.phases.clone();
    phases.iter_mut().for_each(|p| p.solid = p.solid.turned(angle));
    let there = Cell { layout, phases }.solve(6, 1.0).unwrap().response;
    let here = cell.solve(6, 1.0).unwrap().response;
    let law = ThermoElastic { stiffness: here.stiffness, thermal_stress: here.thermal_stress }.turned(angle);
    assert!((there.stiffness - law.stiffness).amax() < 1e-6 * law.stiffness.amax());
    assert!((there.thermal_stress - law.thermal_stress).amax() < 1e-6 * law.thermal_stress.amax());
    assert_relative_eq!(there.anisotropy, here.anisotropy, max_relative = 1e-5);
}

/// Voids: less than the mixture, more than nothing, and exactly linear along the fibre. A void is the limit of a soft inclusion.
#[test]
fn bounds_voids_are_the_limit_of_soft_inclusions() {
    let layout = |second: Option<usize>| {
        let fibre = Inclusion { outlines: vec![Outline::circle([0.0, 0.0], 0.3)], phases: vec![Some(0)] };
        let pocket = Outline { centre: [0.5, 0.45], semi_axes: [0.22, 0.12], angle: 0.3 };
        Layout::new([[1.0, 0.0], [0.0, 1.0]], vec![fibre, Inclusion { outlines: vec![pocket], phases: vec![second] }], 1).unwrap()
    };
    let soft = |factor: f64| isotropic(&solid(3e9 * factor, 0.1, 0.0, 0.2 * factor));
    let phases = |factor: f64| {
        vec![
            phase("glass", isotropic(&glass()), Role::Glass),
            phase("epoxy", isotropic(&epoxy()), Role::Coating),
            phase("soft", soft(factor), Role::Coating),
        ]
    };
    let solve = |second, factor| Cell { layout: layout(second), phases: phases(factor) }.solve(6, 1.0).unwrap().response;
    let void = solve(None, 1.0);
    let [first, second] = [1e-3, 1e-6].map(|factor| difference(&solve(Some(2), factor), &void));
    assert!(second < 1e-5 && first > 100.0 * second, "{first:e} {second:e}");
    assert_relative_eq!(void.fractions.iter().sum::<f64>(), 1.0 - std::f64::consts::PI * 0.22 * 0.12, max_relative = 1e-8);
    let filled = solve(Some(1), 1.0).stiffness;
    assert!((filled - void.stiffness).symmetric_eigenvalues().min() > 0.0 && void.stiffness.symmetric_eigenvalues().min() > 0.0);
    // one solid with pores, pulled along them: E_z is the solid's times its share (the pores change nothing else)
    let porous = |p: &mut Phase| p.solid = isotropic(&epoxy());
    let mut cell = Cell { layout: layout(None), phases: phases(1.0) };
    cell.phases.iter_mut().for_each(porous);
    let c = cell.solve(6, 1.0).unwrap().response.constants().unwrap();
    assert_relative_eq!(c.e[2], 3e9 * void.fractions.iter().sum::<f64>(), max_relative = 1e-8);
    for (found, exact) in [(c.nu[0], 0.38), (c.nu[1], 0.38), (c.alpha[0], 60e-6), (c.alpha[1], 60e-6), (c.alpha[2], 60e-6)] {
        assert_relative_eq!(found, exact, max_relative = 1e-8);
    }
}

/// Two layers across x of solids orthotropic in turned axes: all fields are uniform in each layer, so its response is known in closed form.
/// Strains yy, zz, yz and stresses xx, xy, xz are continuous.
#[test]
fn exact_laminate() {
    let (one, two, share) = (wood(), wood().turned(1.1), 0.3);
    let mesh = laminate(share);
    let phases = [phase("one", one, Role::Glass), phase("two", two, Role::Coating)];
    let solution = Solution::new(mesh, &phases).unwrap();
    let found = &solution.response;
    let (expected, strains) = in_closed_form(&[(share, one.law), (1.0 - share, two.law)]);
    assert!((found.stiffness - expected.stiffness).amax() < 1e-10 * expected.stiffness.amax());
    assert!((found.thermal_stress - expected.thermal_stress).amax() < 1e-10 * expected.thermal_stress.amax());
    assert!((found.phase_strain[0].fixed_view::<6, 6>(0, 0) - strains).amax() < 1e-10);
    let [k1, k2] = [one.conductivity, two.conductivity];
    let series = 1.0 / (share / k1[(0, 0)] + (1.0 - share) / k2[(0, 0)]);
    assert_relative_eq!(found.conductivity[(0, 0)], series, max_relative = 1e-12);
}

/// One element for each layer of a unit square.
fn laminate(share: f64) -> PeriodicMesh {
    let x = [0.0, share / 2.0, share, (1.0 + share) / 2.0, 1.0];
    let node = |i: usize, j: usize| j * 5 + i;
    let nodes = (0..15).map(|k| [x[k % 5], (k / 5) as f64 / 2.0]).collect();
    let element = |first: usize| (0..9).map(|k| node(first + k % 3, k / 3)).collect();
    let mut periodic: Vec<[usize; 2]> = (0..3).map(|j| [node(4, j), node(0, j)]).collect();
    periodic.extend((0..5).map(|i| [node(i, 2), node(i, 0)]));
    PeriodicMesh {
        order: 2,
        nodes,
        elements: vec![element(0), element(2)],
        phases: vec![0, 1],
        inclusions: vec![None, None],
        centres: Vec::new(),
        periodic,
        lattice: [[1.0, 0.0], [0.0, 1.0]],
        phase_areas: vec![share, 1.0 - share],
    }
}

/// With σ_n the continuous stresses, ε_t the continuous strains: C_nn ε_n = σ_n − C_nt ε_t + β_n ΔT in each layer.
fn in_closed_form(layers: &[(f64, ThermoElastic); 2]) -> (ThermoElastic, Matrix6<f64>) {
    let (normal, tangent) = ([0, 5, 4], [1, 2, 3]);
    let block =
        |m: &Matrix6<f64>, rows: [usize; 3], columns: [usize; 3]| nalgebra::Matrix3::from_fn(|i, j| m[(rows[i], columns[j])]);
    let part = |v: &Vector6<f64>, rows: [usize; 3]| nalgebra::Vector3::from_fn(|i, _| v[rows[i]]);
    let parts = layers.map(|(f, l)| {
        let inverse = block(&l.stiffness, normal, normal).try_inverse().unwrap();
        (f, l, inverse, inverse * block(&l.stiffness, normal, tangent), inverse * part(&l.thermal_stress, normal))
    });
    let compliance = parts.iter().fold(nalgebra::Matrix3::zeros(), |s, (f, _, inverse, ..)| s + inverse * *f);
    let stiff = compliance.try_inverse().unwrap();
    let coupling = parts.iter().fold(nalgebra::Matrix3::zeros(), |s, (f, _, _, nt, _)| s + nt * *f);
    let heat = parts.iter().fold(nalgebra::Vector3::zeros(), |s, (f, .., b)| s + b * *f);
    let (mut stiffness, mut thermal_stress, mut first) = (Matrix6::zeros(), Vector6::zeros(), Matrix6::zeros());
    for load in 0..7 {
        let mut strain = Vector6::zeros();
        let warmth = if load == 6 { 1.0 } else { 0.0 };
        if load < 6 {
            strain[load] = 1.0;
        }
        // mean normal strain: compliance σ_n − coupling ε_t + heat
        let stress = stiff * (part(&strain, normal) + coupling * part(&strain, tangent) - heat * warmth);
        let mut total = Vector6::zeros();
        for (k, (f, law, inverse, nt, b)) in parts.iter().enumerate() {
            let inside = inverse * stress - nt * part(&strain, tangent) + b * warmth;
            let mut local = strain;
            (0..3).for_each(|i| local[normal[i]] = inside[i]);
            total += (law.stiffness * local - law.thermal_stress * warmth) * *f;
            if k == 0 && load < 6 {
                first.set_column(load, &local);
            }
        }
        if load < 6 {
            stiffness.set_column(load, &total);
        } else {
            thermal_stress = -total;
        }
    }
    (ThermoElastic { stiffness, thermal_stress }, first)
}

/// Hill's energy condition and Levin's: the two ways to the thermal stress agree, ⟨β⟩ over strains of the phases and the cell's own.
#[test]
fn exact_thermal_stress_follows_from_the_mechanical_strains() {
    let cell = skew_cell([0.0; 2], true);
    let found = cell.solve(6, 1.0).unwrap().response;
    for load in 0..6 {
        let levin: f64 = (0..3)
            .map(|p| found.fractions[p] * cell.phases[p].solid.law.thermal_stress.dot(&found.phase_strain[p].column(load)))
            .sum();
        assert!((levin - found.thermal_stress[load]).abs() < 1e-9 * found.thermal_stress.amax(), "load {load}");
    }
    // the mean stress from the phases' mean strains is the cell's
    let stress = (0..3).fold(Matrix6::zeros(), |sum, p| {
        sum + cell.phases[p].solid.law.stiffness * found.phase_strain[p].fixed_view::<6, 6>(0, 0) * found.fractions[p]
    });
    assert!((stress - found.stiffness).amax() < 1e-9 * found.stiffness.amax());
}

/// Displaced fibres: films stay, the same seed gives the same cell, another another; the cell is no longer quite isotropic.
#[test]
fn bounds_displaced_fibres() {
    let (cell, regular) = (reference(), Arrangement::hexagonal(170e-6, 2, 2).unwrap());
    let at = |seed| displace(&regular, 82.5e-6, 4e-6, 1e-6, seed).unwrap();
    assert_eq!(at(7), at(7));
    assert_ne!(at(7), at(8));
    let displaced = Cell::of_fibres(&cell, &at(7)).unwrap().solve(5, 1.0).unwrap().response;
    let straight = homogenize(&cell).unwrap().constants;
    let c = displaced.constants().unwrap();
    // the rule of mixtures along the fibre does not know of places; across it they matter
    assert_relative_eq!(c.e[2], straight.e_z, max_relative = 1e-4);
    assert!((c.e[0] / straight.e_r - 1.0).abs() > 1e-3 && (c.e[0] / straight.e_r - 1.0).abs() < 0.2);
    assert!(displaced.anisotropy > 1e-3 && displaced.anisotropy < 0.2, "{:e}", displaced.anisotropy);
    assert!(displace(&regular, 84.8e-6, 4e-6, 1e-6, 1).is_err());
}

/// Order and mesh follow from the tolerance; the estimate holds against a much finer solution; what rounding forbids is refused.
#[test]
fn bounds_accuracy_asked_for() {
    let fibre =
        Inclusion { outlines: vec![Outline { centre: [0.1, 0.0], semi_axes: [0.35, 0.25], angle: 0.4 }], phases: vec![Some(0)] };
    let layout = Layout::new([[1.0, 0.1], [0.2, 0.9]], vec![fibre], 1).unwrap();
    let phases = vec![phase("fibre", wood(), Role::Glass), phase("epoxy", isotropic(&epoxy()), Role::Coating)];
    let cell = Cell { layout, phases };
    let finest = cell.solve(10, 2.0).unwrap().response.constants().unwrap().named();
    for tolerance in [1e-3, 1e-6] {
        let found = cell.homogenize_to(tolerance).unwrap();
        assert!(found.relative_error.iter().all(|(_, error)| *error <= tolerance));
        for (((name, value), (_, exact)), (_, error)) in
            found.constants.named().into_iter().zip(&finest).zip(&found.relative_error)
        {
            if !["alpha_xy", "k_xy", "m_rxy"].contains(&name) {
                assert!((value / exact - 1.0).abs() <= error.max(1e-9), "{name} to {tolerance:e}: {value:e} {exact:e} {error:e}");
            }
        }
    }
    match cell.homogenize_to(1e-15) {
        Err(Error::Accuracy { reached, requested, .. }) => assert!(requested == 1e-15 && reached > 1e-15 && reached < 1e-8),
        other => panic!("{:?}", other.map(|found| found.relative_error)),
    }
}

/// Densities mix by area, voids weigh nothing; one unknown makes all unknown.
#[test]
fn exact_density_and_heat_capacity() {
    let mut cell = skew_cell([0.0; 2], true);
    assert_eq!(cell.density().unwrap(), None);
    cell.phases.iter_mut().for_each(|p| (p.solid.density, p.solid.specific_heat) = (Some(1200.0), Some(1500.0)));
    let solid: f64 = cell.solve(4, 1.0).unwrap().response.fractions.iter().sum();
    assert!(solid < 0.99);
    assert_relative_eq!(cell.density().unwrap().unwrap(), 1200.0 * solid, max_relative = 1e-8);
    assert_relative_eq!(cell.heat_capacity().unwrap().unwrap(), 1200.0 * 1500.0 * solid, max_relative = 1e-8);
    cell.phases[0].solid.density = Some(-1.0);
    assert!(matches!(cell.heat_capacity(), Err(Error::Property { what: "density", .. })));
}

/// Where rounding is what is left, the estimate says so: a matrix nine orders softer than the fibre.
#[test]
fn rounding_is_in_the_estimate() {
    let cell = |youngs_modulus| FibreCell { adhesive: solid(youngs_modulus, 0.3, 250e-6, 0.45), ..reference() };
    let found =
        |cell: &FibreCell| Cell::of_fibres(cell, &Arrangement::hexagonal(cell.pitch, 1, 1).unwrap()).unwrap().homogenize_to(1e-6);
    match found(&cell(1.0)) {
        Err(Error::Accuracy { reached, why, .. }) => assert!(reached > 1e-5 && why.starts_with("rounding"), "{reached:e} {why}"),
        other => panic!("{:?}", other.map(|found| found.relative_error)),
    }
    let soft = cell(1e3);
    let (exact, found) = (homogenize(&soft).unwrap().constants, found(&soft).unwrap());
    let estimate = found.relative_error.iter().find(|(name, _)| *name == "g_xz").unwrap().1;
    let error = (found.constants.g[1] / exact.g_zr - 1.0).abs();
    assert!(1e-9 < error && error < estimate, "{error:e} {estimate:e}");
}

#[test]
fn bounds_phases_orders_and_tolerances_that_there_are_not_are_refused() {
    let cell = Cell::of_fibres(&reference(), &Arrangement::hexagonal(170e-6, 1, 1).unwrap()).unwrap();
    let said = |result: Result<(), Error>| result.unwrap_err().to_string();
    assert!(said(cell.solve(0, 1.0).map(|_| ())).contains("order = 0, but it must be at least 1"));
    for tolerance in [f64::NAN, -1e-3] {
        let expected = format!("relative_error = {tolerance}, but it must be 0 or more; `TOLERANCE` is 1e-6");
        assert_eq!(said(cell.homogenize_to(tolerance).map(|_| ())), expected);
        assert_eq!(said(homogenization::homogenize_to(&reference(), tolerance).map(|_| ())), expected);
    }

    let fibre = Inclusion { outlines: vec![Outline::circle([0.0, 0.0], 0.3)], phases: vec![Some(5)] };
    let of = |inclusion: &Inclusion, matrix| Cell {
        layout: Layout::new([[1.0, 0.0], [0.0, 1.0]], vec![inclusion.clone()], matrix).unwrap(),
        phases: vec![phase("glass", isotropic(&glass()), Role::Glass)],
    };
    let beyond = of(&fibre, 0);
    assert!(said(beyond.solve(4, 1.0).map(|_| ())).starts_with("inclusion 0 names phase 5, there are 1, numbered from 0; "));
    assert!(said(beyond.density().map(|_| ())).starts_with("inclusion 0 names phase 5"));
    let matrix = of(&Inclusion { phases: vec![Some(0)], ..fibre }, 2);
    assert!(said(matrix.solve(4, 1.0).map(|_| ())).starts_with("the matrix names phase 2, there are 1"));
}
