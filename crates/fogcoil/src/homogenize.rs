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

/// The shear modulus that only square packing has beside `g_r`.
const DIAGONAL: &str = "g_r_45";

/// The constants in SI under their own names, `error_estimate`: the relative error of each, and `bounds`.
pub fn json(case: &CellCase, result: &Homogenized) -> Value {
    let diagonal = diagonal(case, result);
    let with =
        |named: Vec<(&'static str, f64)>, value: Option<f64>| named.into_iter().chain(value.map(|value| (DIAGONAL, value)));
    let mut all = object(with(result.constants.named().into(), diagonal.map(|[value, _]| value)).chain(masses(case)));
    let errors = with(result.relative_error.named().into(), diagonal.map(|[_, error]| error));
    all.insert("error_estimate".into(), object(errors).into());
    all.insert("bounds".into(), bounds_of(&case.cell).map_or(Value::Null, |found| bounds::json(&found)));
    all.into()
}

/// Of square packing the shear modulus at 45° to the rows \[Pa\] and its relative error: the modulus is E/(2 (1 + ν)) of `e_r` and `nu_r`, whose errors may add up.
fn diagonal(case: &CellCase, result: &Homogenized) -> Option<[f64; 2]> {
    let error = result.relative_error.e_r + result.error().nu_r / (1.0 + result.constants.nu_r);
    (case.cell.packing == Packing::Square).then(|| [result.effective.shear_moduli_across()[1], error])
}

/// Constants that follow from densities.
fn masses(case: &CellCase) -> impl Iterator<Item = (&'static str, f64)> + use<> {
    // a density out of range was refused when the file was read
    let known = |value: Result<Option<f64>, homogenization::Error>| value.ok().flatten();
    heavy([known(case.cell.density()), known(case.cell.heat_capacity())])
}

/// The constants as a table with units and numerical errors.
pub fn text(case: &CellCase, result: &Homogenized) -> String {
    let mut rows = vec![["constant", "value", "numerical error", "unit", "meaning"].map(String::from).to_vec()];
    let diagonal = diagonal(case, result);
    let constants = result.constants.named().into_iter().zip(result.error().named().map(|(_, error)| error));
    for ((key, value), error) in constants.chain(diagonal.map(|[value, error]| ((DIAGONAL, value), value * error))) {
        let (unit, convert, meaning) = presentation(key);
        let (value, error) = (convert(value), plus_minus(convert(error)));
        let along = if diagonal.is_some() && ["e_r", "g_r", "nu_r"].contains(&key) { ", along its rows" } else { "" };
        rows.push(vec![key.into(), significant(value, 6), error, unit.into(), format!("{meaning}{along}")]);
    }
    for (key, value) in masses(case) {
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
