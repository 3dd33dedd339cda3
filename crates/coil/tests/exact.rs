//! The coil in time and under heat against closed forms: composite cylinder, thermal stress of rings, energy, order of the stepping.

use crate::common::{changed, reference};
use coil::{
    Drive, Dynamics, Error, Fidelity, Heater, MeshFineness, Model, Mount, Outputs, Profile, Reduction, STANDARD, Side,
    ThermalModel, functionals,
};
use fem_core::material::ThermoElastic;
use fem_core::{Constraints, Form, Mesh, Problem, State, Transient, polynomial};
use nalgebra::{DMatrix, Matrix4, Vector4};
use std::f64::consts::PI;

const QUICK: MeshFineness = crate::common::QUICK.resolution;

/// A tube's wall in (r, y): one region between each two of `lines`, one element high.
fn wall(order: usize, lines: &[f64], height: f64) -> Mesh {
    let lattice = polynomial::gauss_lobatto(order);
    let cells = lines.len() - 1;
    let width = cells * order + 1;
    let r = |a: usize| {
        let cell = (a / order).min(cells - 1);
        lines[cell] + (lines[cell + 1] - lines[cell]) * (1.0 + lattice[a - cell * order]) / 2.0
    };
    let nodes = (0..width * (order + 1)).map(|k| [r(k % width), height * (1.0 + lattice[k / width]) / 2.0]).collect();
    let element = |e: usize| (0..(order + 1).pow(2)).map(|k| k / (order + 1) * width + e * order + k % (order + 1)).collect();
    Mesh::new(order, nodes, (0..cells).map(element).collect(), (0..cells).collect()).expect("mesh")
}

// ---- a composite cylinder whose outer surface is suddenly heated ----

/// J_n and Y_n of real x > 0 by their integral representations (Abramowitz and Stegun, 9.1.22), Gauss panels that follow the oscillation.
fn bessel(n: i32, x: f64) -> [f64; 2] {
    let rule = polynomial::gauss(24);
    let integrate = |from: f64, to: f64, panels: usize, f: &dyn Fn(f64) -> f64| -> f64 {
        let h = (to - from) / panels as f64;
        let panel = |p: usize| -> f64 {
            let at = |x: f64| from + h * (p as f64 + (1.0 + x) / 2.0);
            rule.points.iter().zip(&rule.weights).map(|(x, w)| w * f(at(*x))).sum::<f64>() * h / 2.0
        };
        (0..panels).map(panel).sum()
    };
    let m = f64::from(n);
    let panels = 8 + x as usize / 8;
    let j = integrate(0.0, PI, panels, &|a| (x * a.sin() - m * a).cos()) / PI;
    let sine = integrate(0.0, PI, panels, &|a| (x * a.sin() - m * a).sin());
    let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
    let tail = integrate(0.0, (800.0 / x).asinh(), 24, &|s| ((m * s).exp() + sign * (-m * s).exp()) * (-x * s.sinh()).exp());
    [j, (sine - tail) / PI]
}

/// Inner and outer radius, interface; conductivity and heat capacity per volume of the two layers.
struct Composite {
    r: [f64; 3],
    k: [f64; 2],
    c: [f64; 2],
}

/// An eigenfunction R(r) exp(−λ t): coefficients of J0 and Y0 of √(λ c/k) r in both layers.
struct Eigenfunction {
    rate: f64,
    coefficients: [[f64; 2]; 2],
}

impl Composite {
    fn wavenumber(&self, layer: usize, rate: f64) -> f64 {
        (rate * self.c[layer] / self.k[layer]).sqrt()
    }

