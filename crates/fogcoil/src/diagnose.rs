//! `fogcoil diagnose`: recordings of a unit in; what differs from its design, and what most likely causes it, out.

use std::fmt::Write;
use std::path::Path;

use coil::COARSE;
use diagnosis::{Diagnosis, ForwardModel, HeldOut, Observation, Settings, Verdict};
use mechanisms::{Gyro, Library, Prepared, RATE as RATE_CHANNEL};
use serde_json::{Value, json};

use crate::Error;
use crate::cache::Cache;
use crate::input::{CHAMBER, CoilCase, InputError, RATE, RecordCase, SPOOL};
use crate::table::{significant, table};

/// Fewest rows with a rate from which anything is said.
pub const FEWEST_ROWS: usize = 60;
/// Most rows of a record: beyond, neighbours say the same twice.
pub const MOST_ROWS: usize = 100_000;

/// A diagnosis with what it was made from.
pub struct Outcome {
    gyro: Gyro,
    diagnosis: Diagnosis,
    holdouts: Vec<Held>,
    notes: Vec<String>,
}

/// A record that was held out: what the nominal and the extended model predict of it.
struct Held {
    time: Vec<f64>,
    nominal: HeldOut,
    model: HeldOut,
    accepted: bool,
}

/// Diagnoses a unit of the design `case` from the records `fits`, judged on `holdouts`.
///
/// # Errors
/// [`Error::Input`] names the record that cannot be used and why; [`Error::Coil`] if the design cannot be modelled.
pub fn diagnose(
    case: &CoilCase,
    fits: &[RecordCase],
    holdouts: &[RecordCase],
    cache: &Cache,
    progress: &dyn Fn(&str),
) -> Result<Outcome, Error> {
    let coil = |source| Error::Coil { file: case.file.clone(), source };
    let mut notes = Vec::new();
    let records: Vec<Ready> = fits.iter().chain(holdouts).map(|record| ready(record, &mut notes)).collect::<Result<_, _>>()?;
    progress("modelling the coil and what its model may leave out (half a minute, once for a design)");
    let key = (&case.design, COARSE);
    let (library, _) = cache.load_or_build("library", &key, || Library::build(&case.design, |_| ())).map_err(coil)?;
    progress("running every model under the recorded chamber");
    let prepared = |r: &Ready| Prepared::new(&library, &r.observation.time, &r.chamber, r.averaging);
    let prepared = records.iter().map(prepared).collect::<Result<Vec<_>, _>>().map_err(coil)?;
    let gyro = Gyro::new(library, prepared).map_err(coil)?;
    let observations: Vec<Observation> = records.iter().map(|r| r.observation.clone()).collect();
    let numbers: Vec<usize> = (0..fits.len()).collect();
    let failed = |error: diagnosis::Error<coil::Error>| match error {
        diagnosis::Error::Model(source) => coil(source),
        other => Error::Diagnosis(other.to_string()),
    };
    let diagnosis =
        diagnosis::diagnose(&gyro, &numbers, &observations[..fits.len()], &Settings::default(), progress).map_err(failed)?;
    let best = &diagnosis.best().fit;
    let held = |n: usize| -> Result<Held, Error> {
        let observed = &observations[n];
        let model = best.hold_out(&gyro, n, observed, best).map_err(failed)?;
        let nominal = diagnosis.nominal.hold_out(&gyro, n, observed, best).map_err(failed)?;
        let accepted = model.rmse[RATE_CHANNEL] <= nominal.rmse[RATE_CHANNEL];
        Ok(Held { time: observed.time.clone(), nominal, model, accepted })
    };
    let holdouts = (fits.len()..observations.len()).map(held).collect::<Result<Vec<_>, _>>()?;
    Ok(Outcome { gyro, diagnosis, holdouts, notes })
}

/// A record as the engine wants it.
struct Ready {
    observation: Observation,
    chamber: Vec<f64>,
    averaging: f64,
}

fn refuse(case: &RecordCase, field: &str, problem: String, remedy: &str) -> Error {
    let file = case.fingerprint.file.clone();
    InputError { file, line: None, field: Some(field.to_owned()), problem, remedy: remedy.to_owned() }.into()
}

