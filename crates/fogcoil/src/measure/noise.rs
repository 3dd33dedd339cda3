//! The scale of the noise, from what `check` identifies.

use recording::Seconds;
use recording::statistics::normal_quantile;

use super::figure::{Figure, Told, Untold};
use crate::check::{GyroNoise, NO_MAXIMUM, NO_WHITE};
use crate::table::significant;

/// Angle random walk \[deg/sqrt(h)\]; floor of the Allan deviation \[deg/h\] and its averaging time \[s\].
pub(super) struct Scale {
    pub(super) arw: Told,
    pub(super) floor: Told,
    pub(super) floor_time: Option<f64>,
}

pub(super) fn of(noise: Option<&GyroNoise>) -> Scale {
    let Some(noise) = noise else {
        let why = "the rate's noise cannot be identified: too few rows, or no noise".to_owned();
        return Scale { arw: Err(why.clone().into()), floor: Err(why.into()), floor_time: None };
    };
    let found = noise.floor();
    Scale { arw: arw(noise), floor: floor(noise, found), floor_time: found.map(|(tau, _)| tau) }
}

/// A positive number and the relative error of its logarithm, if that is known.
fn told(value: f64, error: Option<f64>) -> Told {
    let Some(error) = error else {
        return Err(Untold { why: format!("interval not known: {NO_MAXIMUM}"), value: Some(value) });
    };
    let factor = (normal_quantile(0.95) * error).exp();
    Ok(Figure { value, ci90: [value / factor, value * factor] })
}

fn arw(noise: &GyroNoise) -> Told {
    let mean = noise.estimate.model.angle_random_walk();
    mean.ok_or_else(|| "a rate is no mean over an interval".to_owned())?;
    let walk = noise.angle_random_walk().ok_or_else(|| NO_WHITE.to_owned())?;
    let told = told(walk, noise.estimate.standard_errors.white)?;
    Ok(Figure { ci90: widened(told.ci90, walk, noise.estimate.model.white, noise.neighbours), ..told })
}

/// Relative standard deviation of a standard deviation from fourth differences of so many rows, times their root: √(½ Σ ρ²) with ρ the correlations of the
/// differences of white noise, −56/70, 28/70, −8/70, 1/70; of second differences it is 0.99.
const BY_NEIGHBOURS: f64 = 1.15;

/// An interval that holds the white noise by fourth differences of neighbours, too: where temperature acts on the rate faster than its lags explain, or a
/// noisy thermometer tells it, the fitted model counts that as noise, and the two part.
fn widened([low, high]: [f64; 2], walk: f64, white: f64, neighbours: Option<(f64, usize)>) -> [f64; 2] {
    let Some((sd, rows)) = neighbours.filter(|_| white > 0.0) else { return [low, high] };
    let (other, share) = (walk * sd / white, normal_quantile(0.95) * BY_NEIGHBOURS / (rows as f64).sqrt());
    if (low..=high).contains(&other) { [low, high] } else { [low.min(other / (1.0 + share)), high.max(other * (1.0 + share))] }
}

fn floor(noise: &GyroNoise, found: Option<(f64, f64)>) -> Told {
    let [_, longest] = noise.ends();
    let model = &noise.estimate.model;
    let Some((tau, deviation)) = found else {
        return Err(Untold::from(format!(
            "the Allan deviation still falls at {} s, where it is {} deg/h: its floor is below that; record longer",
            Seconds(longest.round()),
            significant(model.allan_deviation(longest, noise.interval), 2)
        )));
    };
    // the floor is flat: at its averaging time the deviation changes as the floor does
    told(deviation, noise.estimate.relative_error(|model| model.allan_deviation(tau, noise.interval)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_holds_what_neighbours_tell_with_its_own_error() {
        let of = |sd: f64| widened([0.9, 1.1], 1.0, 2.0, Some((sd, 10_000)));
        assert_eq!(of(2.1), [0.9, 1.1]);
        assert_eq!(widened([0.9, 1.1], 1.0, 2.0, None), [0.9, 1.1]);
        let error = 1.0 + 1.645 * 0.0115;
        let [low, high] = of(1.6);
        assert!((low - 0.8 / error).abs() < 1e-4 && high == 1.1, "{low} {high}");
        let [low, high] = of(2.6);
        assert!(low == 0.9 && (high - 1.3 * error).abs() < 1e-4, "{low} {high}");
    }
}
