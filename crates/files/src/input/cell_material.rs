//! Constituents of a cell: isotropic, orthotropic, or tables over temperature.

use fem_core::material::Isotropic;
use homogenization::Constituent;
use homogenization::irregular::Solid;
use nalgebra::Matrix2;

use super::InputError;
use super::cell_file::{MaterialFile, OrthotropicFile, OrthotropicSolid};
use super::group::Group;
use super::mirror::Mirror;
use super::syntax::MISSING;

const MOST_ROWS: usize = 1000;

/// Material of a phase.
#[derive(Debug, Clone, PartialEq)]
pub enum Material {
    /// Isotropic, the same at all temperatures.
    Isotropic(Constituent),
    /// Orthotropic, the same at all temperatures.
    Orthotropic(Box<Solid>),
    /// Isotropic constants at increasing temperatures \[°C\], linear between them.
    Table(Vec<(f64, Constituent)>),
}

impl Material {
    /// Its constants at a temperature \[°C\], or at any if they are constant. `None` outside its table.
    pub(crate) fn at(&self, celsius: Option<f64>) -> Option<Solid> {
        let rows = match self {
            // it was valid when it was read
            Self::Isotropic(constituent) => return Solid::isotropic(constituent).ok(),
            Self::Orthotropic(solid) => return Some(**solid),
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

    /// Its density and specific heat, as far as they are given.
    pub(super) fn masses(&self) -> [Option<f64>; 2] {
        match self {
            Self::Isotropic(c) => [c.density, c.specific_heat],
            Self::Orthotropic(solid) => [solid.density, solid.specific_heat],
            Self::Table(rows) => rows.first().map_or([None; 2], |(_, c)| [c.density, c.specific_heat]),
        }
    }

    /// Temperatures \[°C\] it is given for; none if constant.
    pub(crate) fn range(&self) -> Option<[f64; 2]> {
        match self {
            Self::Isotropic(_) | Self::Orthotropic(_) => None,
            Self::Table(rows) => Some([rows.first()?.0, rows.last()?.0]),
        }
    }
}

pub(super) fn material(at: &Group, file: &MaterialFile) -> Result<Material, InputError> {
    let plain = [
        ("youngs_modulus_mpa", file.youngs_modulus_mpa.map(|value| value.model())),
        ("poisson_ratio", *file.poisson_ratio),
        ("thermal_expansion_per_k", file.thermal_expansion_per_k.map(|value| value.model())),
        ("conductivity_w_per_mk", file.conductivity_w_per_mk.map(|value| value.model())),
    ];
    if file.orthotropic.is_some() && !file.table.is_empty() {
        return Err(at.fault("table", "is given beside `orthotropic`", "keep one of the two"));
    }
    if let Some(group) = file.general_key()
        && let Some((key, _)) = plain.iter().find(|(_, value)| value.is_some())
    {
        return Err(at.fault(key, format!("is given beside `{group}`"), "keep one of the two"));
    }
    // the same at all temperatures
    let density = file.density_kg_per_m3.map(|value| value.model());
    let specific_heat = file.specific_heat_j_per_kgk.map(|value| value.model());
    if let Some(orthotropic) = &*file.orthotropic {
        let solid = solid(&at.group("orthotropic"), orthotropic)?;
        return Ok(Material::Orthotropic(Box::new(Solid { density, specific_heat, ..solid })));
    }
    if !file.table.is_empty() {
        let rows = table(at, file)?.into_iter();
        return Ok(Material::Table(rows.map(|(t, plain)| (t, Constituent { density, specific_heat, ..plain })).collect()));
    }
    let given = |i: usize| {
        let (key, value) = plain[i];
        let remedy = "add it to the group, or give `orthotropic` or `table` in place of all";
        value.ok_or_else(|| at.fault(key, MISSING, remedy))
    };
    let plain = constituent(at, [given(0)?, given(1)?, given(2)?, given(3)?])?;
    Ok(Material::Isotropic(Constituent { density, specific_heat, ..plain }))
}

/// Constants from modulus, ratio, expansion and conductivity, SI.
fn constituent(at: &Group, [modulus, ratio, expansion, conductivity]: [f64; 4]) -> Result<Constituent, InputError> {
    let elastic = Isotropic { youngs_modulus: modulus, poisson_ratio: ratio, thermal_expansion: expansion };
    at.law(elastic.law())?;
    Ok(Constituent::new(elastic, conductivity))
}

fn table(at: &Group, file: &MaterialFile) -> Result<Vec<(f64, Constituent)>, InputError> {
    if file.table.len() > MOST_ROWS {
        let problem = format!("{} rows are given, at most {MOST_ROWS} are read", file.table.len());
        return Err(at.fault("table", problem, "thin the table out"));
    }
    let mut rows: Vec<(f64, Constituent)> = Vec::with_capacity(file.table.len());
    for (at, file) in at.each("table", &file.table) {
        let temperature = file.temperature_c.model();
        if let Some((before, _)) = rows.last().filter(|(before, _)| temperature <= *before) {
            let problem = format!("{temperature} degC is not greater than the row before it, {before} degC");
            return Err(at.fault("temperature_c", problem, "list the rows by increasing temperature"));
        }
        let (expansion, conductivity) = (file.thermal_expansion_per_k.model(), file.conductivity_w_per_mk.model());
        rows.push((
            temperature,
            constituent(&at, [file.youngs_modulus_mpa.model(), file.poisson_ratio, expansion, conductivity])?,
        ));
    }
    Ok(rows)
}

fn solid(at: &Group, file: &OrthotropicFile) -> Result<Solid, InputError> {
    let OrthotropicSolid { law, k_x, k_y, k_z: conductivity_z, angle } = file.model();
    let law = at.law(law.law())?;
    let conductivity = Matrix2::new(k_x, 0.0, 0.0, k_y);
    Ok(Solid { law, conductivity, conductivity_z, density: None, specific_heat: None }.turned(angle))
}