fn ready(case: &RecordCase, notes: &mut Vec<String>) -> Result<Ready, Error> {
    case.require_usable()?;
    let kept = case.kept();
    let rows = kept.time().len();
    if rows > MOST_ROWS {
        return Err(refuse(case, "time_s", format!("{rows} rows are more than {MOST_ROWS}"), "give means over longer intervals"));
    }
    let used = |name: &str| -> Option<Vec<f64>> {
        let number = case.number(name)?;
        let values = &kept.channels()[number].values;
        let mask = case.report.masks.get(number)?;
        Some(values.iter().zip(mask).map(|(v, used)| if *used { *v } else { f64::NAN }).collect())
    };
    let missing = || refuse(case, CHAMBER, "there is no chamber temperature to drive the model with".into(), "add the column");
    let mut chamber = used(CHAMBER).ok_or_else(missing)?;
    if !bridge(kept.time(), &mut chamber) {
        return Err(missing());
    }
    let nothing = || vec![f64::NAN; rows];
    let rate = used(RATE).unwrap_or_else(nothing);
    let count = rate.iter().filter(|r| r.is_finite()).count();
    if count < FEWEST_ROWS {
        let problem = format!("{count} rows with a rate are too few to tell anything");
        return Err(refuse(case, RATE, problem, "record at least an hour, with ramps"));
    }
    let spool = used(SPOOL).unwrap_or_else(|| {
        notes.push(format!(
            "{}: no spool_c: heat paths and the thermometer cannot be told apart",
            case.fingerprint.file.display()
        ));
        nothing()
    });
    let observation = Observation { time: kept.time().to_vec(), channels: vec![spool, rate] };
    Ok(Ready { observation, chamber, averaging: case.averaging })
}

/// Fills gaps on straight lines; false if there is nothing to draw them through.
fn bridge(time: &[f64], values: &mut [f64]) -> bool {
    let known: Vec<usize> = (0..values.len()).filter(|&n| values[n].is_finite()).collect();
    let (Some(&first), Some(&last)) = (known.first(), known.last()) else { return false };
    for n in 0..values.len() {
        if !values[n].is_finite() {
            let at = known.partition_point(|k| *k < n);
            values[n] = match (at.checked_sub(1).map(|k| known[k]), known.get(at)) {
                (Some(a), Some(&b)) => values[a] + (values[b] - values[a]) * (time[n] - time[a]) / (time[b] - time[a]),
                (Some(_), None) => values[last],
                _ => values[first],
            };
        }
    }
    true
}

/// The verdict's name.
fn name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::None => "none",
        Verdict::Recalibrate => "recalibrate",
        Verdict::Explained => "explained",
        Verdict::Unknown => "unknown",
    }
}

impl Outcome {
    fn id(&self, mechanism: usize) -> &str {
        &self.gyro.mechanisms()[mechanism].id
    }

    /// Probabilities worth saying.
    fn likely(&self) -> impl Iterator<Item = (&str, f64)> {
        self.diagnosis.mechanisms.iter().filter(|(_, p)| *p >= 5e-4).map(|(m, p)| (self.id(*m), *p))
    }

    /// What the residual looks like where nothing explains it.
    fn structure(&self) -> Option<String> {
        let rival = self.diagnosis.best().rival.as_ref()?;
        let channel = &self.gyro.channels()[rival.channel].name;
        let at = rival.at.map_or(String::new(), |at| format!(", {at:.3}"));
        Some(format!("what is left in {channel} is {}{at}", rival.structure.describe()))
    }

    /// One object, as scripts read it.
    pub fn json(&self) -> Value {
        let d = &self.diagnosis;
        let explained = d.verdict == Verdict::Explained;
        let mechanisms: Vec<Value> = self.likely().map(|(id, p)| json!({"id": id, "probability": p})).collect();
        let set: Vec<&str> = d.set.iter().map(|m| self.id(*m)).collect();
        let mut parameters = serde_json::Map::new();
        for estimate in d.parameters.iter().flatten().filter(|_| explained) {
            parameters.insert(estimate.name.clone(), json!({"value": estimate.value, "ci90": estimate.ci90}));
        }
        let located = d.best().fit.active.first().filter(|_| explained).map(|active| {
            let place = self.gyro.located(active);
            json!({"stage": place.stage, "temperature_c": place.temperature, "time_s": place.time, "layers": place.layers})
        });
        let held = self.holdouts.first().map(|held| {
            let of = |h: &HeldOut| h.rmse[RATE_CHANNEL];
            let floor = held.model.noise_floor[RATE_CHANNEL];
            json!({"rmse_nominal": of(&held.nominal), "rmse_model": of(&held.model), "noise_floor": floor, "accepted": held.accepted})
        });
        let nowhere = json!({"stage": null, "temperature_c": null, "time_s": null, "layers": null});
        json!({
            "verdict": name(d.verdict),
            "mechanisms": mechanisms,
            "set": set,
            "parameters": parameters,
            "located": located.unwrap_or(nowhere),
            "structure": self.structure(),
            "holdout": held,
        })
    }

