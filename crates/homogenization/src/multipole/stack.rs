//! Concentric rings under one angular harmonic: what the rings inside a radius answer to a displacement of their rim.
//!
//! In a ring the displacement is `2μ (u_x + i u_y) = κ φ − z φ̄′ − ψ̄` and the resultant of the tractions along an arc
//! `X = φ + z φ̄′ + ψ̄ = i ∫ t ds` (Kolosov and Muskhelishvili). The harmonic e^{ipθ} of u meets e^{iqθ}, q = 2 − p: of the powers of
//! φ and ψ only z^p, z^(p−2) (regular) and z^q, z^(−p) (singular) take part. Every coefficient is that of its power at the radius at
//! hand, so that nothing grows with p.

use nalgebra::{Matrix2, Vector2};

#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// Shear modulus μ \[Pa\].
    pub(super) mu: f64,
    /// κ − 1 = 2 μ / (λ + μ) = 2 − 4ν.
    pub(super) kappa_less_one: f64,
}

/// A disc or ring: outer radius in units of the outermost one, constants, stress xx = yy under the loads that strain nothing in the
/// plane (unit ε_zz; ΔT of one kelvin).
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    pub(super) radius: f64,
    pub(super) plane: Plane,
    pub(super) stress: [f64; 2],
}

impl Plane {
    fn kappa(&self) -> f64 {
        1.0 + self.kappa_less_one
    }

    /// `2μ (u_p, u_q)` of unit regular and of unit singular coefficients.
    pub(super) fn displacements(&self, p: usize) -> [Matrix2<f64>; 2] {
        let (p, q) = (p as f64, 2.0 - p as f64);
        let kappa = self.kappa();
        [Matrix2::new(kappa, 0.0, -p, -1.0), Matrix2::new(-q, -1.0, kappa, 0.0)]
    }

    /// Singular coefficients per regular ones around a rim whose `(X_p, X_q)` is `impedance · (u_p, u_q)`. `None` for no elastic rim.
    pub(super) fn reflection(&self, p: usize, impedance: &Matrix2<f64>) -> Option<Matrix2<f64>> {
        let ([u_r, u_s], [x_r, x_s]) = (self.displacements(p), resultants(p));
        let ratio = impedance / (2.0 * self.mu);
        Some(-(x_s - ratio * u_s).try_inverse()? * (x_r - ratio * u_r))
    }
}

/// `(X_p, X_q)` of unit regular and of unit singular coefficients.
fn resultants(p: usize) -> [Matrix2<f64>; 2] {
    let (p, q) = (p as f64, 2.0 - p as f64);
    [Matrix2::new(1.0, 0.0, p, 1.0), Matrix2::new(q, 1.0, 1.0, 0.0)]
}

/// Factors of regular coefficients from a radius inwards, of singular ones outwards, between radii of the given quotient below 1.
fn decay(p: usize, quotient: f64) -> [Matrix2<f64>; 2] {
    let (fast, slow) = (quotient.powi(p as i32), quotient.powi(p as i32 - 2));
    [Matrix2::new(fast, 0.0, 0.0, slow), Matrix2::new(slow, 0.0, 0.0, fast)]
}

/// The answer of a stack of rings to the harmonic p ≥ 3 of its rim's displacement.
pub(super) struct Harmonic {
    p: usize,
    /// `(X_p, X_q)` per `(u_p, u_q)` at the rim.
    pub(super) impedance: Matrix2<f64>,
    /// for each ring but the innermost: singular coefficients per regular ones at its inner and at its outer radius
    reflections: Vec<[Matrix2<f64>; 2]>,
}

impl Harmonic {
    /// `None` if a ring's constants are not those of a solid.
    pub(super) fn new(p: usize, rings: &[Ring]) -> Option<Self> {
        let [u_r, _] = rings[0].plane.displacements(p);
        let mut impedance = resultants(p)[0] * u_r.try_inverse()? * (2.0 * rings[0].plane.mu);
        let mut reflections = Vec::with_capacity(rings.len() - 1);
        for pair in rings.windows(2) {
            let ring = &pair[1];
            let inner = ring.plane.reflection(p, &impedance)?;
            let [regular, singular] = decay(p, pair[0].radius / ring.radius);
            let outer = singular * inner * regular;
            let ([u_r, u_s], [x_r, x_s]) = (ring.plane.displacements(p), resultants(p));
            impedance = (x_r + x_s * outer) * (u_r + u_s * outer).try_inverse()? * (2.0 * ring.plane.mu);
            reflections.push([inner, outer]);
        }
        Some(Self { p, impedance, reflections })
    }

