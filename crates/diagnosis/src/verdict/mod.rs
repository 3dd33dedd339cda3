//! Verdict of the recordings, in a word and in numbers.
//!
//! [`conclude`] makes a verdict of weighed candidates, and [`set`] says which mechanisms are not excluded. [`judge`] tests the verdict on
//! held-out records, [`unlisted`] on a composed law.

mod conclude;
mod judge;
mod set;
mod unlisted;
mod waves;

pub use judge::{Contradiction, Judged, Judgement, Ruling, SURE};
#[cfg(test)]
pub(crate) use set::tests::{candidate, library};

use crate::fit::{Fit, Hypothesis};
use crate::{Estimate, Rival, Stage};

/// A hypothesis that was compared.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The fit, at its most probable parameters.
    pub fit: Fit,
    /// Structure that was added to it, if any.
    pub rival: Option<Rival>,
    /// ln of evidence times prior probability.
    pub log_weight: f64,
    /// Probability among all that were compared.
    pub probability: f64,
}

impl Candidate {
    /// The design with its constants free, and nothing else.
    pub fn is_constants_alone(&self) -> bool {
        self.rival.is_none() && self.fit.hypothesis == Hypothesis::RECALIBRATED
    }

    /// ln of its prior probability.
    pub fn log_prior(&self) -> f64 {
        self.log_weight - self.log_evidence()
    }

    /// ln of the evidence, with that of its structure.
    pub fn log_evidence(&self) -> f64 {
        self.fit.log_evidence + self.rival.as_ref().map_or(0.0, |r| r.gain)
    }
}

/// Conclusion drawn from the recordings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The nominal model suffices.
    None,
    /// Re-estimating the design's own constants within their uncertainties suffices.
    Recalibrate,
    /// A mechanism of the library explains the difference, or two.
    Explained,
    /// There is structure that nothing in the library explains.
    Unknown,
}

/// The outcome.
#[derive(Debug, Clone)]
pub struct Diagnosis {
    /// The verdict in a word.
    pub verdict: Verdict,
    /// All candidates, most probable first.
    pub candidates: Vec<Candidate>,
    /// Marginal probability of every mechanism (its number in the library), most probable first.
    pub mechanisms: Vec<(usize, f64)>,
    /// Mechanisms that the recordings do not exclude, best first.
    pub set: Vec<usize>,
    /// Parameters of the best candidate's mechanisms, in its order.
    pub parameters: Vec<Vec<Estimate>>,
    /// The nominal model, its offsets and model errors fitted.
    pub nominal: Fit,
    /// The nominal model under the best candidate's noise; its residual is the mismatch.
    pub mismatch: Fit,
    /// Fit of a flexible input at each stage to the mismatch, best first.
    pub stages: Vec<Stage>,
    verdicts: [f64; 4],
    excluded: f64,
}

impl Diagnosis {
    /// The most probable candidate.
    pub fn best(&self) -> &Candidate {
        &self.candidates[0]
    }

    /// Probabilities of the verdicts none, recalibrate, explained and unknown, by the records that were fitted.
    pub fn verdicts(&self) -> [f64; 4] {
        self.verdicts
    }

    /// Ends of the interval of the choice of the best candidate's mechanism at `place`, if it has one.
    pub fn choice(&self, place: usize) -> Option<[f64; 2]> {
        self.best().fit.hypothesis.mechanisms.get(place)?.1?;
        Some(self.parameters.get(place)?.first()?.ci90)
    }
}
