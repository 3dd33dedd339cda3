//! Display of effective constants.

use serde_json::{Map, Value};

use crate::units::{to_mpa, to_ppm};

/// The constants that follow from densities, by their keys: density \[kg/m³\] and heat capacity of a volume \[J/(m³ K)\] as they are known, and where both are
/// the heat capacity of a mass.
pub(super) fn heavy([density, capacity]: [Option<f64>; 2]) -> impl Iterator<Item = (&'static str, f64)> {
    let specific = density.zip(capacity).map(|(density, capacity)| capacity / density);
    let all = [("density_kg_per_m3", density), ("heat_capacity_j_per_m3k", capacity), ("specific_heat_j_per_kgk", specific)];
    all.into_iter().filter_map(|(key, value)| Some((key, value?)))
}

pub(super) fn object(named: impl IntoIterator<Item = (&'static str, f64)>) -> Map<String, Value> {
    named.into_iter().map(|(key, value)| (key.to_owned(), value.into())).collect()
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
        "g_r_45" => ("MPa", to_mpa, "shear modulus across the fibre, at 45 deg to its rows"),
        "density_kg_per_m3" => ("kg/m3", same, "density"),
        "heat_capacity_j_per_m3k" => ("J/(m3 K)", same, "heat capacity of a volume, thermoelastic part neglected"),
        "specific_heat_j_per_kgk" => ("J/(kg K)", same, "specific heat, as a coil file takes it"),
        _ => ("SI", same, ""),
    }
}
