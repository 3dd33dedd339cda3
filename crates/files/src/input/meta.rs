//! What is known of a record besides its columns: `meta.ron` beside it.

use std::path::Path;

use schemars::JsonSchema;
use serde::Deserialize;

use super::InputError;
use super::quantity::NotNegative;
use super::source::Source;

/// What a meta file may say; everything may be left out.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Meta {
    /// Name of the design that the unit was built to.
    pub design: String,
    /// Nominal interval between rows \[s\]; 0 if it is not given.
    #[schemars(with = "NotNegative")]
    pub sample_interval_s: f64,
    /// In words, what a row's rate is.
    pub rate_is: String,
    /// The thermometers.
    pub temperature_sensor: TemperatureSensor,
    /// Angle random walk from a bench test \[deg/√h\].
    #[schemars(with = "Option<NotNegative>")]
    pub nominal_arw_deg_per_sqrt_h: Option<f64>,
}

/// The thermometers of a record; 0 where nothing is known.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TemperatureSensor {
    /// Standard deviation of a reading \[°C\].
    #[schemars(with = "NotNegative")]
    pub noise_c: f64,
    /// Resolution of the chamber's \[°C\].
    #[schemars(with = "NotNegative")]
    pub chamber_quantisation_c: f64,
    /// Resolution of the spool's \[°C\].
    #[schemars(with = "NotNegative")]
    pub spool_quantisation_c: f64,
}

/// Longest interval between rows \[s\]: thirty years.
pub(super) const MOST_INTERVAL_S: f64 = 1e9;

/// Reads and checks a meta file.
pub(super) fn read(path: &Path) -> Result<Meta, InputError> {
    let source = Source::read(path)?;
    let meta: Meta = source.parse(None)?;
    let sensor = &meta.temperature_sensor;
    let values = [
        ("temperature_sensor.noise_c", sensor.noise_c),
        ("temperature_sensor.chamber_quantisation_c", sensor.chamber_quantisation_c),
        ("temperature_sensor.spool_quantisation_c", sensor.spool_quantisation_c),
        ("nominal_arw_deg_per_sqrt_h", meta.nominal_arw_deg_per_sqrt_h.unwrap_or(0.0)),
    ];
    if !(0.0..=MOST_INTERVAL_S).contains(&meta.sample_interval_s) {
        let problem = format!("{:e} s is not an interval of 0 to {MOST_INTERVAL_S:e} s", meta.sample_interval_s);
        return Err(source.fault(
            "sample_interval_s",
            problem,
            "give the seconds over which a rate is a mean, or leave the field out",
        ));
    }
    match values.into_iter().find(|(_, value)| !(*value >= 0.0 && value.is_finite())) {
        Some((field, value)) => {
            Err(source.fault(field, format!("{value} is not 0 or more"), "give the value, or leave the field out"))
        }
        None => Ok(meta),
    }
}
