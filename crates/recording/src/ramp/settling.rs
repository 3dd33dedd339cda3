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

    /// A seat that follows the drive over a ramp with one time constant: it is found between two that are tried, and none farther away than a step.
    #[test]
    fn exact_a_time_constant_is_found_within_a_step() {
        const LAG: f64 = 43.0;
        let time: Vec<f64> = (0..120).map(|n| 20.0 * f64::from(n)).collect();
        let drive: Vec<f64> = time.iter().map(|t| 0.01 * (t - 300.0).clamp(0.0, 1000.0)).collect();
        let behind = lagging(&time, &drive, LAG);
        let seat: Vec<f64> = drive.iter().zip(&behind).map(|(drive, behind)| drive - behind).collect();
        let mask = vec![true; time.len()];
        let [time, drive, seat] = [&time, &drive, &seat].map(Vec::as_slice);
        let input = &Input { time, values: seat, mask: &mask, drive, reading: [0.0; 2], seat, interval: 20.0, averaging: 20.0 };
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
}
