//! Composite cylinders: each fibre with its share of adhesive as one cylinder of n layers, solved exactly.

use super::phases::{Phase, phases};
use crate::{Effective, Error, FibreCell};
use nalgebra::{Matrix2, Matrix4, Matrix4x2, Matrix6, RowVector3, RowVector4, SMatrix, Vector6};

/// Effective response of an assemblage of composite cylinders, the cell's circle of equal area: exact for the assemblage (Hashin and
/// Rosen 1964), but for the shear modulus across the fibre, which is the generalised self-consistent one (Christensen and Lo 1979,
/// n layers: Hervé and Zaoui 1995). An estimate for the hexagonal lattice, good where the film between fibres is not thin.
///
/// # Errors
/// [`Error`] names the constituent out of range.
pub fn cylinders(cell: &FibreCell) -> Result<Effective, Error> {
    let phases = phases(cell)?;
    let (axial, glass) = axisymmetric(&phases);
    let across = shear_across(&phases, axial[(0, 0)] / 4.0);
    let along = antiplane(&phases, |p| p.shear);
    let conductivity = antiplane(&phases, |p| p.conductivity);
    let (bulk, coupling, n) = (axial[(0, 0)] / 4.0, axial[(0, 1)] / 2.0, axial[(1, 1)]);
    let mut stiffness = Matrix6::zeros();
    for (i, j, value) in [
        (0, 0, bulk + across),
        (1, 1, bulk + across),
        (2, 2, n),
        (0, 1, bulk - across),
        (0, 2, coupling),
        (1, 2, coupling),
        (3, 3, along),
        (4, 4, along),
        (5, 5, across),
    ] {
        stiffness[(i, j)] = value;
        stiffness[(j, i)] = value;
    }
    let beta = -axial[(0, 2)] / 2.0;
    let mut glass_strain = SMatrix::zeros();
    for row in 0..2 {
        for (load, value) in [(0, glass[0] / 2.0), (1, glass[0] / 2.0), (2, glass[1]), (4, glass[2])] {
            glass_strain[(row, load)] = value;
        }
    }
    Ok(Effective {
        stiffness,
        thermal_stress: Vector6::new(beta, beta, -axial[(1, 2)], 0.0, 0.0, 0.0),
        conductivity: Matrix2::identity() * conductivity,
        conductivity_z: phases.iter().map(|p| p.share * p.conductivity).sum(),
        glass_strain,
        unknowns: 0,
        area_error: 0.0,
    })
}

/// Rows 2σ_xx and σ_zz per (e, ε, T) as in [`super::form`], and the glass's mean radial strain per the same.
///
/// In a layer `u = A r + B/r`, `σ_rr = 2k A − 2G B/r² + λ ε − β T`; `u/r` and `σ_rr` are continuous. Everything is carried as a row of
/// coefficients of (strain of the innermost layer, ε, T).
pub(crate) fn axisymmetric(phases: &[Phase]) -> (SMatrix<f64, 2, 3>, RowVector3<f64>) {
    let unit = |i: usize| RowVector3::from_fn(|_, j| f64::from(i == j));
    let (mut strain, mut stress) = (unit(0), RowVector3::zeros()); // u/r and σ_rr
    let (mut axial, mut glass, mut glass_share) = (RowVector3::zeros(), RowVector3::zeros(), 0.0);
    let mut inside = 0.0;
    for phase in phases {
        let Phase { share, bulk, shear, lambda, filled, .. } = *phase;
        let beta = phase.thermal_stress();
        let held = unit(1) * lambda - unit(2) * beta;
        let a = if inside == 0.0 { strain } else { (stress - held + strain * (2.0 * shear)) / (2.0 * (bulk + shear)) };
        let b = (strain - a) * (inside / filled);
        strain = a + b;
        stress = a * (2.0 * bulk) - b * (2.0 * shear) + held;
        axial += (a * (2.0 * lambda) + unit(1) * (lambda + 2.0 * shear) - unit(2) * beta) * share;
        if phase.glass {
            glass += a * share;
            glass_share += share;
        }
        inside = filled;
    }
    // the outermost u/r is e: exchange the innermost strain for it
    let exchange = |row: RowVector3<f64>| {
        let per_e = row[0] / strain[0];
        RowVector3::new(per_e, row[1] - per_e * strain[1], row[2] - per_e * strain[2])
    };
    (SMatrix::<f64, 2, 3>::from_rows(&[exchange(stress * 2.0), exchange(axial)]), exchange(glass / glass_share))
}

