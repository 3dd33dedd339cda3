//! What is compared.

use crate::Rival;
use crate::fit::Fit;

/// A hypothesis that was compared.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// At its most probable parameters.
    pub fit: Fit,
    /// Structure that was added to it, if any.
    pub rival: Option<Rival>,
    /// ln of evidence times prior probability.
    pub log_weight: f64,
    /// Probability among all that were compared.
    pub probability: f64,
}

impl Candidate {
    /// ln of the evidence, with that of its structure.
    pub(crate) fn log_evidence(&self) -> f64 {
        self.fit.log_evidence + self.rival.as_ref().map_or(0.0, |r| r.gain)
    }
}
