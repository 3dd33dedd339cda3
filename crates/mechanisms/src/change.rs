//! The change of a response, as a mechanism makes it.

use crate::course::Parts;
use crate::record_to_bias::Prepared;
use coil::Parameter;

/// Change of a coil's response, a value for each row of a record.
#[derive(Debug, Clone)]
pub struct Change {
    /// Change of the bias: Shupe, elasto-optic axial and radial \[deg/h\].
    pub parts: Parts,
    /// What is added to that for a relative change of a constant by 1 \[deg/h\], where it is not as that of the nominal bias.
    pub per: Vec<(Parameter, Parts)>,
    /// Change of the spool's thermometer \[K\]; `None` if there is none.
    pub thermometer: Option<Vec<f64>>,
    /// Thresholds that the coil passes.
    pub thresholds: Vec<Threshold>,
    /// A flange whose power does all this.
    pub heated: Option<Heated>,
    /// Change of the rate beside the bias \[deg/h\]; `None` if there is none.
    pub rate: Option<Vec<f64>>,
}

/// A passage of a threshold on the coil's mean temperature, which no record tells.
#[derive(Debug, Clone, PartialEq)]
pub struct Threshold {
    /// Row in which it is passed.
    pub row: usize,
    /// Which it is, from 0.
    pub number: usize,
    /// Change of each of the mechanism's parameters by a kelvin that the coil is warmer then, where its effect stays.
    pub parameters: Vec<f64>,
}

/// A flange that gives off a power, which no record tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heated {
    /// Which of those that may be heated, from 0.
    pub place: usize,
    /// Its power, the mechanism's first parameter \[W\].
    pub power: f64,
    /// Time from when it is switched on to the first row \[s\].
    pub before: f64,
}

impl Change {
    /// Nothing changes.
    pub fn none(record: &Prepared) -> Self {
        Self::of_parts([0, 1, 2].map(|_| vec![0.0; record.time.len()]))
    }

    /// The bias changes alone.
    pub fn of_parts(parts: Parts) -> Self {
        Self { parts, thermometer: None, per: Vec::new(), thresholds: Vec::new(), heated: None, rate: None }
    }

    /// The rate changes, but no part of the bias.
    pub fn of_rate(record: &Prepared, rate: Vec<f64>) -> Self {
        Self { rate: Some(rate), ..Self::none(record) }
    }
}
