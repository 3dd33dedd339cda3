//! Records whose columns are exchanged, whose thermometer came loose or jumped, or whose rate has the other sign or another unit: what a mechanism would hardly do, and a mistake does.

use diagnosis::Observation;
use files::{Note, Remark};
use mechanisms::{Gyro, RATE as RATE_CHANNEL, SPOOL as SPOOL_CHANNEL, thermometer_under};
use recording::check::Unit;

use super::as_drawn::{AsDrawn, TOLERATED, as_well, spread};
use super::jumped::{self, FOLLOWS};
use super::loose::Loose;
use crate::input::{CHAMBER, RATE, SPOOL};
use crate::prepare::Record;
use crate::rate_unit::{how_far, suspected};
use crate::table::significant;

/// Least ratio of the residual with the columns as they are to the residual with the suspected columns at which the suspicion is reported.
const SUSPECT: f64 = 4.0;
/// The same for the rate's sign, and of what is predicted to what its other unit leaves: beside the thermal bias there is noise.
const REVERSED: f64 = 2.5;
/// Root mean square of the nominal model's residual of the thermometer below which no column is suspected \[K\].
const FAIR_K: f64 = 0.5;

/// The warnings about a record: `number` is its number in `gyro`, the design as it is, and `answered` what the answer leaves of
/// each channel, rms. What the answer explains better is no mistake; without an explanation nothing is answered.
pub(super) fn warning(gyro: &Gyro, number: usize, record: &Record, answered: Option<&[f64]>) -> Result<Vec<Note>, coil::Error> {
    let answered = |channel: usize| answered.map(|answered| answered[channel]);
    let drawn = AsDrawn::of(gyro, number)?;
    let predicted = &drawn.predicted;
    let Observation { time, channels } = &record.observed;
    let (spool, rate) = (&channels[SPOOL_CHANNEL], &channels[RATE_CHANNEL]);
    let left = spread(spool, &predicted[SPOOL_CHANNEL], 1.0);
    if left > FAIR_K {
        let exchanged = [
            (format!("{SPOOL} and {RATE}"), &record.chamber, rate),
            (format!("{CHAMBER} and {SPOOL}"), spool, &record.chamber),
            (format!("{CHAMBER} and {RATE}"), rate, spool),
        ];
        for (columns, chamber, thermometer) in exchanged {
            let would = spread(thermometer, &thermometer_under(gyro.library(), time, chamber)?, 1.0);
            // what the model hardly follows with them exchanged is not exchanged
            let follows = would < FOLLOWS * spread(thermometer, &vec![0.0; time.len()], 1.0);
            if SUSPECT * would < left && follows && as_well(would, answered(SPOOL_CHANNEL)) {
                let [left, would] = [left, would].map(|k| significant(k, 2));
                let text = format!(
                    "{columns} seem to be exchanged: the model leaves {left} K rms of the thermometer as it stands, {would} K with \
                     them exchanged; check the header or --column"
                );
                return Ok(vec![Remark::ExchangedColumns.warning(text).at(&record.fingerprint.file)]);
            }
        }
        let loose = Loose::found(time, spool, &predicted[SPOOL_CHANNEL], &record.chamber);
        if let Some(loose) = loose.filter(|loose| as_well(loose.would, answered(SPOOL_CHANNEL))) {
            return Ok(vec![loose.warning(left).at(&record.fingerprint.file)]);
        }
    }
    let jumped = jumped::warning(gyro, number, record, &predicted[SPOOL_CHANNEL], answered(SPOOL_CHANNEL))?;
    let [left, would] = [1.0, -1.0].map(|sign| spread(rate, &predicted[RATE_CHANNEL], sign));
    // of a design that nearly cancels, tolerances turn the sign about
    let has_a_sign = spread(&predicted[RATE_CHANNEL], &predicted[RATE_CHANNEL], 0.0) > TOLERATED * drawn.tolerated[RATE_CHANNEL];
    let as_much = as_well(would, answered(RATE_CHANNEL))
        || has_a_sign && drawn.explains_as_much(RATE_CHANNEL, would, answered(RATE_CHANNEL));
    let reversed = (REVERSED * would < left && as_much).then(|| {
        let [left, would] = [left, would].map(|r| significant(r, 2));
        let text = format!(
            "{RATE} seems to have the other sign: the nominal model leaves {left} deg/h rms as it stands, {would} with the rate \
             negated; check the sense of the gyro's axis and cw_climbs"
        );
        Remark::ReversedRate.warning(text).at(&record.fingerprint.file)
    });
    let unit = other_unit(rate, &drawn, &record.rate_units, answered(RATE_CHANNEL));
    let unit = unit.map(|text| Remark::RateUnit.warning(text).at(&record.fingerprint.file));
    Ok(unit.into_iter().chain(jumped).chain(reversed).collect())
}

