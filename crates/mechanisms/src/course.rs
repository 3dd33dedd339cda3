//! The courses of reduced models: drives and modes in the rows of a recording, and what thermometer and bias are of them.

use crate::library::Functionals;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Output, Reduced, Smooth};
use nalgebra::DMatrix;

/// Place of the spool's thermometer among the channels.
pub const SPOOL: usize = 0;
/// Place of the rate among the channels.
pub const RATE: usize = 1;

/// Mean bias parts in every row \[deg/h\]: Shupe, elasto-optic axial and radial.
pub type Parts = [Vec<f64>; 3];

/// Rows that end this much later than the averaging span after the row before are gaps \[spans\].
pub(crate) const GAP: f64 = 1.5;

/// Assumed delays of the chamber's instruments \[s\].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Delay {
    /// Time constant of its thermometer.
    pub lag: f64,
    /// Delay of its log's clock.
    pub clock: f64,
}

impl Delay {
    /// Both together.
    pub fn total(&self) -> f64 {
        self.lag + self.clock
    }
}

/// Instants of a recording with those between them, and those at which a reading that follows a gap begins.
#[derive(Debug, Clone)]
pub(crate) struct Clock {
    pub(crate) time: Vec<f64>,
    pub(crate) chamber: Vec<f64>,
    /// place of each row of the recording
    pub(crate) rows: Vec<usize>,
    /// whether a reading begins at an instant that is not a row's
    pub(crate) begins: Vec<bool>,
}

/// Parts into which an interval is divided to follow the chamber between its readings.
pub(crate) const BETWEEN: usize = 4;

impl Clock {
    /// Between rows the chamber is smooth ([`Smooth::through`]), without corners, wherever readings begin. After a gap one begins `averaging` seconds
    /// before its row.
    pub(crate) fn new(time: &[f64], chamber: &[f64], averaging: f64) -> Self {
        let smooth = Smooth::through(time, chamber);
        let mut instants = Vec::with_capacity(time.len());
        let (mut rows, mut starts) = (Vec::with_capacity(time.len()), Vec::new());
        for n in 0..time.len() {
            if averaging > 0.0 && n > 0 && time[n] - time[n - 1] > GAP * averaging {
                starts.push(instants.len() * BETWEEN);
                instants.push(time[n] - averaging);
            }
            rows.push(instants.len() * BETWEEN);
            instants.push(time[n]);
        }
        let within = |from: f64, to: f64, part: usize| {
            if part == BETWEEN { to } else { from + (to - from) * part as f64 / BETWEEN as f64 }
        };
        let between = instants.windows(2).flat_map(|w| (1..=BETWEEN).map(|part| within(w[0], w[1], part)).collect::<Vec<_>>());
        let fine: Vec<f64> = instants.first().copied().into_iter().chain(between).collect();
        let mut begins = vec![false; fine.len()];
        starts.into_iter().for_each(|n| begins[n] = true);
        Self { chamber: fine.iter().map(|t| smooth.at(*t).0).collect(), time: fine, rows, begins }
    }

    /// Places of the instants at which the reading of each row begins and ends; the first begins nowhere.
    pub(crate) fn readings(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let began = |row: usize| {
            let (before, n) = (self.rows[row - 1], self.rows[row]);
            // a reading that follows a gap begins at an instant of its own
            (before..n).rev().find(|&m| self.begins[m]).unwrap_or(before)
        };
        (0..self.rows.len()).map(move |row| [if row > 0 { began(row) } else { 0 }, self.rows[row]])
    }
}

/// A course at later instants, plus a time constant times its rate: the chamber behind its thermometer and its log. Beyond its ends it stays.
pub(crate) fn undelayed(time: &[f64], course: &[f64], Delay { lag, clock }: Delay) -> Vec<f64> {
    if lag == 0.0 && clock == 0.0 {
        return course.to_vec();
    }
    let rates = recording::condition::slopes(time, course);
    let last = time.len() - 1;
    let at = |t: &f64| {
        let t = (t + clock).clamp(time[0], time[last]);
        let after = time.partition_point(|instant| *instant < t).clamp(last.min(1), last);
        let before = after.saturating_sub(1);
        let span = time[after] - time[before];
        let share = if after > before { (t - time[before]) / span } else { 0.0 };
        let between = |x: &[f64]| x[before] + share * (x[after] - x[before]);
        // the cubic that has the rates at both ends
        let rise = course[after] - course[before];
        let (leaving, arriving) = (span * rates[before] - rise, span * rates[after] - rise);
        let bend = share * (1.0 - share) * ((1.0 - share) * leaving - share * arriving);
        between(course) + bend + lag * between(&rates)
    };
    time.iter().map(at).collect()
}

