//! Stiffness and bond that depend on temperature and time, in `COIL.ron`.

use coil::{Body, FactorsAt, Mechanics, Opening};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::InputError;
use super::group::Group;
use super::mirror::{Mirror, mirrored};
use super::quantity::{Factor, HysteresisK, RelaxingShare, Share, TemperatureC, TimeS};
use super::winding_file::SideFile;

/// Rows of the longest temperature table accepted: each costs a model.
const MOST_ROWS: usize = 100;

/// Dependence of the coil's stiffness or bond on temperature or time.
#[derive(Serialize, Deserialize, JsonSchema, Default)]
pub(crate) enum MechanicsFile {
    #[default]
    Elastic,
    TemperatureTable(#[schemars(length(min = 1, max = 100))] Vec<FactorsFile>),
    Relaxing(RelaxingFile),
    Opening(OpeningFile),
}

/// E(t)/E(0) = 1 - fraction + fraction exp(-t/time).
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RelaxingFile {
    /// Share of the modulus that relaxes.
    fraction: RelaxingShare,
    /// Relaxation time.
    time_s: TimeS,
}

mirrored! {
    /// Factors at a mean temperature of the coil; linear between rows, constant beyond. At most 100 rows.
    FactorsFile is FactorsAt {
        /// The temperature.
        temperature_c: TemperatureC = temperature,
        /// Factor on E_r and G.
        transverse_modulus_factor: Factor = transverse_modulus,
        /// Factor on alpha_r.
        transverse_expansion_factor: Factor = transverse_expansion,
    }

    /// The outer part of the bond to a flange opens in the cold.
    OpeningFile is Opening {
        /// Side of the flange.
        side: SideFile = side,
        /// Temperature below which it opens.
        below_c: TemperatureC = below,
        /// Distance above that temperature at which it closes.
        hysteresis_k: HysteresisK = hysteresis,
        /// Share of the annulus' width.
        fraction: Share = fraction,
    }
}

impl Mirror<Mechanics> for MechanicsFile {
    fn model(&self) -> Mechanics {
        match self {
            Self::Elastic => Mechanics::Elastic,
            Self::TemperatureTable(rows) => Mechanics::TemperatureTable(rows.model()),
            Self::Relaxing(file) => Mechanics::Relaxing { fraction: file.fraction.model(), time: file.time_s.model() },
            Self::Opening(file) => Mechanics::Opening(file.model()),
        }
    }

    fn of(model: &Mechanics) -> Self {
        match model {
            Mechanics::Elastic => Self::Elastic,
            Mechanics::TemperatureTable(rows) => Self::TemperatureTable(Mirror::of(rows)),
            Mechanics::Relaxing { fraction, time } => {
                Self::Relaxing(RelaxingFile { fraction: Mirror::of(fraction), time_s: Mirror::of(time) })
            }
            Mechanics::Opening(opening) => Self::Opening(Mirror::of(opening)),
        }
    }
}

/// The law, if its table rises and keeps the coil's stiffness definite.
pub(super) fn mechanics(at: &Group, file: &MechanicsFile, body: &Body) -> Result<Mechanics, InputError> {
    let law = file.model();
    let Mechanics::TemperatureTable(rows) = &law else { return Ok(law) };
    if rows.is_empty() || rows.len() > MOST_ROWS {
        return Err(at.fault("", format!("{} rows are given", rows.len()), format!("give 1 to {MOST_ROWS}")));
    }
    let limit = body.elastic.indefinite_at_e_r_factor();
    for (i, row) in rows.iter().enumerate() {
        let (at, temperature, factor) = (at.group(&format!("[{i}]")), row.temperature, row.transverse_modulus);
        if let Some(before) = rows[..i].last().filter(|before| before.temperature >= temperature) {
            let problem = format!("{temperature} C is not above the row before, {} C", before.temperature);
            return Err(at.fault("temperature_c", problem, "order the rows by rising temperature"));
        }
        if factor >= limit {
            let problem = format!("{factor} makes the coil's stiffness indefinite, from {limit:.4} on");
            return Err(at.fault("transverse_modulus_factor", problem, "give a smaller factor"));
        }
    }
    Ok(law)
}
