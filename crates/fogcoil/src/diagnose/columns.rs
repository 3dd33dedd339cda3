//! Records whose columns are exchanged, or whose rate has the other sign: what a mechanism would hardly do, and a mistake does.

use diagnosis::{ForwardModel, Observation, expected};
use files::{Note, Remark};
use mechanisms::{Gyro, RATE as RATE_CHANNEL, SPOOL as SPOOL_CHANNEL, thermometer_under};

use crate::input::{CHAMBER, RATE, SPOOL};
use crate::prepare::Record;
use crate::table::significant;

/// Least ratio of the residual with the columns as they are to the residual with the suspected columns at which the suspicion is reported.
const SUSPECT: f64 = 4.0;
/// The same for the rate's sign: beside the thermal bias there is noise.
const REVERSED: f64 = 2.5;
/// Largest ratio of what a mistake leaves to what the answer leaves at which the mistake explains as much: it does so with nothing fitted, so that a
/// tail of metres that turns the rate about, and leaves as little, is no rival.
const AS_WELL: f64 = 1.1;
/// Root mean square of the nominal model's residual of the thermometer below which no column is suspected \[K\].
const FAIR_K: f64 = 0.5;

/// The warning about a record, if there is one: `number` is its number in `gyro`, the design as it is, and `answered` what the answer leaves of
/// each channel, rms. What the answer explains better is no mistake; without an explanation nothing is answered.
pub(super) fn warning(
    gyro: &Gyro,
    number: usize,
    record: &Record,
    answered: Option<&[f64]>,
) -> Result<Option<Note>, coil::Error> {
    let explains_more = |would: f64, channel: usize| answered.is_none_or(|answered| would < AS_WELL * answered[channel]);
    let predicted = gyro.respond(number, &expected(gyro.nuisances()), &[])?;
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
            if SUSPECT * would < left && explains_more(would, SPOOL_CHANNEL) {
                let [left, would] = [left, would].map(|k| significant(k, 2));
                let text = format!(
                    "{columns} seem to be exchanged: the model leaves {left} K rms of the thermometer as it stands, {would} K with \
                     them exchanged; check the header or --column"
                );
                return Ok(Some(Remark::ExchangedColumns.warning(text).at(&record.fingerprint.file)));
            }
        }
    }
    let [left, would] = [1.0, -1.0].map(|sign| spread(rate, &predicted[RATE_CHANNEL], sign));
    Ok((REVERSED * would < left && explains_more(would, RATE_CHANNEL)).then(|| {
        let [left, would] = [left, would].map(|r| significant(r, 2));
        let text = format!(
            "{RATE} seems to have the other sign: the nominal model leaves {left} deg/h rms as it stands, {would} with the rate \
             negated; check the sense of the gyro's axis and cw_climbs"
        );
        Remark::ReversedRate.warning(text).at(&record.fingerprint.file)
    }))
}

/// Standard deviation of what is recorded less `sign` times what is predicted; 0 where nothing is recorded.
fn spread(recorded: &[f64], predicted: &[f64], sign: f64) -> f64 {
    let left: Vec<f64> = recorded.iter().zip(predicted).map(|(y, p)| y - sign * p).filter(|r| r.is_finite()).collect();
    let count = left.len().max(1) as f64;
    let mean = left.iter().sum::<f64>() / count;
    (left.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / count).sqrt()
}
