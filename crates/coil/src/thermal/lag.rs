//! The lag behind the chamber in a steady ramp.

use super::{Drive, ThermalModel};
use crate::{Design, Error, MeshFineness};

/// How far each place lags behind the chamber wall when that has been warming at a constant rate for long.
///
/// The temperature is `T_wall(t) − lag · Ṫ` everywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct RampLag {
    /// At the centre of every turn, in the winding's order \[s\].
    pub turns: Vec<f64>,
    /// At the thermometer, without its own lag \[s\].
    pub sensor: f64,
    /// Unknowns of the system.
    pub unknowns: usize,
}

/// Solves `−∇·(k ∇lag) = ρ c` with no lag at the wall.
///
/// # Errors
/// [`Error`] names the dimension or property at fault, or the solve that failed.
pub fn ramp_lag(design: &Design, resolution: &MeshFineness) -> Result<RampLag, Error> {
    let winding = winding::wind(&design.winding)?;
    let model = ThermalModel::new(design, resolution, &[Drive::Chamber])?;
    let solution = model.conductivity().solve(model.stored()).map_err(|source| Error::Solve { part: "chamber", source })?;
    let lag = model.map().expand(&solution[0]);
    let at = |field: &str, r: f64, y: f64| model.grid().probe(field, r, y).map(|p| p.value_of(&lag));
    Ok(RampLag {
        turns: winding.turns().iter().map(|t| at("winding", t.r, t.y)).collect::<Result<_, _>>()?,
        sensor: at("sensor", design.sensor.radius, design.sensor.y)?,
        unknowns: model.conductivity().unknowns(),
    })
}
