//! `fogcoil sensitivity`: bias per temperature rate in a steady ramp, by part.

use coil::{Mechanics, SteadySensitivity};
use serde_json::{Value, json};

use crate::input::{CoilCase, Origin};
use crate::table::{plus_minus, table};

/// The parts and their total in (deg/h)/(degC/min), the error estimate of the total in the same unit, and the fibre's length in m.
pub fn json(result: &SteadySensitivity) -> Value {
    let parts = result.sensitivity;
    json!({
        "shupe": parts.shupe,
        "eo_axial": parts.eo_axial,
        "eo_radial": parts.eo_radial,
        "total": parts.total(),
        "length_m": result.length,
        "error_estimate": result.error_estimate,
    })
}

/// The parts as a table, and where the numbers behind them come from.
pub fn text(case: &CoilCase, result: &SteadySensitivity) -> String {
    let (parts, errors) = (result.sensitivity, result.part_errors);
    let row = |name: &str, value: f64, error: f64, meaning: &str| {
        vec![name.to_owned(), format!("{:.5}", (value * 1e5).round() / 1e5 + 0.0), plus_minus(error), meaning.to_owned()]
    };
    let rows = [
        row("shupe", parts.shupe, errors.shupe, "thermal phase, eq. (1)"),
        row("eo_axial", parts.eo_axial, errors.eo_axial, "strain along the fibre, eq. (2)"),
        row("eo_radial", parts.eo_radial, errors.eo_radial, "strain across the fibre, eq. (2)"),
        row("total", parts.total(), result.error_estimate, "the sum of the three"),
    ];
    format!(
        "{}: steady-ramp sensitivity in (deg/h)/(degC/min), numerical error beside it\n\n{}\n\
         fibre {:.4} m; {} unknowns\n\
         coil constants: {}; dehomogenisation row: {}\n\
         The value follows from the file's spool, bonding and materials; where one of them was chosen to match a measurement, so was\n\
         this value.\n",
        case.name,
        table(&rows),
        result.length,
        result.unknowns,
        origin(&case.provenance.material),
        origin(&case.provenance.dehomogenization),
    ) + match case.design.mechanics {
        Mechanics::Elastic => "",
        _ => {
            "The file's mechanics change with temperature or time; this is the sensitivity of the nominal state, see `simulate`.\n"
        }
    }
}

pub(crate) fn origin(origin: &Origin) -> String {
    match origin {
        Origin::Given => "as given in the file".into(),
        Origin::Cell(path) => format!("homogenised from {}", path.display()),
        Origin::Printed => "Table II of Osunluk et al. as printed, misprints included".into(),
    }
}
