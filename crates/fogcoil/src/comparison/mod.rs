//! The library's mechanisms as pictures and tables: the changes by each, and the rivals that it is mistaken for.

mod confusion;
mod signature;
mod text;
mod trial;

use std::collections::BTreeMap;

use diagnosis::{Active, ForwardModel, Plan, Prior, expected, separation};
use mechanisms::{CATALOGUE, Gyro, Instruments, Library, Mechanism, ON_REQUEST, Prepared, RATE, SPOOL};
use progress::Step;

use crate::Error;
use crate::cache::Cache;
use crate::input::CoilCase;
use crate::prepare::library;
use crate::recommend::{Contender, Limits, Programme, everything, prepared, programmes, usual};

pub(crate) use signature::{CHANNELS, chamber};
pub use trial::Trial;

/// Separation of a truth from a rival by a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told {
    /// Distance in standard deviations of the noise, priors included.
    pub sigma: f64,
    /// Expected ln of the odds for the truth.
    pub log_odds: f64,
}

/// A parameter of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct TypicalParameter {
    /// Name with its unit.
    pub name: String,
    /// Prior knowledge of it; `None` of a choice, of which every value is as likely.
    pub prior: Option<Prior>,
    /// A size that is neither small nor large.
    pub typical: f64,
}

/// A mechanism.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Its id.
    pub id: String,
    /// Stage of the chain where it acts.
    pub stage: String,
    /// Its parameters, its choice first.
    pub parameters: Vec<TypicalParameter>,
    /// Its changes in each of [`Comparison::programmes`] at its typical size: spool temperature \[K\] and rate \[deg/h\].
    pub(crate) changes: Vec<[Vec<f64>; 2]>,
}

/// Changes by the mechanisms of a design, without their comparison.
pub(crate) struct Responses {
    /// The mechanisms.
    pub(crate) entries: Vec<Entry>,
    pub(crate) programmes: Vec<Programme>,
    gyro: Gyro<'static>,
    contenders: Vec<Contender>,
    truths: Vec<Active>,
}

/// All named mechanisms of a design.
pub struct Comparison {
    /// Name of the design.
    pub design: String,
    /// The mechanisms.
    pub entries: Vec<Entry>,
    /// One programme of each family, the slow ramp first, the fast one second.
    pub programmes: Vec<Programme>,
    /// Ids of the rivals: the mechanisms, the recalibrated design, and the nominal one, which tells whether anything is seen.
    pub rivals: Vec<String>,
    /// `[programme][truth][rival]`; `None` of a mechanism against itself.
    pub told: Vec<Vec<Vec<Option<Told>>>>,
}

impl Comparison {
    /// Measures every mechanism of a design against every other one.
    ///
    /// # Errors
    /// [`files::Error::Coil`] if the design cannot be modelled.
    pub fn measure(case: &CoilCase, cache: &Cache, progress: &dyn Fn(Step)) -> Result<Self, Error> {
        Self::among(case, Responses::of(case, cache)?, progress)
    }

    /// The same for mechanisms that are weighed on request, against all.
    ///
    /// # Errors
    /// As [`Self::measure`].
    pub fn on_request(case: &CoilCase, cache: &Cache, progress: &dyn Fn(Step)) -> Result<Self, Error> {
        let all = Responses::among(case, cache, &[CATALOGUE, ON_REQUEST].concat())?;
        let asked = |id: &str| ON_REQUEST.iter().any(|mechanism| mechanism.facts().id == id);
        Self::among(case, all.only(asked), progress)
    }

    /// The same for the mechanisms that are chosen by their ids, against all.
    ///
    /// # Errors
    /// As [`Self::measure`].
    pub fn only(case: &CoilCase, chosen: impl Fn(&str) -> bool, cache: &Cache, progress: &dyn Fn(Step)) -> Result<Self, Error> {
        Self::among(case, Responses::of(case, cache)?.only(chosen), progress)
    }

    fn among(case: &CoilCase, responses: Responses, progress: &dyn Fn(Step)) -> Result<Self, Error> {
        let Responses { entries, programmes, gyro, mut contenders, truths } = responses;
        let failed = Error::of_diagnosis(&case.file);
        contenders.push(Contender::recalibrated());
        contenders.extend(Contender::named(&gyro, "nominal").map_err(failed)?);
        let noise = usual(&gyro);
        let mut told = Vec::with_capacity(programmes.len());
        for (k, programme) in programmes.iter().enumerate() {
            let plan = Plan { records: &[k], instants: &[everything(programme)], noise: Some(&noise) };
            let mut of_programme = Vec::with_capacity(truths.len());
            for truth in &truths {
                let id = &gyro.mechanisms()[truth.mechanism].id;
                progress(Step::begins(&format!("{}: {id}", programme.family)));
                let against = |rival: &Contender| -> Result<Option<Told>, Error> {
                    if rival.id == *id {
                        return Ok(None);
                    }
                    let found = separation(&gyro, &plan, std::slice::from_ref(truth), &rival.hypotheses).map_err(failed)?;
                    Ok(Some(Told { sigma: found.sigma(), log_odds: found.log_odds() }))
                };
                of_programme.push(contenders.iter().map(against).collect::<Result<Vec<_>, _>>()?);
            }
            told.push(of_programme);
        }
        let rivals = contenders.into_iter().map(|c| c.id).collect();
        Ok(Self { design: case.name.clone(), entries, programmes, rivals, told })
    }
}

