//! `fogcoil homogenize`: effective constants and the M row of a cell.

use homogenization::{Constants, Homogenized};
use serde_json::{Map, Value};

use crate::input::CellCase;
use crate::table::{plus_minus, significant, table};
use crate::units::{to_mpa, to_ppm};

/// The constants in SI under their own names, and `error_estimate`: the relative error of each.
pub fn json(result: &Homogenized) -> Value {
    let object = |constants: &Constants| -> Map<String, Value> {
        constants.named().into_iter().map(|(key, value)| (key.to_owned(), value.into())).collect()
    };
    let mut all = object(&result.constants);
    all.insert("error_estimate".into(), object(&result.relative_error).into());
    all.into()
}

/// The constants as a table with units and numerical errors.
pub fn text(case: &CellCase, result: &Homogenized) -> String {
    let mut rows = vec![["constant", "value", "numerical error", "unit", "meaning"].map(String::from).to_vec()];
    for ((key, value), (_, relative)) in result.constants.named().into_iter().zip(result.relative_error.named()) {
        let (unit, convert, meaning) = presentation(key);
        let value = convert(value);
        let error = plus_minus(relative * value.abs());
        rows.push(vec![key.into(), significant(value, 6), error, unit.into(), meaning.into()]);
    }
    format!(
        "{}: effective constants; z = fibre (the coil's hoop), r = across it\n\n{}\n{} unknowns; the errors are numerical, they say \
         nothing about the constituents\n",
        case.name,
        table(&rows),
        result.unknowns
    )
}

/// Unit, conversion from SI, and meaning.
fn presentation(key: &str) -> (&'static str, fn(f64) -> f64, &'static str) {
    let same: fn(f64) -> f64 = |value| value;
    match key {
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
