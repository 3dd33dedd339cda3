//! Closed forms of rings, tubes and composite walls.

use crate::common::{annulus, coil, edge_weights, isotropic, nodal_error, solve, stiffness, thermal_stress, wall};
use fem_core::material::ThermoElastic;
use fem_core::{Constraints, Edge, Factor, Form, Mesh, Problem, SparseMatrix};
use nalgebra::{DMatrix, Matrix2, Vector2};
use std::f64::consts::PI;

const AXI: Form = Form::AXISYMMETRIC_ELASTICITY;

/// Plane strain along the axis: u_y = 0 everywhere on both faces.
fn between_faces(mesh: &Mesh, height: f64) -> Vec<Option<f64>> {
    mesh.nodes().iter().flat_map(|p| [None, (p[1] == 0.0 || p[1] == height).then_some(0.0)]).collect()
}

fn heated(mesh: &Mesh, laws: &[ThermoElastic]) -> Vec<f64> {
    let problem = Problem::new(mesh, AXI, mesh.order() + 2);
    let load = problem.loads(&laws.iter().map(|l| Some(thermal_stress(AXI, l))).collect::<Vec<_>>()).expect("a load");
    let laws: Vec<_> = laws.iter().map(|l| Some(stiffness(AXI, l))).collect();
    solve(&problem, &laws, &between_faces(mesh, 2e-3), &load[0])
}

/// Radial displacement per K of a free ring, fibres along the hoop, ends held: with k² = C_θθ/C_rr the equilibrium
/// r² u'' + r u' − k² u = r (β_r − β_θ)/C_rr has the solution A r^k + B r^−k + P r, and σ_r = 0 at both radii gives A and B.
fn orthotropic_ring(law: ThermoElastic, [a, b]: [f64; 2]) -> impl Fn(f64) -> f64 {
    let (c_rr, c_rt, c_tt) = (law.stiffness[(0, 0)], law.stiffness[(0, 2)], law.stiffness[(2, 2)]);
    let (beta_r, beta_t) = (law.thermal_stress[0], law.thermal_stress[2]);
    let k = (c_tt / c_rr).sqrt();
    let particular = (beta_r - beta_t) / (c_rr - c_tt);
    let row = |r: f64| [(c_rr * k + c_rt) * r.powf(k - 1.0), (c_rt - c_rr * k) * r.powf(-k - 1.0)];
    let (at_a, at_b) = (row(a / b), row(1.0)); // radii in units of b
    let free = beta_r - (c_rr + c_rt) * particular;
    let c = Matrix2::new(at_a[0], at_a[1], at_b[0], at_b[1]).try_inverse().expect("regular") * Vector2::new(free, free);
    move |r| b * (c[0] * (r / b).powf(k) + c[1] * (r / b).powf(-k)) + particular * r
}

#[test]
fn exact_free_ring_wound_of_fibre() {
    let mesh = wall(10, &[43.5e-3, 46e-3, 48.825e-3], 2e-3);
    let exact = orthotropic_ring(coil(), [43.5e-3, 48.825e-3]);
    let u = heated(&mesh, &[coil(), coil()]);
    let error = nodal_error(&mesh, &u, |[r, _]| vec![exact(r), 0.0]);
    assert!(error < 1e-10, "{error:e}");
    // it does not move like a free isotropic ring of either expansion
    assert!(exact(43.5e-3) < 0.0 && exact(48.825e-3) > 3.36e-6 * 48.825e-3);
}

/// A tube under internal pressure p, ends held (Lamé 1852): u = (1+ν)/E · p a²/(b²−a²) · ((1−2ν) r + b²/r).
#[test]
fn exact_thick_tube_under_pressure() {
    let (a, b, height, p) = (10e-3, 25e-3, 2e-3, 1e6);
    for (e, nu) in [(68.9e9, 0.33), (2e6, 0.4998)] {
        let mesh = wall(12, &[a, 14e-3, 19e-3, b], height);
        let problem = Problem::new(&mesh, AXI, mesh.order() + 2);
        let mut load = vec![0.0; 2 * mesh.nodes().len()];
        let inside: Vec<usize> = (0..mesh.nodes().len()).filter(|i| mesh.nodes()[*i][0] == a).collect();
        for (node, w) in inside.iter().zip(edge_weights(mesh.order())) {
            load[2 * node] = p * std::f64::consts::TAU * a * w * height / 2.0;
        }
        let laws = vec![Some(stiffness(AXI, &isotropic(e, nu, 0.0))); 3];
        let u = solve(&problem, &laws, &between_faces(&mesh, height), &load);
        let factor = (1.0 + nu) / e * p * a * a / (b * b - a * a);
        let error = nodal_error(&mesh, &u, |[r, _]| vec![factor * ((1.0 - 2.0 * nu) * r + b * b / r), 0.0]);
        assert!(error < 1e-9, "nu {nu}: {error:e}");
    }
}