/// Effective modulus of a scalar problem (antiplane shear, conduction): `φ = A r + B/r` in each layer.
fn antiplane(phases: &[Phase], modulus: impl Fn(&Phase) -> f64) -> f64 {
    let (mut inner, mut inside) = (0.0, 0.0);
    for phase in phases {
        let g = modulus(phase);
        let (sum, difference) = ((g + inner) * phase.filled, (g - inner) * inside);
        inner = if inside == 0.0 { g } else { g * (sum - difference) / (sum + difference) };
        inside = phase.filled;
    }
    inner
}

/// `(u_r, u_θ, σ_rr, σ_rθ)` of the four states of angular order 2 at radius r, by Muskhelishvili's potentials `−z`, `z³`, `z⁻¹` and
/// `z⁻³`; amplitudes cos 2θ and sin 2θ.
fn states(phase: &Phase, r: f64) -> Matrix4<f64> {
    let (g, kappa) = (phase.shear, 1.0 + 2.0 * phase.shear / phase.bulk);
    let (r2, i2) = (r * r, 1.0 / (r * r));
    Matrix4::from_rows(&[
        RowVector4::new(r, (kappa - 3.0) * r * r2, (kappa + 1.0) / r, i2 / r),
        RowVector4::new(-r, (kappa + 3.0) * r * r2, (1.0 - kappa) / r, i2 / r),
        RowVector4::new(2.0 * g, 0.0, -8.0 * g * i2, -6.0 * g * i2 * i2),
        RowVector4::new(-2.0 * g, 12.0 * g * r2, -4.0 * g * i2, -6.0 * g * i2 * i2),
    ])
}

/// The medium whose far shear the embedded composite cylinder does not disturb on average: the `z⁻¹` state is absent outside.
///
/// Moduli are scaled by the outermost phase's shear modulus. NaN if no layer is left to invert, which positive moduli never make.
fn shear_across(phases: &[Phase], bulk: f64) -> f64 {
    let scale = phases.last().map_or(1.0, |p| p.shear);
    let scaled = |p: &Phase| Phase { shear: p.shear / scale, bulk: p.bulk / scale, ..*p };
    let mut inner: Option<Matrix4x2<f64>> = None;
    let mut inside = 0.0_f64;
    for phase in phases.iter().map(scaled) {
        let outer = states(&phase, phase.filled.sqrt());
        let next = match inner {
            None => outer.fixed_columns::<2>(0).into_owned(),
            Some(at) => match states(&phase, inside.sqrt()).lu().solve(&at) {
                Some(amplitudes) => outer * amplitudes,
                None => return f64::NAN,
            },
        };
        // the two states are kept apart and of size one
        let next = next.qr().q();
        inner = Some(next);
        inside = phase.filled;
    }
    let Some(inner) = inner else { return f64::NAN };
    // det [inner, r, r⁻³] is quadratic in the medium's shear modulus g
    let det = |g: f64| {
        let medium = states(&Phase { shear: g, bulk: bulk / scale, ..phases[0] }, 1.0);
        Matrix4::from_columns(&[inner.column(0), inner.column(1), medium.column(0), medium.column(3)]).determinant()
    };
    let (at0, at1, at2) = (det(0.0), det(1.0), det(-1.0));
    let (a, b, c) = ((at1 + at2) / 2.0 - at0, (at1 - at2) / 2.0, at0);
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    let q = -(b + b.signum() * root) / 2.0;
    scale * (q / a).max(c / q)
}
