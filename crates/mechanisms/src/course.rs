//! The courses of reduced models: drives and modes in the rows of a recording, and what thermometer and bias are of them.

use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Output, Outputs, Reduced, Slopes, Smooth};
use nalgebra::{DMatrix, DVector};

/// Place of the spool's thermometer among the channels.
pub const SPOOL: usize = 0;
/// Place of the rate among the channels.
pub const RATE: usize = 1;

/// The three bias parts as functionals of drives and modes.
pub(crate) type Functionals = [DVector<f64>; 3];

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
        let rows: Vec<usize> = (0..time.len()).collect();
        Self::with_jumps(time, &rows, &[], chamber, averaging)
    }

    /// The same of a course that jumps behind some of its instants, and is smooth from one jump to the next; `rows` are its places in the recording's rows.
    pub(crate) fn with_jumps(time: &[f64], rows: &[usize], jumps: &[usize], course: &[f64], averaging: f64) -> Self {
        let ends = || jumps.iter().map(|n| n + 1).chain([time.len()]);
        let pieces: Vec<Smooth> = std::iter::once(0)
            .chain(ends())
            .zip(ends())
            .map(|(from, to)| Smooth::through(&time[from..to], &course[from..to]))
            .collect();
        let first_of = |piece: &Smooth| piece.time().first().copied().unwrap_or(f64::NEG_INFINITY);
        let value = |t: f64| pieces[pieces.partition_point(|piece| first_of(piece) <= t).max(1) - 1].at(t).0;
        let starts: Vec<f64> = rows
            .windows(2)
            .map(|w| [time[w[0]], time[w[1]]])
            .filter(|[before, row]| averaging > 0.0 && row - before > GAP * averaging)
            .map(|[_, row]| row - averaging)
            .collect();
        let mut instants: Vec<f64> = time.iter().chain(&starts).copied().collect();
        instants.sort_by(f64::total_cmp);
        instants.dedup();
        let leaps = |from: f64| jumps.binary_search_by(|n| time[*n].total_cmp(&from)).is_ok();
        let within = |from: f64, to: f64, part: usize| {
            if part == BETWEEN { to } else { from + (to - from) * part as f64 / BETWEEN as f64 }
        };
        let between = instants.windows(2).flat_map(|w| {
            // nothing lies within a jump
            let parts = if leaps(w[0]) { BETWEEN..=BETWEEN } else { 1..=BETWEEN };
            parts.map(|part| within(w[0], w[1], part)).collect::<Vec<_>>()
        });
        let fine: Vec<f64> = instants.first().copied().into_iter().chain(between).collect();
        let place = |t: f64| fine.partition_point(|instant| *instant < t);
        let mut begins = vec![false; fine.len()];
        starts.into_iter().for_each(|t| begins[place(t)] = true);
        let rows = rows.iter().map(|n| place(time[*n])).collect();
        Self { chamber: fine.iter().map(|t| value(*t)).collect(), time: fine, rows, begins }
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

    /// Derivatives of thermometer and mean bias parts, and of the coil's mean temperature, by every constant, in the rows.
    pub(crate) fn slopes(&self, slopes: &Slopes) -> Vec<(Series, Vec<f64>)> {
        let (time, spans) = self.readings_alone();
        let chamber: Vec<f64> = self.chamber.iter().step_by(BETWEEN).copied().collect();
        let first = chamber[0];
        let courses = slopes.run(&time, &[chamber], &[first]);
        courses.slopes.iter().map(|slope| (in_rows(slope, &time, &spans), at(&slope.coil_mean, &spans))).collect()
    }

    /// Derivatives of thermometer and mean bias parts by every constant, in the rows, under the second drive, which jumps to 1 `before` the first row \[s\].
    pub(crate) fn slopes_of_a_step(&self, slopes: &Slopes, before: f64, averaging: f64) -> Vec<Series> {
        let (rows, mut spans) = self.readings_alone();
        // the first reading began before its row, but sees nothing from before the drive was on
        let seen = averaging.min(before);
        let mut time: Vec<f64> = [before, seen].into_iter().filter(|by| *by > 0.0).map(|by| rows[0] - by).collect();
        time.dedup();
        let earlier = time.len();
        time.extend(rows);
        spans.iter_mut().flatten().for_each(|n| *n += earlier);
        if seen > 0.0 {
            spans[0][0] -= 1;
        }
        let courses = slopes.run(&time, &[vec![0.0; time.len()], vec![1.0; time.len()]], &[0.0, 0.0]);
        let first = if averaging > 0.0 { seen / averaging } else { 0.0 };
        let of = |slope: &Outputs<Vec<f64>>| {
            let mut series = in_rows(slope, &time, &spans);
            series.parts.iter_mut().for_each(|part| part[0] *= first);
            series
        };
        courses.slopes.iter().map(of).collect()
    }

    /// The instants without the steps between the readings, which derivatives need not; and [`Self::readings`] among them.
    fn readings_alone(&self) -> (Vec<f64>, Vec<[usize; 2]>) {
        let time = self.time.iter().step_by(BETWEEN).copied().collect();
        (time, self.readings().map(|span| span.map(|n| n / BETWEEN)).collect())
    }
}