    /// What the accepted model predicts of the first record that was held out, `time_s,rate_deg_per_h`; `None` if there is none.
    ///
    /// A model that predicts it worse than the nominal one is not accepted: then the nominal prediction is given.
    pub fn prediction(&self) -> Option<String> {
        let held = self.holdouts.first()?;
        let chosen = if held.accepted { &held.model } else { &held.nominal };
        let mut text = "time_s,rate_deg_per_h\n".to_owned();
        for (t, rate) in held.time.iter().zip(&chosen.prediction[RATE_CHANNEL]) {
            let _ = writeln!(text, "{t},{rate}");
        }
        Some(text)
    }

    /// What a user should know besides.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// For people.
    pub fn text(&self) -> String {
        let d = &self.diagnosis;
        let mut out = match d.verdict {
            Verdict::None => "The nominal model suffices: no difference beyond noise.\n".to_owned(),
            Verdict::Recalibrate => "The design's own constants, re-estimated within their uncertainties, suffice.\n".to_owned(),
            Verdict::Explained => {
                format!("The recording differs from the design. Most likely: {}.\n", self.names().join(" and "))
            }
            Verdict::Unknown => {
                "The recording differs from the design in a way that nothing in the library explains.\n".to_owned()
            }
        };
        if let Some(structure) = self.structure().filter(|_| d.verdict == Verdict::Unknown) {
            let _ = writeln!(out, "{structure}.");
        }
        if d.set.len() > 1 {
            let others: Vec<&str> = d.set.iter().map(|m| self.id(*m)).collect();
            let _ = writeln!(out, "Not excluded by this recording: {}.", others.join(", "));
        }
        let mut rows = vec![vec!["mechanism".to_owned(), "probability".to_owned(), String::new()]];
        rows.extend(self.likely().take(6).map(|(id, p)| vec![id.to_owned(), format!("{p:.3}"), String::new()]));
        if d.verdict == Verdict::Explained {
            rows.push(vec!["parameter (fitted)".to_owned(), "value".to_owned(), "90 % interval".to_owned()]);
            for estimate in d.parameters.iter().flatten() {
                let interval = estimate.ci90.map(|end| significant(end, 4)).join(" to ");
                rows.push(vec![estimate.name.clone(), significant(estimate.value, 4), interval]);
            }
        }
        for (n, held) in self.holdouts.iter().enumerate() {
            rows.push(vec![format!("held-out record {}", n + 1), "rms, deg/h".to_owned(), String::new()]);
            let floor = held.model.noise_floor[RATE_CHANNEL];
            for (name, value) in [
                ("  nominal model", held.nominal.rmse[RATE_CHANNEL]),
                ("  extended model", held.model.rmse[RATE_CHANNEL]),
                ("  noise as identified", floor),
            ] {
                rows.push(vec![name.to_owned(), significant(value, 3), String::new()]);
            }
            if !held.accepted {
                rows.push(vec!["  the extended model is worse here: not accepted".to_owned(), String::new(), String::new()]);
            }
        }
        out.push_str(&table(&rows));
        out
    }

    fn names(&self) -> Vec<&str> {
        self.diagnosis.best().fit.active.iter().map(|a| self.id(a.mechanism)).collect()
    }
}

/// Refuses a design that the library cannot be made for.
///
/// # Errors
/// [`Error::Input`] for a coil file whose own mechanics changes with temperature or time.
pub fn check_design(case: &CoilCase, file: &Path) -> Result<(), Error> {
    if case.design.mechanics == coil::Mechanics::Elastic {
        return Ok(());
    }
    let problem =
        "a design whose mechanics changes is not diagnosed: its own changes would hide those that are sought".to_owned();
    let remedy = "set it to Elastic, the nominal design".to_owned();
    Err(InputError { file: file.to_owned(), line: None, field: Some("mechanics".into()), problem, remedy }.into())
}
