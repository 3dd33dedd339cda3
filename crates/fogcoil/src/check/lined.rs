//! Lines in the rate: hum and vibration, which are no noise.

use files::{Note, Remark};
use recording::Seconds;
use recording::lines::{Line, has_line, strongest};
use recording::noise::{NoiseModel, Whitener};

use crate::input::RATE;
use crate::table::significant;

/// Most lines that are taken off: a hum whose frequency wanders has no end of them.
const MOST_LINES: usize = 8;
/// Steps of the channel's last digit that a line exceeds: what rounding makes of an even drift is a third of one.
const ROUNDED: f64 = 0.5;

/// Parts of a record, and of the temperature's fastest pace, in which a line is compared with that of the whole, and the share of its amplitude by which it may differ there.
const PARTS: f64 = 4.0;
const ALIKE: f64 = 0.5;
/// Range \[K\] of a course from which it may make a line.
const FEWEST_KELVIN: f64 = 1.0;

/// A line of the rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateLine {
    /// The line itself \[deg/h\].
    pub line: Line,
    /// The temperature that has it, too.
    pub of: Option<&'static str>,
    /// Whether it is the same in every quarter of the record, and where the temperature falls, rests and rises; where it never rests this is not told.
    pub is_steady: bool,
}

/// Lines in what a model of the noise leaves of a rate, NaN where a row is not used, the strongest first; none beyond [`MOST_LINES`] with those known.
pub(super) fn lines(model: &NoiseModel, time: &[f64], rest: &[f64], step: Option<f64>, known: usize) -> Vec<Line> {
    let used: Vec<bool> = rest.iter().map(|value| value.is_finite()).collect();
    let Ok(whitener) = Whitener::new(model, time, &used) else { return Vec::new() };
    let least = ROUNDED * step.unwrap_or(0.0);
    let (mut rest, mut white, mut found) = (rest.to_vec(), vec![f64::NAN; time.len()], Vec::new());
    while known + found.len() < MOST_LINES {
        whitener.rows().iter().zip(whitener.apply(&rest)).for_each(|(row, z)| white[*row] = z);
        let Some(line) = strongest(time, &rest, &white).filter(|line| line.amplitude() > least) else { break };
        take_off(&line, time, &mut rest);
        found.push(line);
    }
    found
}

pub(super) fn take_off(line: &Line, time: &[f64], values: &mut [f64]) {
    values.iter_mut().zip(time).for_each(|(value, t)| *value -= line.at(*t));
}

/// Lines with the temperature that has them, too; `rest` is what the noise leaves of the rate beside them, `course` the temperature without its noise.
pub(super) fn of(
    lines: Vec<Line>,
    (time, rest): (&[f64], &[f64]),
    temperature: Option<(&'static str, &[f64])>,
    course: Option<&[f64]>,
) -> Vec<RateLine> {
    let has = |line: &Line| temperature.filter(|(_, values)| has_line(time, values, line.period)).map(|(name, _)| name);
    lines.into_iter().map(|line| RateLine { line, of: has(&line), is_steady: goes_on(&line, time, rest, course) }).collect()
}

/// Whether a line is the same in every quarter of a series, of which `rest` is what it leaves, and whatever the temperature does.
fn goes_on(line: &Line, time: &[f64], rest: &[f64], course: Option<&[f64]>) -> bool {
    let (start, length) = (time[0], time[time.len() - 1] - time[0]);
    let quarter = |row: usize| (PARTS * (time[row] - start) / length).floor().min(PARTS - 1.0) as usize;
    let is_same = |rows: &[usize]| {
        let left = line.left(rows.iter().map(|row| (&time[*row], &rest[*row])));
        left.is_some_and(|left| left < ALIKE * line.amplitude())
    };
    let used: Vec<usize> = (0..time.len()).filter(|row| rest[*row].is_finite()).collect();
    let mut parts = (0..PARTS as usize).map(|n| used.iter().copied().filter(|row| quarter(*row) == n).collect::<Vec<_>>());
    parts.all(|rows| is_same(&rows))
        && course.filter(|course| moves(course)).is_none_or(|course| {
            let paces = by_pace(time, course, &used);
            // where nothing rests a ripple over temperature may be a line: of one ramp, or of ramps to and fro
            let told = |rows: &&Vec<usize>| rows.len() as f64 * 2.0 * PARTS > used.len() as f64;
            told(&&paces[RESTS]) && paces.iter().filter(told).all(|rows| is_same(rows))
        })
}

fn moves(course: &[f64]) -> bool {
    let [least, most] = course.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], t| [least.min(*t), most.max(*t)]);
    most - least > FEWEST_KELVIN
}

/// Place of the rows in which a temperature rests in [`by_pace`].
const RESTS: usize = 1;

