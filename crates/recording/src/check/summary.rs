//! Summary of a channel, with the numbers by which it is judged.

use super::expectation::Expectation;

/// Summary of a channel.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelSummary {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Values that are there.
    pub present: usize,
    /// Values that are used.
    pub used: usize,
    /// Least value used \[u\].
    pub least: f64,
    /// Median of those present \[u\].
    pub median: f64,
    /// Largest value used \[u\].
    pub largest: f64,
    /// Standard deviation of the white noise of a value, from differences of neighbours \[u\].
    pub noise: Option<f64>,
    /// Step between values, if they lie on a lattice \[u\].
    pub step: Option<f64>,
}

pub(super) struct Context<'a> {
    pub(super) time: &'a [f64],
    pub(super) values: &'a [f64],
    pub(super) summary: &'a ChannelSummary,
    pub(super) interval: f64,
    pub(super) expectation: &'a Expectation,
}

/// Steps of resolution, in standard deviations of the noise, from which on it hides the noise.
pub(super) const COARSE: f64 = 3.0;
