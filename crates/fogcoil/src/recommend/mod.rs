//! `fogcoil recommend`: which chamber programme, or which further sensor, would tell mechanisms apart.

mod bench;
mod inspection;
mod programme;
mod say;

use diagnosis::{Active, ForwardModel, Observation, Plan, fitted};
use mechanisms::{Gyro, Prepared, RATE, SPOOL};
use recording::noise::NoiseModel;

use crate::Error;
use crate::cache::Cache;
use crate::diagnose::{Ready, library, ready};
use crate::input::{CoilCase, RecordCase};

pub use bench::Odds;
pub(crate) use bench::{Contender, everything, odds, prepared, told_apart, usual};
pub(crate) use inspection::inspection;
pub use programme::{Limits, Programme, programmes};
pub use say::{json, text};

/// Noise of a spool thermometer that may be added \[K\], its drift a tenth of the usual.
const FINE_K: f64 = 0.001;
const FINE_DRIFT: f64 = 0.1;

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
}

/// The test that is repeated for comparison.
struct Repeat {
    name: String,
    records: Vec<usize>,
    instants: Vec<Observation>,
    noise: [NoiseModel; 2],
    /// how often it fits into the time of the others
    times: f64,
}

/// Finds what tells the mechanisms `between` apart; `records` of the unit, if there are any, give sizes, noise, and the test that is repeated.
///
/// # Errors
/// [`Error::Usage`] for ids that the design's library does not hold and for limits that leave nothing to vary; [`Error::Input`] for a record that
/// cannot be used; [`Error::Coil`] if the design cannot be modelled.
pub fn recommend(
    case: &CoilCase,
    between: &[String],
    records: &[RecordCase],
    limits: &Limits,
    cache: &Cache,
    progress: &dyn Fn(&str),
) -> Result<Recommendation, Error> {
    limits.check()?;
    check_ids(between)?;
    let coil = |source| Error::Coil { file: case.file.clone(), source };
    let failed = |error: diagnosis::Error<coil::Error>| match error {
        diagnosis::Error::Model(source) => coil(source),
        other => Error::Diagnosis(other.to_string()),
    };
    let given: Vec<Ready> = records.iter().map(|record| ready(record, &mut Vec::new())).collect::<Result<_, _>>()?;
    progress("modelling the coil and what its model may leave out (half a minute, once for a design)");
    let library = library(case, cache)?;
    let programmes = programmes(limits);
    progress("running every model under every programme");
    let recorded = given.iter().map(|r| Prepared::new(&library, &r.observation.time, &r.chamber, r.averaging));
    let all = recorded.chain(programmes.iter().map(|programme| prepared(&library, programme)));
    let all = all.collect::<Result<Vec<_>, _>>().map_err(coil)?;
    let gyro = Gyro::new(library, all).map_err(coil)?;
    let mut contenders = contenders(&gyro, between, failed)?;
    let observations: Vec<Observation> = given.into_iter().map(|r| r.observation).collect();
    let recorded = observations.len();
    let mut noise = None;
    if recorded > 0 {
        progress("fitting each of them to the record");
        noise = Some(fit(&gyro, &observations, &mut contenders).map_err(failed)?);
    }
    let proposed_noise = noise.map_or_else(|| usual(&gyro), |[spool, rate]| [spool, over(&rate, bench::INTERVAL)]);
    let told = |records: &[usize], instants: &[Observation], noise: &[NoiseModel]| {
        odds(&gyro, &contenders, &Plan { records, instants, noise: Some(noise) }).map_err(failed)
    };
    let mut profiles = Vec::new();
    for (k, programme) in programmes.iter().enumerate() {
        progress(&format!("{} ({} of {})", programme.name, k + 1, programmes.len()));
        let odds = told(&[recorded + k], &[everything(programme)], &proposed_noise)?;
        profiles.push((recorded + k, Ranked { programme: programme.clone(), odds }));
    }
    profiles.sort_by(|a, b| b.1.odds.log_odds.total_cmp(&a.1.odds.log_odds));
    let repeat = match noise {
        Some(noise) => {
            let span: f64 = observations.iter().map(|o| o.time[o.time.len() - 1] - o.time[0]).sum();
            let (records, times) = ((0..recorded).collect(), limits.hours * 3600.0 / span);
            Repeat { name: "the recorded test".into(), records, instants: observations, noise, times }
        }
        None => {
            let (name, instants) = (programmes[0].name.clone(), vec![everything(&programmes[0])]);
            Repeat { name, records: vec![recorded], instants, noise: proposed_noise, times: 1.0 }
        }
    };
    // a repeat tells as much again in as much time again
    let again = |odds: Odds| Odds { sigma: odds.sigma * repeat.times.sqrt(), log_odds: odds.log_odds * repeat.times, ..odds };
    let as_it_was = again(told(&repeat.records, &repeat.instants, &repeat.noise)?);
    progress("further sensors");
    let sensor = format!("a spool thermometer of {FINE_K} K");
    let (number, best) = (profiles[0].0, &profiles[0].1.programme);
    let finer_repeat = again(told(&repeat.records, &whole_spool(repeat.instants.clone()), &finer(repeat.noise))?);
    let finer_best = told(&[number], &[everything(best)], &finer(proposed_noise))?;
    let sensors = vec![
        WithSensor { sensor: sensor.clone(), programme: repeat.name.clone(), odds: finer_repeat },
        WithSensor { sensor, programme: best.name.clone(), odds: finer_best },
    ];
    Ok(Recommendation {
        between: between.to_vec(),
        limits: *limits,
        sizes: contenders.iter().filter_map(|c| c.truth.as_ref()).map(|active| size(&gyro, active)).collect(),
        fitted: recorded > 0,
        repeat: (repeat.name, as_it_was),
        profiles: profiles.into_iter().map(|(_, ranked)| ranked).collect(),
        sensors,
    })
}