/// Radial displacement per K of two bonded rings a…c and c…b of different expansion, ends held: each alone grows by (1+ν)α r;
/// the pressure at c that closes the misfit adds Lamé's solution to each.
fn shrink_fit([a, c, b]: [f64; 3], [e1, nu1, alpha1]: [f64; 3], [e2, nu2, alpha2]: [f64; 3]) -> impl Fn(f64) -> f64 {
    let inner = move |r: f64| (1.0 + nu1) / e1 * c * c / (c * c - a * a) * ((1.0 - 2.0 * nu1) * r + a * a / r);
    let outer = move |r: f64| (1.0 + nu2) / e2 * c * c / (b * b - c * c) * ((1.0 - 2.0 * nu2) * r + b * b / r);
    let pressure = ((1.0 + nu1) * alpha1 - (1.0 + nu2) * alpha2) * c / (inner(c) + outer(c));
    move |r| {
        if r < c { (1.0 + nu1) * alpha1 * r - pressure * inner(r) } else { (1.0 + nu2) * alpha2 * r + pressure * outer(r) }
    }
}

const HUB: [f64; 3] = [68.9e9, 0.33, 23.6e-6];
const SLEEVE: [f64; 3] = [2.1e9, 0.45, 110e-6];
const RADII: [f64; 3] = [39.5e-3, 43.5e-3, 48.8e-3];

#[test]
fn exact_bonded_rings_of_different_expansion() {
    let mesh = wall(10, &RADII, 2e-3);
    let u = heated(&mesh, &[HUB, SLEEVE].map(|[e, nu, alpha]| isotropic(e, nu, alpha)));
    let exact = shrink_fit(RADII, HUB, SLEEVE);
    let error = nodal_error(&mesh, &u, |[r, _]| vec![exact(r), 0.0]);
    assert!(error < 1e-10, "{error:e}");
}

/// The same rings, meshed in the plane across their axis.
#[test]
fn exact_bonded_rings_in_the_plane() {
    let form = Form::PLANE_STRAIN;
    let mesh = annulus(10, &RADII, 8);
    let problem = Problem::new(&mesh, form, mesh.order() + 2);
    let laws = [HUB, SLEEVE].map(|[e, nu, alpha]| isotropic(e, nu, alpha));
    let load = problem.loads(&laws.map(|l| Some(thermal_stress(form, &l)))).unwrap();
    let mut prescribed = vec![None; load[0].len()];
    let node = |x: f64, y: f64| {
        let close = |p: &[f64; 2]| (p[0] - x).hypot(p[1] - y) < 1e-12;
        mesh.nodes().iter().position(close).expect("a node")
    };
    // symmetry leaves these at rest, and with them the ring
    for i in [2 * node(RADII[0], 0.0) + 1, 2 * node(-RADII[0], 0.0) + 1, 2 * node(0.0, RADII[0])] {
        prescribed[i] = Some(0.0);
    }
    let u = solve(&problem, &laws.map(|l| Some(stiffness(form, &l))), &prescribed, &load[0]);
    let exact = shrink_fit(RADII, HUB, SLEEVE);
    let error = nodal_error(&mesh, &u, |[x, y]| {
        let r = x.hypot(y);
        vec![exact(r) * x / r, exact(r) * y / r]
    });
    assert!(error < 1e-9, "{error:e}");
}

/// Heat flow through the wall of a composite cylinder: T falls by Q ln(r₂/r₁)/(2πk) across each layer.
#[test]
fn exact_conduction_through_a_composite_wall() {
    let (lines, k) = ([39.5e-3, 43.5e-3, 48.8e-3, 59.8e-3], [167.0, 0.34, 0.026]);
    let mesh = wall(12, &lines, 2e-3);
    let form = Form::AXISYMMETRIC_DIFFUSION;
    let problem = Problem::new(&mesh, form, mesh.order() + 2);
    let resistance: Vec<f64> = (0..3).map(|i| (lines[i + 1] / lines[i]).ln() / k[i]).collect();
    let q = 7.0 / resistance.iter().sum::<f64>();
    let exact = |r: f64| {
        let layer = if r < lines[1] {
            0
        } else if r < lines[2] {
            1
        } else {
            2
        };
        7.0 - q * (resistance[..layer].iter().sum::<f64>() + (r / lines[layer]).ln() / k[layer])
    };
    let ends = mesh.nodes().iter().map(|p| if p[0] == lines[0] { Some(7.0) } else { (p[0] == lines[3]).then_some(0.0) });
    let laws = k.map(|k| Some(DMatrix::identity(2, 2) * k));
    let t = solve(&problem, &laws, &ends.collect::<Vec<_>>(), &vec![0.0; mesh.nodes().len()]);
    let error = nodal_error(&mesh, &t, |[r, _]| vec![exact(r)]);
    assert!(error < 1e-10, "{error:e}");

    // at the outer radius, where the temperature is 0 and its differences keep their digits
    let all = Constraints::new(t.len()).eliminate(&vec![true; t.len()]);
    let flow = problem.stiffness(&all, &laws).unwrap().multiply(&t);
    let leaving: f64 = (0..t.len()).filter(|i| mesh.nodes()[*i][0] == lines[3]).map(|i| -flow[i]).sum();
    assert!((leaving / (std::f64::consts::TAU * 2e-3 * q) - 1.0).abs() < 1e-10);
}

