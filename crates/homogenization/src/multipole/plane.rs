//! Generalised plane strain: `φ = g z + Σ A_n E_n`, `ψ = h z + Σ B_n E_n + Σ A_n H_n` in units of twice the adhesive's shear modulus
//! and of the outermost radius, with real coefficients under loads that are even about the axes and imaginary ones under shear xy.

use super::stack::{Harmonic, Plane, Ring, Swelling};
use super::system::{Multipoles, solve};
use crate::cell::Phases;
use crate::solve::{GLASS_ROWS, VOIGT};
use crate::{Effective, Error, FibreCell};
use nalgebra::{DMatrix, Vector2};

struct Response {
    /// Mean of (xx + yy)/2 and of (xx − yy)/2 (or xy, under shear) of the stress without that of the load at zero strain.
    stress: [f64; 2],
    /// At each ring's rim, over its radius: the displacement of the harmonics 1 and −1, the mean strains (xx + yy)/2 and (xx − yy)/2
    /// (or xy) of the disc inside.
    discs: Vec<[f64; 2]>,
}

struct Fibre<'a> {
    multipoles: &'a Multipoles,
    rings: Vec<Ring>,
    adhesive: Ring,
    swelling: Swelling,
    harmonics: Vec<Harmonic>,
}

/// Adds the response to in-plane and axial strain and to heat.
pub(super) fn add(multipoles: &Multipoles, cell: &FibreCell, phases: &Phases, effective: &mut Effective) -> Result<(), Error> {
    let fibre = Fibre::new(multipoles, cell, phases)?;
    effective.unknowns = fibre.unknowns();
    // (mean, deviatoric) strain in the plane, then ε_zz and ΔT
    let loads = [(0, [0.5, 0.5], [0.0, 0.0]), (1, [0.5, -0.5], [0.0, 0.0]), (2, [0.0; 2], [1.0, 0.0]), (4, [0.0; 2], [0.0, 1.0])];
    let responses = fibre.even(&loads.map(|(_, strain, own)| (strain, own)))?;
    for ((load, strain, own), response) in loads.into_iter().zip(&responses) {
        let held = fibre.adhesive.stress[0] * own[0] + fibre.adhesive.stress[1] * own[1];
        let dilatation = phase_means(phases, strain[0], response.discs.iter().map(|d| d[0])).map(|mean| 2.0 * mean);
        let axial = dilatation.zip(&phases.laws).zip(&phases.fractions);
        let axial: f64 = axial
            .map(|((d, law), f)| {
                f * (law.stiffness[(2, 0)] * d + law.stiffness[(2, 2)] * own[0] - law.thermal_stress[2] * own[1])
            })
            .sum();
        let [mean, deviator] = [response.stress[0] + held, response.stress[1]];
        set_stress(effective, load, [mean + deviator, mean - deviator, axial, 0.0]);
        let glass = [0, 1].map(|k| phases.glass_mean(phase_means(phases, strain[k], response.discs.iter().map(|d| d[k]))));
        set_glass(effective, load, [glass[0] + glass[1], glass[0] - glass[1], 0.0]);
    }
    let shear = fibre.odd(0.5)?;
    set_stress(effective, 3, [0.0, 0.0, 0.0, shear.stress[1]]);
    let glass = phases.glass_mean(phase_means(phases, 0.5, shear.discs.iter().map(|d| d[1])));
    set_glass(effective, 3, [0.0, 0.0, 2.0 * glass]);
    Ok(())
}

fn set_stress(effective: &mut Effective, load: usize, stress: [f64; 4]) {
    for (voigt, stress) in VOIGT.into_iter().zip(stress) {
        if load == 4 {
            effective.thermal_stress[voigt] = -stress;
        } else {
            effective.stiffness[(voigt, VOIGT[load])] = stress;
        }
    }
}

fn set_glass(effective: &mut Effective, load: usize, strain: [f64; GLASS_ROWS.len()]) {
    strain.into_iter().enumerate().for_each(|(row, strain)| effective.glass_strain[(row, load)] = strain);
}