/// Thermometer and bias parts of one model in the rows of a recording.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    pub(crate) sensor: Vec<f64>,
    pub(crate) parts: Parts,
}

/// Drives and modes of one reduced model in the rows of a recording, and their mean rates.
#[derive(Debug, Clone)]
pub(crate) struct Course {
    /// rows × (drives + modes)
    pub(crate) states: DMatrix<f64>,
    pub(crate) rates: DMatrix<f64>,
}

impl Course {
    /// Runs `drives` from rest at `rest`; both in the order of the model's drives.
    pub(crate) fn new(model: &Reduced, clock: &Clock, drives: &[Vec<f64>], rest: &[f64]) -> Self {
        let mut steps = model.steps(&clock.time, drives, rest);
        // where the reading of the row began
        let (mut began, mut before) = (0, steps.state().vector());
        let mut states = DMatrix::zeros(clock.rows.len(), before.len());
        let (mut rates, mut row) = (states.clone(), 0);
        for n in 0..clock.time.len() {
            if n > 0 {
                steps.next();
            }
            let now = steps.state().vector();
            if clock.rows.get(row) == Some(&n) {
                states.set_row(row, &now.transpose());
                if n > 0 {
                    rates.set_row(row, &((&now - before) / (clock.time[n] - clock.time[began])).transpose());
                }
                row += 1;
                (began, before) = (n, now);
            } else if clock.begins[n] {
                (began, before) = (n, now);
            }
        }
        Self { states, rates }
    }

    pub(crate) fn output(&self, output: &Output) -> Vec<f64> {
        (&self.states * output.vector()).as_slice().to_vec()
    }

    /// Mean bias parts in every row.
    pub(crate) fn parts(&self, functionals: &Functionals) -> Parts {
        [0, 1, 2].map(|p: usize| (&self.rates * (&functionals[p] * DEG_PER_H_PER_RAD_PER_S)).as_slice().to_vec())
    }

    pub(crate) fn series(&self, model: &Reduced) -> Series {
        Series { sensor: self.output(model.thermometer()), parts: self.parts(&model.parts().each_ref().map(Output::vector)) }
    }
}

/// The rate: all three parts together.
pub(crate) fn total(parts: &Parts) -> Vec<f64> {
    (0..parts[0].len()).map(|n| parts[0][n] + parts[1][n] + parts[2][n]).collect()
}

impl Series {
    /// Adds a multiple of a change.
    pub(crate) fn change(&mut self, by: &Self, factor: f64) {
        self.parts.iter_mut().zip(&by.parts).for_each(|(part, change)| add(part, change, factor));
        add(&mut self.sensor, &by.sensor, factor);
    }

    /// Adds multiples of many changes, one after another.
    pub(crate) fn change_by_all(&mut self, by: &[(&Self, f64)]) {
        for (p, part) in self.parts.iter_mut().enumerate() {
            add_all(part, by, |series| &series.parts[p]);
        }
        add_all(&mut self.sensor, by, |series| &series.sensor);
    }
}

/// Rows that stay near the processor while many series are added to them.
const NEAR: usize = 1024;

fn add_all(to: &mut [f64], what: &[(&Series, f64)], of: impl Fn(&Series) -> &[f64]) {
    for (n, rows) in to.chunks_mut(NEAR).enumerate() {
        for (series, factor) in what {
            add(rows, &of(series)[n * NEAR..], *factor);
        }
    }
}

pub(crate) fn minus(a: &Series, b: &Series) -> Series {
    Series { sensor: less(&a.sensor, &b.sensor), parts: difference(&a.parts, &b.parts) }
}

fn difference(a: &Parts, b: &Parts) -> Parts {
    [0, 1, 2].map(|p: usize| less(&a[p], &b[p]))
}

fn less(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

pub(crate) fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn add(to: &mut [f64], what: &[f64], factor: f64) {
    to.iter_mut().zip(what).for_each(|(t, w)| *t += factor * w);
}
