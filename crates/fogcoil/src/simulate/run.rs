//! Profiles as they are run.

use std::borrow::Cow;

use bias::Bias;
use coil::{Dynamics, Profile, Response};

use crate::Error;
use crate::input::ProfileCase;

/// Temperatures between which a chamber is believed \[°C\].
pub(super) const ABSOLUTE_ZERO_C: f64 = -273.15;
pub(super) const HOTTEST_C: f64 = 1000.0;

/// Whether a temperature lies between them.
pub(super) fn is_possible(celsius: f64) -> bool {
    (ABSOLUTE_ZERO_C..=HOTTEST_C).contains(&celsius)
}

/// A profile's responses at its rows.
pub(super) fn run(dynamics: &Dynamics, profile: &ProfileCase) -> Result<Vec<Response>, Error> {
    let file = &profile.fingerprint.file;
    let responses = by_row(dynamics.simulate(&course(profile)).map_err(Error::of_coil(file))?, profile.between.parts());
    match responses.iter().position(|r| !(r.sensor.is_finite() && r.rate().is_finite())) {
        Some(row) => Err(Error::NotFinite { file: file.clone(), time: profile.profile.time[row] }),
        None => Ok(responses),
    }
}

/// A profile as it is run: divided where it is a cubic between its rows.
pub(super) fn course(profile: &ProfileCase) -> Cow<'_, Profile> {
    match profile.between.parts() {
        1 => Cow::Borrowed(&profile.profile),
        parts => Cow::Owned(profile.profile.smoothed(parts)),
    }
}

/// Responses at the rows of a course that was divided into `parts` between each two: the means of a row are those of its parts.
fn by_row(responses: Vec<Response>, parts: usize) -> Vec<Response> {
    if parts == 1 {
        return responses;
    }
    let mean = |part: &[Response]| {
        let share = 1.0 / part.len() as f64;
        let bias = part.iter().fold(Bias::ZERO, |sum, r| sum + r.bias) * share;
        let read_out = part.iter().map(|r| r.read_out).sum::<f64>() * share;
        Response { bias, read_out, ..part[part.len() - 1] }
    };
    responses[..1].iter().copied().chain(responses[1..].chunks(parts).map(mean)).collect()
}