/// Mean over each phase from the mean over the cell and over the disc inside each ring's rim.
fn phase_means(phases: &Phases, whole: f64, discs: impl Iterator<Item = f64>) -> impl Iterator<Item = f64> {
    let (mut inside, mut integral) = (0.0, 0.0);
    let sums: Vec<_> = discs.chain([whole]).collect();
    phases.fractions.iter().zip(sums).map(move |(fraction, mean)| {
        inside += fraction;
        let before = std::mem::replace(&mut integral, mean * inside);
        (integral - before) / fraction
    })
}

impl<'a> Fibre<'a> {
    fn new(multipoles: &'a Multipoles, cell: &FibreCell, phases: &Phases) -> Result<Self, Error> {
        let ring = |i: usize, radius: f64| {
            let stiffness = phases.laws[i].stiffness;
            let (mu, lambda) = (stiffness[(5, 5)], stiffness[(0, 1)]);
            let plane = Plane { mu, kappa_less_one: 2.0 * mu / (lambda + mu) };
            Ring { radius, plane, stress: [lambda, -phases.laws[i].thermal_stress[0]] }
        };
        let outermost = cell.outermost();
        let rings: Vec<_> = cell.rings.iter().enumerate().map(|(i, r)| ring(i, r.outer_radius / outermost)).collect();
        let adhesive = ring(rings.len(), f64::INFINITY);
        let harmonics = multipoles.orders().map(|n| Harmonic::new(n + 2, &rings)).collect::<Option<Vec<_>>>();
        let harmonics = harmonics.ok_or_else(|| multipoles.failed("a ring has no elastic answer"))?;
        Ok(Self { multipoles, swelling: Swelling::new(&rings), rings, adhesive, harmonics })
    }

    /// g, h, then A_n and B_n in turn.
    fn unknowns(&self) -> usize {
        2 + 2 * self.harmonics.len()
    }

    /// Row of the regular coefficient of z^m of φ.
    fn phi(&self, m: usize) -> Vec<(usize, f64)> {
        let mut row: Vec<_> = self.multipoles.orders().map(|n| (1 + n, self.multipoles.e[(n, m)])).collect();
        if m == 1 {
            row.push((0, 1.0));
        }
        row
    }

    /// Row of the regular coefficient of z^m of ψ.
    fn psi(&self, m: usize) -> Vec<(usize, f64)> {
        let pair = |n: usize| [(1 + n, self.multipoles.h[(n, m)]), (2 + n, self.multipoles.e[(n, m)])];
        let mut row: Vec<_> = self.multipoles.orders().flat_map(pair).collect();
        if m == 1 {
            row.push((1, 1.0));
        }
        row
    }

    /// All rows but the first two and that of B_1: the rings' answers to the harmonics p ≥ 3, which give A_(p−2) and B_p.
    fn answers(&self, sign: f64) -> Result<DMatrix<f64>, Error> {
        let mut matrix = DMatrix::identity(self.unknowns(), self.unknowns());
        for (harmonic, n) in self.harmonics.iter().zip(self.multipoles.orders()) {
            let (p, plane) = (n + 2, &self.adhesive.plane);
            let reflection = plane.reflection(p, &harmonic.impedance);
            let reflection = reflection.ok_or_else(|| self.multipoles.failed("the fibre has no elastic answer"))?;
            for (k, row) in [1 + n, 2 + p].into_iter().enumerate().filter(|(_, row)| *row < self.unknowns()) {
                for (j, regular) in [self.phi(p), self.psi(n)].into_iter().enumerate() {
                    regular.into_iter().for_each(|(column, factor)| matrix[(row, column)] -= sign * reflection[(k, j)] * factor);
                }
            }
        }
        Ok(matrix)
    }

    /// Strain and stress in terms of g, h, A_1, B_1: rows of the mean of xx and yy, of half their difference.
    fn deviatoric_strain(&self, sign: f64) -> [(usize, f64); 2] {
        let Multipoles { period, shear_period, .. } = self.multipoles;
        [(1, -sign), (2, (1.0 + self.adhesive.plane.kappa_less_one) * period - sign * shear_period)]
    }

    fn deviatoric_stress(&self, sign: f64, x: &[f64]) -> f64 {
        let Multipoles { period, shear_period, .. } = self.multipoles;
        -2.0 * self.adhesive.plane.mu * (sign * x[1] + (period + sign * shear_period) * x[2])
    }

