//! explore
#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]
use fem_core::material::Isotropic;
use homogenization::*;
fn main() {
    let c = |e: f64, nu, a, k| Constituent {
        elastic: Isotropic { youngs_modulus: e * 1e6, poisson_ratio: nu, thermal_expansion: a },
        conductivity: k,
    };
    let r = |d: f64, constituent, role| Ring { outer_radius: d * 0.5e-6, constituent, role };
    let cell = FibreCell {
        pitch: 170e-6,
        rings: vec![
            r(80.0, c(70200.0, 0.17, 0.55e-6, 1.38), Role::Glass),
            r(112.0, c(2.0, 0.4998, 250e-6, 0.15), Role::Coating),
            r(165.0, c(870.0, 0.4118, 102.75e-6, 0.30), Role::Coating),
        ],
        adhesive: c(5.593, 0.49985, 250e-6, 0.45),
    };
    let t = [
        14502.3165e6,
        95.204994e6,
        24.069245e6,
        24.056231e6,
        0.,
        0.39183723,
        0.97880111,
        0.,
        3.3600953e-6,
        1.9324022e-4,
        0.50983184,
        0.34149326,
        0.028357616,
        0.028357616,
        -0.14804431,
        -1.0504148e-5,
    ];
    for extent in [Extent::Whole, Extent::Quarter] {
        let e = effective(
            &cell,
            &Discretization { order: 8, resolution: Resolution { sectors: 1, grading: 1.0, across: vec![1, 1, 1, 1] }, extent },
        )
        .unwrap();
        println!("{:.6e} {} {:.5e} {:.5}", e.stiffness, e.thermal_stress, e.conductivity, e.glass_strain);
    }
    if std::env::args().count() > 1 {
        return;
    }
    for extent in [Extent::Quarter, Extent::Whole] {
        for (n, g) in [(1, 1.0), (2, 1.0), (2, 1.3), (2, 1.6), (3, 1.3)] {
            for order in [4, 5, 6, 7, 8, 10, 12] {
                let d =
                    Discretization { order, resolution: Resolution { sectors: n, grading: g, across: vec![1, 1, 1, 1] }, extent };
                let s = std::time::Instant::now();
                let e = effective(&cell, &d).unwrap();
                let dt = s.elapsed().as_secs_f64();
                let k = e.constants().unwrap().named();
                let worst = k
                    .iter()
                    .zip(t)
                    .filter(|(_, t)| *t != 0.0)
                    .map(|((n, v), t)| ((v / t - 1.0).abs(), *n))
                    .fold((0.0, ""), |m, x| if x.0 > m.0 { x } else { m });
                println!(
                    "{extent:?} n {n} g {g} p {order} unknowns {} {:.1} ms  E_r {:.2e} worst {:.2e} {} area {:.1e}",
                    e.unknowns,
                    dt * 1e3,
                    k[1].1 / t[1] - 1.0,
                    worst.0,
                    worst.1,
                    e.area_error
                );
            }
        }
    }
}
