//! `fogcoil identify`: constituents from measured effective constants, with what is and what is not determined.

mod json;
mod quantity;
mod text;

pub use json::json;
pub use text::text;

use homogenization::identify::Identification;
use progress::Step;

use crate::Error;
use crate::input::TargetsCase;

/// Seed of every random number: the same file gives the same answer.
pub const SEED: u64 = 1;

/// Identifies the constituents behind a file's targets; `progress` is told what is going on.
///
/// # Errors
/// [`Error::Identification`] if no cell of a kind can be solved.
pub fn identify(case: &TargetsCase, progress: &dyn Fn(Step)) -> Result<Identification, Error> {
    homogenization::identify::identify(&case.families, &case.targets, SEED, progress)
        .ok_or_else(|| Error::Identification { file: case.file.clone() })
}