    /// Under (mean, deviatoric) strain in the plane with the loads of [`Ring::stress`].
    fn even(&self, loads: &[([f64; 2], [f64; 2])]) -> Result<Vec<Response>, Error> {
        let Plane { mu, kappa_less_one } = self.adhesive.plane;
        let period = self.multipoles.period;
        let mut matrix = self.answers(1.0)?;
        matrix.fill_row(0, 0.0);
        (matrix[(0, 0)], matrix[(0, 3)]) = (kappa_less_one, -period);
        matrix.fill_row(1, 0.0);
        self.deviatoric_strain(1.0).into_iter().for_each(|(column, factor)| matrix[(1, column)] = factor);
        // the rim's swelling: 2 φ_1 + B_1 + own stress = impedance ((κ − 1) φ_1 − B_1) / 2μ + held
        let ratio = self.swelling.impedance / (2.0 * mu);
        matrix.fill_row(3, 0.0);
        matrix[(3, 3)] = 1.0;
        let factor = (2.0 - ratio * kappa_less_one) / (1.0 + ratio);
        self.phi(1).into_iter().for_each(|(column, phi)| matrix[(3, column)] += factor * phi);
        let mut rhs = DMatrix::zeros(self.unknowns(), loads.len());
        for (column, (strain, own)) in loads.iter().enumerate() {
            (rhs[(0, column)], rhs[(1, column)]) = (strain[0], strain[1]);
            let held = |load: usize| own[load] * (self.swelling.held[load] - self.adhesive.stress[load]);
            rhs[(3, column)] = (held(0) + held(1)) / (2.0 * mu * (1.0 + ratio));
        }
        let solution = solve(matrix, &rhs, self.multipoles.order)?;
        let response = |(x, (_, own)): (nalgebra::DVectorView<f64>, &([f64; 2], [f64; 2]))| {
            let x = x.as_slice();
            let swelling = kappa_less_one * dot(&self.phi(1), x) - x[3];
            let swellings = self.swelling.inwards(&self.rings, swelling, *own);
            let discs = swellings.into_iter().zip(self.deviators(1.0, x)?).map(|(swelling, deviator)| [swelling, deviator]);
            Ok(Response {
                stress: [2.0 * mu * (2.0 * x[0] + period * x[3]), self.deviatoric_stress(1.0, x)],
                discs: discs.collect(),
            })
        };
        solution.column_iter().zip(loads).map(response).collect()
    }

    /// Under the strain xy. Neither the rotation g of the adhesive nor the torque B_1 on a fibre take part.
    fn odd(&self, strain: f64) -> Result<Response, Error> {
        let mut matrix = self.answers(-1.0)?;
        matrix.fill_row(1, 0.0);
        self.deviatoric_strain(-1.0).into_iter().for_each(|(column, factor)| matrix[(1, column)] = factor);
        for idle in [0, 3] {
            matrix.fill_row(idle, 0.0);
            matrix[(idle, idle)] = 1.0;
        }
        let mut load = DMatrix::zeros(self.unknowns(), 1);
        load[1] = strain;
        let x = solve(matrix, &load, self.multipoles.order)?;
        let x = x.as_slice();
        let discs = self.deviators(-1.0, x)?.into_iter().map(|deviator| [0.0, deviator]).collect();
        Ok(Response { stress: [0.0, self.deviatoric_stress(-1.0, x)], discs })
    }

    /// Displacement of the harmonic −1 at each ring's rim over its radius.
    fn deviators(&self, sign: f64, x: &[f64]) -> Result<Vec<f64>, Error> {
        let [u_r, u_s] = self.adhesive.plane.displacements(3);
        let regular = Vector2::new(dot(&self.phi(3), x), dot(&self.psi(1), x));
        let third = if self.multipoles.order >= 3 { x[5] } else { 0.0 };
        let rim = u_r * regular + u_s * Vector2::new(x[2], third) * sign;
        let inside = self.harmonics[0].inwards(&self.rings, rim);
        let inside = inside.ok_or_else(|| self.multipoles.failed("a ring has no elastic answer"))?;
        Ok(inside.iter().zip(&self.rings).map(|(u, ring)| sign * u[1] / ring.radius).collect())
    }
}

fn dot(row: &[(usize, f64)], x: &[f64]) -> f64 {
    row.iter().map(|(column, factor)| factor * x[*column]).sum()
}