    /// `(u_p, u_q)` at every ring's outer radius from that of the rim.
    pub(super) fn inwards(&self, rings: &[Ring], rim: Vector2<f64>) -> Option<Vec<Vector2<f64>>> {
        let mut all = vec![rim; rings.len()];
        for k in (1..rings.len()).rev() {
            let (ring, [inner, outer]) = (&rings[k], &self.reflections[k - 1]);
            let [u_r, u_s] = ring.plane.displacements(self.p);
            let [regular, _] = decay(self.p, rings[k - 1].radius / ring.radius);
            let coefficients = regular * (u_r + u_s * outer).try_inverse()? * all[k];
            all[k - 1] = (u_r + u_s * inner) * coefficients;
        }
        Some(all)
    }
}

/// The answer of a stack of rings to a swelling of its rim (p = q = 1) and to the loads of [`Ring::stress`].
pub(super) struct Swelling {
    /// X per u at the rim.
    pub(super) impedance: f64,
    /// X at the held rim under each load, as a stress: X over the rim's radius.
    pub(super) held: [f64; 2],
    /// for each ring but the innermost, at its outer radius: singular coefficient per regular one, and of its own under each load
    reflections: Vec<(f64, [f64; 2])>,
}

impl Swelling {
    pub(super) fn new(rings: &[Ring]) -> Self {
        let core = &rings[0];
        // X and the coefficients are over the radius at hand: stresses
        let mut impedance = 4.0 * core.plane.mu / core.plane.kappa_less_one;
        let mut held = core.stress;
        let mut reflections = Vec::with_capacity(rings.len() - 1);
        for pair in rings.windows(2) {
            let Ring { plane, stress, .. } = pair[1];
            let (ratio, share) = (impedance / (2.0 * plane.mu), (pair[0].radius / pair[1].radius).powi(2));
            let reflection = (ratio * plane.kappa_less_one - 2.0) / (1.0 + ratio) * share;
            let own = [0, 1].map(|load| (held[load] - stress[load]) / (1.0 + ratio) * share);
            let quotient = (2.0 + reflection) / (plane.kappa_less_one - reflection);
            impedance = 2.0 * plane.mu * quotient;
            held = [0, 1].map(|load| (quotient + 1.0) * own[load] + stress[load]);
            reflections.push((reflection, own));
        }
        Self { impedance, held, reflections }
    }

    /// u over the radius at every ring's outer radius, from that at the rim, under a combination of the loads.
    pub(super) fn inwards(&self, rings: &[Ring], rim: f64, loads: [f64; 2]) -> Vec<f64> {
        let mut all = vec![rim; rings.len()];
        for k in (1..rings.len()).rev() {
            let (Plane { mu, kappa_less_one }, (reflection, own)) = (rings[k].plane, self.reflections[k - 1]);
            let own = own[0] * loads[0] + own[1] * loads[1];
            let regular = (2.0 * mu * all[k] + own) / (kappa_less_one - reflection);
            let swell = (rings[k].radius / rings[k - 1].radius).powi(2);
            all[k - 1] = (kappa_less_one * regular - (reflection * regular + own) * swell) / (2.0 * mu);
        }
        all
    }
}

/// Singular coefficient per regular one around concentric rings of the given (outer radius, conductivity) in a medium, for the harmonic p.
pub(super) fn conduction(p: usize, rings: &[(f64, f64)], medium: f64) -> f64 {
    let reflection = |k: f64, inside: f64| (k - inside) / (k + inside);
    let mut impedance = rings[0].1;
    for pair in rings.windows(2) {
        let (ratio, k) = (pair[0].0 / pair[1].0, pair[1].1);
        let outer = reflection(k, impedance) * ratio.powi(2 * p as i32);
        impedance = k * (1.0 - outer) / (1.0 + outer);
    }
    reflection(medium, impedance)
}
