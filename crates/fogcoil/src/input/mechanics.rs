//! How a coil file says that stiffness or bond depends on temperature and time.

use coil::{Body, FactorsAt, Mechanics, Opening};
use schemars::JsonSchema;
use serde::Deserialize;

use super::InputError;
use super::coil_file::SideFile;
use super::coil_parts::side;
use super::limits::{FACTOR, Group, HYSTERESIS_K, SHARE, TEMPERATURE_C, TIME_S, within};

/// Rows of the longest temperature table accepted: each costs a model.
const MOST_ROWS: usize = 100;

/// What of the coil's stiffness or bond depends on temperature or time.
#[derive(Deserialize, JsonSchema, Default)]
pub(crate) enum MechanicsFile {
    #[default]
    Elastic,
    TemperatureTable(Vec<FactorsFile>),
    Relaxing(RelaxingFile),
    Opening(OpeningFile),
}

/// Factors at a mean temperature of the coil; linear between rows, constant beyond. At most 100 rows.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FactorsFile {
    /// The temperature.
    #[schemars(transform = within(&TEMPERATURE_C))]
    temperature_c: f64,
    /// On E_r and G.
    #[schemars(transform = within(&FACTOR))]
    transverse_modulus_factor: f64,
    /// On alpha_r.
    #[schemars(transform = within(&FACTOR))]
    transverse_expansion_factor: f64,
}

/// E(t)/E(0) = 1 - fraction + fraction exp(-t/time).
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RelaxingFile {
    /// What relaxes.
    #[schemars(transform = within(&SHARE))]
    fraction: f64,
    /// In what time.
    #[schemars(transform = within(&TIME_S))]
    time_s: f64,
}

/// The outer part of the bond to a flange opens in the cold.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OpeningFile {
    /// Of the flange.
    side: SideFile,
    /// Where it opens.
    #[schemars(transform = within(&TEMPERATURE_C))]
    below_c: f64,
    /// How much above it closes.
    #[schemars(transform = within(&HYSTERESIS_K))]
    hysteresis_k: f64,
    /// Share of the annulus' width.
    #[schemars(transform = within(&SHARE))]
    fraction: f64,
}

pub(crate) fn mechanics(at: &Group, file: &MechanicsFile, body: &Body) -> Result<Mechanics, InputError> {
    match file {
        MechanicsFile::Elastic => Ok(Mechanics::Elastic),
        MechanicsFile::TemperatureTable(rows) => table(at, rows, body).map(Mechanics::TemperatureTable),
        MechanicsFile::Relaxing(file) => Ok(Mechanics::Relaxing {
            fraction: at.number("fraction", file.fraction, &SHARE)?,
            time: at.number("time_s", file.time_s, &TIME_S)?,
        }),
        MechanicsFile::Opening(file) => Ok(Mechanics::Opening(Opening {
            side: side(file.side),
            below: at.number("below_c", file.below_c, &TEMPERATURE_C)?,
            hysteresis: at.number("hysteresis_k", file.hysteresis_k, &HYSTERESIS_K)?,
            fraction: at.number("fraction", file.fraction, &SHARE)?,
        })),
    }
}

fn table(at: &Group, files: &[FactorsFile], body: &Body) -> Result<Vec<FactorsAt>, InputError> {
    if files.is_empty() || files.len() > MOST_ROWS {
        return Err(at.fault("", format!("{} rows are given", files.len()), format!("give 1 to {MOST_ROWS}")));
    }
    let mut rows: Vec<FactorsAt> = Vec::with_capacity(files.len());
    for (i, file) in files.iter().enumerate() {
        let at = at.group(&format!("[{i}]"));
        let temperature = at.number("temperature_c", file.temperature_c, &TEMPERATURE_C)?;
        if let Some(before) = rows.last().filter(|before| before.temperature >= temperature) {
            let problem = format!("{temperature} C is not above the row before, {} C", before.temperature);
            return Err(at.fault("temperature_c", problem, "order the rows by rising temperature"));
        }
        let transverse_modulus = at.number("transverse_modulus_factor", file.transverse_modulus_factor, &FACTOR)?;
        let limit = body.elastic.indefinite_at_e_r_factor();
        if transverse_modulus >= limit {
            let problem = format!("{transverse_modulus} makes the coil's stiffness indefinite, from {limit:.4} on");
            return Err(at.fault("transverse_modulus_factor", problem, "give a smaller factor"));
        }
        let transverse_expansion = at.number("transverse_expansion_factor", file.transverse_expansion_factor, &FACTOR)?;
        rows.push(FactorsAt { temperature, transverse_modulus, transverse_expansion });
    }
    Ok(rows)
}
