//! Limits of the effective constants without a solution of the cell: bounds, and the composite-cylinder estimate.
//!
//! Two quadratic forms enclose the cell's energy in every axisymmetric state (strain across, strain along, temperature). From below
//! and above: uniform stress and uniform strain (Reuss, Voigt; with temperature Schapery 1968), and the tighter pair of Hashin and
//! Shtrikman, each phase in an environment of the softest and of the stiffest shear modulus (Hill 1964, Hashin 1965, Walpole 1969;
//! with temperature Rosen and Hashin 1970). The forms hold for any number of phases, so every constant read from the enclosed form is
//! bounded: `k_plane_strain`, `e_z`, `nu_zr`, `alpha_z`, `alpha_r`, and with the bounds of `g_r` also `e_r`, `nu_r`, `nu_rz`. Shear along
//! the fibre and conduction are scalar problems with their own bounds; `k_z` is exact. The dehomogenisation row has no bounds.
//!
//! Hashin–Shtrikman needs in-plane two-point statistics without the angular harmonic 2, and for `g_r` and what follows from it without
//! 4 as well: the hexagonal lattice has neither, the square one has 4, and there `g_r` keeps its Reuss and Voigt bounds. For three
//! phases the bounds are valid but no longer attained, and those of the expansions are wide where Levin's relation does not fix them.

pub(crate) mod cylinder;
mod form;
pub(crate) mod phases;

pub use cylinder::cylinders;

use crate::{Constants, Error, FibreCell, Packing};
use form::{Interval, Pair, embedded, entry, quotient, uniform_stress};
use phases::{Phase, phases};

/// Every constant's lower and upper bound; infinite where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Lower bounds.
    pub lower: Constants,
    /// Upper bounds.
    pub upper: Constants,
}

/// Bounds and the closed-form estimate of a cell's constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// From uniform stress and uniform strain.
    pub reuss_voigt: Range,
    /// Hashin–Shtrikman.
    pub hashin_shtrikman: Range,
    /// Composite cylinders, see [`cylinders`]: an estimate, not a bound.
    pub cylinders: Constants,
}

impl Range {
    /// Names and the two bounds of each constant.
    pub fn named(&self) -> [(&'static str, [f64; 2]); 16] {
        let (lower, upper) = (self.lower.named(), self.upper.named());
        std::array::from_fn(|i| (lower[i].0, [lower[i].1, upper[i].1]))
    }
}

/// Bounds and estimate of `cell`.
///
/// # Errors
/// [`Error`] names the geometry or the constituent out of range.
pub fn bounds(cell: &FibreCell) -> Result<Bounds, Error> {
    cell.outline()?;
    let singular = || Error::Solve(fem_core::Error::NotPositiveDefinite { unknowns: 3, detail: "effective stiffness".into() });
    let cylinders = cylinders(cell)?.constants().ok_or_else(singular)?;
    let mut phases = phases(cell)?;
    // expansions relative to that of the stiffest against compression: the same bounds, without the difference of its large terms
    let stiffest = phases.iter().max_by(|a, b| (a.share * a.bulk).total_cmp(&(b.share * b.bulk)));
    let reference = stiffest.map_or(0.0, |phase| phase.expansion);
    phases.iter_mut().for_each(|phase| phase.expansion -= reference);
    let shear = extremes(&phases, |p| p.shear);
    let bulk = extremes(&phases, |p| p.bulk);
    let conductivity = extremes(&phases, |p| p.conductivity);
    let wide = [0.0, f64::INFINITY];
    let environment = match cell.packing {
        Packing::Hexagonal => [0, 1].map(|i| bulk[i] * shear[i] / (bulk[i] + 2.0 * shear[i])),
        Packing::Square => wide,
    };
    let range = |pair: Option<Pair>, g_r, g_zr, k_r| -> Result<Range, Error> {
        let scalars =
            [mixed(&phases, |p| p.shear, g_r), mixed(&phases, |p| p.shear, g_zr), mixed(&phases, |p| p.conductivity, k_r)];
        let mut range = enclosed(&phases, &pair.ok_or_else(singular)?, scalars);
        for constants in [&mut range.lower, &mut range.upper] {
            constants.alpha_z += reference;
            constants.alpha_r += reference;
        }
        Ok(range)
    };
    let reuss_voigt = Pair::from_conjugate(uniform_stress(&phases), embedded(&phases, f64::INFINITY));
    let hashin_shtrikman = Pair::new(shear.map(|g| embedded(&phases, g)));
    Ok(Bounds {
        reuss_voigt: range(reuss_voigt, wide, wide, wide)?,
        hashin_shtrikman: range(hashin_shtrikman, environment, shear, conductivity)?,
        cylinders,
    })
}

fn extremes(phases: &[Phase], value: impl Fn(&Phase) -> f64) -> Interval {
    let values = phases.iter().map(value);
    values.fold([f64::INFINITY, 0.0], |[least, most], v| [least.min(v), most.max(v)])
}

/// `1/Σ f/(g + h) − h` for the two environments h; the mean for an infinite one.
fn mixed(phases: &[Phase], modulus: impl Fn(&Phase) -> f64, environment: Interval) -> Interval {
    environment.map(|h| {
        if h.is_infinite() {
            return phases.iter().map(|p| p.share * modulus(p)).sum();
        }
        1.0 / phases.iter().map(|p| p.share / (modulus(p) + h)).sum::<f64>() - h
    })
}

/// Ranges of all constants from two forms and the intervals of `g_r`, `g_zr` and `k_r`.
fn enclosed(phases: &[Phase], pair: &Pair, [g_r, g_zr, k_r]: [Interval; 3]) -> Range {
    let compliance = |i: usize, j: usize| entry(&pair.conjugates, i, j);
    let (across, along) = (compliance(0, 0), compliance(1, 1)); // e per 2σ, ε per σ
    let contraction = [-compliance(0, 1)[1], -compliance(0, 1)[0]]; // of the other direction, per σ_zz or per σ_xx
    // under σ_xx alone: 2σ = σ_xx, ε_xx − ε_yy = σ_xx/(2 g_r)
    let x = [across[0] + 0.25 / g_r[1], across[1] + 0.25 / g_r[0]];
    let poisson = |g: f64, s: f64| (0.25 / g - s) / (0.25 / g + s);
    let k = entry(&pair.forms, 0, 0).map(|h| h / 4.0);
    let k_z = phases.iter().map(|p| p.share * p.conductivity).sum();
    let rows = [
        [1.0 / along[1], 1.0 / along[0]],
        [1.0 / x[1], 1.0 / x[0]],
        g_zr,
        g_r,
        k,
        quotient(contraction, along),
        [poisson(g_r[1], across[1]), poisson(g_r[0], across[0])],
        quotient(contraction, x),
        compliance(1, 2),
        compliance(0, 2),
        [k_z; 2],
        k_r,
    ];
    let of = |end: usize, none: f64| Constants::of(std::array::from_fn(|i| rows.get(i).map_or(none, |row| row[end])));
    Range { lower: of(0, f64::NEG_INFINITY), upper: of(1, f64::INFINITY) }
}
