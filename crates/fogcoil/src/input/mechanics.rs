//! How a coil file says that stiffness or bond depends on temperature and time.

use coil::{Body, FactorsAt, Mechanics, Opening};
use serde::Deserialize;

use super::InputError;
use super::coil_file::SideFile;
use super::coil_parts::side;
use super::limits::{FACTOR, Group, HYSTERESIS_K, SHARE, TEMPERATURE_C, TIME_S};

/// Rows of the longest temperature table accepted: each costs a model.
const MOST_ROWS: usize = 100;

#[derive(Deserialize, Default)]
pub(crate) enum MechanicsFile {
    #[default]
    Elastic,
    TemperatureTable(Vec<FactorsFile>),
    Relaxing(RelaxingFile),
    Opening(OpeningFile),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FactorsFile {
    temperature_c: f64,
    transverse_modulus_factor: f64,
    transverse_expansion_factor: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RelaxingFile {
    fraction: f64,
    time_s: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OpeningFile {
    side: SideFile,
    below_c: f64,
    hysteresis_k: f64,
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