    /// R and k R′ of the unnormalised solution with no flux at r[0], continued through the interface, at a radius.
    fn solution(&self, rate: f64) -> [[f64; 2]; 2] {
        let q = [0, 1].map(|l| self.wavenumber(l, rate));
        // R₀ = Y1(qa) J0(qr) − J1(qa) Y0(qr) has R₀′(a) = 0
        let at_bore = bessel(1, q[0] * self.r[0]);
        let inner = [at_bore[1], -at_bore[0]];
        let [value, flux] = self.evaluate(0, q[0], inner, self.r[1]);
        let x = q[1] * self.r[1];
        let (b0, b1) = (bessel(0, x), bessel(1, x));
        // Wronskian J1 Y0 − J0 Y1 = 2/(πx)
        let (slope, w) = (flux / (self.k[1] * q[1]), PI * x / 2.0);
        let outer = [w * (-b1[1] * value - b0[1] * slope), w * (b1[0] * value + b0[0] * slope)];
        [inner, outer]
    }

    /// R and k R′ in a layer.
    fn evaluate(&self, layer: usize, q: f64, [a, b]: [f64; 2], r: f64) -> [f64; 2] {
        let (b0, b1) = (bessel(0, q * r), bessel(1, q * r));
        [a * b0[0] + b * b0[1], -self.k[layer] * q * (a * b1[0] + b * b1[1])]
    }

    /// R(b) as a function of the rate: its roots are the eigenvalues.
    fn at_surface(&self, rate: f64) -> f64 {
        self.evaluate(1, self.wavenumber(1, rate), self.solution(rate)[1], self.r[2])[0]
    }

    /// The first `count` eigenfunctions, their roots bracketed on a fine scan and bisected.
    fn eigenfunctions(&self, count: usize) -> Vec<Eigenfunction> {
        // phase across both layers per √rate: roots lie about π apart in it
        let phase: f64 = (0..2).map(|l| self.wavenumber(l, 1.0) * (self.r[l + 1] - self.r[l])).sum();
        let at = |i: usize| ((i as f64 + 0.5) * 0.04 * PI / phase).powi(2);
        let mut found = Vec::new();
        let (mut i, mut below) = (0, self.at_surface(at(0)));
        while found.len() < count {
            i += 1;
            let above = self.at_surface(at(i));
            if below * above < 0.0 {
                let (mut low, mut high) = (at(i - 1), at(i));
                for _ in 0..60 {
                    let middle = f64::midpoint(low, high);
                    if self.at_surface(middle) * below > 0.0 { low = middle } else { high = middle }
                }
                let rate = f64::midpoint(low, high);
                found.push(Eigenfunction { rate, coefficients: self.solution(rate) });
            }
            below = above;
        }
        found
    }

    fn value(&self, f: &Eigenfunction, r: f64) -> f64 {
        let layer = usize::from(r > self.r[1]);
        self.evaluate(layer, self.wavenumber(layer, f.rate), f.coefficients[layer], r)[0]
    }

    /// Temperature `t` after the surface was raised by 1: 1 − Σ a R(r) exp(−λt), a = ∫ c R r dr / ∫ c R² r dr.
    fn step(&self, functions: &[Eigenfunction], radii: &[f64], t: f64) -> Vec<f64> {
        let mut temperature = vec![1.0; radii.len()];
        for f in functions {
            // ∫ c R r dr is the flux through the surface over λ; ∫ c R² r dr by Sturm–Liouville: in each layer
            // ∫ R² r dr = [r² (R² + (R′/q)²)]/2
            let mut norm = 0.0;
            for l in 0..2 {
                let q = self.wavenumber(l, f.rate);
                let half = |r: f64| {
                    let [v, flux] = self.evaluate(l, q, f.coefficients[l], r);
                    r * r * (v * v + (flux / (self.k[l] * q)).powi(2)) / 2.0
                };
                norm += self.c[l] * (half(self.r[l + 1]) - half(self.r[l]));
            }
            let surface = self.evaluate(1, self.wavenumber(1, f.rate), f.coefficients[1], self.r[2]);
            let amplitude = -surface[1] * self.r[2] / f.rate / norm * (-f.rate * t).exp();
            temperature.iter_mut().zip(radii).for_each(|(v, &r)| *v -= amplitude * self.value(f, r));
        }
        temperature
    }
}

