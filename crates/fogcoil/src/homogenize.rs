//! `fogcoil homogenize`: effective constants and the M row of a cell, and the strains inside it.

pub mod general;
mod load;
mod quantity;
mod strain;

use homogenization::bounds::bounds;
use homogenization::{Constants, Homogenized, Packing};
use serde_json::{Map, Value};

use crate::input::CellCase;
use crate::table::{plus_minus, significant, table};
use crate::units::{to_mpa, to_ppm};

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
    all.insert("bounds".into(), bounds(&case.cell).map_or(Value::Null, |found| crate::bounds::json(&found)));
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
    let beside =
        bounds(&case.cell).map_or_else(|error| format!("no bounds: {error}\n"), |found| crate::bounds::text(&found, result));
    format!(
        "{}: effective constants; z = fibre (the coil's hoop), r = across it\n\n{}\n{} unknowns; the errors are numerical, they say \
         nothing about the constituents\n\n{beside}",
        case.name,
        table(&rows),
        result.unknowns
    )
}

/// Unit, conversion from SI, and meaning.
pub(crate) fn presentation(key: &str) -> (&'static str, fn(f64) -> f64, &'static str) {
    let same: fn(f64) -> f64 = |value| value;
    match key {
        "e_x" => ("MPa", to_mpa, "Young's modulus along x"),
        "e_y" => ("MPa", to_mpa, "Young's modulus along y"),
        "g_yz" | "g_xz" | "g_xy" => ("MPa", to_mpa, "shear modulus of that plane"),
        "nu_zx" | "nu_zy" | "nu_xy" => ("-", same, "contraction along the second per extension along the first"),
        "alpha_x" => ("1e-6/K", to_ppm, "expansion along x"),
        "alpha_y" => ("1e-6/K", to_ppm, "expansion along y"),
        "alpha_xy" => ("1e-6/K", to_ppm, "shear xy per kelvin"),
        "k_x" => ("W/(m K)", same, "conductivity along x"),
        "k_y" => ("W/(m K)", same, "conductivity along y"),
        "k_xy" => ("W/(m K)", same, "heat flux along x per gradient along y"),
        "m_rxy" => ("-", same, "mean radial strain of the glass per shear xy"),
        "e_z" => ("MPa", to_mpa, "Young's modulus along the fibre"),
        "e_r" => ("MPa", to_mpa, "Young's modulus across the fibre"),
        "g_zr" => ("MPa", to_mpa, "shear modulus in planes that hold the fibre"),
        "g_r" => ("MPa", to_mpa, "shear modulus across the fibre"),
        "k_plane_strain" => ("MPa", to_mpa, "plane-strain bulk modulus"),
        "nu_zr" => ("-", same, "contraction across per extension along"),
        "nu_r" => ("-", same, "Poisson's ratio across the fibre"),
        "nu_rz" => ("-", same, "contraction along per extension across"),
        "alpha_z" => ("1e-6/K", to_ppm, "expansion along the fibre"),
        "alpha_r" => ("1e-6/K", to_ppm, "expansion across the fibre"),
        "k_z" => ("W/(m K)", same, "conductivity along the fibre"),
        "k_r" => ("W/(m K)", same, "conductivity across the fibre"),
        "m_rx" => ("-", same, "mean radial strain of the glass per strain across (x)"),
        "m_ry" => ("-", same, "mean radial strain of the glass per strain across (y)"),
        "m_rz" => ("-", same, "mean radial strain of the glass per strain along"),
        "m_rt" => ("1e-6/K", to_ppm, "mean radial strain of the glass per kelvin"),
        _ => ("SI", same, ""),
    }
}
