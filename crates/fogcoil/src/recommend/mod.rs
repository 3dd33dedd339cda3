//! `fogcoil recommend`: which chamber programme, or which further sensor, would tell mechanisms apart.

mod bench;
mod course;
mod programme;
mod question;
mod say;

use progress::Step;

use crate::Error;
use crate::cache::Cache;
use crate::input::{CoilCase, RecordCase};
use crate::prepare::{library, ready};

pub use bench::Odds;
pub(crate) use bench::{Contender, everything, odds, prepared, told_apart, usual};
pub use course::{Course, Trace};
pub use programme::{Limits, Programme, programmes};
pub(crate) use question::Question;
pub use say::{json, text};
pub(crate) use say::{number, sentence, with};

/// Finds what tells the mechanisms `between` apart; `records` of the unit, if there are any, give sizes, noise, and the test that is repeated.
///
/// # Errors
/// [`files::Error::Usage`] for ids that the design's library does not hold and for limits that leave nothing to vary; [`files::Error::Input`] for a record that
/// cannot be used; [`files::Error::Coil`] if the design cannot be modelled.
pub fn recommend(
    case: &CoilCase,
    between: &[String],
    records: &[RecordCase],
    limits: &Limits,
    cache: &Cache,
    progress: &(dyn Fn(Step) + Sync),
) -> Result<Recommendation, Error> {
    check(between, limits)?;
    let given = records.iter().map(|record| ready(record, &mut Vec::new())).collect::<Result<_, _>>()?;
    let question = Question { file: &case.file, between, records: given, limits: *limits, thorough: true };
    question.answer(library(case, cache, progress)?, progress)
}

/// Refuses what leaves nothing to tell apart.
fn check(between: &[String], limits: &Limits) -> Result<(), Error> {
    limits.check()?;
    if let Some((_, id)) = between.iter().enumerate().find(|(k, id)| between[..*k].contains(*id)) {
        return Err(Error::usage(format!("--between: {id} is given twice")));
    }
    if between.len() < 2 {
        return Err(Error::usage("--between: give two or more ids, separated by commas"));
    }
    Ok(())
}

/// A programme and what it tells.
#[derive(Debug, Clone)]
pub struct Ranked {
    /// The programme.
    pub programme: Programme,
    /// What it tells.
    pub odds: Odds,
}

/// A sensor added to a test.
#[derive(Debug, Clone)]
pub struct WithSensor {
    /// The sensor.
    pub sensor: String,
    /// The test.
    pub programme: String,
    /// What both tell.
    pub odds: Odds,
}

/// A size at which mechanisms are compared.
#[derive(Debug, Clone)]
pub struct Size {
    /// Mechanism.
    pub id: String,
    /// Names and values of its parameters, its choice first.
    pub values: Vec<(String, f64)>,
}

/// What to do next.
#[derive(Debug, Clone)]
pub struct Recommendation {
    /// Ids to be told apart.
    pub between: Vec<String>,
    /// Within these limits.
    pub limits: Limits,
    /// At these sizes.
    pub sizes: Vec<Size>,
    /// Whether the sizes and the noise were fitted to a record; else they are typical.
    pub fitted: bool,
    /// What is repeated for comparison, and what it tells in the same time.
    pub repeat: (String, Odds),
    /// Programmes, best first.
    pub profiles: Vec<Ranked>,
    /// Sensors, with the test that is repeated and with the best programme.
    pub sensors: Vec<WithSensor>,
    /// What the best programme is expected to show.
    pub course: Course,
}