#[test]
fn exact_bessel_functions_of_this_file() {
    // Abramowitz and Stegun, table 9.1
    for (n, x, [j, y]) in [
        (0, 1.0, [0.765_197_686_557_966_6, 0.088_256_964_215_676_96]),
        (1, 1.0, [0.440_050_585_744_933_5, -0.781_212_821_300_288_7]),
        (0, 10.0, [-0.245_935_764_451_348_3, 0.055_671_167_283_599_4]),
        (1, 10.0, [0.043_472_746_168_861_4, 0.249_015_424_206_953_9]),
        (0, 100.0, [0.019_985_850_304_223_12, -0.077_244_313_365_083_15]),
    ] {
        let [ours_j, ours_y] = bessel(n, x);
        assert!((ours_j - j).abs() < 1e-13 && (ours_y - y).abs() < 1e-13, "n {n}, x {x}: {ours_j}, {ours_y}");
    }
}

/// A hub of aluminium under a coil of the reference's conductivity, ends without flux: the heat flow that `ThermalModel` steps, on
/// fem-core because a design always has air around it.
#[test]
fn exact_a_composite_cylinder_follows_a_step_of_its_surface() {
    let body = Composite { r: [39.5e-3, 43.5e-3, 48.825e-3], k: [167.0, 0.34], c: [2700.0 * 896.0, 1400.0 * 1300.0] };
    // lines crowd at the interface and at the surface, where the step begins
    let lines = [39.5e-3, 43.5e-3, 44.2e-3, 46e-3, 47.7e-3, 48.5e-3, 48.74e-3, 48.825e-3];
    let mesh = wall(8, &lines, 2e-3);
    let problem = Problem::new(&mesh, Form::AXISYMMETRIC_DIFFUSION, 10);
    let of = |cell: usize, of: [f64; 2]| of[usize::from(cell > 0)];
    let laws: Vec<_> = (0..7).map(|cell| Some(DMatrix::identity(2, 2) * of(cell, body.k))).collect();
    let capacities: Vec<_> = (0..7).map(|cell| Some(DMatrix::from_element(1, 1, of(cell, body.c)))).collect();
    let nodes = mesh.nodes().len();
    let mut constraints = Constraints::new(nodes);
    for i in (0..nodes).filter(|&i| mesh.nodes()[i][0] == body.r[2]) {
        constraints.hold(i).expect("node");
    }
    let everything = problem.used(|_| true);
    let (map, all) = (constraints.eliminate(&everything), Constraints::new(nodes).eliminate(&everything));
    let capacity = problem.mass(&map, &capacities).expect("capacity");
    let content = map.restrict(&problem.mass(&all, &capacities).expect("capacity").multiply(&vec![1.0; nodes]));
    let conductivity = problem.stiffness(&map, &laws).expect("conductivity");
    let mut transient = Transient::new(capacity, conductivity.clone()).expect("system");
    // T − 1 starts at −1 everywhere inside: projected, as a jump of a drive is, so that no heat is lost
    let start: Vec<f64> = transient.rate_of_load(&content).expect("projection").iter().map(|v| -v).collect();
    let flow: Vec<f64> = conductivity.multiply(&start).iter().map(|f| -f).collect();
    let mut state = State { rate: transient.rate_of_load(&flow).expect("rate"), value: start };
    let (load, mut halvings) = (vec![0.0; map.reduced()], 0);
    let functions = body.eigenfunctions(24);
    assert!(functions.windows(2).all(|w| w[1].rate > w[0].rate));
    let bottom: Vec<usize> = (0..nodes).filter(|&i| mesh.nodes()[i][1] == 0.0).collect();
    let radii: Vec<f64> = bottom.iter().map(|&i| mesh.nodes()[i][0]).collect();
    let (mut time, mut worst) = (0.0, 0.0_f64);
    for until in [2.0, 10.0, 40.0, 160.0] {
        state = transient.advance(&state, &load, until - time, 1e-8, &mut halvings).expect("run");
        time = until;
        let (exact, ours) = (body.step(&functions, &radii, time), map.expand(&state.value));
        let off = bottom.iter().zip(&exact).map(|(&i, exact)| (ours[i] + 1.0 - exact).abs()).fold(0.0, f64::max);
        worst = worst.max(off);
    }
    // 1.8e-7 is the stepping's own
    assert!(worst < 3e-7, "{worst:e}");
}

