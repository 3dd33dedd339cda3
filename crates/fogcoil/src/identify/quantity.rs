//! Parameters and constants in the words and units of people.

use homogenization::identify::{Parameter, Quantity};

use crate::units::{to_mpa, to_ppm};

/// Name, key of the JSON output, unit, and conversion from SI.
pub(super) fn presentation(quantity: Quantity) -> (&'static str, &'static str, &'static str, fn(f64) -> f64) {
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
pub(super) fn title(parameter: &Parameter) -> String {
    format!("{}, {}", parameter.phase, presentation(parameter.quantity).0)
}

/// The largest parts of a direction, e.g. "+0.86 adhesive, Young's modulus; −0.42 …".
pub(super) fn in_words(along: &[f64], parameters: &[Parameter]) -> String {
    let mut parts: Vec<(f64, &Parameter)> =
        along.iter().copied().zip(parameters).filter(|(part, _)| part.abs() > SMALL).collect();
    parts.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let sign = parts.first().map_or(1.0, |(part, _)| part.signum());
    let words = parts.iter().map(|(part, parameter)| format!("{:+.2} {}", part * sign, title(parameter)));
    words.collect::<Vec<_>>().join("; ")
}

/// Parts of a unit direction below this are not named.
const SMALL: f64 = 0.25;
