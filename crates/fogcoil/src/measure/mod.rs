//! `fogcoil measure`: a recording's figures as specifications of gyroscopes state them, each with a 90 % interval (terms of IEEE Std 952-1997).
//!
//! Sensitivity to the temperature's rate, hysteresis, bias over temperature and peak are [`recording::ramp`]'s, driven by the chamber (by the spool where
//! the chamber was not recorded), the bias over temperature by the spool. Angle random walk and bias instability are those of
//! [`crate::check`]. Beside them stands the steady sensitivity of a design, with what its tolerances make of it.

mod figure;
mod json;
mod noise;
mod prediction;
mod text;

use bias::units::S_PER_MIN;
use files::{Note, Remark};
use recording::check::Unit;
use recording::condition::{Thinned, Thinning, bridged, thinned};
use recording::ramp::{Absent, Estimate, Input, Response, respond};
use recording::{Recording, Seconds};

use crate::check::Analysis;
use crate::input::{CHAMBER, Fingerprint, InputError, RATE, RecordCase, SPOOL};

pub use figure::{Figure, Told, Untold};
pub use json::{all, json};
pub use prediction::Prediction;
pub use text::{several, text, text_without_notes};

/// Rows beyond which neighbours are averaged: a ramp of an hour in a day's record is then of more than a hundred.
const MOST_ROWS: usize = 3_000;

