//! Meshes, laws and solves that the tests share.

#![allow(dead_code, reason = "each test binary uses its part")]

use fem_core::material::{Isotropic, ThermoElastic, TransverselyIsotropic};
use fem_core::{Constraints, Form, Mesh, Problem, ReferenceElement, polynomial};
use nalgebra::DMatrix;
use std::collections::HashMap;

/// Repeatable numbers in [−1, 1).
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A grid of `cells` elements on the unit square, each node moved by `map`; `region` of an element by its column.
pub(crate) fn mapped(
    order: usize,
    cells: [usize; 2],
    mut map: impl FnMut([f64; 2]) -> [f64; 2],
    region: impl Fn(usize) -> usize,
) -> Mesh {
    let lattice = polynomial::gauss_lobatto(order);
    let along = |k: usize, n: usize| {
        let cell = (k / order).min(n - 1);
        (cell as f64 + (1.0 + lattice[k - cell * order]) / 2.0) / n as f64
    };
    let width = cells[0] * order + 1;
    let count = width * (cells[1] * order + 1);
    let nodes = (0..count).map(|k| map([along(k % width, cells[0]), along(k / width, cells[1])])).collect();
    let per = order + 1;
    let element = |e: usize| {
        let (i, j) = (e % cells[0] * order, e / cells[0] * order);
        (0..per * per).map(|k| (j + k / per) * width + i + k % per).collect()
    };
    let count = cells[0] * cells[1];
    let regions = (0..count).map(|e| region(e % cells[0])).collect();
    Mesh::new(order, nodes, (0..count).map(element).collect(), regions).expect("a valid grid")
}

/// The rectangle [1, 2] × [0, 1] in 3 × 3 elements of which every node, also on the boundary, is out of place.
pub(crate) fn distorted(order: usize, seed: u64) -> Mesh {
    let mut noise = Noise(seed);
    let amplitude = 0.12 / 3.0 / (order * order) as f64;
    mapped(order, [3, 3], |[x, y]| [1.0 + x + amplitude * noise.next(), y + amplitude * noise.next()], |i| i % 2)
}

/// A whole annulus between circles of the given `radii` (one region between each two), nodes on circles, closed on itself.
pub(crate) fn annulus(order: usize, radii: &[f64], sectors: usize) -> Mesh {
    let cells = radii.len() - 1;
    let polar = |[x, y]: [f64; 2]| {
        let ring = ((x * cells as f64) as usize).min(cells - 1);
        let r = radii[ring] + (radii[ring + 1] - radii[ring]) * (x * cells as f64 - ring as f64);
        let (sin, cos) = (y * std::f64::consts::TAU).sin_cos();
        [r * cos, r * sin]
    };
    let open = mapped(order, [cells, sectors], polar, |i| i);
    let width = cells * order + 1;
    let kept = open.nodes().len() - width;
    let elements = open.elements().iter().map(|e| e.iter().map(|n| if *n < kept { *n } else { n - kept }).collect()).collect();
    Mesh::new(order, open.nodes()[..kept].to_vec(), elements, open.regions().to_vec()).expect("a valid annulus")
}

/// A tube's wall in (r, y): `lines` in r, one region between each two, height `height`, one element high.
pub(crate) fn wall(order: usize, lines: &[f64], height: f64) -> Mesh {
    let cells = lines.len() - 1;
    let place = |[x, y]: [f64; 2]| {
        let cell = ((x * cells as f64 + 1e-12) as usize).min(cells - 1);
        [lines[cell] + (lines[cell + 1] - lines[cell]) * (x * cells as f64 - cell as f64), height * y]
    };
    mapped(order, [cells, 1], place, |i| i)
}

/// Whether each node lies on the mesh's boundary: on an element edge that no other element has.
pub(crate) fn on_boundary(mesh: &Mesh) -> Vec<bool> {
    let p = mesh.order();
    let edge = |element: &[usize], side: usize| -> Vec<usize> {
        let at = |k: usize| [k, p * (p + 1) + k, k * (p + 1), k * (p + 1) + p][side];
        (0..=p).map(|k| element[at(k)]).collect()
    };
    let mut seen: HashMap<[usize; 2], (usize, Vec<usize>)> = HashMap::new();
    for element in mesh.elements() {
        for nodes in (0..4).map(|side| edge(element, side)) {
            let ends = [nodes[0].min(nodes[p]), nodes[0].max(nodes[p])];
            seen.entry(ends).or_insert((0, nodes)).0 += 1;
        }
    }
    let mut boundary = vec![false; mesh.nodes().len()];
    for (count, nodes) in seen.into_values() {
        nodes.iter().for_each(|node| boundary[*node] |= count == 1);
    }
    boundary
}

pub(crate) fn isotropic(e: f64, nu: f64, alpha: f64) -> ThermoElastic {
    Isotropic { youngs_modulus: e, poisson_ratio: nu, thermal_expansion: alpha }.law().expect("a valid solid")
}

/// A coil like the paper's: stiff along the fibre, soft and expansive across it.
pub(crate) fn coil() -> ThermoElastic {
    let coil = TransverselyIsotropic {
        e_z: 14.5e9,
        e_r: 95.2e6,
        g_zr: 24.1e6,
        nu_zr: 0.392,
        nu_r: 0.979,
        alpha_z: 3.36e-6,
        alpha_r: 193e-6,
    };
    coil.law().expect("a valid coil")
}

