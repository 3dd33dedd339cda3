//! Jumps of the chamber's readings that the spool does not follow: its thermometer jumped, or its channel, and not the air.

use diagnosis::{ForwardModel, expected};
use files::{Note, Remark};
use mechanisms::{Gyro, SPOOL as SPOOL_CHANNEL, thermometer_under};
use nalgebra::{DMatrix, DVector};
use recording::Seconds;
use recording::check::white_noise;

use super::as_drawn::{as_well, spread};
use crate::input::{CHAMBER, SPOOL};
use crate::jumps::{Jump, jumps};
use crate::prepare::Record;
use crate::table::significant;

/// Shares of a jump that the spool leaves out where it leaves it out whole, and least share that the jumps explain of what the model leaves of the spool.
const WHOLE: [f64; 2] = [0.75, 1.25];
const EXPLAINS: f64 = 0.5;
/// Largest part of the spool's own course that is left without the jumps.
pub(super) const FOLLOWS: f64 = 0.3;
/// Part of a jump up to which the answer of the spool to it is watched where the readings are not the air's behind it: later these differ by more than the jump.
const WATCHED: f64 = 0.5;

/// Jumps that the spool leaves out whole, and what is left of it without them \[K\], rms. `responses` are those of the spool to each jump; `left` is what the
/// model leaves of it, with white `noise`, and its `own` course \[K\], rms; `slopes` are what a standard deviation of each of the model's constants changes there.
/// `None` where such jumps explain little of what the constants alone leave.
fn missing(left: &[f64], [noise, own]: [f64; 2], slopes: &[Vec<f64>], responses: &[Vec<f64>]) -> Option<(Vec<bool>, f64)> {
    let rows: Vec<usize> = (0..left.len()).filter(|&n| left[n].is_finite()).collect();
    // less its mean: offsets are free; a constant that moves by one standard deviation costs as much as a row that is off by its noise
    let stacked = |series: &[f64], constant: Option<usize>| -> DVector<f64> {
        let mean = rows.iter().map(|&n| series[n]).sum::<f64>() / rows.len().max(1) as f64;
        let costs = (0..slopes.len()).map(|k| if constant == Some(k) { noise } else { 0.0 });
        DVector::from_iterator(rows.len() + slopes.len(), rows.iter().map(|&n| series[n] - mean).chain(costs))
    };
    let slopes: Vec<DVector<f64>> = slopes.iter().enumerate().map(|(k, slope)| stacked(slope, Some(k))).collect();
    let responses: Vec<DVector<f64>> = responses.iter().map(|response| stacked(response, None)).collect();
    let residual = stacked(left, None);
    let fitted = |columns: &[DVector<f64>], to: &DVector<f64>| -> Option<(DVector<f64>, f64)> {
        if columns.is_empty() {
            return Some((DVector::zeros(0), to.norm_squared()));
        }
        let matrix = DMatrix::from_columns(columns);
        let found = matrix.clone().svd(true, true).solve(to, 1e-9).ok()?;
        let left = (to - matrix * &found).norm_squared();
        Some((found, left))
    };
    let (shares, _) = fitted(&[&responses[..], &slopes].concat(), &-&residual)?;
    let whole: Vec<bool> = shares.iter().take(responses.len()).map(|share| (WHOLE[0]..WHOLE[1]).contains(share)).collect();
    let without = responses.iter().zip(&whole).filter(|(_, whole)| **whole).fold(residual.clone(), |sum, (r, _)| sum + r);
    let ((_, as_read), (_, without)) = (fitted(&slopes, &residual)?, fitted(&slopes, &without)?);
    let would = (without / rows.len().max(1) as f64).sqrt();
    // a thermometer that follows nothing does not tell; one that follows the rest does
    let told = whole.contains(&true) && without <= (1.0 - EXPLAINS) * as_read && would < FOLLOWS * own;
    told.then_some((whole, would))
}

/// What is left of the spool before the largest part of a jump would have reached it, none later; `response` is that of the spool to the jump.
fn watched(left: &[f64], response: &[f64], jump: &Jump) -> Vec<f64> {
    let end = response.iter().position(|answer| answer.abs() > WATCHED * jump.by.abs()).unwrap_or(left.len());
    left.iter().enumerate().map(|(n, left)| if n < end { *left } else { f64::NAN }).collect()
}