// ---- thermal stress of rings ----

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

// ---- energy ----

/// Heat content \[J\] and heat flow out through walls and mounts \[W\] as functionals of the temperature at all nodes.
///
/// Summed over the free nodes the discrete equations read d/dt Σ(C T) = P − Σ(K T), exactly; what the walls' nodes hold and pass on
/// is put on one of them, as all have the chamber's temperature.
fn heat(thermal: &ThermalModel) -> Vec<Vec<f64>> {
    let ones = vec![1.0; thermal.map().reduced()];
    let wall = thermal.map().expand(&ones).iter().position(|v| *v == 0.0).expect("a node on the wall");
    let content = thermal.capacity().multiply(&ones);
    let flow = thermal.conductivity().matrix().multiply(&ones);
    let on_wall = [thermal.stored()[0].iter().sum::<f64>() - content.iter().sum::<f64>(), -flow.iter().sum::<f64>()];
    [content, flow]
        .iter()
        .zip(on_wall)
        .map(|(free, at_wall)| {
            let mut functional = thermal.map().expand(free);
            functional[wall] = at_wall;
            functional
        })
        .collect()
}

const POWER: f64 = 0.7;
/// Corners of the chamber's course: rest, 20 K up, rest until all is steady.
const CORNERS: [(f64, f64); 4] = [(0.0, 0.0), (600.0, 0.0), (1200.0, 20.0), (60_000.0, 20.0)];
const DRIVES: [Drive; 2] = [Drive::Chamber, Drive::Heaters];

fn heated() -> ThermalModel {
    let design = changed(|d| {
        d.heat.mounts.push(Mount { side: Side::Right, conductance: 20.0 });
        d.heat.heaters.push(Heater { side: Side::Right, power: POWER });
    });
    ThermalModel::new(&design, &MeshFineness { order: 2, layers: 0, ratio: 0.2 }, &DRIVES).expect("model")
}

/// Instants after each corner at the Gauss points of panels that double in length, with their weights; the corners have none.
fn instants() -> Vec<(f64, f64, f64)> {
    let rule = polynomial::gauss(8);
    let mut all = vec![(CORNERS[0].0, CORNERS[0].1, 0.0)];
    for w in CORNERS.windows(2) {
        let [(t0, u0), (t1, u1)] = [w[0], w[1]];
        let (mut from, mut to) = (t0, t0 + 1e-4);
        while from < t1 {
            for (x, weight) in rule.points.iter().zip(&rule.weights) {
                let t = from + (to - from) * (1.0 + x) / 2.0;
                all.push((t, u0 + (u1 - u0) * (t - t0) / (t1 - t0), weight * (to - from) / 2.0));
            }
            (from, to) = (to, (to + 2.0 * (to - from)).min(t1));
        }
        all.push((t1, u1, 0.0));
    }
    all
}

#[test]
fn exact_the_full_run_keeps_the_energy() {
    let thermal = heated();
    let instants = instants();
    let time: Vec<f64> = instants.iter().map(|i| i.0).collect();
    let profile = Profile { drives: vec![instants.iter().map(|i| i.1).collect(), vec![1.0; time.len()]], time };
    let run = thermal.run(&profile, &heat(&thermal), 1e-9).expect("run").outputs;
    let out: f64 = run.iter().zip(&instants).map(|(row, i)| i.2 * row[1]).sum();
    let (gained, put_in) = (run[run.len() - 1][0] - run[0][0], POWER * CORNERS[3].0);
    let off = (put_in - out - gained) / put_in;
    assert!(off.abs() < 1e-8, "{off:e}");
    assert!((run[run.len() - 1][1] / POWER - 1.0).abs() < 1e-8, "at the end the power leaves: {} W", run[run.len() - 1][1]);
}

