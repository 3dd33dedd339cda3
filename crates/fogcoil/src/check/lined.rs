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

/// Parts of a record in which a line is compared with that of the whole, and the share of its amplitude by which it may differ there.
const PARTS: f64 = 4.0;
const ALIKE: f64 = 0.5;
/// Least change \[K\] of a ramp, and share of all that a course goes which is its change, from which it is nothing but a ramp.
const FEWEST_KELVIN: f64 = 1.0;
const ONE_WAY: f64 = 0.9;

/// A line of the rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateLine {
    /// The line itself \[deg/h\].
    pub line: Line,
    /// The temperature that has it, too.
    pub of: Option<&'static str>,
    /// Whether it is the same in every quarter of the record, and where the temperature falls, rests and rises.
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
    let is_ramp = course.is_some_and(is_ramp);
    lines
        .into_iter()
        .map(|line| RateLine { line, of: has(&line), is_steady: !is_ramp && goes_on(&line, time, rest, course) })
        .collect()
}

/// Whether a course is one ramp, in which a ripple over temperature is a line over time.
fn is_ramp(course: &[f64]) -> bool {
    let travel: f64 = course.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    let net = course.last().zip(course.first()).map_or(0.0, |(last, first)| (last - first).abs());
    net > FEWEST_KELVIN && net > ONE_WAY * travel
}

/// Whether a line is the same in every quarter of a series, of which `rest` is what it leaves, and where the temperature falls, rests and rises.
fn goes_on(line: &Line, time: &[f64], rest: &[f64], course: Option<&[f64]>) -> bool {
    let (start, length) = (time[0], time[time.len() - 1] - time[0]);
    let quarter = |row: usize| (PARTS * (time[row] - start) / length).floor().min(PARTS - 1.0) as usize;
    let goes_on = |rows: &[usize]| {
        let left = line.left(rows.iter().map(|row| (&time[*row], &rest[*row])));
        left.is_some_and(|left| left < ALIKE * line.amplitude())
    };
    let used: Vec<usize> = (0..time.len()).filter(|row| rest[*row].is_finite()).collect();
    let parts = (0..PARTS as usize).map(|n| used.iter().copied().filter(|row| quarter(*row) == n).collect::<Vec<_>>());
    let paces = course.map_or_else(Vec::new, |course| by_pace(time, course, &used));
    parts.chain(paces).all(|rows| goes_on(&rows))
}

/// The rows of those in use in which a temperature falls, rests and rises: the latter by less than a part of its fastest pace. Too few are left out, as a
/// line is not told in them.
fn by_pace(time: &[f64], course: &[f64], used: &[usize]) -> Vec<Vec<usize>> {
    let pace = |row: usize| {
        let ends = [row.saturating_sub(1), (row + 1).min(time.len() - 1)];
        (course[ends[1]] - course[ends[0]]) / (time[ends[1]] - time[ends[0]])
    };
    let fastest = used.iter().map(|row| pace(*row).abs()).fold(0.0, f64::max);
    let way = |row: usize| (pace(row) / fastest * PARTS).clamp(-1.0, 1.0).trunc();
    let ways = [-1.0, 0.0, 1.0].map(|one| used.iter().copied().filter(|row| way(*row) == one).collect::<Vec<_>>());
    ways.into_iter().filter(|rows| rows.len() as f64 * 2.0 * PARTS > used.len() as f64).collect()
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
        goes_on_beside(of, |_| 20.0)
    }

    /// The same where the temperature has a course.
    fn goes_on_beside(of: impl Fn(f64) -> f64, course: impl Fn(f64) -> f64) -> bool {
        let time: Vec<f64> = (0..ROWS).map(|n| 30.0 * n as f64).collect();
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1_u32 << 24) - 0.5
        };
        let values: Vec<f64> = time.iter().map(|t| of(*t) + noise()).collect();
        let line = strongest(&time, &values, &values).expect("a line");
        assert!((line.period / PERIOD - 1.0).abs() < 0.02, "{line:?}");
        let mut rest = values;
        take_off(&line, &time, &mut rest);
        let course: Vec<f64> = time.iter().map(|t| course(*t)).collect();
        goes_on(&line, &time, &rest, Some(&course))
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
            20.0 + 40.0 * (t.rem_euclid(12_000.0) / 4800.0).min(1.0)
                - 40.0 * ((t.rem_euclid(12_000.0) - 6000.0) / 4800.0).clamp(0.0, 1.0)
        };
        let saw = |t: f64| 20.0 + (t.rem_euclid(9000.0) - 4500.0).abs() / 120.0;
        let wave = |t: f64| (std::f64::consts::TAU * t / PERIOD + 1.0).sin();
        for course in [&cycles as &dyn Fn(f64) -> f64, &saw] {
            let pace = (course(60.0) - course(0.0)).abs() / 60.0;
            assert!(goes_on_beside(wave, course));
            assert!(!goes_on_beside(|t| 2.0 * wave(course(t) / pace), course));
        }
    }

    #[test]
    fn one_ramp_alone_tells_no_line_from_a_ripple() {
        let course = |of: fn(f64) -> f64| (0..ROWS).map(|n| of(n as f64 / ROWS as f64)).collect::<Vec<_>>();
        assert!(is_ramp(&course(|x| 20.0 + 40.0 * x)) && is_ramp(&course(|x| 60.0 - 40.0 * x)));
        assert!(!is_ramp(&course(|x| 20.0 + 40.0 * (6.0 * x).sin())) && !is_ramp(&course(|x| 20.0 + 0.2 * x)));
    }
}
