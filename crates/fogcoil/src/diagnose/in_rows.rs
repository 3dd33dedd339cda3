//! A residual that is far more than the noise of a record's own rows: what a fit leaves unexplained, its noise has swallowed.

use diagnosis::{Fit, ForwardModel, HeldOut};
use files::{Note, Remark};
use mechanisms::{Gyro, RATE as RATE_CHANNEL, SPOOL as SPOOL_CHANNEL};
use recording::Seconds;

use crate::left::Left;
use crate::prepare::Record;
use crate::table::significant;

/// Channels with their names and units.
const CHANNELS: [(usize, &str, &str); 2] = [(RATE_CHANNEL, "rate", "deg/h"), (SPOOL_CHANNEL, "thermometer", "K")];

/// What a prediction leaves of a channel of a record that was held out, about its mean.
pub(super) fn of_held(gyro: &Gyro, record: &Record, answer: &HeldOut, channel: usize) -> Option<Left> {
    let recorded = record.observed.channels.get(channel)?;
    let mut left: Vec<f64> = recorded.iter().zip(answer.prediction.get(channel)?).map(|(y, p)| y - p).collect();
    let known: Vec<f64> = left.iter().copied().filter(|r| r.is_finite()).collect();
    let mean = known.iter().sum::<f64>() / known.len() as f64;
    left.iter_mut().for_each(|r| *r -= mean);
    Left::of(&record.observed.time, &left, &gyro.channels()[channel].noise, answer.noise_floor[channel])
}

/// Note on a fitted record of which a fit leaves far more than its rows' noise; `number` is its place among the fitted ones.
pub(super) fn left_in_fit(gyro: &Gyro, number: usize, record: &Record, fit: &Fit) -> Option<Note> {
    let of = |(channel, name, unit): (usize, &str, &str)| {
        let (beforehand, residual) = (&gyro.channels()[channel].noise, &fit.residuals[number][channel]);
        let left = Left::of(&record.observed.time, residual, beforehand, fit.noise_model(number, channel).white)?;
        let [rms, noise] = [left.rms, left.with_drift].map(|value| significant(value, 2));
        let text = format!(
            "{rms} {unit} of the {name}, whose rows have a noise of {noise} {unit}{}",
            half(&record.observed.time, residual)
        );
        left.is_misfit().then_some(text)
    };
    let left: Vec<String> = CHANNELS.into_iter().filter_map(of).collect();
    let text = format!(
        "what was found leaves {} in this record, which was fitted: something is unexplained, or a filter makes neighbouring rows alike",
        left.join(", and ")
    );
    (!left.is_empty()).then(|| Remark::FitLeft.note(text).at(&record.fingerprint.file))
}

/// The rows that hold half of the squares of a residual, in words.
fn half(time: &[f64], residual: &[f64]) -> String {
    let mut rows: Vec<usize> = (0..residual.len().min(time.len())).filter(|row| residual[*row].is_finite()).collect();
    let all: f64 = rows.iter().map(|row| residual[*row].powi(2)).sum();
    rows.sort_by(|a, b| residual[*b].abs().total_cmp(&residual[*a].abs()));
    let mut sum = 0.0;
    let count = rows
        .iter()
        .take_while(|row| {
            let before = sum;
            sum += residual[**row].powi(2);
            before < all / 2.0
        })
        .count();
    let of = rows.len();
    let held = &rows[..count];
    match (held.iter().min(), held.iter().max()) {
        (Some(first), Some(last)) if first < last => format!(
            " (half of its squares in {count} of {of} rows, from {} to {} s)",
            Seconds(time[*first]),
            Seconds(time[*last])
        ),
        (Some(first), _) => format!(" (half of its squares in one of {of} rows, at {} s)", Seconds(time[*first])),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rows_that_hold_half_of_a_residual_are_told() {
        let time: Vec<f64> = (0..8).map(|n| 30.0 * f64::from(n)).collect();
        let rows = [0.1, 2.0, 0.1, f64::NAN, -2.0, 0.1, 0.1, 0.1];
        assert_eq!(half(&time, &rows), " (half of its squares in 2 of 7 rows, from 30 to 120 s)");
        assert_eq!(half(&time, &[0.0, 3.0, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1]), " (half of its squares in one of 8 rows, at 30 s)");
        assert_eq!(half(&time, &[f64::NAN; 8]), "");
    }
}