/// Voigt rows of the strains of the two elastic forms.
pub(crate) fn rows(form: Form) -> &'static [usize] {
    if form == Form::PLANE_STRAIN { &[0, 1, 5] } else { &[0, 1, 2, 5] }
}

/// Stiffness of a law in a form's strains. In the axisymmetric form the law's z is the hoop direction.
pub(crate) fn stiffness(form: Form, law: &ThermoElastic) -> DMatrix<f64> {
    let rows = rows(form);
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| law.stiffness[(rows[i], rows[j])])
}

/// The thermal stress of 1 K in a form's strains.
pub(crate) fn thermal_stress(form: Form, law: &ThermoElastic) -> DMatrix<f64> {
    DMatrix::from_fn(rows(form).len(), 1, |i, _| law.thermal_stress[rows(form)[i]])
}

/// Solves with the unknowns that are `Some` prescribed, under the full load vector `load`.
pub(crate) fn solve(problem: &Problem, laws: &[Option<DMatrix<f64>>], prescribed: &[Option<f64>], load: &[f64]) -> Vec<f64> {
    let everything = problem.used(|_| true);
    let all = Constraints::new(prescribed.len()).eliminate(&everything);
    let mut free = Constraints::new(prescribed.len());
    (0..prescribed.len()).filter(|i| prescribed[*i].is_some()).for_each(|i| free.hold(i).expect("an unknown"));
    let free = free.eliminate(&everything);
    let lift: Vec<f64> = prescribed.iter().map(|v| v.unwrap_or(0.0)).collect();
    let reaction = problem.stiffness(&all, laws).expect("a stiffness").multiply(&lift);
    let rhs: Vec<f64> = load.iter().zip(reaction).map(|(f, r)| f - r).collect();
    let factor = problem.factor(&free, laws).expect("positive definite");
    let u = free.expand(&factor.solve(&[free.restrict(&rhs)]).expect("a solution")[0]);
    u.iter().zip(lift).map(|(u, l)| u + l).collect()
}

/// Integrals over [−1, 1] of the Lagrange polynomials of `order`.
pub(crate) fn edge_weights(order: usize) -> Vec<f64> {
    let (basis, q) = (polynomial::Lagrange::gauss_lobatto(order), polynomial::gauss(order + 1));
    let mut weights = vec![0.0; order + 1];
    for (x, w) in q.points.iter().zip(&q.weights) {
        weights.iter_mut().zip(basis.evaluate(*x).0).for_each(|(sum, v)| *sum += w * v);
    }
    weights
}

/// The largest deviation of nodal values, component by component, from `exact`, relative to its largest value.
pub(crate) fn nodal_error(mesh: &Mesh, u: &[f64], exact: impl Fn([f64; 2]) -> Vec<f64>) -> f64 {
    let exact: Vec<f64> = mesh.nodes().iter().flat_map(|p| exact(*p)).collect();
    assert_eq!(exact.len(), u.len());
    let largest = exact.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    u.iter().zip(&exact).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / largest
}

/// A field and its gradient, component by component.
pub(crate) type Field<'a> = &'a dyn Fn([f64; 2]) -> (Vec<f64>, Vec<[f64; 2]>);

/// L2 norm of the error of u, and of its gradient, by a quadrature three points finer than the element's order.
pub(crate) fn errors(mesh: &Mesh, form: Form, u: &[f64], exact: Field) -> [f64; 2] {
    let reference = ReferenceElement::new(mesh.order(), mesh.order() + 4);
    let c = form.components;
    let mut squares = [0.0; 2];
    for (e, nodes) in mesh.elements().iter().enumerate() {
        let g = reference.geometry(mesh, e, form.measure).expect("a valid element");
        for k in 0..g.weight.len() {
            let (value, gradient) = exact([g.x[k], g.y[k]]);
            for i in 0..c {
                let sum = |m: &DMatrix<f64>| -> f64 { nodes.iter().enumerate().map(|(a, n)| m[(a, k)] * u[n * c + i]).sum() };
                squares[0] += g.weight[k] * (sum(&reference.value) - value[i]).powi(2);
                squares[1] += g.weight[k] * (sum(&g.d_x) - gradient[i][0]).powi(2);
                squares[1] += g.weight[k] * (sum(&g.d_y) - gradient[i][1]).powi(2);
            }
        }
    }
    squares.map(f64::sqrt)
}

/// Strains of the nodal solution `u` at the centre of every element.
pub(crate) fn strains_at_centres(problem: &Problem, form: Form, u: &[f64]) -> Vec<Vec<f64>> {
    let mesh = problem.mesh();
    let strains = |e: usize| {
        let [n, dx, dy] = problem.at_point(e, 0.1, -0.3);
        let nodes = &mesh.elements()[e];
        let sum = |d: &[f64], c: usize| -> f64 { d.iter().zip(nodes).map(|(d, node)| d * u[2 * node + c]).sum() };
        let x: f64 = n.iter().zip(nodes).map(|(n, node)| n * mesh.nodes()[*node][0]).sum();
        let shear = sum(&dy, 0) + sum(&dx, 1);
        if form == Form::PLANE_STRAIN {
            vec![sum(&dx, 0), sum(&dy, 1), shear]
        } else {
            vec![sum(&dx, 0), sum(&dy, 1), sum(&n, 0) / x, shear]
        }
    };
    (0..mesh.elements().len()).map(strains).collect()
}