/// The numbers that a recording gives.
#[derive(Debug, Clone)]
pub struct Measurement {
    /// The recording.
    pub fingerprint: Fingerprint,
    /// The temperature whose rate counts, and the one over which a bias at rest is sought; `None` if there is none.
    pub temperatures: Option<[&'static str; 2]>,
    /// Time constants that were tried \[s\].
    pub lags: Vec<f64>,
    /// Sensitivity of the bias to the temperature's rate in a steady ramp: the mean of heating and cooling \[(deg/h)/(degC/min)\].
    pub sensitivity: Told,
    /// Sensitivity while the temperature rises.
    pub heating: Told,
    /// Sensitivity while the temperature falls.
    pub cooling: Told,
    /// Heating less cooling.
    pub asymmetry: Told,
    /// Bias at rest at one temperature, reached from below, less that reached from above \[deg/h\].
    pub hysteresis: Told,
    /// Largest less least bias at rest over the record's range of temperatures \[deg/h\].
    pub bias_span: Told,
    /// Range of the temperature over which it is \[K\], if there is one.
    pub span_range: Option<f64>,
    /// Bias by temperature where it is largest, relative to the first row \[deg/h\].
    pub peak: Told,
    /// The instant of the peak \[s\].
    pub peak_time: Option<f64>,
    /// Length of the record of the peak \[s\], and the fastest change of its temperature in ten minutes \[K/s\]: peaks of other programmes are no equals.
    pub peak_under: Option<[f64; 2]>,
    /// Angle random walk \[deg/sqrt(h)\].
    pub arw: Told,
    /// Floor of the Allan deviation \[deg/h\].
    pub bias_instability: Told,
    /// Averaging time of the floor \[s\].
    pub floor_time: Option<f64>,
    /// Whether the floor is an upper bound, as the temperature changed.
    pub floor_is_bound: bool,
    /// Other units in which the rate may be, those that are rare last: conversion from the rate as it was read.
    pub rate_units: Vec<Unit>,
    /// Further remarks for the user, with the reason for each number that is not told.
    pub notes: Vec<Note>,
}

/// The figures of a recording.
///
/// # Errors
/// [`InputError`] names what forbids its use.
pub fn measure(case: &RecordCase) -> Result<Measurement, InputError> {
    case.require_usable()?;
    let file = &case.fingerprint.file;
    let mut notes: Vec<Note> = case.notes.iter().filter(|note| note.is_warning()).map(|note| note.clone().at(file)).collect();
    let severe = case.report.findings.iter().filter(|finding| finding.severity == recording::check::Severity::Warning);
    notes.extend(severe.map(|finding| Remark::of_finding(&finding.kind).warning(finding.to_string()).at(file)));
    let (drive, response) = response(case);
    let analysis = Analysis::new(case);
    // of what a check says besides, that which may make a figure void
    let tells = |note: &&Note| matches!(note.remark, Remark::Line | Remark::SpoolFirst | Remark::ChamberJump);
    notes.extend(analysis.notes.iter().filter(tells).map(|note| note.clone().at(file)));
    let noise = noise::of(analysis.noise.as_ref());
    // u/(K/s) to u/(K/min)
    let per_minute = |of: fn(&Response) -> &Result<Estimate, Absent>| told(&response, of, 1.0 / S_PER_MIN);
    let plain = |of: fn(&Response) -> &Result<Estimate, Absent>| told(&response, of, 1.0);
    let peak = response.as_ref().map_err(|why| Untold::from(why.clone()));
    let peak = peak.and_then(|r| r.peak.as_ref().map_err(|absent| Untold::from(absent.to_string())));
    let peak = peak.map(|(estimate, time)| (figure(*estimate), *time));
    let mut measured = Measurement {
        fingerprint: case.fingerprint.clone(),
        temperatures: drive.as_ref().map(|drive| drive.names),
        lags: response.as_ref().map_or_else(|_| Vec::new(), |response| response.lags.clone()),
        sensitivity: per_minute(|r| &r.sensitivity),
        heating: per_minute(|r| &r.heating),
        cooling: per_minute(|r| &r.cooling),
        asymmetry: per_minute(|r| &r.asymmetry),
        hysteresis: plain(|r| &r.hysteresis),
        bias_span: plain(|r| &r.span).map(|Figure { value, ci90: [low, high] }| Figure { value, ci90: [low.max(0.0), high] }),
        span_range: drive.as_ref().map(|drive| drive.range),
        peak: peak.clone().map(|(figure, _)| figure),
        peak_time: peak.ok().map(|(_, time)| time),
        peak_under: drive.and_then(|drive| drive.programme),
        arw: noise.arw,
        bias_instability: noise.floor,
        floor_time: noise.floor_time,
        floor_is_bound: analysis.noise.as_ref().is_some_and(|noise| noise.is_bound),
        rate_units: case.rate_units.clone(),
        notes,
    };
    measured.notes.extend(one_temperature(&measured).map(|note| note.at(file)));
    measured.notes.extend(measured.not_measured());
    Ok(measured)
}

/// A note of a sensitivity beside which no second temperature tells how slowly the unit settles.
fn one_temperature(measured: &Measurement) -> Option<Note> {
    let [drive, _] = measured.temperatures.filter(|[drive, seat]| drive == seat)?;
    let longest = Seconds(measured.lags.first()?.round());
    let text = format!(
        "{drive} alone does not tell how slowly the unit settles: the sensitivity is that of responses up to {longest} s"
    );
    measured.sensitivity.is_ok().then(|| Remark::OneTemperature.note(text))
}

impl Measurement {
    /// A note on each figure that is not told.
    pub(crate) fn not_measured(&self) -> Vec<Note> {
        let why = |(key, _, told): (&str, &str, &Told)| told.as_ref().err().map(|untold| format!("{key}: {}", untold.why));
        let missing = self.figures().into_iter().filter_map(why);
        missing.map(|text| Remark::NotMeasured.note(text).at(&self.fingerprint.file)).collect()
    }

    /// Whether the number of a key is an upper bound.
    pub(super) fn is_bound(&self, key: &str) -> bool {
        key == "bias_instability" && self.floor_is_bound
    }