/// The warning of the largest jump that the spool does not follow, if there is one: in the record of this `number` in `gyro`, the design as it is, which
/// predicts so much of the spool. What the answer leaves less of, `answered`, rms \[K\], is no mistake.
pub(super) fn warning(
    gyro: &Gyro,
    number: usize,
    record: &Record,
    predicted: &[f64],
    answered: Option<f64>,
) -> Result<Option<Note>, coil::Error> {
    let (time, chamber, spool) = (&record.observed.time, &record.chamber, &record.observed.channels[SPOOL_CHANNEL]);
    let used: Vec<bool> = spool.iter().map(|value| value.is_finite()).collect();
    let (jumps, noise) = (jumps(time, chamber), white_noise(time, spool, &used));
    let Some(noise) = noise.filter(|_| !jumps.is_empty()) else { return Ok(None) };
    let as_read = thermometer_under(gyro.library(), time, chamber)?;
    let response = |jump: &Jump| -> Result<Vec<f64>, coil::Error> {
        let without: Vec<f64> = chamber.iter().enumerate().map(|(n, c)| if n < jump.row { *c } else { c - jump.by }).collect();
        Ok(thermometer_under(gyro.library(), time, &without)?
            .iter()
            .zip(&as_read)
            .map(|(without, with)| with - without)
            .collect())
    };
    let responses = jumps.iter().map(response).collect::<Result<Vec<_>, _>>()?;
    let middle = expected(gyro.nuisances());
    let slope = |k: usize| -> Result<Vec<f64>, coil::Error> {
        let mut moved = middle.clone();
        moved[k] = gyro.nuisances()[k].parameter.prior.value(1.0);
        let moved = gyro.respond(number, &moved, &[])?.swap_remove(SPOOL_CHANNEL);
        Ok(moved.iter().zip(predicted).map(|(moved, predicted)| moved - predicted).collect())
    };
    let slopes = (0..middle.len()).map(slope).collect::<Result<Vec<_>, _>>()?;
    let left: Vec<f64> = spool.iter().zip(predicted).map(|(read, predicted)| read - predicted).collect();
    let own = spread(spool, &vec![0.0; spool.len()], 1.0);
    let is_mistake = |(_, would): &(Vec<bool>, f64)| as_well(*would, answered);
    let told = missing(&left, [noise, own], &slopes, &responses).filter(is_mistake);
    let mut told =
        told.into_iter().flat_map(|(whole, _)| jumps.iter().zip(whole).filter(|(_, whole)| *whole)).map(|(jump, _)| jump);
    // a sensor that fell off reads anything later
    let fell = |(jump, response): &(&Jump, &Vec<f64>)| {
        let response = std::slice::from_ref(*response);
        missing(&watched(&left, &response[0], jump), [noise, own], &slopes, response).is_some_and(|found| is_mistake(&found))
    };
    let told = told.next().or_else(|| jumps.iter().zip(&responses).find(fell).map(|(jump, _)| jump));
    Ok(told.map(|jump| {
        let text = format!(
            "{CHAMBER} jumps by {} K at {} s, and {SPOOL} goes on as if it had not: its sensor seems to have moved, or its channel",
            significant(jump.by, 2),
            Seconds(time[jump.row])
        );
        Remark::ChamberJump.warning(text).at(&record.fingerprint.file)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jumps::tests::chamber;
    use mechanisms::lagged;

    #[test]
    fn the_spool_tells_whether_the_air_jumped() {
        let lag = |time: &[f64], c: &[f64]| lagged(time, c, 1800.0);
        let [time, jumped] = chamber(-0.7);
        let [_, sound] = chamber(0.0);
        let step: Vec<f64> = (0..600).map(|n| if n < 320 { 0.0 } else { -0.7 }).collect();
        let response = [lag(&time, &step)];
        // what a model of the coil leaves that is a tenth too slow, driven by what was read; a standard deviation of its time constant is half as much
        let model = |by: f64| lagged(&time, &jumped, by);
        let slope: Vec<f64> = model(1890.0).iter().zip(model(1800.0)).map(|(a, b)| a - b).collect();
        let noise = |n: usize| 0.02 * ((n * 7907 % 1000) as f64 / 1000.0 - 0.5);
        let left = |driven: &[f64]| -> Vec<f64> {
            lag(&time, driven).iter().zip(model(1980.0)).enumerate().map(|(n, (spool, model))| spool - model + noise(n)).collect()
        };
        let told = |left: &[f64]| missing(left, [0.006, 10.0], std::slice::from_ref(&slope), &response);
        let (whole, would) = told(&left(&sound)).expect("the air did not jump");
        assert!(whole == [true] && would < 0.02, "{would}");
        // a thermometer that lies outside moves by no more than is left
        assert_eq!(missing(&left(&sound), [0.006, 0.01], std::slice::from_ref(&slope), &response), None);
        assert_eq!(told(&left(&jumped)), None);
        // without what is known of the constants it could not be told
        assert_eq!(missing(&left(&sound), [0.006, 10.0], &[], &response), None);
        // half a jump is something else, and so is one that explains little
        let half: Vec<f64> = sound.iter().zip(&jumped).map(|(a, b)| (a + b) / 2.0).collect();
        assert_eq!(told(&left(&half)), None);
        // a sensor that fell off and then stands still, while the air goes on: its jump is told by the first that follows
        let fallen: Vec<f64> = jumped.iter().enumerate().map(|(n, c)| if n < 320 { *c } else { jumped[320] }).collect();
        let off: Vec<f64> =
            lag(&time, &sound).iter().zip(lag(&time, &fallen)).enumerate().map(|(n, (a, b))| a - b + noise(n)).collect();
        let jump = Jump { row: 320, by: -0.7, is_behind_gap: false };
        assert_eq!(missing(&off, [0.006, 10.0], std::slice::from_ref(&slope), &response), None);
        let seen = watched(&off, &response[0], &jump);
        assert!(seen.iter().filter(|left| left.is_finite()).count() > 330);
        assert!(missing(&seen, [0.006, 10.0], std::slice::from_ref(&slope), &response).is_some());
        let tilted: Vec<f64> = left(&sound).iter().zip(&time).map(|(r, t)| r + t / 10_000.0).collect();
        assert_eq!(told(&tilted), None);
    }
}
