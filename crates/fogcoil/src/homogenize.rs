//! `fogcoil homogenize`: effective constants and the M row of a cell, and the strains inside it.

mod bounds;
pub(crate) mod constants;
pub mod general;
mod load;
mod quantity;
mod strain;

use homogenization::bounds::bounds as bounds_of;
use homogenization::{Homogenized, Packing};
use serde_json::Value;

use crate::input::CellCase;
use crate::table::{plus_minus, significant, table};
use constants::{heavy, object, presentation};

pub use load::{parse_load, words};
pub use quantity::{Quantity, parse_quantity};
pub use strain::Strains;

/// The constants in SI under their own names, `error_estimate`: the relative error of each, and `bounds`.
pub fn json(case: &CellCase, result: &Homogenized) -> Value {
    let mut all = object(result.constants.named().into_iter().chain(extras(case, result)));
    all.insert("error_estimate".into(), object(result.relative_error.named()).into());
    all.insert("bounds".into(), bounds_of(&case.cell).map_or(Value::Null, |found| bounds::json(&found)));
    all.into()
}

/// Constants that only some cells have: the second shear modulus of square packing, constants that follow from densities.
fn extras(case: &CellCase, result: &Homogenized) -> impl Iterator<Item = (&'static str, f64)> + use<> {
    let square = (case.cell.packing == Packing::Square).then(|| result.effective.shear_moduli_across()[1]);
    // a density out of range was refused when the file was read
    let known = |value: Result<Option<f64>, homogenization::Error>| value.ok().flatten();
    let heavy = heavy([known(case.cell.density()), known(case.cell.heat_capacity())]);
    square.map(|value| ("g_r_45", value)).into_iter().chain(heavy)
}

/// The constants as a table with units and numerical errors.
pub fn text(case: &CellCase, result: &Homogenized) -> String {
    let mut rows = vec![["constant", "value", "numerical error", "unit", "meaning"].map(String::from).to_vec()];
    for ((key, value), (_, error)) in result.constants.named().into_iter().zip(result.error().named()) {
        let (unit, convert, meaning) = presentation(key);
        let (value, error) = (convert(value), plus_minus(convert(error)));
        rows.push(vec![key.into(), significant(value, 6), error, unit.into(), meaning.into()]);
    }
    for (key, value) in extras(case, result) {
        let (unit, _, meaning) = presentation(key);
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
