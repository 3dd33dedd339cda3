//! Constituents of a cell: isotropic, orthotropic, or tables over temperature.

use fem_core::material::{Isotropic, Orthotropic};
use homogenization::Constituent;
use homogenization::irregular::Solid;
use nalgebra::Matrix2;

use super::InputError;
use super::cell_file::{MaterialFile, OrthotropicFile, RowFile};
use super::limits::{CONDUCTIVITY, DENSITY, EXPANSION_PER_K, Group, MODULUS_MPA, RATIO, SPECIFIC_HEAT, TEMPERATURE_C};
use crate::units::from_mpa;

/// Rows of the longest table accepted.
const MOST_ROWS: usize = 1000;

/// What a phase is made of.
#[derive(Debug, Clone, PartialEq)]
pub enum Material {
    /// The same at all temperatures.
    Constant(Box<Solid>),
    /// Isotropic constants at increasing temperatures \[°C\], linear between them.
    Table(Vec<(f64, Constituent)>),
}

impl Material {
    /// Its constants at a temperature \[°C\], or at any if they are constant. `None` outside its table.
    pub(crate) fn at(&self, celsius: Option<f64>) -> Option<Solid> {
        let rows = match self {
            Self::Constant(solid) => return Some(**solid),
            Self::Table(rows) => rows,
        };
        let wanted = celsius?;
        let (_, only) = rows.first().filter(|(t, _)| *t == wanted).copied().unzip();
        let between = || {
            let pair = rows.windows(2).find(|pair| pair[0].0 <= wanted && wanted <= pair[1].0)?;
            let (below, above) = (&pair[0].1, &pair[1].1);
            let share = (wanted - pair[0].0) / (pair[1].0 - pair[0].0);
            let mean = |f: fn(&Constituent) -> f64| f(below) + share * (f(above) - f(below));
            let elastic = Isotropic {
                youngs_modulus: mean(|c| c.elastic.youngs_modulus),
                poisson_ratio: mean(|c| c.elastic.poisson_ratio),
                thermal_expansion: mean(|c| c.elastic.thermal_expansion),
            };
            Some(Constituent { elastic, conductivity: mean(|c| c.conductivity), ..*below })
        };
        // a mean of valid constants is valid
        Solid::isotropic(&only.or_else(between)?).ok()
    }

    /// Temperatures \[°C\] it is given for; none if constant.
    pub(crate) fn range(&self) -> Option<[f64; 2]> {
        match self {
            Self::Constant(_) => None,
            Self::Table(rows) => Some([rows.first()?.0, rows.last()?.0]),
        }
    }
}

pub(super) fn material(at: &Group, file: &MaterialFile) -> Result<Material, InputError> {
    let plain = [
        ("youngs_modulus_mpa", file.youngs_modulus_mpa),
        ("poisson_ratio", file.poisson_ratio),
        ("thermal_expansion_per_k", file.thermal_expansion_per_k),
        ("conductivity_w_per_mk", file.conductivity_w_per_mk),
    ];
    let group = if file.orthotropic.is_some() { "orthotropic" } else { "table" };
    if file.orthotropic.is_some() || !file.table.is_empty() {
        if file.orthotropic.is_some() && !file.table.is_empty() {
            return Err(at.fault("table", "is given beside `orthotropic`", "keep one of the two"));
        }
        if let Some((key, _)) = plain.iter().find(|(_, value)| value.is_some()) {
            return Err(at.fault(key, format!("is given beside `{group}`"), "keep one of the two"));
        }
    }
    match &file.orthotropic {
        Some(orthotropic) => {
            let (density, specific_heat) = heavy(at, file)?;
            let solid = solid(&at.group("orthotropic"), orthotropic)?;
            Ok(Material::Constant(Box::new(Solid { density, specific_heat, ..solid })))
        }
        None if !file.table.is_empty() => table(at, file),
        None => {
            let constituent = isotropic(at, file)?;
            Ok(Material::Constant(Box::new(at.law(Solid::isotropic(&constituent))?)))
        }
    }
}

/// The isotropic constituent of a material that has neither table nor orthotropic constants.
pub(super) fn isotropic(at: &Group, file: &MaterialFile) -> Result<Constituent, InputError> {
    let required = |key: &str, value: Option<f64>| {
        value.ok_or_else(|| {
            at.fault(key, "the field is missing", "add it to the group, or give `orthotropic` or `table` in place of all")
        })
    };
    let constants = [
        required("youngs_modulus_mpa", file.youngs_modulus_mpa)?,
        required("poisson_ratio", file.poisson_ratio)?,
        required("thermal_expansion_per_k", file.thermal_expansion_per_k)?,
        required("conductivity_w_per_mk", file.conductivity_w_per_mk)?,
    ];
    let (density, specific_heat) = heavy(at, file)?;
    Ok(Constituent { density, specific_heat, ..constituent(at, constants)? })
}

