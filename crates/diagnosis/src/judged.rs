//! Residuals of records that were not fitted, under a fit's noise.

use crate::Observation;
use crate::fit::Fit;
use crate::noise::Noise;

impl Fit {
    /// A channel's residual in a record that was not fitted, whitened by the noise of the first record that was; only the rows that
    /// were observed. Empty where the instants do not increase.
    pub fn whiten(&self, channel: usize, observed: &Observation, residual: &[f64]) -> Vec<f64> {
        Noise::of_record(&self.noise, 0, observed).map_or(Vec::new(), |noise| noise.whiten(0, channel, residual))
    }
}