/// Pappus: a region of area A whose centroid is at radius R turns into 2πRA.
#[test]
fn exact_measures_of_an_annulus_and_of_a_torus() {
    let plane = annulus(12, &[1.0, 1.5, 2.25], 6);
    let areas = Problem::new(&plane, Form::DIFFUSION, 14).region_measures().unwrap();
    for (area, [a, b]) in areas.iter().zip([[1.0, 1.5], [1.5, 2.25_f64]]) {
        let exact = std::f64::consts::PI * (b * b - a * a);
        assert!((area / exact - 1.0).abs() < 1e-10, "{area} against {exact}");
    }
    let moved = plane.nodes().iter().map(|p| [p[0] + 5.0, p[1]]).collect();
    let torus = Mesh::new(12, moved, plane.elements().to_vec(), plane.regions().to_vec()).unwrap();
    let volumes = Problem::new(&torus, AXI, 14).region_measures().unwrap();
    for (volume, area) in volumes.iter().zip(&areas) {
        assert!((volume / (std::f64::consts::TAU * 5.0 * area) - 1.0).abs() < 1e-10);
    }
}

/// A tube that is heated inside its wall, held at 0 on its bore and cooled from outside: T = c + d ln r − q r²/4k, where the source meets a node that is held.
#[test]
fn exact_a_source_beside_a_held_face_and_a_cooled_one() {
    let ([a, b], [k, q, h, air]) = ([10e-3, 30e-3], [2.0, 2e6, 40.0, 25.0]);
    // 4 elements of order 8 along the radius
    let radii: Vec<f64> = (0..5).map(|n| a + (b - a) * f64::from(n) / 4.0).collect();
    let mesh = Mesh::rectangles(8, &radii, &[0.0, 2e-3], |_, _| Some(0)).expect("a mesh");
    let problem = Problem::new(&mesh, Form::AXISYMMETRIC_DIFFUSION, 10);
    let mut constraints = Constraints::new(mesh.nodes().len());
    for (node, [r, _]) in mesh.nodes().iter().enumerate() {
        if *r == a {
            constraints.hold(node).expect("held");
        }
    }
    let map = constraints.eliminate(&problem.used(|_| true));
    let outer = |value: f64| [(3, Edge::XiHigh, value)];
    let conductivity = problem.stiffness(&map, &[Some(DMatrix::identity(2, 2) * k)]).expect("a conductivity");
    let exchange = problem.boundary_mass(&map, &outer(h)).expect("a surface");
    let inside = problem.source(&[Some(DMatrix::from_element(1, 1, q))]).expect("a source");
    let through = problem.surface_load(&outer(h * air)).expect("a load");
    // all that enters
    let [volume, area] = [PI * (b * b - a * a) * 2e-3, 2.0 * PI * b * 2e-3];
    assert!((inside.iter().sum::<f64>() / (q * volume) - 1.0).abs() < 1e-12);
    assert!((through.iter().sum::<f64>() / (h * air * area) - 1.0).abs() < 1e-12);
    assert_eq!(problem.source(&[None]).expect("nothing"), vec![0.0; mesh.nodes().len()]);

    let load: Vec<f64> = inside.iter().zip(&through).map(|(x, y)| x + y).collect();
    let factor = Factor::new(SparseMatrix::combine(1.0, &conductivity, 1.0, &exchange)).expect("a factor");
    let t = map.expand(&factor.solve(&[map.restrict(&load)]).expect("a solution")[0]);
    let bend = |r: f64| q * r * r / (4.0 * k);
    let d = (q * b / 2.0 + h * (bend(b) - bend(a) + air)) / (k / b + h * (b / a).ln());
    let exact = |r: f64| bend(a) - bend(r) + d * (r / a).ln();
    let error = mesh.nodes().iter().zip(&t).map(|([r, _], t)| (t - exact(*r)).abs()).fold(0.0, f64::max);
    assert!(error < 1e-6 * exact(b).abs(), "{error:e} of {}", exact(b));
}