impl Responses {
    /// Those of the mechanisms that are chosen by their ids.
    fn only(mut self, chosen: impl Fn(&str) -> bool) -> Self {
        self.entries.retain(|entry| chosen(&entry.id));
        let gyro = &self.gyro;
        self.truths.retain(|truth| chosen(&gyro.mechanisms()[truth.mechanism].id));
        self
    }

    /// Runs every named mechanism at its typical size.
    pub(crate) fn of(case: &CoilCase, cache: &Cache) -> Result<Self, Error> {
        Self::among(case, cache, CATALOGUE)
    }

    fn among(case: &CoilCase, cache: &Cache, mechanisms: &[&'static dyn Mechanism]) -> Result<Self, Error> {
        let coil = Error::of_coil(&case.file);
        let library = library(case, cache, &|_| ())?;
        let mut programmes = programmes(&Limits::USUAL);
        programmes.dedup_by_key(|programme| programme.family);
        let records = programmes.iter().map(|p| recorded(&library, p)).collect::<Result<Vec<_>, _>>().map_err(coil)?;
        let (all, told) = (records.len(), Instruments { earth: Some(EARTH), ..Instruments::default() });
        let gyro = Gyro::fitted_to(library, mechanisms, records, all, &told).map_err(coil)?;
        let named = gyro.mechanisms().iter().filter(|mechanism| mechanism.named);
        let contenders = named.filter_map(|mechanism| Contender::named(&gyro, &mechanism.id).transpose());
        let contenders = contenders.collect::<Result<Vec<_>, _>>().map_err(Error::of_diagnosis(&case.file))?;
        let truths: Vec<Active> = contenders.iter().filter_map(|c| c.truth.clone()).collect();
        let entries = truths.iter().map(|truth| entry(&gyro, truth, programmes.len())).collect::<Result<_, _>>().map_err(coil)?;
        Ok(Self { entries, programmes, gyro, contenders, truths })
    }
}

/// Earth's rate about a vertical axis at 40 degrees of latitude \[deg/h\].
const EARTH: f64 = 9.67;
/// Humidity in a programme's first third and after it \[%\].
const HUMIDITY: [f64; 2] = [50.0, 10.0];
/// A field of the Earth's size \[µT\], and how long it has one direction \[s\].
const FIELD: (f64, f64) = (50.0, 7200.0);

/// A programme's record, with the further columns that mechanisms see: a humidity that is stepped once, a field that is turned again and again.
fn recorded(library: &Library, programme: &Programme) -> Result<Prepared, coil::Error> {
    let prepared = prepared(library, programme)?;
    let time = prepared.time();
    let humidity = time.iter().map(|t| HUMIDITY[usize::from(3.0 * t > programme.duration())]).collect();
    let field = time.iter().map(|t| if (t / FIELD.1).floor() % 2.0 == 0.0 { FIELD.0 } else { -FIELD.0 }).collect();
    let columns = BTreeMap::from([("humidity_percent".to_owned(), humidity), ("field_ut".to_owned(), field)]);
    Ok(prepared.with_columns(columns))
}

fn entry(gyro: &Gyro, truth: &Active, programmes: usize) -> Result<Entry, coil::Error> {
    let mechanism = &gyro.mechanisms()[truth.mechanism];
    let choice = mechanism.choice.iter().zip(truth.choice);
    let choice = choice.map(|((name, _), typical)| TypicalParameter { name: name.clone(), prior: None, typical });
    let of = |(p, v): (&diagnosis::Parameter, &f64)| TypicalParameter { name: p.name.clone(), prior: Some(p.prior), typical: *v };
    let parameters = choice.chain(mechanism.parameters.iter().zip(&truth.values).map(of)).collect();
    let middle = expected(gyro.nuisances());
    let change = |record: usize| -> Result<[Vec<f64>; 2], coil::Error> {
        let (with, without) = (gyro.respond(record, &middle, std::slice::from_ref(truth))?, gyro.respond(record, &middle, &[])?);
        Ok([SPOOL, RATE].map(|c: usize| with[c].iter().zip(&without[c]).map(|(a, b)| a - b).collect()))
    };
    let changes = (0..programmes).map(change).collect::<Result<_, _>>()?;
    Ok(Entry { id: mechanism.id.clone(), stage: mechanism.stage.clone(), parameters, changes })
}