/// Thermometer and mean bias parts of what has a phase at some instants, in readings from one to another.
fn in_rows(outputs: &Outputs<Vec<f64>>, time: &[f64], spans: &[[usize; 2]]) -> Series {
    let mean = |phase: &Vec<f64>| -> Vec<f64> {
        let of = |&[from, to]: &[usize; 2]| {
            if to > from { (phase[to] - phase[from]) / (time[to] - time[from]) * DEG_PER_H_PER_RAD_PER_S } else { 0.0 }
        };
        spans.iter().map(of).collect()
    };
    Series { sensor: at(&outputs.thermometer, spans), parts: outputs.parts[0].each_ref().map(mean) }
}

/// Values at the ends of readings.
fn at(course: &[f64], spans: &[[usize; 2]]) -> Vec<f64> {
    spans.iter().map(|[_, n]| course[*n]).collect()
}

/// The chamber behind a thermometer and a log that are late.
#[derive(Debug, Clone)]
pub(crate) struct Undelayed {
    pub(crate) chamber: Vec<f64>,
    /// its derivative by the whole delay where the thermometer's lag is kept \[K/s\]
    pub(crate) later: Vec<f64>,
    /// its derivative by the square of that lag where the whole delay is kept \[K/s²\]
    pub(crate) slower: Vec<f64>,
}

/// The chamber from the course s that its thermometer said: s(t + c) + τ s′(t + c) with the delay c of the log and the lag τ. By c + τ the derivative is s′ + τ s″,
/// by τ² where c + τ is kept −½ s″. Before its first instant the chamber was at rest, as the coil is; behind its last one s goes on straight.
pub(crate) fn undelayed(time: &[f64], course: &[f64], Delay { lag, clock }: Delay) -> Undelayed {
    let slopes = |of: &[f64]| recording::condition::slopes(time, of);
    let rates = slopes(course);
    let (of_course, of_rates) = (Smooth::with_rates(time, course, &rates), Smooth::with_rates(time, &rates, &slopes(&rates)));
    let (first, last) = (time[0], time[time.len() - 1]);
    let mut found = Undelayed { chamber: Vec::new(), later: Vec::new(), slower: Vec::new() };
    for instant in time.iter().map(|t| t + clock) {
        let within = instant.clamp(first, last);
        let (value, (rate, bend)) = (of_course.at(within).0, of_rates.at(within));
        let rate = if first < instant { rate } else { 0.0 };
        let bend = if first < instant && instant < last { bend } else { 0.0 };
        found.chamber.push(value + (lag + instant - within) * rate);
        found.later.push(rate + lag * bend);
        found.slower.push(-bend / 2.0);
    }
    found
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
    /// As long, and nothing throughout.
    pub(crate) fn nothing(&self) -> Self {
        let nothing = vec![0.0; self.sensor.len()];
        Self { parts: [0, 1, 2].map(|_| nothing.clone()), sensor: nothing }
    }

    pub(crate) fn scale(&mut self, factor: f64) {
        self.parts.iter_mut().chain([&mut self.sensor]).flatten().for_each(|value| *value *= factor);
    }

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

#[cfg(test)]
mod tests {
    use super::*;

    /// Against differences, far from the ends and at them: in a start that is not quite at rest, too, and where the course goes on straight.
    #[test]
    fn the_chamber_s_derivatives_by_lag_and_clock_are_those_of_its_courses() {
        let time: Vec<f64> = (0..200).map(|n| 5.0 * f64::from(n)).collect();
        let course: Vec<f64> = time.iter().map(|t| 20.0 + 0.004 * t + 3.0 * (t / 150.0).sin()).collect();
        let of = |total: f64, lag: f64| undelayed(&time, &course, Delay { lag, clock: total - lag });
        for (total, lag) in [(20.0, 0.0), (40.0, 52.5), (-7.5, 45.0)] {
            let here = of(total, lag);
            let by = |ahead: &[f64], back: &[f64], step: f64| -> Vec<f64> {
                ahead.iter().zip(back).map(|(a, b)| (a - b) / step).collect()
            };
            let later = by(&of(total + 0.5, lag).chamber, &of(total - 0.5, lag).chamber, 1.0);
            let to = (lag * lag + 20.0).sqrt();
            let slower = by(&of(total, to).chamber, &here.chamber, 20.0);
            let near = |told: &[f64], found: &[f64], close: f64| {
                let largest = found.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                // a kink at either end is met within a step of the clock
                let off = told.iter().zip(found).enumerate().filter(|(n, _)| (14..186).contains(n) || *n < 1 || *n > 198);
                off.map(|(_, (a, b))| (a - b).abs()).fold(0.0, f64::max) < close * largest
            };
            assert!(near(&here.later, &later, 0.02), "later: {total} s, lag {lag} s");
            assert!(near(&here.slower, &slower, 0.1), "slower: {total} s, lag {lag} s");
        }
    }

    #[test]
    fn exact_a_course_without_delay_is_itself() {
        let (time, course) = ([0.0, 1.0, 3.0, 4.5], [2.0, 2.5, 1.0, -1.0]);
        assert_eq!(undelayed(&time, &course, Delay::default()).chamber, course);
        assert_eq!(undelayed(&[1.0], &[4.0], Delay { lag: 3.0, clock: -2.0 }).chamber, [4.0]);
    }
}
