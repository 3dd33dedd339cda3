//! Relative changes of a part of the bias, by the temperature of the coil.

use super::form::{Form, Ranges, lag};

/// Relative changes of a part of the bias, by the temperature of the coil.
pub(super) fn forms<'a>(target: &'static str, what: &str, ranges: &Ranges) -> Vec<Form<'a>> {
    let Ranges { far, rate, parts, .. } = *ranges;
    let [shupe, axial, radial, all] = parts;
    let bias = match target {
        "Shupe" => shupe,
        "Axial" => axial,
        "Radial" => radial,
        _ => all,
    };
    let form = |id: &str, with: &str, known, unit, per_size: f64, beside, states: String, law: &str| Form {
        id: format!("composed-{id}-of-{}", target.to_lowercase()),
        title: format!("A change of {what} with {with}"),
        known,
        stage: "Material",
        per_size: per_size * bias,
        unit,
        beside,
        states,
        target,
        law: law.into(),
    };
    let none = String::new;
    vec![
        form(
            "level",
            "the coil's temperature",
            "constants that depend on temperature",
            "1/K",
            far,
            vec![],
            none(),
            "size * (coil - 20)",
        ),
        form(
            "square",
            "the square of the coil's temperature",
            "constants that bend with temperature",
            "1/K2",
            far.powi(2),
            vec![],
            none(),
            "size * (coil - 20)^2",
        ),
        form(
            "speed",
            "the speed of the coil's temperature",
            "stiffness that depends on the rate of strain",
            "s/K",
            rate,
            vec![],
            none(),
            "size * abs(coil_rate)",
        ),
        form(
            "lag",
            "what lags behind the coil's temperature",
            "relaxation, or swelling by moisture",
            "1/K",
            far,
            vec![ranges.memory()],
            lag("x", "coil", "tau"),
            "size * (coil - x)",
        ),
    ]
}
