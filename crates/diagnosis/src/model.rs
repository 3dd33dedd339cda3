//! The interface of a forward model that the engine needs.

use crate::{Failure, Parameter, Prior};
use nalgebra::DMatrix;

/// One output that is both predicted and recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Name.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Mean and standard deviation of the constant that is added to every recording of the channel, the latter infinite where it may be anything; it
    /// is a nuisance, never a finding.
    pub offset: (f64, f64),
    /// Span of a sample's mean \[s\], 0 for momentary values.
    pub averaging: f64,
    /// Prior of its noise.
    pub noise: NoisePrior,
}

/// Size of the noise's terms as known beforehand: medians and the standard deviation of their logarithms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoisePrior {
    /// White noise of a sample.
    pub white: (f64, f64),
    /// Exponentially correlated drift, standard deviation.
    pub drift: (f64, f64),
    /// Its correlation time \[s\].
    pub drift_time: (f64, f64),
    /// Random walk [unit/√s].
    pub walk: (f64, f64),
    /// Noise of the drive, passed through the model: standard deviation; 0 where the drive is known.
    pub passed: (f64, f64),
    /// Its correlation time \[s\], > 0.
    pub passed_time: f64,
}

impl NoisePrior {
    /// Noise where the drive is known: white noise, drift, its correlation time and random walk.
    pub fn new(white: (f64, f64), drift: (f64, f64), drift_time: (f64, f64), walk: (f64, f64)) -> Self {
        Self { white, drift, drift_time, walk, passed: (0.0, 1.0), passed_time: 1.0 }
    }
}

/// Role of an uncertain number of the nominal model: when it is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Always free: an error that the model is known to have.
    ModelError,
    /// Always free: the error of an instrument.
    Sensor,
    /// Free wherever the design is not taken for right to the digit.
    Constant,
}

/// An uncertain number of the nominal model.
#[derive(Debug, Clone, PartialEq)]
pub struct Nuisance {
    /// The number.
    pub parameter: Parameter,
    /// Role, which says when it is free.
    pub role: Role,
    /// Whether every record has its own.
    pub local: bool,
}

/// Something that the nominal model leaves out.
#[derive(Debug, Clone, PartialEq)]
pub struct Omission {
    /// Short name.
    pub id: String,
    /// Part of the chain where it acts.
    pub stage: String,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// A further, whole-numbered parameter with its candidates, which are compared one by one.
    pub choice: Option<(String, Vec<f64>)>,
    /// Values of the parameters from which fits start, at least one, each with a value for every parameter.
    pub starts: Vec<Vec<f64>>,
    /// Whether an explanation by it counts as explained; else it only describes an unknown.
    pub named: bool,
    /// Weight before the recording is seen, relative to the others: finite and at least 0.
    pub weight: f64,
}

/// A mechanism at work.
#[derive(Debug, Clone, PartialEq)]
pub struct Active {
    /// Its number in [`ForwardModel::mechanisms`].
    pub mechanism: usize,
    /// Values of its parameters.
    pub values: Vec<f64>,
    /// Value of its choice, if it has one.
    pub choice: Option<f64>,
}

/// Two states of the modelled system that a mismatch may depend on, at the instants of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Level, e.g. the temperature of what is modelled.
    pub level: Vec<f64>,
    /// Its rate of change [level/s].
    pub rate: Vec<f64>,
}

/// A flexible input at one part of the chain: response of the channels to each of its functions with amplitude 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Latent {
    /// Part of the chain.
    pub stage: String,
    /// Responses `[function][channel][row]`.
    pub functions: Vec<Vec<Vec<f64>>>,
}

/// A nominal model with the mechanisms that it may leave out, prepared for some records.
pub trait ForwardModel {
    /// The channels, in the order of every response.
    fn channels(&self) -> &[Channel];

    /// Uncertain numbers of the nominal model.
    fn nuisances(&self) -> &[Nuisance];

    /// Precision of the nuisances beforehand, each in standard deviations of its own prior, where some go together: the inverse of their
    /// correlations. Those of which every record has its own are independent of all others.
    fn precision(&self) -> Option<&DMatrix<f64>> {
        None
    }

    /// The library.
    fn mechanisms(&self) -> &[Omission];

    /// The nuisance that a mechanism's first parameter replaces while it is at work, on the same scale: a factor on a constant is the unit's whole
    /// deviation there, and no record could tell the two apart.
    fn stands_for(&self, _mechanism: usize) -> Option<usize> {
        None
    }

    /// Whether a nuisance acts on what mechanisms add as it does on the nominal response, such as a delay of all that is read: its effect is another one
    /// beside a mechanism, however small the mechanism's change of the nominal system is.
    fn acts_on_mechanisms(&self, _nuisance: usize) -> bool {
        false
    }

    /// Changes of a mechanism's parameters, in their order, by one unit of a nuisance while the mechanism's effect stays where the records hold it: a
    /// threshold goes with a temperature that no record tells. Empty if nothing changes.
    fn carries(&self, _nuisance: usize, _active: &Active) -> Vec<f64> {
        Vec::new()
    }

    /// Response of every channel, `[channel][row]`, at the instants of a record, with nuisances at given values and mechanisms at work.
    ///
    /// # Errors
    /// The model's error if it cannot respond.
    fn respond(&self, record: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Failure>;

    /// The same model where it is good about these nuisances and mechanisms, if it is not yet: a model that is linear in some of them is made anew there.
    ///
    /// # Errors
    /// The model's error if it cannot be made.
    fn about(&self, _nuisances: &[f64], _active: &[Active]) -> Result<Option<Self>, Failure>
    where
        Self: Sized,
    {
        Ok(None)
    }

    /// Nuisances about which the model may be made first, beside the middles of their priors: where it is far from linear in one of them, the
    /// nearest minimum need not be the least. Those that the search from the middles has come to, `found`, may be the better ones for the others.
    fn starts(&self, _found: &[f64]) -> Vec<Vec<f64>> {
        Vec::new()
    }

    /// State of the nominal system during a record, one level and one rate for each instant.
    fn state(&self, record: usize) -> &State;

    /// A flexible input at every stage where one can act, one at each; without any, a mismatch is not located by stage. Of several records those stages
    /// are compared that each of them has.
    ///
    /// # Errors
    /// The model's error if it cannot respond.
    fn latent(&self, _record: usize) -> Result<Vec<Latent>, Failure> {
        Ok(Vec::new())
    }

    /// Members of a group, such as layers, each a function; a record may tell which of them are at work.
    ///
    /// # Errors
    /// The model's error if it cannot respond.
    fn members(&self, _record: usize) -> Result<Option<Latent>, Failure> {
        Ok(None)
    }
}

/// Recorded values, one series for each channel; NaN where none is usable.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Instants \[s\], increasing.
    pub time: Vec<f64>,
    /// Series of each channel.
    pub channels: Vec<Vec<f64>>,
}

impl Nuisance {
    /// A number of the nominal model that is known to 1σ = `sd` about `mean`.
    pub fn normal(name: impl Into<String>, mean: f64, sd: f64, role: Role) -> Self {
        Self { parameter: Parameter::new(name, Prior::Normal { mean, sd }), role, local: false }
    }
}
