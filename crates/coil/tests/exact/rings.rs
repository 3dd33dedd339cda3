//! Thermal stress of rings.

use super::wall;
use crate::common::reference;
use fem_core::material::ThermoElastic;
use fem_core::{Constraints, Form, Problem};
use nalgebra::{DMatrix, Matrix4, Vector4};

/// Radial displacement of bonded rings under ΔT = t₀ + t₂ r² of one common axial strain: in each layer, with k² = C_θθ/C_rr,
/// u = A r^k + B r^−k + P r + Q r³; σ_r = 0 at both surfaces, u and σ_r continuous between.
struct Rings {
    r: [f64; 3],
    laws: [ThermoElastic; 2],
    t: [f64; 2],
    axial: f64,
    coefficients: Vector4<f64>,
}

/// [C_rr, C_rθ, C_θθ, C_ry, C_θy, β_r, β_θ] in the coil's frame: r is the law's x, y its y, hoop its z.
fn constants(law: &ThermoElastic) -> [f64; 7] {
    let c = law.stiffness;
    let beta = law.thermal_stress;
    [c[(0, 0)], c[(0, 2)], c[(2, 2)], c[(0, 1)], c[(2, 1)], beta[0], beta[2]]
}

impl Rings {
    fn new(r: [f64; 3], laws: [ThermoElastic; 2], t: [f64; 2], axial: f64) -> Self {
        let mut rings = Self { r, laws, t, axial, coefficients: Vector4::zeros() };
        // rows: σ_r(a), σ_r(b), jumps of u and σ_r; unknowns A, B of both layers; scaled so that all are of one size
        let stiff = constants(&laws[0])[0];
        let equations = |x: &Rings| {
            let (inner, outer) = (x.at(0, r[1]), x.at(1, r[1]));
            let value = [x.at(0, r[0])[1] / stiff, x.at(1, r[2])[1] / stiff];
            Vector4::new(value[0], value[1], (inner[0] - outer[0]) / r[1], (inner[1] - outer[1]) / stiff)
        };
        let rest = equations(&rings);
        let mut matrix = Matrix4::zeros();
        for k in 0..4 {
            rings.coefficients = Vector4::zeros();
            rings.coefficients[k] = 1.0;
            matrix.set_column(k, &(equations(&rings) - rest));
        }
        rings.coefficients = matrix.lu().solve(&-rest).expect("regular");
        rings
    }

    /// u and σ_r.
    fn at(&self, layer: usize, r: f64) -> [f64; 2] {
        let [c_rr, c_rt, c_tt, c_ry, c_ty, beta_r, beta_t] = constants(&self.laws[layer]);
        let (k, x) = ((c_tt / c_rr).sqrt(), r / self.r[1]);
        let [t0, t2] = self.t;
        // C_rr (r² u″ + r u′) − C_θθ u = r [(β_r − β_θ) T + r β_r T′] + r (C_θy − C_ry) ε_y
        let gap = c_rr - c_tt;
        let linear =
            ((beta_r - beta_t) * t0 + (c_ty - c_ry) * self.axial) / if gap.abs() > 1e-9 * c_rr { gap } else { f64::INFINITY };
        let cubic = ((beta_r - beta_t) * t2 + 2.0 * beta_r * t2) / (9.0 * c_rr - c_tt);
        let [a, b] = [self.coefficients[2 * layer], self.coefficients[2 * layer + 1]];
        let u = self.r[1] * (a * x.powf(k) + b * x.powf(-k)) + linear * r + cubic * r.powi(3);
        let strain = k * (a * x.powf(k - 1.0) - b * x.powf(-k - 1.0)) + linear + 3.0 * cubic * r * r;
        [u, c_rr * strain + c_rt * u / r + c_ry * self.axial - beta_r * (t0 + t2 * r * r)]
    }

    fn displacement(&self, r: f64) -> f64 {
        self.at(usize::from(r > self.r[1]), r)[0]
    }
}

/// Axial displacement `axial · y` prescribed on both faces, temperature per node: radial displacement, relative error and size.
fn ring_error(rings: &Rings) -> f64 {
    let height = 2e-3;
    let mesh = wall(12, &rings.r, height);
    let form = Form::AXISYMMETRIC_ELASTICITY;
    let rows = [0, 1, 2, 5];
    let problem = Problem::new(&mesh, form, 15);
    let stiffness = rings.laws.map(|l| Some(DMatrix::from_fn(4, 4, |i, j| l.stiffness[(rows[i], rows[j])])));
    let beta = rings.laws.map(|l| Some(DMatrix::from_fn(4, 1, |i, _| l.thermal_stress[rows[i]])));
    let everything = problem.used(|_| true);
    let count = 2 * mesh.nodes().len();
    let (mut constraints, mut lift) = (Constraints::new(count), vec![0.0; count]);
    for (i, p) in mesh.nodes().iter().enumerate().filter(|(_, p)| p[1] == 0.0 || p[1] == height) {
        constraints.hold(2 * i + 1).expect("node");
        lift[2 * i + 1] = rings.axial * p[1];
    }
    let (map, all) = (constraints.eliminate(&everything), Constraints::new(count).eliminate(&everything));
    let t: Vec<f64> = mesh.nodes().iter().map(|p| rings.t[0] + rings.t[1] * p[0] * p[0]).collect();
    let load = problem.coupling(&beta).expect("coupling").multiply(&t);
    let reaction = problem.stiffness(&all, &stiffness).expect("stiffness").multiply(&lift);
    let rhs: Vec<f64> = load.iter().zip(reaction).map(|(f, r)| f - r).collect();
    let factor = problem.factor(&map, &stiffness).expect("factor");
    let u = map.expand(&factor.solve(&[map.restrict(&rhs)]).expect("solve")[0]);
    let exact: Vec<f64> = mesh.nodes().iter().map(|p| rings.displacement(p[0])).collect();
    let size = exact.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    exact.iter().enumerate().map(|(i, e)| (u[2 * i] - e).abs()).fold(0.0, f64::max) / size
}

fn coil_law() -> ThermoElastic {
    reference().body.elastic.law().expect("law")
}

fn spool_law() -> ThermoElastic {
    crate::common::aluminium().elastic.law().expect("law")
}

#[test]
fn exact_a_fibre_ring_under_a_radial_temperature_distribution() {
    let rings = Rings::new([43.5e-3, 46e-3, 48.825e-3], [coil_law(), coil_law()], [3.0, -4e3], 1.7e-5);
    let error = ring_error(&rings);
    assert!(error < 1e-10, "{error:e}");
}

#[test]
fn exact_a_coil_shrunk_on_its_hub_by_a_radial_temperature_distribution() {
    let rings = Rings::new([39.5e-3, 43.5e-3, 48.825e-3], [spool_law(), coil_law()], [-30.0, 2e4], -3e-5);
    let error = ring_error(&rings);
    assert!(error < 1e-10, "{error:e}");
    // Lamé and Duhamel: with two layers of one isotropic material and no temperature gradient nothing but free expansion is left
    let free = Rings::new([39.5e-3, 43.5e-3, 48.825e-3], [spool_law(), spool_law()], [10.0, 0.0], 23.6e-5);
    assert!((free.displacement(45e-3) / (23.6e-5 * 45e-3) - 1.0).abs() < 1e-12);
}
