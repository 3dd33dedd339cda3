//! `fogcoil identify`: constituents from measured effective constants, with what is and what is not determined.

mod json;
mod text;

pub use json::json;
pub use text::text;

use homogenization::identify::{Identification, Parameter, Quantity};
use progress::Step;

use crate::Error;
use crate::input::TargetsCase;
use crate::units::{to_mpa, to_ppm};

/// Seed of every random number: the same file gives the same answer.
pub const SEED: u64 = 1;

/// Identifies the constituents behind a file's targets; `progress` is told what is going on.
///
/// # Errors
/// [`Error::Identification`] if no cell of a kind can be solved.
pub fn identify(case: &TargetsCase, progress: &dyn Fn(Step)) -> Result<Identification, Error> {
    homogenization::identify::identify(&case.families, &case.targets, SEED, progress)
        .ok_or_else(|| Error::Identification { file: case.file.clone() })
}

/// Name, key of the JSON output, unit, and conversion from SI.
fn presentation(quantity: Quantity) -> (&'static str, &'static str, &'static str, fn(f64) -> f64) {
    match quantity {
        Quantity::YoungsModulus => ("Young's modulus", "youngs_modulus", "MPa", to_mpa),
        Quantity::BulkModulus => ("bulk modulus", "bulk_modulus", "MPa", to_mpa),
        Quantity::PoissonRatio => ("Poisson's ratio", "poisson_ratio", "-", |value| value),
        Quantity::ThermalExpansion => ("expansion", "thermal_expansion", "1e-6/K", to_ppm),
        Quantity::Conductivity => ("conductivity", "conductivity", "W/(m K)", |value| value),
        Quantity::OuterDiameter => ("outer diameter", "outer_diameter", "um", to_ppm),
    }
}

/// "secondary coating, Young's modulus".
fn title(parameter: &Parameter) -> String {
    format!("{}, {}", parameter.phase, presentation(parameter.quantity).0)
}

/// The largest parts of a direction, e.g. "+0.86 adhesive, Young's modulus; −0.42 …".
fn in_words(along: &[f64], parameters: &[Parameter]) -> String {
    let mut parts: Vec<(f64, &Parameter)> =
        along.iter().copied().zip(parameters).filter(|(part, _)| part.abs() > SMALL).collect();
    parts.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let sign = parts.first().map_or(1.0, |(part, _)| part.signum());
    let words = parts.iter().map(|(part, parameter)| format!("{:+.2} {}", part * sign, title(parameter)));
    words.collect::<Vec<_>>().join("; ")
}

/// Parts of a unit direction below this are not named.
const SMALL: f64 = 0.25;
