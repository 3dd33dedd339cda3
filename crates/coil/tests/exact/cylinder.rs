//! A composite cylinder whose outer surface is suddenly heated.

use super::wall;
use fem_core::{Constraints, Form, Problem, State, Transient, polynomial};
use nalgebra::DMatrix;
use std::f64::consts::PI;

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
