//! Energies of axisymmetric states as quadratic forms, and what two of them in Loewner order say of every constant between them.

use super::phases::Phase;
use nalgebra::{Matrix2, Matrix3, Vector2};

/// Hessian of twice the potential `W(e, ε, T)`: e the strain across the fibre (xx = yy), ε along it, T the temperature. Its
/// conjugates are 2σ_xx and σ_zz. The pure T term is free: whatever it is, it is the same in every form compared.
pub(crate) type Form = Matrix3<f64>;

fn form(phase: &Phase) -> Form {
    let (Phase { bulk, shear, lambda, .. }, beta) = (*phase, phase.thermal_stress());
    let off = [2.0 * lambda, -2.0 * beta, -beta];
    Matrix3::new(4.0 * bulk, off[0], off[1], off[0], lambda + 2.0 * shear, off[2], off[1], off[2], 0.0)
}

/// Effective form when each phase sits in a transverse environment of shear modulus `shear` (Hashin–Shtrikman; infinite: Voigt).
pub(crate) fn embedded(phases: &[Phase], shear: f64) -> Form {
    if shear.is_infinite() {
        return phases.iter().map(|p| form(p) * p.share).sum();
    }
    let environment = 4.0 * shear;
    let (mut s, mut b, mut c) = (0.0, Vector2::zeros(), Matrix2::zeros());
    for phase in phases {
        let h = form(phase);
        let (across, coupling) = (h[(0, 0)] + environment, h.fixed_view::<2, 1>(1, 0));
        s += phase.share / across;
        b += coupling * (phase.share / across);
        c += (h.fixed_view::<2, 2>(1, 1) - coupling * coupling.transpose() / across) * phase.share;
    }
    c += b * b.transpose() / s;
    let b = b / s;
    Matrix3::new(1.0 / s - environment, b[0], b[1], b[0], c[(0, 0)], c[(0, 1)], b[1], c[(1, 0)], c[(1, 1)])
}

/// Conjugate of the effective form under uniform stress (Reuss): the mean of the phases' conjugates, each written out, since a nearly
/// incompressible phase's form is nearly singular to invert.
pub(crate) fn uniform_stress(phases: &[Phase]) -> Form {
    let conjugates = phases.iter().map(|phase| {
        let Phase { bulk, shear, lambda, expansion: alpha, share, .. } = *phase;
        let youngs_modulus = shear * (3.0 * lambda + 2.0 * shear) / bulk;
        let poisson_ratio = lambda / (2.0 * bulk);
        let off = -poisson_ratio / youngs_modulus;
        let across = (1.0 - poisson_ratio) / (2.0 * youngs_modulus);
        let thermal = 3.0 * alpha * phase.thermal_stress();
        Matrix3::new(across, off, alpha, off, 1.0 / youngs_modulus, alpha, alpha, alpha, thermal) * share
    });
    conjugates.sum()
}

/// The Legendre transform in the strains: compliance, expansion and what belongs to T; its own inverse, and it turns the order round.
fn conjugate(form: &Form) -> Option<Form> {
    let s = form.fixed_view::<2, 2>(0, 0).try_inverse()?;
    let b = form.fixed_view::<2, 1>(0, 2).into_owned();
    let alpha = -(s * b);
    let last = (b.transpose() * s * b)[0] - form[(2, 2)];
    Some(Matrix3::new(s[(0, 0)], s[(0, 1)], alpha[0], s[(1, 0)], s[(1, 1)], alpha[1], alpha[0], alpha[1], last))
}

/// Two forms in Loewner order, the lower first, and their conjugates, whose order is the other way round.
pub(crate) struct Pair {
    pub(crate) forms: [Form; 2],
    pub(crate) conjugates: [Form; 2],
}

impl Pair {
    pub(crate) fn new([lower, upper]: [Form; 2]) -> Option<Pair> {
        Some(Pair { conjugates: [conjugate(&upper)?, conjugate(&lower)?], forms: [lower, upper] })
    }

    /// The pair whose lower form is known by its conjugate.
    pub(crate) fn from_conjugate(lower_conjugate: Form, upper: Form) -> Option<Pair> {
        Some(Pair { forms: [conjugate(&lower_conjugate)?, upper], conjugates: [conjugate(&upper)?, lower_conjugate] })
    }
}

/// A closed interval, lower end first.
pub(crate) type Interval = [f64; 2];

/// Entry (i, j) of any form between `lower` and `upper` in Loewner order: with D their difference, it differs from the middle by
/// at most √(D_ii D_jj)/2 (Cauchy–Schwarz).
pub(crate) fn entry([lower, upper]: &[Form; 2], i: usize, j: usize) -> Interval {
    let spread = |i: usize| (upper[(i, i)] - lower[(i, i)]).max(0.0);
    let (middle, half) = ((lower[(i, j)] + upper[(i, j)]) / 2.0, (spread(i) * spread(j)).sqrt() / 2.0);
    [middle - half, middle + half]
}

/// Quotient of two intervals, the second positive.
pub(crate) fn quotient(a: Interval, b: Interval) -> Interval {
    let all = [a[0] / b[0], a[0] / b[1], a[1] / b[0], a[1] / b[1]];
    [all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
}
