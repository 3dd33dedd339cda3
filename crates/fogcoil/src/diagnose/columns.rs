//! Records whose columns are exchanged, whose thermometer came loose or jumped, or whose rate has the other sign: what a mechanism would hardly do, and a mistake does.

use diagnosis::Observation;
use files::{Note, Remark};
use mechanisms::{Gyro, RATE as RATE_CHANNEL, SPOOL as SPOOL_CHANNEL, thermometer_under};

use super::as_drawn::{AsDrawn, TOLERATED, as_well, spread};
use super::jumped;
use super::loose::Loose;
use crate::input::{CHAMBER, RATE, SPOOL};
use crate::prepare::Record;
use crate::table::significant;

/// Least ratio of the residual with the columns as they are to the residual with the suspected columns at which the suspicion is reported.
const SUSPECT: f64 = 4.0;
/// The same for the rate's sign: beside the thermal bias there is noise.
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
            if SUSPECT * would < left && as_well(would, answered(SPOOL_CHANNEL)) {
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
    let has_a_sign = spread(&predicted[RATE_CHANNEL], &predicted[RATE_CHANNEL], 0.0) > TOLERATED * drawn.tolerated;
    let as_much = as_well(would, answered(RATE_CHANNEL)) || has_a_sign && drawn.explains_as_much(would, answered(RATE_CHANNEL));
    let reversed = (REVERSED * would < left && as_much).then(|| {
        let [left, would] = [left, would].map(|r| significant(r, 2));
        let text = format!(
            "{RATE} seems to have the other sign: the nominal model leaves {left} deg/h rms as it stands, {would} with the rate \
             negated; check the sense of the gyro's axis and cw_climbs"
        );
        Remark::ReversedRate.warning(text).at(&record.fingerprint.file)
    });
    Ok(jumped.into_iter().chain(reversed).collect())
}
