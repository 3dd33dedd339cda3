//! A mechanism's file as it is written.

use mechanisms::Stage;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::mirror::mirrored_choice;

/// Physics of a user's own that the model of a coil leaves out, `MECHANISM.ron`: parameters, states, and laws in named quantities.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MechanismFile {
    /// Short name in every output: small letters, digits and hyphens.
    pub(crate) id: String,
    /// A heading.
    #[serde(deserialize_with = "super::name::printable")]
    pub(crate) title: String,
    /// Part of the chain in which it acts.
    pub(crate) stage: StageFile,
    /// The mechanism in a sentence, as an answer tells it.
    #[serde(default, deserialize_with = "super::name::printable")]
    pub(crate) meaning: String,
    /// Its signature in a record.
    #[serde(default, deserialize_with = "super::name::printable")]
    pub(crate) signature: String,
    /// A check of the unit itself that decides about it.
    #[serde(default, deserialize_with = "super::name::printable")]
    pub(crate) inspection: String,
    /// Literature.
    #[serde(default, deserialize_with = "super::name::printable")]
    pub(crate) source: String,
    /// Numbers that are fitted, 1 to 8.
    #[schemars(length(min = 1, max = 8))]
    pub(crate) parameters: Vec<ParameterFile>,
    /// Further columns of the records that states and laws name, up to 8.
    #[serde(default)]
    #[schemars(length(max = 8))]
    pub(crate) columns: Vec<ColumnFile>,
    /// States, its memory, up to 8.
    #[serde(default)]
    #[schemars(length(max = 8))]
    pub(crate) states: Vec<StateFile>,
    /// Its changes of the model, 1 to 8.
    #[schemars(length(min = 1, max = 8))]
    pub(crate) laws: Vec<LawFile>,
}

mirrored_choice! {
    /// Part of the chain.
    StageFile is Stage: { Thermal, Material, Bond, Winding, Optics, Electronics, Sensor }
}

/// A number that is fitted.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ParameterFile {
    /// Its name in states and laws.
    pub(crate) name: String,
    /// Its unit, like s or deg/h/K; 1 for a pure number.
    pub(crate) unit: String,
    /// Its prior distribution, in its unit.
    pub(crate) prior: PriorFile,
    /// Source of the prior.
    #[serde(default, deserialize_with = "super::name::printable")]
    pub(crate) source: String,
    /// Values from which fits start, up to 50; empty: from the prior.
    #[serde(default)]
    #[schemars(length(max = 50))]
    pub(crate) starts: Vec<f64>,
    /// Its value, as `simulate` takes it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) value: Option<f64>,
}

/// Prior distribution of a number: Normal(mean, standard deviation); Size(scale); LogNormal(median, standard deviation of the logarithm); Uniform(low, high).
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy)]
pub(crate) enum PriorFile {
    /// Mean and standard deviation.
    Normal(f64, f64),
    /// A size of either sign whose order of magnitude is uncertain: near 0 as Normal(0, scale), far out as one whose logarithm is normal.
    Size(f64),
    /// Median, and standard deviation of the natural logarithm.
    LogNormal(f64, f64),
    /// Lowest and highest value.
    Uniform(f64, f64),
}

/// A further column of a record.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ColumnFile {
    /// Its name in states and laws, and in the record unless `column` gives another.
    pub(crate) name: String,
    /// Its name in the record where that has blanks, brackets or other signs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) column: Option<String>,
    /// Its unit in the record.
    pub(crate) unit: String,
}

impl ColumnFile {
    /// Its name in the record.
    pub(crate) fn in_record(&self) -> &str {
        self.column.as_deref().unwrap_or(&self.name)
    }
}

/// A state of a mechanism, its memory.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StateFile {
    /// Its name in states and laws.
    pub(crate) name: String,
    /// Its unit.
    pub(crate) unit: String,
    /// Its change in time.
    pub(crate) goes: GoesFile,
}

/// Change of a state in time.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(crate) enum GoesFile {
    /// A rate of change, from a first value.
    #[serde(rename = "Rate")]
    Rate {
        /// dx/dt, in its unit over seconds.
        rate: String,
        /// Its value in the first row, without states.
        first: String,
    },
    /// A play (backlash, hysteresis): the state follows an expression once that is half the width away.
    #[serde(rename = "Play")]
    Play {
        /// The expression that it follows, without states.
        of: String,
        /// Width, in parameters alone.
        width: String,
    },
    /// The highest value so far of an expression without states.
    Highest(String),
    /// The lowest value so far of an expression without states.
    Lowest(String),
}

/// The changed quantity of a law, and the law.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(crate) enum LawFile {
    /// Added to the rate, deg/h.
    Rate(String),
    /// Added to the temperature of the spool's thermometer, K.
    Thermometer(String),
    /// Added to the chamber's temperature, K: everything follows.
    Chamber(String),
    /// Heat into the first flange that can be heated, W.
    FlangePower(String),
    /// Relative change of the coil's transverse moduli, 1.
    Stiffness(String),
    /// Relative change of the coil's transverse expansion, 1.
    Expansion(String),
    /// Share of the first flange's bond that is open, 1.
    OpenBond(String),
    /// Length by which the CW tail is longer, m.
    Tail(String),
    /// Relative change of the thermal phase, 1.
    Shupe(String),
    /// Relative change of the elasto-optic axial part, 1.
    Axial(String),
    /// Relative change of the elasto-optic radial part, 1.
    Radial(String),
    /// Relative change of all parts of the bias, 1.
    Bias(String),
}
