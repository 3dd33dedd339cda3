//! Effect of a design's tolerances on a number that follows from it: slopes by differences, one standard deviation to either side.

use crate::{Design, Error, MeshFineness, Model, Number, Tolerances};
use bias::Sensitivity;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::SQRT_2;

/// One standard deviation of a number that follows from a design, and its origins.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// One standard deviation, to first order in the tolerances.
    pub sd: f64,
    /// Change by one standard deviation of each number of the design, the largest first.
    pub changes: Vec<(Number, f64)>,
    /// Share of the variance that each has, in their order, with its part of the correlated share, so that all add up to 1.
    pub shares: Vec<f64>,
}

/// The mesh behind the slopes: good to a per cent of them.
const SLOPES: MeshFineness = MeshFineness { order: 4, layers: 2, ratio: 0.15 };

/// Whether a number acts in a uniform ramp, in which no heat flows.
fn acts_in_a_ramp(number: Number) -> bool {
    match number {
        Number::Tail => true,
        // one temperature throughout: no thermal phase between the halves
        Number::ThermoOptic | Number::SensorLag => false,
        Number::Constant(parameter) => parameter.of_mechanics(),
    }
}

/// One standard deviation of a number that changes by `changes` when each of some numbers goes one standard deviation, these going together as
/// their `correlation` says; and the share of its variance that each has, with its part of the correlated share: all add up to 1.
pub fn propagated(changes: &[f64], correlation: &DMatrix<f64>) -> (f64, Vec<f64>) {
    let own = DVector::from_column_slice(changes);
    let with_others = correlation * &own;
    let variance = own.dot(&with_others).max(0.0);
    let share = |(own, all): (&f64, &f64)| if variance > 0.0 { own * all / variance } else { 0.0 };
    (variance.sqrt(), own.iter().zip(with_others.iter()).map(share).collect())
}

/// Effect of one standard deviation of a number on the steady-ramp sensitivity, part by part, (°/h)/(°C/min).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensitivityChange {
    /// The number.
    pub number: Number,
    /// Change of each part; their sum is the change of the sensitivity.
    pub parts: Sensitivity,
}

fn mapped(a: &Sensitivity, b: &Sensitivity, of: impl Fn(f64, f64) -> f64) -> Sensitivity {
    Sensitivity { shupe: of(a.shupe, b.shupe), eo_axial: of(a.eo_axial, b.eo_axial), eo_radial: of(a.eo_radial, b.eo_radial) }
}

/// Changes of a design's steady-ramp sensitivity by its tolerances: one standard deviation of each number that acts in a ramp, in the order of
/// [`crate::Parameter::ALL`], tails last. Where the design cannot have a number on one side, as a Poisson's ratio beyond its bound, the other side counts alone.
///
/// # Errors
/// [`Error`] names the dimension or property at fault, or the solve that failed, of the design itself or on both sides of it.
pub fn sensitivity_changes(design: &Design, tolerances: &Tolerances) -> Result<Vec<SensitivityChange>, Error> {
    let of = |design: &Design| -> Result<Sensitivity, Error> { Model::new(design, &SLOPES)?.sensitivity() };
    let here = of(design)?;
    let mut changes = Vec::new();
    for number in Number::every().filter(|n| acts_in_a_ramp(*n)) {
        let (Some(drawn), Some(sd)) = (number.of(design), tolerances.sd(number, design)) else { continue };
        if sd <= 0.0 {
            continue;
        }
        let up = of(&number.set(design, drawn + sd));
        // a tail is not shortened below nothing
        let down = (number != Number::Tail).then(|| of(&number.set(design, drawn - sd)).ok()).flatten();
        let difference = |a: &Sensitivity, b: &Sensitivity| mapped(a, b, |a, b| a - b);
        let parts = match (up, down) {
            (Ok(up), Some(down)) => mapped(&up, &down, |up, down| (up - down) / 2.0),
            (Ok(up), None) => difference(&up, &here),
            (Err(_), Some(down)) => difference(&here, &down),
            (Err(error), None) => return Err(error),
        };
        // both tails vary alike, each by itself
        let parts = if number == Number::Tail { mapped(&parts, &parts, |part, _| SQRT_2 * part) } else { parts };
        changes.push(SensitivityChange { number, parts });
    }
    Ok(changes)
}

/// Effect of the tolerances of a design on its steady-ramp sensitivity, (°/h)/(°C/min), by [`sensitivity_changes`].
///
/// # Errors
/// As [`sensitivity_changes`].
pub fn sensitivity_band(design: &Design, tolerances: &Tolerances) -> Result<Band, Error> {
    let parts = sensitivity_changes(design, tolerances)?;
    let mut changes: Vec<(Number, f64)> = parts.iter().map(|change| (change.number, change.parts.total())).collect();
    changes.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let (numbers, each): (Vec<Number>, Vec<f64>) = changes.iter().copied().unzip();
    let (sd, shares) = propagated(&each, &tolerances.correlation(&numbers));
    Ok(Band { sd, changes, shares })
}
