//! How slowly a second thermometer follows the first.
//!
//! All parts of a body that conducts heat settle with the same time constants, in shares of their own (Carslaw and Jaeger 1959). A thermometer tells its longest
//! one far better than a channel with noise and a bias over temperature does.

use super::input::Input;
use crate::Error;
use crate::lag::lagging;
use crate::noise::{NoiseModel, Series, residual};

/// Time constants are tried from this share of the longest one that ramps and rests let settle, up to so many times that, or to the longest rest.
const FROM: f64 = 0.25;
const TO: f64 = 4.0;
/// Steps of them in an octave.
const STEPS: i32 = 8;
/// Thirds of two steps by which a minimum is found: to a twentieth of a per cent.
const THIRDS: usize = 15;
/// Below each time constant stand halves of it, so many in all, none shorter than this share of an interval.
const HALVES: i32 = 6;
const SHORTEST: f64 = 0.25;
/// Largest sum of squares at a minimum beside the least of all: twice its root.
const ENOUGH: f64 = 4.0;

/// Slowness of a thermometer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Slowest {
    /// It settles with this time constant, or a shorter one \[s\].
    Of(f64),
    /// More slowly than any that was tried.
    Beyond,
}

/// The longest time constant with which the seat follows the drive, about a `longest` one \[s\], `rest` being the longest rest \[s\]: of sets that go down from a time constant by halves, the first one
/// that follows it better than its neighbours do.
///
/// # Errors
/// As [`crate::noise::identify`].
pub(super) fn slowest(input: &Input, longest: f64, rest: f64) -> Result<Slowest, Error> {
    let octaves = (TO.max(rest / longest) / FROM).log2().ceil() as i32;
    let tried: Vec<f64> = (0..=STEPS * octaves).map(|n| longest * FROM * 2.0_f64.powf(f64::from(n) / f64::from(STEPS))).collect();
    let squares = tried.iter().map(|first| left(input, *first)).collect::<Result<Vec<f64>, _>>()?;
    let least = squares.iter().copied().fold(f64::INFINITY, f64::min);
    for n in minima(&squares) {
        let (first, squares) = if squares[n] > ENOUGH * least { lowest(input, tried[n])? } else { (tried[n], squares[n]) };
        if squares <= ENOUGH * least {
            return Ok(if n + 1 < tried.len() { Slowest::Of(first) } else { Slowest::Beyond });
        }
    }
    Ok(Slowest::Beyond)
}

/// Numbers of those that are no larger than their neighbours.
fn minima(squares: &[f64]) -> Vec<usize> {
    let at = |n: Option<usize>| n.and_then(|n| squares.get(n)).copied().unwrap_or(f64::INFINITY);
    (0..squares.len()).filter(|&n| squares[n] <= at(n.checked_sub(1)) && squares[n] <= at(Some(n + 1))).collect()
}

/// The time constant within a step of another that leaves least, and what it leaves: by thirds.
fn lowest(input: &Input, about: f64) -> Result<(f64, f64), Error> {
    let step = 2.0_f64.powf(1.0 / f64::from(STEPS));
    let [mut low, mut high] = [about / step, about * step];
    for _ in 0..THIRDS {
        let third = (high / low).cbrt();
        if left(input, low * third)? < left(input, high / third)? { high /= third } else { low *= third }
    }
    let middle = (low * high).sqrt();
    Ok((middle, left(input, middle)?))
}

