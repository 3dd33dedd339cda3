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

/// A line of the rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateLine {
    /// The line itself \[deg/h\].
    pub line: Line,
    /// The temperature that has it, too.
    pub of: Option<&'static str>,
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

/// Lines with the temperature that has them, too.
pub(super) fn of(lines: Vec<Line>, time: &[f64], temperature: Option<(&'static str, &[f64])>) -> Vec<RateLine> {
    let has = |line: &Line| temperature.filter(|(_, values)| has_line(time, values, line.period)).map(|(name, _)| name);
    lines.into_iter().map(|line| RateLine { line, of: has(&line) }).collect()
}

/// A warning of the lines.
pub(super) fn lined(lines: &[RateLine]) -> Option<Note> {
    let most = lines.iter().max_by(|a, b| a.line.amplitude().total_cmp(&b.line.amplitude()))?;
    let others = match lines.len() {
        1 => String::new(),
        2 => ", and another".into(),
        more => format!(", and {} others", more - 1),
    };
    let source = most.of.map_or("hum or vibration, perhaps a faster one that rows fold".to_owned(), |name| {
        format!("{name} has it, too, so that the chamber may make it")
    });
    Some(Remark::Line.warning(format!(
        "{RATE} has a line with a period of {} s and an amplitude of {} deg/h{others}: {source}; kept out of the noise",
        Seconds((most.line.period * 1e3).round() / 1e3),
        significant(most.line.amplitude(), 2)
    )))
}
