//! The change of a response, as a mechanism makes it.

use crate::bond;
use crate::course::Parts;
use crate::record_to_bias::Prepared;
use coil::Parameter;

/// Change of a coil's response, a value for each row of a record.
#[derive(Debug, Clone)]
pub struct Change {
    /// Change of the bias: Shupe, elasto-optic axial and radial \[deg/h\].
    pub parts: Parts,
    /// What constants add, where it is not as what they add to the nominal bias.
    pub per: Vec<Per>,
    /// Change of the spool's thermometer \[K\]; `None` if there is none.
    pub thermometer: Option<Vec<f64>>,
    /// Thresholds that the coil passes.
    pub thresholds: Vec<Threshold>,
    /// `Some` if it stands apart from the coil's other bias, so that constants act on it by `per` alone, and a CW tail that is longer by a metre by these parts
    /// \[deg/h\].
    pub apart: Option<Box<Parts>>,
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

/// What is added for a relative change of a constant by 1.
#[derive(Debug, Clone)]
pub struct Per {
    /// Which.
    pub parameter: Parameter,
    /// What is added to the bias \[deg/h\].
    pub parts: Parts,
    /// What is added to the spool's thermometer \[K\]; `None` if nothing is.
    pub thermometer: Option<Vec<f64>>,
}

impl Per {
    /// What an open bond's constants add, which leaves the thermometer alone: parts in the order of [`bond::constants`].
    pub(crate) fn of_a_bond(parts: Vec<Parts>) -> Vec<Self> {
        bond::constants().zip(parts).map(|(parameter, parts)| Self { parameter, parts, thermometer: None }).collect()
    }
}

impl Change {
    /// Nothing changes.
    pub fn none(record: &Prepared) -> Self {
        Self::of_parts([0, 1, 2].map(|_| vec![0.0; record.time.len()]))
    }

    /// The bias changes alone.
    pub fn of_parts(parts: Parts) -> Self {
        Self { parts, thermometer: None, per: Vec::new(), thresholds: Vec::new(), apart: None, rate: None }
    }

    /// The rate changes, but no part of the bias.
    pub fn of_rate(record: &Prepared, rate: Vec<f64>) -> Self {
        Self { rate: Some(rate), ..Self::none(record) }
    }
}
