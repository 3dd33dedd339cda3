//! A question about a design, and its answer.

use std::path::Path;

use diagnosis::{Active, ForwardModel, Observation, Plan, fitted};
use mechanisms::{Gyro, Library, Mechanism, RATE, SPOOL};
use progress::Step;
use recording::noise::NoiseModel;

use super::bench::{self, Contender, Failure, Odds, everything, odds, prepared, usual};
use super::course::Course;
use super::no_place::not_there;
use super::programme::{Limits, programmes};
use super::recommendation::{Ranked, Recommendation, Size, WithSensor};
use crate::Error;
use crate::prepare::Record;

/// Noise of a spool thermometer that may be added \[K\], its drift a tenth of the usual.
const FINE_K: f64 = 0.001;
const FINE_DRIFT: f64 = 0.1;

/// The test that is repeated for comparison.
struct Repeat {
    name: String,
    records: Vec<usize>,
    instants: Vec<Observation>,
    noise: [NoiseModel; 2],
    /// number of times that it fits into the time of the others
    times: f64,
}

pub(crate) struct Question<'a> {
    pub(crate) file: &'a Path,
    /// all that there are
    pub(crate) mechanisms: &'a [&'a dyn Mechanism],
    pub(crate) between: &'a [String],
    pub(crate) records: Vec<Record>,
    pub(crate) limits: Limits,
    /// Whether all results are asked for; else a programme is no longer computed once it is known not to be the best, and sensors are left out where a
    /// programme decides.
    pub(crate) thorough: bool,
}

