//! `fogcoil check`: is a recording usable, and what noise is in it?
//!
//! Gyro and thermometers are judged by [`recording::check`]; the gyro's noise is identified after an offset and what linear systems
//! lag behind the chamber's temperature have been taken off, so that thermal bias does not pass for noise. What of the bias is no
//! linear lag remains: the slow terms are then upper bounds.

mod certainty;
mod json;
mod jumped;
mod lags;
mod lined;
mod order;
mod text;

use bias::units::S_PER_H;
use charts::{Axis, Figure, Panel, Series as Line, Style, significant};
use files::Note;
use recording::Recording;
use recording::allan::{AllanPoint, CONFIDENCE, allan};
use recording::check::white_noise_beyond_cubics;
use recording::condition::bridged;
use recording::lag::lagging;
use recording::noise::{Bounds, NoiseEstimate, NoiseModel, Parameter, Series, Term, Whitener, identify, residual};
use recording::smooth::smoothed;

use crate::contradictions::contradictions;
use crate::input::{CHAMBER, RATE, RecordCase, SPOOL};
use crate::prepare::{stands_still, starts_off_rest};
use jumped::jumped;
use lags::lags;
pub(crate) use lined::lined;
use lined::take_off;
use order::spool_first;

pub use json::json;
pub use lined::RateLine;
pub use text::{several, text, text_without_notes, unreadable};

/// A recording and its noise.
#[derive(Debug, Clone)]
pub struct Analysis<'a> {
    /// The recording.
    pub case: &'a RecordCase,
    /// Remarks on how it was read and how it starts.
    pub notes: Vec<Note>,
    /// The gyro's noise; `None` where the recording cannot be used, or has too few rows, or no noise.
    pub noise: Option<GyroNoise>,
}

/// The noise of a rate.
#[derive(Debug, Clone)]
pub struct GyroNoise {
    /// The most likely model.
    pub estimate: NoiseEstimate,
    /// The temperature whose lags were taken off; `None` if only an offset was.
    pub driver: Option<&'static str>,
    /// Whether that temperature changed: what of the thermal bias is no linear lag is in the slow terms, which are then upper bounds.
    pub is_bound: bool,
    /// Time constants of the lags \[s\].
    pub lags: Vec<f64>,
    /// Lines that were taken off.
    pub lines: Vec<RateLine>,
    /// Rows left out because the model does not expect them: fast transients.
    pub left_out: usize,
    /// Allan deviation of what is left.
    pub allan: Vec<AllanPoint>,
    /// Interval of the rows \[s\].
    pub interval: f64,
    /// Time from the first row to the last \[s\].
    pub span: f64,
    /// White noise of a sample from fourth differences of neighbours in the rate itself, less its lines \[deg/h\], and the number of rows: lags of a
    /// temperature bring the noise of the thermometer with them.
    pub neighbours: Option<(f64, usize)>,
}

impl GyroNoise {
    /// Standard deviation of the white noise of a sample \[deg/h\]; `None` where other noise hides it.
    pub fn white(&self) -> Option<f64> {
        let model = &self.estimate.model;
        let white = NoiseModel::white(model.white, model.averaging);
        let of = |model: &NoiseModel| model.allan_deviation(self.interval, self.interval);
        (of(&white) >= HIDDEN * of(model) && self.is_told(Parameter::White)).then_some(model.white)
    }

    /// Whether the recording tells a parameter of the model: the likelihood is not greatest at an end of the search for it.
    pub fn is_told(&self, parameter: Parameter) -> bool {
        !self.estimate.at_edge.contains(&parameter)
    }

    /// Angle random walk \[deg/√h\]; `None` of momentary values, and where other noise hides it.
    pub fn angle_random_walk(&self) -> Option<f64> {
        let walk = self.estimate.model.angle_random_walk()?;
        self.white().map(|_| walk / S_PER_H.sqrt())
    }
}

/// Share of white noise in the Allan deviation over one interval below which nobody can tell its size: a hundredth of the variance.
const HIDDEN: f64 = 0.1;
/// Reason why no white noise is told.
pub const NO_WHITE: &str =
    "white noise is hidden by slower noise, or by what temperature does to the rate; record faster, or at one temperature";
