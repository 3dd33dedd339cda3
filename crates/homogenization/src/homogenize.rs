//! Effective constants of a cell with an error beside each.

use crate::cell::Phases;
use crate::multipole::{self, HIGHEST_ORDER, Multipoles};
use crate::rounding::{self, shaken};
use crate::solve::{CellProblem, Integration};
use crate::{Constants, Discretization, Effective, Error, FibreCell};
use rve_mesh::{Extent, Resolution};

/// A constant below this fraction of its natural scale (1 for Poisson's ratios and strains of the glass per strain, the larger
/// effective expansion for expansions and strains of the glass per K) is as good as zero, and so is its relative error.
pub const NEGLIGIBLE: f64 = 1e-6;

/// Least decrease of the multipoles from one order that is tried to the next.
const STEP: f64 = 0.03;

/// A constant's estimate is at least this share of the worst one's: two orders may agree in one of them by chance.
pub(crate) const SHARE: f64 = 0.1;

/// Factor on the distance to two orders higher: it covers the true error as long as two orders halve it at least.
pub const SAFETY: f64 = 2.0;

/// The relative error that [`homogenize`] meets in every constant.
pub const TOLERANCE: f64 = 1e-6;

/// Effective constants with their numerical error.
#[derive(Debug, Clone, PartialEq)]
pub struct Homogenized {
    /// The constants.
    pub constants: Constants,
    /// Estimated relative error of each: [`SAFETY`] times its largest distance from its values with fewer multipoles ([`homogenize_to`]) or two
    /// polynomial orders higher ([`homogenize_on`]), and no less than a tenth of the worst one's; the effect of rounding is added. A constant that is nearly zero is compared with [`Constants::size`] instead.
    pub relative_error: Constants,
    /// Stiffness, thermal stress, conductivity and glass strain behind the constants.
    pub effective: Effective,
    /// Unknowns of the largest system behind the constants.
    pub unknowns: usize,
}

impl Homogenized {
    /// Estimated error of each constant in its own unit.
    pub fn error(&self) -> Constants {
        self.relative_error.combine(&self.constants.size(), |relative, size| relative * size)
    }
}

impl Discretization {
    /// The quarter cell at order 6 with two sectors per 30° and one element across each phase: every constant of the reference
    /// cell to 1e-6.
    pub fn standard(cell: &FibreCell) -> Self {
        Self {
            order: 6,
            resolution: Resolution { sectors: 2, grading: 1.0, across: vec![1; cell.rings.len() + 1] },
            extent: Extent::Quarter,
        }
    }

    /// The same mesh two polynomial orders higher.
    pub fn refined(&self) -> Self {
        Self { order: self.order + 2, ..self.clone() }
    }
}

/// Effective response of `cell` on one mesh of finite elements.
///
/// # Errors
/// [`Error`] names the constituent or the geometry at fault, or the solve that failed.
pub fn effective(cell: &FibreCell, discretization: &Discretization) -> Result<Effective, Error> {
    effective_with(cell, discretization, Integration::Full)
}

/// As [`effective`], with a choice of how the volumetric part is integrated.
///
/// # Errors
/// As [`effective`].
pub fn effective_with(cell: &FibreCell, discretization: &Discretization, volumetric: Integration) -> Result<Effective, Error> {
    CellProblem::new(cell, discretization, volumetric)?.effective()
}

/// Effective constants by finite elements on `discretization`, each with its estimated relative error: an independent check of
/// [`homogenize_to`], which knows neither mesh nor element.
///
/// # Errors
/// As [`effective`].
pub fn homogenize_on(cell: &FibreCell, discretization: &Discretization) -> Result<Homogenized, Error> {
    let effective = effective(cell, discretization)?;
    let finer = crate::effective(cell, &discretization.refined())?;
    let constants = effective.constants().ok_or_else(Error::singular)?;
    let truncation = truncation(&constants, &finer.constants().ok_or_else(Error::singular)?);
    let rounding = rounding(cell, &effective, &constants, |shaken| crate::effective(shaken, discretization));
    let relative_error = truncation.combine(&rounding, |t, r| t + r);
    Ok(Homogenized { constants, relative_error, unknowns: effective.unknowns, effective })
}

/// Truncation error, from two results of which one has the smaller error.
fn truncation(a: &Constants, b: &Constants) -> Constants {
    let difference = relative_difference(a, b);
    let floor = SHARE * worst(&difference.named()).1;
    difference.combine(&difference, |d, _| SAFETY * d.max(floor))
}

