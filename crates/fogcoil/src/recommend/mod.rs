//! `fogcoil recommend`: the chamber programme, or the further sensor, that would tell mechanisms apart.

mod bench;
mod course;
mod no_place;
mod picture;
mod programme;
mod question;
mod recommendation;
mod say;

use mechanisms::Mechanism;
use progress::Step;

use crate::Error;
use crate::cache::Cache;
use crate::contradictions::contradictions;
use crate::input::{CoilCase, RecordCase};
use crate::prepare::{library, other_design, ready};
use files::Note;

pub use bench::Odds;
pub(crate) use bench::{Contender, everything, odds, prepared, told_apart, usual};
pub use course::{Course, Trace};
pub(crate) use picture::figure;
pub use picture::svg;
pub use programme::{Limits, Programme, programmes};
pub(crate) use question::Question;
pub use recommendation::{Ranked, Recommendation, Size, WithSensor};
pub use say::{caveat, json, text};
pub(crate) use say::{number, sentence, with};

/// Notes against the use of sizes and noise from some records: units of another design, meta files that their records contradict.
pub fn notes(case: &CoilCase, records: &[RecordCase]) -> Vec<Note> {
    records.iter().flat_map(|record| other_design(case, record).into_iter().chain(contradictions(record))).collect()
}

/// Finds the test that tells the mechanisms `between` apart; `records` of the unit, if there are any, give sizes, noise, and the test that is repeated.
///
/// # Errors
/// [`files::Error::Usage`] for ids that the design's library does not hold and for limits that leave nothing to vary; [`files::Error::Input`] for a record that
/// cannot be used; [`files::Error::Coil`] if the design cannot be modelled.
pub fn recommend(
    case: &CoilCase,
    mechanisms: &[&dyn Mechanism],
    between: &[String],
    records: &[RecordCase],
    limits: &Limits,
    cache: &Cache,
    progress: &(dyn Fn(Step) + Sync),
) -> Result<Recommendation, Error> {
    question::check(between, limits)?;
    let given = records.iter().map(|record| ready(record, &mut Vec::new())).collect::<Result<_, _>>()?;
    let question = Question { file: &case.file, mechanisms, between, records: given, limits: *limits, thorough: true };
    question.answer(library(case, cache, progress)?, progress)
}
