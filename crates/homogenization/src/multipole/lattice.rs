//! Sums over the points P ≠ 0 of the lattice of unit pitch: S_k = Σ 1/P^k and T_k = Σ P̄/P^k.
//!
//! Both packings have a mirror (the sums are real) and at least four-fold symmetry (so has what is left of the sums that converge
//! only conditionally, S_2 and T_3, which are set to zero here; [`LatticeSums::shear_period`] makes up for T_3).

use crate::Packing;
use std::f64::consts::TAU;

/// From this power on, the nearest shells of points are the whole sum to rounding.
const DIRECT: usize = 20;
/// Shells that are summed then: 8.6 pitches to the power of −18 against 1.
const SHELLS: i32 = 10;
/// Size of a term that adds nothing to a sum, to which the nearest points contribute up to one each.
const NOTHING: f64 = 1e-20;
/// Highest power of q = e^{2πiτ}, |q| < 0.0044, in the series.
const TERMS: usize = 24;
/// Powers of 1/2 that the period's series needs.
const PERIOD_POWERS: usize = 64;

pub(crate) struct LatticeSums {
    s: Vec<f64>,
    t: Vec<f64>,
    pub(crate) area: f64,
    /// c of `H(z + Q) − H(z) = −Q̄ E′(z) + c Q`, where E is Weierstrass's ζ and `H = Σ P̄/(z − P)²` without its term in z.
    pub(crate) shear_period: f64,
}

impl LatticeSums {
    pub(crate) fn new(packing: Packing, last: usize) -> Self {
        let angle = packing.angle();
        let tau = [angle.cos(), angle.sin()];
        let last = last.max(PERIOD_POWERS);
        let (mut s, mut t) = (vec![0.0; last + 1], vec![0.0; last + 1]);
        for k in 4..=last.min(DIRECT - 1) {
            if k % 2 == 0 {
                s[k] = series(tau, k);
            } else {
                t[k] = s[k - 1] + series_of_conjugates(tau, k);
            }
        }
        add_shells(tau, &mut s, &mut t);
        let half = |coefficients: &dyn Fn(usize) -> f64| -> f64 {
            (2..PERIOD_POWERS - 1).map(|m| coefficients(m) * 0.5_f64.powi(m as i32)).sum()
        };
        let weierstrass_p = 4.0 + half(&|m| (m + 1) as f64 * s[m + 2]);
        let shear_period = 2.0 * half(&|m| (m + 1) as f64 * t[m + 2]) - weierstrass_p;
        Self { s, t, area: tau[1], shear_period }
    }

    /// S_k for even k ≥ 4; zero for S_2 and odd k.
    pub(crate) fn s(&self, k: usize) -> f64 {
        self.s[k]
    }

    /// T_k for odd k ≥ 5; zero for T_3 and even k.
    pub(crate) fn t(&self, k: usize) -> f64 {
        self.t[k]
    }
}

/// (2π)^k / (k − 1)! Σ_n Σ_r weight(n) r^(k−1) Re q^(rn), from Lipschitz's formula for the sum along a row of points.
fn rows(tau: [f64; 2], k: usize, weight: impl Fn(f64) -> f64) -> f64 {
    let factor = (1..k).fold(TAU, |f, i| f * TAU / i as f64);
    let term = |n: usize, r: usize| {
        let power = TAU * (n * r) as f64;
        weight(n as f64) * (r as f64).powi(k as i32 - 1) * (-power * tau[1]).exp() * (power * tau[0]).cos()
    };
    factor * (1..=TERMS).flat_map(|n| (1..=TERMS / n).map(move |r| (n, r))).map(|(n, r)| term(n, r)).sum::<f64>()
}

/// S_k of even k: the row through the origin, 2 ζ(k), and all others.
fn series(tau: [f64; 2], k: usize) -> f64 {
    let sign = if k.is_multiple_of(4) { 1.0 } else { -1.0 };
    2.0 * zeta(k) + 2.0 * sign * rows(tau, k, |_| 1.0)
}

/// T_k − S_(k−1) of odd k: P̄ = P − 2i n Im τ in row n.
fn series_of_conjugates(tau: [f64; 2], k: usize) -> f64 {
    let sign = if k % 4 == 1 { 1.0 } else { -1.0 };
    -4.0 * tau[1] * sign * rows(tau, k, |n| n)
}

/// Riemann's ζ(k), k ≥ 4, by Euler and Maclaurin.
fn zeta(k: usize) -> f64 {
    const N: f64 = 50.0;
    let x = k as f64;
    let tail = N / (x - 1.0) - 0.5 + x / (12.0 * N) - x * (x + 1.0) * (x + 2.0) / (720.0 * N.powi(3));
    (1..=N as usize).rev().map(|i| (i as f64).powf(-x)).sum::<f64>() + tail * N.powf(-x)
}

/// Powers from [`DIRECT`] on, point by point: half of the plane, the other half says the same.
fn add_shells(tau: [f64; 2], s: &mut [f64], t: &mut [f64]) {
    for (m, n) in (-SHELLS..=SHELLS).flat_map(|m| (0..=SHELLS).map(move |n| (m, n))).filter(|&(m, n)| n > 0 || m > 0) {
        let (x, y) = (f64::from(m) + f64::from(n) * tau[0], f64::from(n) * tau[1]);
        let (radius, angle) = (x.hypot(y), y.atan2(x));
        for k in DIRECT..s.len() {
            let size = 2.0 * radius.powi(-(k as i32));
            if size * radius < NOTHING {
                break;
            }
            if k % 2 == 0 {
                s[k] += size * (k as f64 * angle).cos();
            } else {
                t[k] += size * radius * ((k + 1) as f64 * angle).cos();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-13 * b.abs().max(1.0), "{a} against {b}");
    }

    /// S_4 of the square lattice is ϖ⁴/15 with the lemniscate constant ϖ; the others follow from S_4 and S_6 by ℘'s recurrence.
    #[test]
    fn exact_sums_obey_weierstrass() {
        let lemniscate: f64 = 2.622_057_554_292_119;
        let square = LatticeSums::new(Packing::Square, 40);
        close(square.s(4), lemniscate.powi(4) / 15.0);
        for packing in [Packing::Square, Packing::Hexagonal] {
            let sums = LatticeSums::new(packing, 40);
            let c = |k: usize| (2 * k - 1) as f64 * sums.s(2 * k);
            for k in 4..=20 {
                let products: f64 = (2..=k - 2).map(|m| c(m) * c(k - m)).sum();
                close(c(k) / (2 * k - 1) as f64, 3.0 * products / ((2 * k + 1) * (k - 3) * (2 * k - 1)) as f64);
            }
        }
    }

    /// Six-fold symmetry leaves no shear period; both ways to sum agree where they meet.
    #[test]
    fn exact_symmetry_and_shells() {
        let sums = LatticeSums::new(Packing::Hexagonal, 64);
        assert!(sums.shear_period.abs() < 1e-12, "{}", sums.shear_period);
        assert!([4, 8, 10].iter().all(|&k| sums.s(k).abs() < 1e-13) && [7, 9].iter().all(|&k| sums.t(k).abs() < 1e-13));
        for packing in [Packing::Square, Packing::Hexagonal] {
            let (sums, angle) = (LatticeSums::new(packing, 64), packing.angle());
            let tau = [angle.cos(), angle.sin()];
            for k in [20, 24] {
                close(sums.s(k), series(tau, k));
                close(sums.t(k + 1), sums.s(k) + series_of_conjugates(tau, k + 1));
            }
        }
    }
}