pub(crate) fn worst(errors: &[(&'static str, f64)]) -> (&'static str, f64) {
    errors.iter().fold(("", 0.0), |worst, one| if one.1 > worst.1 || one.1.is_nan() { *one } else { worst })
}

impl Constants {
    /// Reference of the relative error of each: its size, or [`NEGLIGIBLE`] of its natural scale if that is larger; for the row M, which has
    /// zeros without contrast, that scale itself where it is less than [`NEGLIGIBLE`] of it.
    pub fn size(&self) -> Self {
        let expansion = self.alpha_z.abs().max(self.alpha_r.abs());
        let scale = |(name, value): (&str, f64)| match name {
            "alpha_z" | "alpha_r" | "m_rt" => expansion,
            "nu_zr" | "nu_r" | "nu_rz" | "m_rx" | "m_ry" | "m_rz" => 1.0,
            _ => value.abs(),
        };
        let size = |named: (&str, f64)| {
            let (value, scale) = (named.1.abs(), scale(named));
            match named.0 {
                name if name.starts_with("m_") && value < NEGLIGIBLE * scale => scale,
                _ => value.max(NEGLIGIBLE * scale),
            }
        };
        Self::of(self.named().map(size))
    }
}

/// |a − b| of each constant over its [`Constants::size`].
fn relative_difference(a: &Constants, b: &Constants) -> Constants {
    let difference = a.combine(b, |a, b| (a - b).abs());
    // 0/0 where nothing expands
    difference.combine(&b.size(), |difference, size| if difference == 0.0 { 0.0 } else { difference / size })
}

/// Effective constants of `cell`, each to [`TOLERANCE`].
///
/// # Errors
/// As [`homogenize_to`].
pub fn homogenize(cell: &FibreCell) -> Result<Homogenized, Error> {
    homogenize_to(cell, TOLERANCE)
}

/// Effective constants of `cell`, each to `relative_error` by its own estimate: multipoles up to an order that follows from the film's
/// thickness, raised until two orders agree.
///
/// # Errors
/// [`Error::Accuracy`] if rounding, or a film too thin for [`HIGHEST_ORDER`], stands in the way, with the best estimate reached; [`Error::Tolerance`] for a `relative_error` that is negative or NaN;
/// else [`Error`] names the constituent or the geometry at fault.
pub fn homogenize_to(cell: &FibreCell, relative_error: f64) -> Result<Homogenized, Error> {
    Error::unless_accuracy(relative_error)?;
    Phases::new(cell)?;
    let decay = multipole::decay(cell);
    // orders of one residue modulo the symmetry converge evenly, those of −1 fastest
    let period = cell.packing.sides();
    let highest = (HIGHEST_ORDER + 1) / period * period - 1;
    let needed = |factor: f64| ((factor.ln() / decay.ln()).clamp(1.0, HIGHEST_ORDER as f64) as usize).div_ceil(period) * period;
    let step = needed(STEP);
    let mut order = (needed(relative_error.clamp(f64::EPSILON, 1.0)) + step - 1).min(highest);
    loop {
        let multipoles = Multipoles::new(cell, order)?;
        let effective = multipoles.effective(cell)?;
        let constants = effective.constants().ok_or_else(Error::singular)?;
        let rounding = rounding(cell, &effective, &constants, |shaken| multipoles.effective(shaken));
        // single orders are off by more than their neighbours on both sides, and may agree with one of them
        let mut lower = multipoles;
        let mut truncation = constants.combine(&constants, |_, _| 0.0);
        for fewer in [Some(period), (step > period).then_some(step)].into_iter().flatten() {
            lower = lower.lowered(order.saturating_sub(fewer).max(1));
            let of_lower = lower.effective(cell)?.constants().ok_or_else(Error::singular)?;
            truncation = truncation.combine(&self::truncation(&of_lower, &constants), f64::max);
        }
        let relative = truncation.combine(&rounding, |t, r| t + r);
        let (constant, reached) = worst(&relative.named());
        if reached <= relative_error {
            return Ok(Homogenized { constants, relative_error: relative, unknowns: effective.unknowns, effective });
        }
        let rounded = reached < 2.0 * worst(&rounding.named()).1;
        if rounded || order == highest {
            let why = if rounded {
                "rounding stands in the way (a nearly incompressible phase, a great contrast): choose a tolerance above this value"
            } else {
                "the film between the fibres is too thin: make the pitch larger, or choose a tolerance above this value"
            };
            let with = format!("multipoles up to order {order}");
            return Err(Error::Accuracy { constant, requested: relative_error, reached, with, why: why.into() });
        }
        order = (order + step).min(highest);
    }
}

/// Effect of rounding on each constant, relative; infinite where a rounding away there is no cell.
fn rounding(
    cell: &FibreCell,
    effective: &Effective,
    exact: &Constants,
    solved: impl Fn(&FibreCell) -> Result<Effective, Error>,
) -> Constants {
    let least = rounding::least(effective);
    let mut errors = exact.combine(exact, |_, _| least);
    for seed in 0..rounding::CELLS {
        let other = solved(&shaken(cell, seed)).ok().and_then(|effective| effective.constants());
        let distance = other.map_or(exact.combine(exact, |_, _| f64::INFINITY), |other| relative_difference(&other, exact));
        errors = errors.combine(&distance, |error, d| error.max(rounding::SPREAD * d));
    }
    let floor = SHARE * worst(&errors.named()).1;
    errors.combine(&errors, |error, _| error.max(floor))
}

/// The traction-free cell one kelvin warmer, solved on its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeCell {
    /// Mean radial strain of the glass \[1/K\].
    pub glass_strain: f64,
    /// Remainder of the mean stress (xx, yy, zz), relative to the stress of the fully held cell.
    pub relative_stress: f64,
}

/// Solves the cell under `ΔT = 1 K` and the macroscopic strain that leaves no mean stress.
///
/// # Errors
/// As [`effective`].
pub fn free_cell(cell: &FibreCell, discretization: &Discretization, constants: &Constants) -> Result<FreeCell, Error> {
    let problem = CellProblem::new(cell, discretization, Integration::Full)?;
    let (glass, stress) = problem.combined([constants.alpha_r, constants.alpha_r, constants.alpha_z])?;
    let (_, held) = problem.combined([0.0; 3])?;
    let largest = |s: [f64; 3]| s.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
    Ok(FreeCell { glass_strain: (glass[0] + glass[1]) / 2.0, relative_stress: largest(stress) / largest(held) })
}
