//! `fogcoil homogenize`: effective constants and the M row of a cell, and the strains inside it.

mod bounds;
pub(crate) mod constants;
pub mod general;
mod load;
mod quantity;
mod strain;

use homogenization::bounds::bounds as bounds_of;
use homogenization::{Constants, Homogenized, Packing};
use serde_json::{Map, Value};

use crate::input::CellCase;
use crate::table::{plus_minus, significant, table};
use constants::presentation;

pub use load::{parse_load, words};
pub use quantity::{Quantity, parse_quantity};
pub use strain::Strains;

/// The constants in SI under their own names, `error_estimate`: the relative error of each, and `bounds`.
pub fn json(case: &CellCase, result: &Homogenized) -> Value {
    let object = |constants: &Constants| -> Map<String, Value> {
        constants.named().into_iter().map(|(key, value)| (key.to_owned(), value.into())).collect()
    };
    let mut all = object(&result.constants);
    all.extend(extras(case, result).into_iter().map(|(key, value, _)| (key.to_owned(), value.into())));
    all.insert("error_estimate".into(), object(&result.relative_error).into());
    all.insert("bounds".into(), bounds_of(&case.cell).map_or(Value::Null, |found| bounds::json(&found)));
    all.into()
}

/// What only some cells have, with unit and meaning: the second shear modulus of square packing, what follows from densities.
fn extras(case: &CellCase, result: &Homogenized) -> Vec<(&'static str, f64, [&'static str; 2])> {
    let square = (case.cell.packing == Packing::Square).then(|| result.effective.shear_moduli_across()[1]);
    // a density out of range was refused when the file was read
    let known = |value: Result<Option<f64>, homogenization::Error>| value.ok().flatten();
    [
        ("g_r_45", square, ["Pa", "shear modulus across the fibre at 45 deg to its rows"]),
        ("density_kg_per_m3", known(case.cell.density()), ["kg/m3", "density"]),
        (
            "heat_capacity_j_per_m3k",
            known(case.cell.heat_capacity()),
            ["J/(m3 K)", "heat capacity of a volume, thermoelastic part neglected"],
        ),
    ]
    .into_iter()
    .filter_map(|(key, value, words)| Some((key, value?, words)))
    .collect()
}

/// The constants as a table with units and numerical errors.
pub fn text(case: &CellCase, result: &Homogenized) -> String {
    let mut rows = vec![["constant", "value", "numerical error", "unit", "meaning"].map(String::from).to_vec()];
    for ((key, value), (_, error)) in result.constants.named().into_iter().zip(result.error().named()) {
        let (unit, convert, meaning) = presentation(key);
        let (value, error) = (convert(value), plus_minus(convert(error)));
        rows.push(vec![key.into(), significant(value, 6), error, unit.into(), meaning.into()]);
    }
    for (key, value, [unit, meaning]) in extras(case, result) {
        rows.push(vec![key.into(), significant(value, 6), String::new(), unit.into(), meaning.into()]);
    }
    let beside = bounds_of(&case.cell).map_or_else(|error| format!("no bounds: {error}\n"), |found| bounds::text(&found, result));
    format!(
        "{}: effective constants; z = fibre (the coil's hoop), r = across it\n\n{}\n{} unknowns; the errors are numerical, they say \
         nothing about the constituents\n\n{beside}",
        case.name,
        table(&rows),
        result.unknowns
    )
}