/// Reason why a fitted number has no interval.
pub const NO_MAXIMUM: &str = "the record does not tell it apart from other noise; record longer, at one temperature";
/// Innovations beyond so many standard deviations are left out, of long recordings beyond √(2 ln rows): normal noise has less than one.
const UNEXPECTED: f64 = 4.0;
/// Slope of the Allan deviation at its beginning below which quantisation is sought: between its own, -1, and white noise's, -1/2.
const QUANTISED: f64 = -0.7;
/// Most identifications, each without what the one before did not expect.
const MOST_PASSES: usize = 4;
/// Most rows of a temperature that is freed of its noise: in more, of which the fit takes means, less of it is left.
const MOST_SMOOTHED: usize = 20_000;
/// Factor by which guides and marks may lie below the least Allan deviation in a picture.
const BELOW: f64 = 30.0;

impl GyroNoise {
    /// Shortest and longest averaging time \[s\].
    pub fn ends(&self) -> [f64; 2] {
        [self.interval, self.allan.last().map_or(self.interval, |point| point.tau)]
    }

    /// The floor of the fitted Allan deviation: its averaging time \[s\] and the deviation \[deg/h\]; `None` where it still falls.
    pub fn floor(&self) -> Option<(f64, f64)> {
        self.estimate.model.floor(self.ends(), self.interval)
    }

    /// Number of courses that were taken off: an offset, and of a temperature its lags and its change.
    fn taken_off_count(&self) -> usize {
        1 + self.driver.map_or(0, |_| self.lags.len() + 1)
    }

    /// The terms fitted beside it, in words.
    fn taken_off(&self) -> String {
        match self.driver {
            Some(name) => format!("an offset and what {} linear lags of {name} explain", self.lags.len()),
            None => "an offset".into(),
        }
    }
}

impl<'a> Analysis<'a> {
    /// Analyses a recording.
    pub fn new(case: &'a RecordCase) -> Self {
        let usable = case.report.usable();
        let noise = if usable { gyro_noise(case) } else { None };
        let seen = usable.then(|| [spool_first(case), jumped(case), starts_off_rest(case)]).into_iter().flatten().flatten();
        let contradicted = if usable { contradictions(case) } else { Vec::new() };
        let lined = noise.as_ref().and_then(|noise| lined(&noise.lines, "kept out of the noise"));
        let notes = case.notes.iter().cloned().chain(seen).chain(contradicted).chain(lined).collect();
        Self { case, notes, noise }
    }
}

fn gyro_noise(case: &RecordCase) -> Option<GyroNoise> {
    let kept = case.kept();
    let (time, instants) = (kept.time(), case.report.instants.as_ref()?);
    let rate = case.number(RATE)?;
    let (mut values, mask) = (kept.channels()[rate].values.clone(), &case.report.masks[rate]);
    let driver = [CHAMBER, SPOOL].into_iter().find(|name| {
        case.number(name).is_some_and(|number| {
            let summary = &case.report.channels[number];
            summary.used > time.len() / 2 && summary.largest > summary.least
        })
    });
    let readings = driver.and_then(|name| case.report.used(&case.recording).channel(name).map(|channel| channel.values.clone()));
    let temperature = readings.as_deref().and_then(|readings| free_of_noise(time, readings));
    let is_bound = temperature.as_deref().is_some_and(|values| !stands_still(values, instants.interval));
    let lags = if driver.is_some() { lags(instants.interval, instants.span, time.len()) } else { Vec::new() };
    let mut columns = vec![vec![1.0; time.len()]];
    if let Some(temperature) = &temperature {
        columns.extend(lags.iter().map(|lag| lagging(time, temperature, *lag)));
        columns.push(temperature.iter().map(|t| t - temperature[0]).collect());
    }
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut bounds = Bounds::new(case.averaging, time);
    let mut used = mask.clone();
    let (mut passes, mut lines) = (0, Vec::new());
    let (estimate, allan, neighbours, rest) = loop {
        let series = Series { time, values: &values, mask: &used, columns: &columns };
        let estimate = identify(&series, &bounds).ok()?;
        let rest = residual(&series, &estimate.model).ok()?;
        let more = lined::lines(&estimate.model, time, &rest, case.report.channels[rate].step, lines.len());
        if !more.is_empty() {
            more.iter().for_each(|line| take_off(line, time, &mut values));
            lines.extend(more);
            continue;
        }
        let still: Vec<bool> = rest.iter().map(|value| value.is_finite()).collect();
        let allan = allan(time, &rest, &still).ok()?;
        passes += 1;
        // quantisation is sought where it shows: elsewhere it would take the white noise's place
        let quantised = allan.first().is_some_and(|point| point.slope < QUANTISED) && !bounds.terms.contains(&Term::Quantisation);
        if quantised {
            bounds.terms.push(Term::Quantisation);
        }
        let more = leave_out(&estimate, time, &rest, &mut used) || quantised;
        if !more || passes == MOST_PASSES {
            let rows = still.iter().filter(|there| **there).count();
            let neighbours = white_noise_beyond_cubics(time, &values, &still).filter(|sd| *sd > 0.0).map(|sd| (sd, rows));
            break (estimate, allan, neighbours, rest);
        }
    };
    let left_out = mask.iter().zip(&used).filter(|(there, used)| **there && !**used).count();
    let lines = lined::of(lines, (time, &rest), driver.zip(readings.as_deref()), temperature.as_deref());
    Some(GyroNoise {
        estimate,
        driver,
        is_bound,
        lags,
        lines,
        left_out,
        allan,
        interval: instants.interval,
        span: instants.span,
        neighbours,
    })
}