    /// Keys, units and numbers, in the order in which they are shown.
    pub fn figures(&self) -> [(&'static str, &'static str, &Told); 9] {
        const RAMP: &str = "(deg/h)/(degC/min)";
        [
            ("sensitivity", RAMP, &self.sensitivity),
            ("heating", RAMP, &self.heating),
            ("cooling", RAMP, &self.cooling),
            ("asymmetry", RAMP, &self.asymmetry),
            ("hysteresis", "deg/h", &self.hysteresis),
            ("bias_span", "deg/h", &self.bias_span),
            ("peak", "deg/h", &self.peak),
            ("arw", "deg/sqrt(h)", &self.arw),
            ("bias_instability", "deg/h", &self.bias_instability),
        ]
    }
}

fn figure(estimate: Estimate) -> Figure {
    Figure { value: estimate.value, ci90: estimate.ci90() }
}

fn told(response: &Result<Response, String>, of: fn(&Response) -> &Result<Estimate, Absent>, factor: f64) -> Told {
    let response = response.as_ref().map_err(|why| Untold::from(why.clone()))?;
    of(response).as_ref().map(|estimate| figure(estimate.times(factor))).map_err(|absent| absent.to_string().into())
}

/// Length of a programme \[s\], and its fastest change in ten minutes \[K/s\], which the noise of readings hardly touches.
fn programme(time: &[f64], drive: &[f64]) -> Option<[f64; 2]> {
    const WITHIN: f64 = 600.0;
    let slope = |n: usize| {
        let before = time[..n].partition_point(|t| *t <= time[n] - WITHIN).checked_sub(1)?;
        Some((drive[n] - drive[before]).abs() / (time[n] - time[before]))
    };
    let fastest = (0..time.len()).filter_map(slope).reduce(f64::max)?;
    Some([time[time.len() - 1] - time[0], fastest])
}

/// Names of the temperature whose rate counts and of the one over which a bias at rest is sought, the [`programme`] of the first and the range of the second \[K\].
struct Drive {
    names: [&'static str; 2],
    programme: Option<[f64; 2]>,
    range: f64,
}

/// Response of the rate to the temperatures, with these.
fn response(case: &RecordCase) -> (Option<Drive>, Result<Response, String>) {
    let used = case.report.used(&case.recording);
    let interval = case.report.instants.as_ref().map_or(0.0, |instants| instants.interval);
    let rule = Thinning { many_rows: MOST_ROWS, interval, most_rows: MOST_ROWS };
    let (used, every) = match thinned(&used, interval, &rule) {
        Some(Thinned { recording, every, .. }) => (recording, every as f64),
        None => (used, 1.0),
    };
    let temperature = |used: &Recording, name: &str| {
        let values = &used.channel(name)?.values;
        let known = values.iter().filter(|value| value.is_finite()).count();
        if 2 * known > values.len() { bridged(used.time(), values) } else { None }
    };
    let [chamber, spool] = [CHAMBER, SPOOL].map(|name| temperature(&used, name).map(|values| (name, values)));
    let Some((driver, drive)) = chamber.clone().or_else(|| spool.clone()) else {
        return (None, Err("there is no temperature; record chamber_c or spool_c".into()));
    };
    let (seated, seat) = spool.unwrap_or_else(|| (driver, drive.clone()));
    let summary = case.number(driver).map(|number| &case.report.channels[number]);
    let of = |value: Option<f64>| value.unwrap_or(0.0) / every.sqrt();
    let reading = [of(summary.and_then(|s| s.noise)), of(summary.and_then(|s| s.step))];
    let values = used.channel(RATE).map_or_else(|| vec![f64::NAN; used.time().len()], |channel| channel.values.clone());
    let mask: Vec<bool> = values.iter().map(|value| value.is_finite()).collect();
    let answered = respond(&Input {
        time: used.time(),
        values: &values,
        mask: &mask,
        drive: &drive,
        reading,
        seat: &seat,
        interval: interval * every,
        averaging: case.averaging * every,
    });
    let [least, most] = seat.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| [low.min(*t), high.max(*t)]);
    let drive = Drive { names: [driver, seated], programme: programme(used.time(), &drive), range: most - least };
    (Some(drive), answered.map_err(|absent| absent.to_string()))
}