impl Question<'_> {
    pub(crate) fn answer(self, library: Library, progress: &dyn Fn(Step)) -> Result<Recommendation, Error> {
        let Self { file, mechanisms, between, records: given, limits, thorough } = self;
        check(between, &limits)?;
        let asked: Vec<&dyn Mechanism> =
            mechanisms.iter().copied().filter(|m| between.iter().any(|id| id == m.facts().id)).collect();
        if let Some((id, column)) = asked.iter().find_map(|m| Some((m.facts().id, *m.columns().first()?))) {
            let text = format!(
                "--between: the law of `{id}` names the column {column}, which no programme of the chamber tells; leave it out of --between"
            );
            return Err(Error::usage(text));
        }
        let coil = Error::of_coil(file);
        let failed = &Error::of_diagnosis_with(file, mechanisms);
        let programmes = programmes(&limits);
        progress(Step::begins("running every model under every programme"));
        let recorded = given.iter().map(|record| record.prepared(&library));
        let all = recorded.chain(programmes.iter().map(|programme| prepared(&library, programme)));
        let all = all.collect::<Result<Vec<_>, _>>().map_err(coil)?;
        let gyro = Gyro::new(library, mechanisms, all).map_err(coil)?;
        let named = |id: &String| {
            let unknown = || Error::usage(not_there(id, &gyro, mechanisms));
            Contender::named(&gyro, id).map_err(failed)?.ok_or_else(unknown)
        };
        let mut contenders = between.iter().map(named).collect::<Result<Vec<_>, _>>()?;
        if contenders.iter().all(|c| c.truth.is_none()) {
            return Err(Error::usage("--between: one of the ids must be a mechanism's"));
        }
        let observations: Vec<Observation> = given.into_iter().map(|r| r.observed).collect();
        let recorded = observations.len();
        let mut noise = None;
        if recorded > 0 {
            progress(Step::begins("fitting each of them to the record"));
            noise = Some(fit(&gyro, &observations, &mut contenders).map_err(failed)?);
        }
        let proposed_noise = noise.map_or_else(|| usual(&gyro), |[spool, rate]| [spool, over(&rate, bench::INTERVAL)]);
        let told = |records: &[usize], instants: &[Observation], noise: &[NoiseModel]| {
            odds(&gyro, &contenders, &Plan { records, instants, noise: Some(noise) }).map_err(failed)
        };
        let planned = |k: usize| ([recorded + k], [everything(&programmes[k])]);
        let mut order: Vec<(usize, Option<Odds>)> = (0..programmes.len()).map(|k| (k, None)).collect();
        if !thorough {
            let narrow: Vec<Contender> = contenders.iter().map(Contender::narrowed).collect();
            for (k, bound) in &mut order {
                let (records, instants) = planned(*k);
                let plan = Plan { records: &records, instants: &instants, noise: Some(&proposed_noise) };
                *bound = Some(odds(&gyro, &narrow, &plan).map_err(failed)?);
            }
            let height = |bound: &Option<Odds>| bound.as_ref().map_or(0.0, |b| b.log_odds);
            order.sort_by(|a, b| height(&b.1).total_cmp(&height(&a.1)));
        }
        let (mut profiles, mut most) = (Vec::new(), f64::NEG_INFINITY);
        for (n, (k, bound)) in order.into_iter().enumerate() {
            progress(Step::counted(&programmes[k].name, n + 1, programmes.len()));
            let (records, instants) = planned(k);
            let odds = match bound {
                Some(bound) if bound.log_odds < most => bound,
                _ => told(&records, &instants, &proposed_noise)?,
            };
            most = most.max(odds.log_odds);
            profiles.push((recorded + k, Ranked { programme: programmes[k].clone(), odds }));
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
        let as_it_was = told(&repeat.records, &repeat.instants, &repeated(repeat.noise, repeat.times))?;
        let (number, best) = (profiles[0].0, &profiles[0].1.programme);
        let mut sensors = Vec::new();
        if thorough || !profiles[0].1.odds.decides() {
            progress(Step::begins("further sensors"));
            let sensor = format!("a spool thermometer of {FINE_K} K");
            let noise = repeated(finer(repeat.noise), repeat.times);
            let finer_repeat = told(&repeat.records, &whole_spool(repeat.instants.clone()), &noise)?;
            let finer_best = told(&[number], &[everything(best)], &finer(proposed_noise))?;
            sensors.push(WithSensor { sensor: sensor.clone(), programme: repeat.name.clone(), odds: finer_repeat });
            sensors.push(WithSensor { sensor, programme: best.name.clone(), odds: finer_best });
        }
        let plan = Plan { records: &[number], instants: &[everything(best)], noise: Some(&proposed_noise) };
        let course = Course::new(&gyro, &contenders, &profiles[0].1.odds, (number, best), &plan).map_err(failed)?;
        let inspection = |m: &&dyn Mechanism| Some((m.facts().id.to_owned(), m.facts().inspection()?.to_owned()));
        let ordered = between.iter().filter_map(|id| asked.iter().find(|m| m.facts().id == id));
        Ok(Recommendation {
            between: between.to_vec(),
            inspections: ordered.filter_map(inspection).collect(),
            limits,
            sizes: contenders.iter().filter_map(|c| c.truth.as_ref()).map(|active| size(&gyro, active)).collect(),
            fitted: recorded > 0,
            repeat: (repeat.name, as_it_was),
            profiles: profiles.into_iter().map(|(_, ranked)| ranked).collect(),
            sensors,
            course,
        })
    }
}

/// Gives the contenders the sizes that fit records best, and returns the noise beside the best of them.
fn fit(gyro: &Gyro, observations: &[Observation], contenders: &mut [Contender]) -> Result<[NoiseModel; 2], Failure> {
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

/// Noise of one record that tells as much as `times` of the kind, or as a part of one: of the same unit, so that their constants are one. What is no
/// other in the next record, the model's own error, stays.
fn repeated(noise: [NoiseModel; 2], times: f64) -> [NoiseModel; 2] {
    let root = times.sqrt();
    noise.map(|n| NoiseModel { white: n.white / root, drift: n.drift / root, walk: n.walk / root, ..n })
}

/// The noise of means over another span.
fn over(noise: &NoiseModel, averaging: f64) -> NoiseModel {
    let share = if noise.averaging > 0.0 { (noise.averaging / averaging).sqrt() } else { 1.0 };
    NoiseModel { averaging, white: noise.white * share, ..*noise }
}

/// Refuses a question that leaves nothing to tell apart.
pub(super) fn check(between: &[String], limits: &Limits) -> Result<(), Error> {
    limits.check()?;
    if let Some((_, id)) = between.iter().enumerate().find(|(k, id)| between[..*k].contains(*id)) {
        return Err(Error::usage(format!("--between: {id} is given twice")));
    }
    if between.len() < 2 {
        return Err(Error::usage("--between: give two or more ids, separated by commas"));
    }
    Ok(())
}