fn check_ids(between: &[String]) -> Result<(), Error> {
    if let Some((_, id)) = between.iter().enumerate().find(|(k, id)| between[..*k].contains(*id)) {
        return Err(Error::Usage(format!("--between: {id} is given twice")));
    }
    if between.len() < 2 {
        return Err(Error::Usage("--between: give two or more ids, separated by commas".into()));
    }
    Ok(())
}

fn contenders(
    gyro: &Gyro,
    between: &[String],
    failed: impl Fn(diagnosis::Error<coil::Error>) -> Error,
) -> Result<Vec<Contender>, Error> {
    let mut contenders = Vec::with_capacity(between.len());
    for id in between {
        let Some(contender) = Contender::named(gyro, id).map_err(&failed)? else {
            let known = Contender::known(gyro);
            return Err(Error::Usage(format!("--between: `{id}` is not in this design's library; it holds {known}")));
        };
        contenders.push(contender);
    }
    if contenders.iter().all(|c| c.truth.is_none()) {
        return Err(Error::Usage("--between: one of the ids must be a mechanism's".into()));
    }
    Ok(contenders)
}

/// Gives the contenders the sizes that fit records best, and returns the noise beside the best of them.
fn fit(
    gyro: &Gyro,
    observations: &[Observation],
    contenders: &mut [Contender],
) -> Result<[NoiseModel; 2], diagnosis::Error<coil::Error>> {
    let records: Vec<usize> = (0..observations.len()).collect();
    let (mut noise, mut most) = (usual(gyro), f64::NEG_INFINITY);
    for contender in contenders {
        let fit = fitted(gyro, &records, observations, &contender.hypotheses)?;
        contender.truth = fit.active.first().cloned();
        if fit.log_evidence > most {
            most = fit.log_evidence;
            noise = [SPOOL, RATE].map(|channel| *fit.noise_model(0, channel));
        }
    }
    Ok(noise)
}

fn size(gyro: &Gyro, active: &Active) -> Size {
    let entry = &gyro.mechanisms()[active.mechanism];
    let choice = entry.choice.iter().zip(active.choice).map(|((name, _), value)| (name.clone(), value));
    let parameters = entry.parameters.iter().zip(&active.values).map(|(p, value)| (p.name.clone(), *value));
    Size { id: entry.id.clone(), values: choice.chain(parameters).collect() }
}

/// The same instants with a spool thermometer that reads at each of them.
fn whole_spool(mut instants: Vec<Observation>) -> Vec<Observation> {
    instants.iter_mut().for_each(|o| o.channels[SPOOL] = vec![0.0; o.time.len()]);
    instants
}

fn finer([spool, rate]: [NoiseModel; 2]) -> [NoiseModel; 2] {
    [NoiseModel { white: FINE_K.min(spool.white), drift: FINE_DRIFT * spool.drift, ..spool }, rate]
}

/// The noise of means over another span.
fn over(noise: &NoiseModel, averaging: f64) -> NoiseModel {
    let share = if noise.averaging > 0.0 { (noise.averaging / averaging).sqrt() } else { 1.0 };
    NoiseModel { averaging, white: noise.white * share, ..*noise }
}