/// The rows of those in use in which a temperature falls, rests and rises: the latter by more than a part of its fastest pace.
fn by_pace(time: &[f64], course: &[f64], used: &[usize]) -> [Vec<usize>; 3] {
    let pace = |row: usize| {
        let ends = [row.saturating_sub(1), (row + 1).min(time.len() - 1)];
        (course[ends[1]] - course[ends[0]]) / (time[ends[1]] - time[ends[0]])
    };
    let fastest = used.iter().map(|row| pace(*row).abs()).fold(0.0, f64::max);
    let way = |row: usize| (pace(row) / fastest * PARTS).clamp(-1.0, 1.0).trunc();
    [-1.0, 0.0, 1.0].map(|one| used.iter().copied().filter(|row| way(*row) == one).collect())
}

/// A warning of the lines, and what is done about them.
pub(crate) fn lined(lines: &[RateLine], done: &str) -> Option<Note> {
    let most = lines.iter().max_by(|a, b| a.line.amplitude().total_cmp(&b.line.amplitude()))?;
    let others = match lines.len() {
        1 => String::new(),
        2 => ", and another".into(),
        more => format!(", and {} others", more - 1),
    };
    let source = match most.of {
        Some(name) => format!("{name} has it, too, so that the chamber may make it"),
        None if most.is_steady => "hum or vibration, perhaps a faster one that rows fold".into(),
        None => "it may come of the temperature's course, such as a ripple over temperature, or of hum".into(),
    };
    Some(Remark::Line.warning(format!(
        "{RATE} has a line with a period of {} s and an amplitude of {} deg/h{others}: {source}; {done}",
        Seconds((most.line.period * 1e3).round() / 1e3),
        significant(most.line.amplitude(), 2)
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: usize = 1200;
    const PERIOD: f64 = 400.0;

    /// The strongest line of a series beside even noise, and whether it goes on.
    fn goes_on_in(of: impl Fn(f64) -> f64) -> bool {
        let (line, goes_on) = beside(of, |_| 20.0);
        assert!((line.period / PERIOD - 1.0).abs() < 0.02, "{line:?}");
        goes_on
    }

    /// The same where the temperature has a course.
    fn beside(of: impl Fn(f64) -> f64, course: impl Fn(f64) -> f64) -> (Line, bool) {
        let time: Vec<f64> = (0..ROWS).map(|n| 30.0 * n as f64).collect();
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1_u32 << 24) - 0.5
        };
        let values: Vec<f64> = time.iter().map(|t| of(*t) + noise()).collect();
        let line = strongest(&time, &values, &values).expect("a line");
        let mut rest = values;
        take_off(&line, &time, &mut rest);
        let course: Vec<f64> = time.iter().map(|t| course(*t)).collect();
        (line, goes_on(&line, &time, &rest, Some(&course)))
    }

    /// A ripple over temperature is a line while that ramps: in the other quarters, or at another pace, there is none.
    #[test]
    fn a_line_goes_on_or_belongs_to_a_ramp() {
        let end = 30.0 * ROWS as f64;
        let wave = |t: f64| (std::f64::consts::TAU * t / PERIOD + 1.0).sin();
        assert!(goes_on_in(wave));
        assert!(!goes_on_in(|t| if t > 0.5 * end { 2.0 * wave(t) } else { 0.0 }));
        assert!(!goes_on_in(|t| if t > 0.4 * end { 2.0 * wave(t) } else { 2.0 * wave(t / 3.0) }));
    }

    /// Cycles of ramps and rests have both in each quarter: a ripple over temperature makes its line in the ramps alone, and runs backwards in every second.
    #[test]
    fn a_ripple_over_temperature_is_no_line_of_cycles() {
        // 40 K up in 4800 s, 1200 s of rest, and down again
        let cycles = |t: f64| {
            let (up, down) = (t.rem_euclid(12_000.0) / 4800.0, (t.rem_euclid(12_000.0) - 6000.0) / 4800.0);
            20.0 + 40.0 * (up.min(1.0) - down.clamp(0.0, 1.0))
        };
        let wave = |t: f64| (std::f64::consts::TAU * t / PERIOD + 1.0).sin();
        assert!(beside(wave, cycles).1);
        for phase in 0..8 {
            let (line, goes_on) = beside(|t| 2.0 * wave(cycles(t) / (40.0 / 4800.0) + 50.0 * f64::from(phase)), cycles);
            assert!(!goes_on, "{line:?}");
        }
    }

    /// A ramp, or ramps to and fro, of 40 K; one of 0.2 K makes no ripple.
    #[test]
    fn ramps_without_rest_tell_no_line_from_a_ripple() {
        let end = 30.0 * ROWS as f64;
        let wave = |t: f64| (std::f64::consts::TAU * t / PERIOD + 1.0).sin();
        assert!(!beside(wave, |t| 20.0 + 40.0 * t / end).1 && !beside(wave, |t| 60.0 - 40.0 * t / end).1);
        assert!(!beside(wave, |t| 20.0 + (t.rem_euclid(9000.0) - 4500.0).abs() / 120.0).1);
        assert!(beside(wave, |t| 20.0 + 0.2 * t / end).1 && beside(wave, |t| 20.0 + 40.0 * (6.0 * t / end).sin()).1);
    }
}
