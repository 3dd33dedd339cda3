//! A nominal model's description of itself, so that small laws can be offered to it without further knowledge of it.

use diagnosis::{Channel, Nuisance};

/// Kind of number that a quantity is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// A level without a natural zero, such as a temperature.
    Level,
    /// A flow or an effort that is nothing at 0, such as a current.
    Flow,
    /// A phase in cycles: only its fraction matters.
    Phase,
    /// The time since the start.
    Time,
}

/// Something that drives the modelled system, or a state of it, on which a law may depend.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Quantity {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) kind: Kind,
}

/// Where a law may act: an input, a loss, a reading.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    /// The quantity of the body at which this is, if any: two flows may be exchanged by the difference of theirs.
    pub(crate) own: Option<usize>,
    pub(crate) acts: Acts,
}

/// Kind of action at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Acts {
    /// A flow to which others add.
    Flow,
    /// A loss, which may change; what else flows off is a flow's matter.
    Loss,
    /// A channel's reading.
    Reading(usize),
}

/// One instant: how long the last one is ago, the quantities, and what the nominal model has at every place.
pub(crate) struct Moment<'a> {
    pub(crate) step: f64,
    pub(crate) quantities: &'a [f64],
    pub(crate) places: &'a mut [f64],
}

/// Parts of a plant.
#[derive(Debug, Clone)]
pub(crate) struct Facts {
    pub(crate) channels: Vec<Channel>,
    pub(crate) nuisances: Vec<Nuisance>,
    pub(crate) quantities: &'static [Quantity],
    pub(crate) places: &'static [Place],
}

/// A nominal model of textbook physics that runs through whole tests from their first instant.
pub(crate) trait Plant {
    fn facts(&self) -> &Facts;
    /// Instants of a test \[s\].
    fn time(&self, test: usize) -> &[f64];
    /// Channels at the instants of a test. At every instant `laws` is shown the moment, and changes what is at the places; with it the model goes on.
    fn run(&self, test: usize, constants: &[f64], laws: &mut dyn FnMut(Moment<'_>)) -> Vec<Vec<f64>>;
}
