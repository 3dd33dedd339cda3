//! The scale of the noise, from what `check` identifies.

use bias::units::S_PER_H;
use recording::Seconds;
use recording::statistics::normal_quantile;

use super::figure::{Figure, Told};
use crate::check::GyroNoise;
use crate::table::significant;

/// Angle random walk \[deg/sqrt(h)\]; floor of the Allan deviation \[deg/h\] and its averaging time \[s\].
pub(super) struct Scale {
    pub(super) arw: Told,
    pub(super) floor: Result<(Figure, f64), String>,
}

const NO_MAXIMUM: &str = "the likelihood of the noise has no maximum within its bounds; record longer, at one temperature";

pub(super) fn of(noise: Option<&GyroNoise>) -> Scale {
    let Some(noise) = noise else {
        let why = "the rate's noise cannot be identified: too few rows, or no noise".to_owned();
        return Scale { arw: Err(why.clone()), floor: Err(why) };
    };
    Scale { arw: arw(noise), floor: floor(noise) }
}

/// A positive number and the relative error of its logarithm.
fn figure(value: f64, error: f64) -> Figure {
    let factor = (normal_quantile(0.95) * error).exp();
    Figure { value, ci90: [value / factor, value * factor] }
}

fn arw(noise: &GyroNoise) -> Told {
    let per_root_second = noise.estimate.model.angle_random_walk().ok_or("a rate is no mean over an interval")?;
    let error = noise.estimate.standard_errors.white.ok_or(NO_MAXIMUM)?;
    Ok(figure(per_root_second / S_PER_H.sqrt(), error))
}

fn floor(noise: &GyroNoise) -> Result<(Figure, f64), String> {
    let longest = noise.allan.last().map_or(noise.interval, |point| point.tau);
    let ends = [noise.interval, longest];
    let model = &noise.estimate.model;
    let Some((tau, deviation)) = model.floor(ends, noise.interval) else {
        return Err(format!(
            "the Allan deviation still falls at {} s, where it is {} deg/h: its floor is below that; record longer",
            Seconds(longest.round()),
            significant(model.allan_deviation(longest, noise.interval), 2)
        ));
    };
    // the floor is flat: at its averaging time the deviation changes as the floor does
    let error = noise.estimate.relative_error(|model| model.allan_deviation(tau, noise.interval)).ok_or(NO_MAXIMUM)?;
    Ok((figure(deviation, error), tau))
}