/// A recording without the lines of its rate that go on whatever the temperature does, which no temperature has, and these lines.
pub(crate) fn without_lines(case: &RecordCase) -> Option<(RecordCase, Vec<RateLine>)> {
    let lines = gyro_noise(case)?.lines.into_iter().filter(|line| line.of.is_none() && line.is_steady).collect::<Vec<_>>();
    if lines.is_empty() {
        return None;
    }
    let (mut channels, time) = (case.recording.channels().to_vec(), case.recording.time());
    let rate = &mut channels[case.number(RATE)?].values;
    lines.iter().for_each(|RateLine { line, .. }| take_off(line, time, rate));
    let recording = Recording::new(time.to_vec(), channels).ok()?;
    Some((RecordCase { recording, ..case.clone() }, lines))
}

/// A temperature without its thermometer's noise, which would pass for the rate's through the lags; masked values are on the course between their neighbours.
fn free_of_noise(time: &[f64], readings: &[f64]) -> Option<Vec<f64>> {
    let smooth = (time.len() <= MOST_SMOOTHED).then(|| smoothed(time, readings, None).ok()).flatten();
    smooth.map_or_else(|| bridged(time, readings), |smooth| Some(smooth.values))
}

/// Masks the rows that the model does not expect, where the temperature turns too fast for its lags; whether there were any.
fn leave_out(estimate: &NoiseEstimate, time: &[f64], rest: &[f64], used: &mut [bool]) -> bool {
    let Ok(whitener) = Whitener::new(&estimate.model, time, used) else { return false };
    let white = whitener.apply(rest);
    let bound = UNEXPECTED.max((2.0 * (whitener.rows().len() as f64).ln()).sqrt());
    let unexpected: Vec<usize> =
        whitener.rows().iter().zip(white).filter(|(_, z)| z.abs() > bound).map(|(row, _)| *row).collect();
    unexpected.iter().for_each(|row| used[*row] = false);
    !unexpected.is_empty()
}

/// The Allan deviation with its intervals and the fitted model, as an SVG document; `None` without identified noise.
pub fn svg(analysis: &Analysis) -> Option<String> {
    let noise = analysis.noise.as_ref()?;
    let file = analysis.case.fingerprint.file.file_name().unwrap_or_default().to_string_lossy();
    let caption = format!("{file}; beside {}.", noise.taken_off());
    let less = noise.driver.map_or(String::new(), |_| " less its linear response to temperature".to_owned());
    let title = format!("Allan deviation of the rate{less}, {file}");
    let allan = Allan { points: &noise.allan, model: &noise.estimate.model, interval: noise.interval, is_bound: noise.is_bound };
    Some(allan.figure("allan", title, caption)?.document())
}

/// An Allan deviation and the noise model that was fitted.
#[derive(Clone, Copy)]
pub(crate) struct Allan<'a> {
    pub(crate) points: &'a [AllanPoint],
    pub(crate) model: &'a NoiseModel,
    /// Interval of the rows \[s\].
    pub(crate) interval: f64,
    /// Whether slow terms are upper bounds.
    pub(crate) is_bound: bool,
}

