//! Bounds and the closed-form estimate beside a cell's constants.

use homogenization::Homogenized;
use homogenization::bounds::Bounds;
use serde_json::{Map, Value, json as object};

use super::constants::presentation;
use crate::table::{significant, table};

/// Bounds of each constant: `reuss`, `hashin_shtrikman_lower`, `hashin_shtrikman_upper`, `voigt` (null where there is no bound) and `cylinders`.
pub(super) fn json(bounds: &Bounds) -> Value {
    let finite = |value: f64| value.is_finite().then_some(value);
    let rows = bounds.reuss_voigt.named().into_iter().zip(bounds.hashin_shtrikman.named()).zip(bounds.cylinders.named());
    let all: Map<String, Value> = rows
        .map(|(((key, [reuss, voigt]), (_, [lower, upper])), (_, cylinders))| {
            let row = object!({
                "reuss": finite(reuss),
                "hashin_shtrikman_lower": finite(lower),
                "hashin_shtrikman_upper": finite(upper),
                "voigt": finite(voigt),
                "cylinders": cylinders,
            });
            (key.to_owned(), row)
        })
        .collect();
    all.into()
}

pub(super) fn text(bounds: &Bounds, result: &Homogenized) -> String {
    let relative_errors = result.relative_error.named();
    let heads = ["constant", "Reuss", "HS lower", "value", "HS upper", "Voigt", "", "cylinders", "unit"];
    let mut rows = vec![heads.map(String::from).to_vec()];
    let named = bounds.reuss_voigt.named().into_iter().zip(bounds.hashin_shtrikman.named());
    let mut outside = false;
    let values = result.constants.named().into_iter().zip(relative_errors).zip(bounds.cylinders.named());
    for (((key, [reuss, voigt]), (_, [lower, upper])), (((_, value), (_, error)), (_, cylinders))) in named.zip(values) {
        let (unit, convert, _) = presentation(key);
        let show = |value: f64| if value.is_finite() { significant(convert(value), 4) } else { "none".into() };
        let slack = (error + ROUNDING) * value.abs();
        let inside = lower - slack <= value && value <= upper + slack;
        outside |= !inside;
        let mark = match (lower.is_finite(), inside) {
            (false, _) => "",
            (true, true) => "inside",
            (true, false) => "OUTSIDE",
        };
        let cells = [reuss, lower, value, upper, voigt].map(show);
        rows.push([key.to_owned()].into_iter().chain(cells).chain([mark.into(), show(cylinders), unit.into()]).collect());
    }
    let warning = if outside { "a constant outside its bounds is the program's fault, please report it\n" } else { "" };
    format!(
        "bounds: uniform stress and strain (Reuss, Voigt) and Hashin-Shtrikman (HS); cylinders: composite-cylinder estimate, g_r generalised \
         self-consistent\n\n{}{warning}",
        table(&rows)
    )
}

/// Relative rounding error of bounds that coincide: the root of a difference that should vanish.
const ROUNDING: f64 = 1e-6;
