//! A drawing that is wrong in one word, or of another unit: it explains at once what faults would have to.

use coil::Design;
use files::{Note, Remark};
use mechanisms::{Gyro, RATE as RATE_CHANNEL, SPOOL as SPOOL_CHANNEL};

use super::as_drawn::{AsDrawn, TOLERATED, as_well, spread};
use crate::input::CoilCase;
use crate::other_drawing::other_drawings;
use crate::prepare::Record;
use crate::table::significant;

/// Least ratio of what the drawing leaves to what the other one leaves at which that is reported: nine tenths of the variance go with one word.
const RATIO: f64 = 3.0;

/// Ratio of what the negated rate leaves to what another drawing leaves from which it is the drawing, and not the sign.
const RATHER: f64 = 2.0;

/// A word of the drawing that seems to be another.
pub(super) struct Doubt {
    pub(super) note: Note,
    /// The word, as a coil file has it.
    pub(super) words: String,
    /// Of each record, whether it is followed so much better than by the rate of the other sign that this is no longer to be suspected.
    pub(super) rather_than_sign: Vec<bool>,
}

/// The warning that another drawing follows the fitted records far better: `gyro` is the design as it is, `answered` what the answer leaves of the channels of each record,
/// rms; `None` without an answer.
///
/// As much as the tolerances of the constants usually make is no reason to doubt a word, where the constants suffice. Beside a fault it is one where the word leaves
/// no more than the answer does, of rate and thermometer, with nothing fitted.
pub(super) fn warning(
    gyro: &Gyro,
    case: &CoilCase,
    records: &[Record],
    answered: Option<&[Vec<f64>]>,
    constants_suffice: bool,
) -> Result<Option<Doubt>, coil::Error> {
    // when heaters were switched on is no part of a design
    if !case.design.heat.heaters.is_empty() {
        return Ok(None);
    }
    let drawn = (0..records.len()).map(|n| AsDrawn::of(gyro, n)).collect::<Result<Vec<_>, _>>()?;
    let in_full = |design: &Design| -> Result<Vec<[Vec<f64>; 2]>, coil::Error> {
        let full = gyro.in_full(design)?;
        (0..records.len()).map(|n| full.under(n)).collect()
    };
    let drawn_in_full = in_full(&case.design)?;
    let rate = |n: usize| &records[n].observed.channels[RATE_CHANNEL];
    // over the rows of all records
    let pooled = |each: &[f64]| {
        let rows = |n: usize| rate(n).iter().filter(|rate| rate.is_finite()).count() as f64;
        let squares: f64 = each.iter().enumerate().map(|(n, rms)| rows(n) * rms * rms).sum();
        (squares / (0..each.len()).map(rows).sum::<f64>().max(1.0)).sqrt()
    };
    let tolerated = pooled(&drawn.iter().map(|drawn| drawn.tolerated[RATE_CHANNEL]).collect::<Vec<_>>());
    let numbers = 0..records.len();
    let [left, negated] = [1.0, -1.0]
        .map(|sign| -> Vec<f64> { numbers.clone().map(|n| spread(rate(n), &drawn[n].predicted[RATE_CHANNEL], sign)).collect() });
    let left_of_all = pooled(&left);
    let is_tolerated = left_of_all < TOLERATED * tolerated;
    if constants_suffice && is_tolerated {
        return Ok(None);
    }
    let mut best: Option<(f64, String, Vec<bool>)> = None;
    for other in other_drawings(&case.design) {
        // one that cannot be solved is none
        let Ok(changed) = in_full(&other.design) else { continue };
        let would = |n: usize, channel: usize| {
            let change = changed[n][channel].iter().zip(&drawn_in_full[n][channel]).map(|(a, b)| a - b);
            let predicted: Vec<f64> = drawn[n].predicted[channel].iter().zip(change).map(|(own, change)| own + change).collect();
            spread(&records[n].observed.channels[channel], &predicted, 1.0)
        };
        let explains = |n: usize, channel: usize| {
            let (would, answered) = (would(n, channel), answered.map(|answered| answered[n][channel]));
            if is_tolerated { as_well(would, answered) } else { drawn[n].explains_as_much(channel, would, answered) }
        };
        let as_much = numbers.clone().all(|n| [SPOOL_CHANNEL, RATE_CHANNEL].into_iter().all(|channel| explains(n, channel)));
        let would: Vec<f64> = numbers.clone().map(|n| would(n, RATE_CHANNEL)).collect();
        let of_all = pooled(&would);
        if as_much && RATIO * of_all < left_of_all && best.as_ref().is_none_or(|(least, ..)| of_all < *least) {
            let rather_than_sign = would.iter().zip(&negated).map(|(would, negated)| RATHER * would < *negated).collect();
            best = Some((of_all, other.words, rather_than_sign));
        }
    }
    Ok(best.map(|(would, words, rather_than_sign)| {
        let [left, would] = [left_of_all, would].map(|r| significant(r, 2));
        let text = format!(
            "the unit may differ from its drawing in one word: as drawn it leaves {left} deg/h rms of the fitted records, with {words} {would}, and nothing fitted"
        );
        Doubt { note: Remark::DoubtedDrawing.warning(text).at(&case.file), words, rather_than_sign }
    }))
}