impl<'a> Allan<'a> {
    /// Deviation, intervals, model and guides; `None` where there is no deviation to draw.
    pub(crate) fn figure(self, id: &'static str, title: String, caption: String) -> Option<Figure<'a>> {
        let bottom = self.bottom()?;
        let mut series = self.guides(bottom);
        series.extend([
            self.curve(&format!("{:.0} % interval", 100.0 * CONFIDENCE), Style::Third, |_, point| point.low),
            self.curve("", Style::Third, |_, point| point.high),
            self.curve("fitted model", Style::Marked(1), |allan, point| allan.deviation(point.tau)),
            self.curve("recording", Style::Marked(0), |_, point| point.deviation),
        ]);
        series.extend(self.marks(bottom));
        Some(Figure {
            id,
            title,
            description:
                "Overlapping Allan deviation against averaging time, both axes logarithmic, between the ends of its 90 % \
                          intervals, and that of the fitted noise model; guides of the slopes −1/2, 0 and +1/2, and marks at \
                          the angle random walk and the bias instability."
                    .into(),
            caption,
            columns: 1,
            panels: vec![Panel::lines(
                Axis::logarithmic("averaging time [s]"),
                Axis::logarithmic("Allan deviation [°/h]"),
                24.0,
                series,
            )],
        })
    }

    fn curve(self, name: &str, style: Style, of: fn(&Self, &AllanPoint) -> f64) -> Line<'a> {
        Line::new(name, style, self.points.iter().map(|point| (point.tau, of(&self, point))).collect())
    }

    /// Deviation of the model.
    fn deviation(&self, tau: f64) -> f64 {
        self.model.allan_deviation(tau, self.interval)
    }

    /// Shortest and longest averaging time \[s\].
    fn ends(&self) -> [f64; 2] {
        [self.interval, self.points.last().map_or(self.interval, |point| point.tau)]
    }

    /// Deviation of the model's white noise alone.
    fn white(&self, tau: f64) -> f64 {
        let span = if self.model.averaging > 0.0 { self.model.averaging } else { self.interval };
        self.model.white * (span / tau).sqrt()
    }

    /// Least deviation that the picture reaches down to; `None` where there is no deviation to draw.
    fn bottom(&self) -> Option<f64> {
        let drawn = self.points.iter().map(|point| point.deviation).filter(|deviation| *deviation > 0.0);
        drawn.reduce(f64::min).map(|least| least / BELOW)
    }

    /// Lines of slope −1/2 through the model's white noise, 0 through its floor and +1/2 through its rate random walk, the latter two through
    /// its last point where it has none.
    fn guides(&self, bottom: f64) -> Vec<Line<'a>> {
        let [first, last] = self.ends();
        let hour = last.max(S_PER_H);
        let (at, floor) = self.floor().unwrap_or((last, self.deviation(last)));
        let walk = if self.model.walk > 0.0 { self.model.walk / 3_f64.sqrt() } else { floor / at.sqrt() };
        let white = self.white(1.0);
        let low = bottom.max(floor.min(self.white(hour)));
        let ends = [[first, hour.min((white / bottom).powi(2))], [first, hour], [first.max((low / walk).powi(2)), last]];
        let lines = [(white, -0.5), (floor, 0.0), (walk, 0.5)].into_iter().zip(ends);
        let lines = lines.filter(|((size, _), [from, to])| *size > 0.0 && from < to);
        let line = |(n, ((size, slope), ends)): (usize, ((f64, f64), [f64; 2]))| {
            let name = if n == 0 { "slopes −1/2, 0 and +1/2" } else { "" };
            Line::new(name, Style::Guide, ends.map(|tau| (tau, size * tau.powf(slope))).to_vec())
        };
        lines.enumerate().map(line).collect()
    }

    fn floor(&self) -> Option<(f64, f64)> {
        self.model.floor(self.ends(), self.interval)
    }

    /// The angle random walk, which is the white noise's deviation at 1 h, and the floor, each where the model has it.
    fn marks(&self, bottom: f64) -> Vec<Line<'a>> {
        let walk = self.model.angle_random_walk().filter(|_| self.white(S_PER_H) >= bottom).map(|walk| {
            let name = format!("angle random walk {} °/√h, at 1 h", significant(walk / S_PER_H.sqrt(), 3));
            Line::new(name, Style::Points(2), vec![(S_PER_H, self.white(S_PER_H))])
        });
        let floor = self.floor().map(|(tau, floor)| {
            let at_most = if self.is_bound { "at most " } else { "" };
            let name = format!("bias instability {at_most}{} °/h, at {} s", significant(floor, 2), significant(tau, 2));
            Line::new(name, Style::Points(3), vec![(tau, floor)])
        });
        walk.into_iter().chain(floor).collect()
    }
}
