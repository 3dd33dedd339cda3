//! What the recordings say, in a word and in numbers.
//!
//! [`conclude`] makes a verdict of weighed candidates, [`set`] says which mechanisms are not excluded, [`judge`] what records that were held
//! out make of it.

mod conclude;
mod diagnosis;
mod judge;
mod set;

pub use diagnosis::{Diagnosis, Verdict};
pub use judge::{Contradiction, Judged, Judgement, Ruling};