/// Density \[kg/m³\] and specific heat \[J/(kg K)\], as far as they are given: the same at all temperatures.
fn heavy(at: &Group, file: &MaterialFile) -> Result<(Option<f64>, Option<f64>), InputError> {
    let optional = |key: &str, value: Option<f64>, limit| value.map(|value| at.number(key, value, limit)).transpose();
    let density = optional("density_kg_per_m3", file.density_kg_per_m3, &DENSITY)?;
    Ok((density, optional("specific_heat_j_per_kgk", file.specific_heat_j_per_kgk, &SPECIFIC_HEAT)?))
}

fn constituent(at: &Group, [modulus, ratio, expansion, conductivity]: [f64; 4]) -> Result<Constituent, InputError> {
    let elastic = Isotropic {
        youngs_modulus: from_mpa(at.number("youngs_modulus_mpa", modulus, &MODULUS_MPA)?),
        poisson_ratio: ratio,
        thermal_expansion: at.number("thermal_expansion_per_k", expansion, &EXPANSION_PER_K)?,
    };
    at.law(elastic.law())?;
    Ok(Constituent::new(elastic, at.number("conductivity_w_per_mk", conductivity, &CONDUCTIVITY)?))
}

fn table(at: &Group, file: &MaterialFile) -> Result<Material, InputError> {
    let (files, (density, specific_heat)) = (&file.table, heavy(at, file)?);
    if files.len() > MOST_ROWS {
        let problem = format!("{} rows are given, at most {MOST_ROWS} are read", files.len());
        return Err(at.fault("table", problem, "thin the table out"));
    }
    let mut rows: Vec<(f64, Constituent)> = Vec::with_capacity(files.len());
    for (i, file) in files.iter().enumerate() {
        let at = at.group(&format!("table[{i}]"));
        let temperature = at.number("temperature_c", file.temperature_c, &TEMPERATURE_C)?;
        if let Some((before, _)) = rows.last().filter(|(before, _)| temperature <= *before) {
            let problem = format!("{temperature} degC is not greater than the row before it, {before} degC");
            return Err(at.fault("temperature_c", problem, "list the rows by increasing temperature"));
        }
        let RowFile { youngs_modulus_mpa, poisson_ratio, thermal_expansion_per_k, conductivity_w_per_mk, .. } = *file;
        let plain = constituent(&at, [youngs_modulus_mpa, poisson_ratio, thermal_expansion_per_k, conductivity_w_per_mk])?;
        rows.push((temperature, Constituent { density, specific_heat, ..plain }));
    }
    Ok(Material::Table(rows))
}

fn solid(at: &Group, file: &OrthotropicFile) -> Result<Solid, InputError> {
    let modulus = |key: &str, value: f64| at.number(key, value, &MODULUS_MPA).map(from_mpa);
    let expansion = |key: &str, value: f64| at.number(key, value, &EXPANSION_PER_K);
    let law = Orthotropic {
        e_x: modulus("e_x_mpa", file.e_x_mpa)?,
        e_y: modulus("e_y_mpa", file.e_y_mpa)?,
        e_z: modulus("e_z_mpa", file.e_z_mpa)?,
        g_yz: modulus("g_yz_mpa", file.g_yz_mpa)?,
        g_xz: modulus("g_xz_mpa", file.g_xz_mpa)?,
        g_xy: modulus("g_xy_mpa", file.g_xy_mpa)?,
        nu_yz: at.number("nu_yz", file.nu_yz, &RATIO)?,
        nu_xz: at.number("nu_xz", file.nu_xz, &RATIO)?,
        nu_xy: at.number("nu_xy", file.nu_xy, &RATIO)?,
        alpha_x: expansion("alpha_x_per_k", file.alpha_x_per_k)?,
        alpha_y: expansion("alpha_y_per_k", file.alpha_y_per_k)?,
        alpha_z: expansion("alpha_z_per_k", file.alpha_z_per_k)?,
    };
    let law = at.law(law.law())?;
    let conductivity = |key: &str, value: f64| at.number(key, value, &CONDUCTIVITY);
    let (x, y) = (conductivity("k_x_w_per_mk", file.k_x_w_per_mk)?, conductivity("k_y_w_per_mk", file.k_y_w_per_mk)?);
    let conductivity_z = conductivity("k_z_w_per_mk", file.k_z_w_per_mk)?;
    let angle = at.number("angle_deg", file.angle_deg, &super::limits::ANGLE_DEG)?.to_radians();
    let conductivity = Matrix2::new(x, 0.0, 0.0, y);
    Ok(Solid { law, conductivity, conductivity_z, density: None, specific_heat: None }.turned(angle))
}