/// What a set that begins at a time constant leaves of the seat: a sum of squares.
fn left(input: &Input, first: f64) -> Result<f64, Error> {
    let shortest = SHORTEST * input.interval;
    let lags: Vec<f64> = (0..HALVES).map(|n| first / 2.0_f64.powi(n)).filter(|lag| *lag >= shortest).collect();
    let start = input.time[0];
    let mut columns = vec![vec![1.0; input.time.len()], input.drive.to_vec()];
    columns.extend(lags.iter().map(|lag| lagging(input.time, input.drive, *lag)));
    // the state in which the record begins is not known
    columns.extend(lags.iter().map(|lag| input.time.iter().map(|t| (-(t - start) / lag).exp()).collect()));
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mask = vec![true; input.time.len()];
    let series = Series { time: input.time, values: input.seat, mask: &mask, columns: &columns };
    let left = residual(&series, &NoiseModel::white(1.0, input.averaging))?;
    Ok(left.iter().map(|value| value * value).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minima_are_no_larger_than_their_neighbours() {
        assert_eq!(minima(&[9.0, 5.0, 2.0, 6.0, 1.0, 3.0]), [2, 4]);
        assert_eq!((minima(&[1.0, 1.1, 1.2]), minima(&[3.0, 2.0, 1.0])), (vec![0], vec![2]));
    }

    const INTERVAL: f64 = 20.0;

    /// Instants, and a drive that rises over a ramp between rests.
    fn course() -> [Vec<f64>; 2] {
        let time: Vec<f64> = (0..120).map(|n| INTERVAL * f64::from(n)).collect();
        let drive = time.iter().map(|t| 0.01 * (t - 300.0).clamp(0.0, 1000.0)).collect();
        [time, drive]
    }

    /// A seat that follows a drive with one time constant.
    fn following(time: &[f64], drive: &[f64], lag: f64) -> Vec<f64> {
        drive.iter().zip(lagging(time, drive, lag)).map(|(drive, behind)| drive - behind).collect()
    }

    fn input<'a>(time: &'a [f64], drive: &'a [f64], seat: &'a [f64]) -> Input<'a> {
        Input { time, values: seat, mask: &[], drive, reading: [0.0; 2], seat, interval: INTERVAL, averaging: INTERVAL }
    }

    /// A seat that follows the drive over a ramp with one time constant: it is found between two that are tried, and none farther away than a step.
    #[test]
    fn exact_a_time_constant_is_found_within_a_step() {
        const LAG: f64 = 43.0;
        let [time, drive] = course();
        let seat = following(&time, &drive, LAG);
        let input = &input(&time, &drive, &seat);
        let found = |steps: f64| lowest(input, LAG * 2.0_f64.powf(steps / f64::from(STEPS))).expect("a minimum");
        for steps in [-0.9, -0.55, -0.2, 0.0, 0.3, 0.6, 0.95] {
            let (lag, squares) = found(steps);
            assert!((lag / LAG - 1.0).abs() < 5e-4, "{steps}: {lag}");
            assert_eq!(squares, left(input, lag).unwrap());
        }
        for (steps, nearest) in [(-3.0, -2.0), (3.0, 2.0)] {
            let (lag, squares) = found(steps);
            assert!(((lag / LAG).log2() * f64::from(STEPS) - nearest).abs() < 5e-3, "{steps}: {lag}");
            assert_eq!(squares, left(input, lag).unwrap());
        }
    }

    /// The longest that is tried is four times the longest that settles, or the longest rest.
    #[test]
    fn exact_a_time_constant_is_found_between_those_that_are_tried() {
        const LAG: f64 = 43.0;
        let [time, drive] = course();
        let seat = following(&time, &drive, LAG);
        for (longest, rest) in [(35.0, 0.0), (80.0, 0.0), (6.2, 200.0)] {
            let found = slowest(&input(&time, &drive, &seat), longest, rest).unwrap();
            assert!(matches!(found, Slowest::Of(lag) if (lag / LAG - 1.0).abs() < 5e-4), "{longest}, {rest}: {found:?}");
        }
        assert_eq!(slowest(&input(&time, &drive, &seat), 5.0, 0.0).unwrap(), Slowest::Beyond);
    }

    /// A seat that stands still follows with any time constant, the first of which is taken as it is.
    #[test]
    fn exact_a_seat_that_stands_still_is_not_slow() {
        let [time, drive] = course();
        let seat = vec![0.0; time.len()];
        assert_eq!(slowest(&input(&time, &drive, &seat), 80.0, 0.0).unwrap(), Slowest::Of(80.0 * FROM));
    }

    /// Halves of a time constant down to a quarter of an interval: the seat follows with one of them, or with one that is shorter.
    #[test]
    fn exact_time_constants_of_a_set_are_no_shorter_than_a_quarter_of_an_interval() {
        const FIRST: f64 = 43.0;
        let [time, drive] = course();
        for (halves, is_left) in [(0, false), (1, false), (2, false), (3, false), (4, true)] {
            let seat = following(&time, &drive, FIRST / 2.0_f64.powi(halves));
            let squares = left(&input(&time, &drive, &seat), FIRST).unwrap();
            assert_eq!(squares > 1e-20, is_left, "{halves}: {squares}");
        }
    }

    /// A seat that settles from another temperature while the record begins, at whatever instant that is.
    #[test]
    fn exact_a_record_may_begin_at_any_instant_while_a_seat_settles() {
        const LAG: f64 = 400.0;
        let [mut time, drive] = course();
        let seat: Vec<f64> = time.iter().map(|t| 3.0 * (-t / LAG).exp()).collect();
        for origin in [0.0, 1e6, -1e6] {
            time.iter_mut().enumerate().for_each(|(n, t)| *t = origin + INTERVAL * n as f64);
            let squares = left(&input(&time, &drive, &seat), LAG).unwrap();
            assert!(squares < 1e-20, "{origin}: {squares}");
        }
    }
}