/// The words on a `rate` that is as the design predicts once it is taken to be in another unit, and far from that as it was read; `answered` is what the answer leaves of it.
fn other_unit(rate: &[f64], drawn: &AsDrawn, units: &[Unit], answered: Option<f64>) -> Option<String> {
    let predicted = &drawn.predicted[RATE_CHANNEL];
    // where nothing is predicted any unit agrees
    let there: Vec<f64> =
        predicted.iter().zip(rate).filter(|(_, rate)| rate.is_finite()).map(|(predicted, _)| *predicted).collect();
    let size = spread(&there, &there, 0.0);
    let would = |scale: f64| scale * spread(rate, predicted, 1.0 / scale);
    let agrees = |scale: f64| {
        REVERSED * would(scale) < size
            && drawn.explains_as_much(RATE_CHANNEL, would(scale), answered.map(|answered| scale * answered))
    };
    let unit = suspected(units, agrees).filter(|_| size > TOLERATED * drawn.tolerated[RATE_CHANNEL])?;
    let [size, would] = [size, would(unit.scale)].map(|r| significant(r, 2));
    let (name, how) = (&unit.name, how_far(unit.scale));
    Some(format!(
        "{RATE} seems to be in {name}: as it is read it is {how}, in {name} the nominal model leaves {would} deg/h rms of it, of {size} that it predicts; \
         give --unit rate={name}, or unit in the map file"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A course that is predicted, and the same in another unit with noise: the unit is told, unless what is predicted is within tolerances, or the answer leaves far
    /// less, or the record is as it is predicted.
    #[test]
    fn exact_a_rate_in_another_unit_is_told_by_its_size() {
        let course: Vec<f64> = (0..200).map(|n| (f64::from(n) / 20.0).sin()).collect();
        let drawn = |tolerated: f64| AsDrawn { predicted: vec![course.clone(); 2], tolerated: [tolerated; 2] };
        let units = [("deg/h", 1.0 / 3600.0), ("rad/s", 57.296), ("mdeg/s", 1e-3)];
        let units = units.map(|(name, scale)| Unit { name: name.into(), scale, offset: 0.0 });
        let of = |factor: f64, tolerated: f64, answered: Option<f64>| {
            let noise = |n: usize| if n.is_multiple_of(2) { 0.05 } else { -0.05 };
            let rate: Vec<f64> = course.iter().enumerate().map(|(n, r)| factor * (1.1 * r + noise(n)) + 7.0).collect();
            other_unit(&rate, &drawn(tolerated), &units, answered)
        };
        let said = of(1.0 / 57.296, 0.1, Some(0.05 / 57.296)).unwrap();
        assert!(said.starts_with("rate_deg_per_h seems to be in rad/s: as it is read it is 57.3 times too small"), "{said}");
        assert!(of(3600.0, 0.1, None).unwrap().contains("in deg/h: as it is read it is 3600 times too large"));
        // a rate at rest, whose size says nothing
        let rest: Vec<f64> = (0..200).map(|n| if n < 60 { 0.01 * f64::from(n % 2) } else { f64::NAN }).collect();
        let flat: Vec<f64> = course.iter().enumerate().map(|(n, r)| if n < 60 { 0.0 } else { *r }).collect();
        let resting = AsDrawn { predicted: vec![flat; 2], tolerated: [0.1; 2] };
        assert_eq!(other_unit(&rest, &resting, &units, Some(0.005)), None);
        assert_eq!(
            [of(1.0, 0.1, None), of(1.0 / 57.296, 0.5, None), of(1.0 / 57.296, 0.0, Some(0.0)), of(-1.0 / 57.296, 0.1, None)],
            [const { None }; 4]
        );
    }
}