#[test]
fn exact_the_reduced_model_keeps_the_energy() {
    let thermal = heated();
    let [content, flow]: [Vec<f64>; 2] = heat(&thermal).try_into().expect("two functionals");
    // read in the places of thermometer and coil
    let outputs = Outputs { thermometer: content, coil_mean: flow, parts: Vec::new() };
    let reduced = Reduction::new(&thermal, &outputs, 24).expect("reduction").reduced;
    let (content, flow) = (reduced.thermometer(), reduced.coil_mean());
    let instants = instants();
    let time: Vec<f64> = instants.iter().map(|i| i.0).collect();
    let courses = [instants.iter().map(|i| i.1).collect(), vec![1.0; time.len()]];
    let mut steps = reduced.steps(&time, &courses, &[0.0, 0.0]);
    let (start, mut out) = (content.of(steps.state()), 0.0);
    for (t, _, weight) in &instants[1..] {
        steps.next().expect("a step an instant");
        out += weight * flow.of(steps.state());
        let put_in = POWER * t;
        // at every corner, in the middle of a transient or at rest
        if CORNERS[1..].iter().any(|corner| corner.0 == *t) {
            let off = (put_in - out - (content.of(steps.state()) - start)) / put_in;
            assert!(off.abs() < 1e-8, "until {t} s: {off:e}");
        }
    }
}

// ---- time ----

/// Order of the stepping on the coil's own matrices, from its slowest mode: fem-core's tests measure it on a rod.
#[test]
fn mms_the_coils_heat_flow_is_stepped_to_second_order() {
    let thermal = ThermalModel::new(&reference(), &QUICK, &[Drive::Chamber]).expect("model");
    let conductivity = thermal.conductivity();
    let mut start = conductivity.solve(thermal.stored()).expect("solve").remove(0);
    for _ in 0..3 {
        start = conductivity.solve(&[thermal.capacity().multiply(&start)]).expect("solve").remove(0);
        let largest = start.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        start.iter_mut().for_each(|v| *v /= largest);
    }
    let load = vec![0.0; start.len()];
    let end = |steps: u32| {
        let mut transient = Transient::new(thermal.capacity().clone(), conductivity.matrix().clone()).expect("system");
        let flow: Vec<f64> = conductivity.matrix().multiply(&start).iter().map(|f| -f).collect();
        let mut state = State { rate: transient.rate_of_load(&flow).expect("rate"), value: start.clone() };
        for _ in 0..steps {
            state = transient.step(&state, &load, 2000.0 / f64::from(steps)).expect("step").0;
        }
        state.value
    };
    let finest = end(1024);
    let errors: Vec<f64> =
        [8, 16, 32, 64].map(|n| end(n).iter().zip(&finest).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)).to_vec();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.15, "order {order:.3} from errors {errors:?}");
    }
}

/// A staircase of 10 K steps at 2 K/min through a controller with a lag of 80 s, rows every 30 s.
fn staircase() -> Profile {
    let programme = |t: f64| (0..4).map(|k| (t - 600.0 - 3000.0 * f64::from(k)).clamp(0.0, 300.0) / 30.0).sum::<f64>();
    let time = crate::common::half_minutes(450);
    let mut chamber = 0.0;
    let mut course = Vec::new();
    for t in &time {
        course.push(chamber);
        for k in 0..30 {
            chamber += (programme(t + f64::from(k) + 0.5) - chamber) * (1.0 - (-1.0_f64 / 80.0).exp());
        }
    }
    Profile { drives: vec![course], time }
}

