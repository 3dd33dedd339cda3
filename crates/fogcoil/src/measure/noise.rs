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

/// A number whose interval is not known.
fn not_known(value: f64) -> Untold {
    Untold { why: format!("interval not known: {NO_MAXIMUM}"), value: Some(value) }
}

/// A positive number and the relative error of its logarithm, if that is known.
fn told(value: f64, error: Option<f64>) -> Told {
    let error = error.ok_or_else(|| not_known(value))?;
    let factor = (normal_quantile(0.95) * error).exp();
    Ok(Figure { value, ci90: [value / factor, value * factor] })
}

fn arw(noise: &GyroNoise) -> Told {
    let mean = noise.estimate.model.angle_random_walk();
    mean.ok_or_else(|| "a rate is no mean over an interval".to_owned())?;
    let walk = noise.angle_random_walk().ok_or_else(|| NO_WHITE.to_owned())?;
    let ends = noise.white_ends(normal_quantile(0.95)).ok_or_else(|| not_known(walk))?;
    Ok(Figure { value: walk, ci90: ends.map(|end| walk * end) })
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