#[test]
fn exact_reduced_and_full_runs_agree_on_a_staircase() {
    let design = reference();
    let thermal = ThermalModel::new(&design, &QUICK, &[Drive::Chamber]).expect("model");
    let outputs = functionals(&design, &Model::new(&design, &QUICK).expect("model"), &thermal).expect("outputs");
    let profile = staircase();
    let [shupe, eo_axial, eo_radial] = outputs.parts[0].clone();
    let full = thermal.run(&profile, &[shupe, eo_axial, eo_radial, outputs.thermometer], 1e-5).expect("run").outputs;
    let fidelity = Fidelity { resolution: QUICK, ..STANDARD };
    let reduced = Dynamics::new(&design, &[Drive::Chamber], &fidelity).expect("model").simulate(&profile).expect("run");
    let rate = |n: usize, part: usize| (full[n][part] - full[n - 1][part]) / 30.0;
    let mut worst = [0.0_f64; 4];
    let peak = |f: &dyn Fn(usize) -> f64| (1..reduced.len()).map(|n| f(n).abs()).fold(0.0, f64::max);
    for (part, worst) in worst[..3].iter_mut().enumerate() {
        let of = |n: usize| [reduced[n].bias.shupe, reduced[n].bias.eo_axial, reduced[n].bias.eo_radial][part];
        *worst = peak(&|n| rate(n, part) - of(n)) / peak(&|n| rate(n, part));
    }
    worst[3] = peak(&|n| full[n][3] - reduced[n].sensor) / peak(&|n| full[n][3]);
    assert!(worst.iter().all(|w| *w < 1e-3), "{worst:?}");
}

// ---- courses between rows ----

#[test]
fn exact_a_smoothed_profile_keeps_rows_lines_and_parabolas() {
    let time: Vec<f64> = [0.0, 30.0, 60.0, 85.0, 120.0, 200.0].to_vec();
    let of = |f: fn(f64) -> f64| Profile { time: time.clone(), drives: vec![time.iter().map(|t| f(*t)).collect()] };
    let smooth = of(|t| 3.0 - t * t / 1e3).smoothed(5);
    assert_eq!(smooth.time.len(), 26);
    // between two rows with neighbours on either side
    for (t, u) in smooth.time.iter().zip(&smooth.drives[0]).filter(|(t, _)| (30.0..=120.0).contains(*t)) {
        assert!((u - (3.0 - t * t / 1e3)).abs() < 1e-12, "{t}: {u}");
    }
    for (n, t) in time.iter().enumerate() {
        assert_eq!((smooth.time[5 * n], smooth.drives[0][5 * n]), (*t, 3.0 - t * t / 1e3));
    }
    let line = of(|t| 1.0 + t / 7.0).smoothed(4);
    assert!(line.time.iter().zip(&line.drives[0]).all(|(t, u)| (u - 1.0 - t / 7.0).abs() < 1e-13));
    assert_eq!(line.smoothed(1), line);
}

#[test]
fn bounds_a_smoothed_profile_leaves_its_rows_by_a_quarter_of_a_change_at_most() {
    // a jump of 10 K within a second, then an hour of rest: no slope of the jump may reach into the hour
    let jump = Profile { time: vec![0.0, 30.0, 31.0, 3631.0, 3661.0], drives: vec![vec![0.0, 0.0, 10.0, 10.0, 9.0]] };
    let (low, high) = jump.smoothed(50).drives[0].iter().fold((0.0_f64, 0.0_f64), |(l, h), u| (l.min(*u), h.max(*u)));
    assert!(low >= -2.5 && high <= 12.5 && high > 10.0, "{low} to {high}");
    let bad = Profile { time: vec![0.0, 30.0, 30.0], drives: vec![vec![1.0, 2.0, f64::NAN]] };
    let dynamics = Dynamics::new(&reference(), &[Drive::Chamber], &Fidelity { resolution: QUICK, modes: 6 }).expect("model");
    assert!(matches!(dynamics.simulate(&bad.smoothed(4)), Err(Error::Profile { .. })));
    assert_eq!(Profile { time: vec![0.0], drives: vec![vec![4.0]] }.smoothed(4).drives, [[4.0]]);
}
