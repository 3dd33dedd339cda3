//! A spool's thermometer that came loose: from one instant on it follows the chamber.

use files::Remark;
use mechanisms::lagged;
use recording::Seconds;
use recording::statistics::robust_sd;

use crate::input::SPOOL;
use crate::table::significant;

/// Least ratio of the residuals without a break, by the model throughout or by the chamber throughout, to that with one.
const SUSPECT: f64 = 4.0;
/// Standard deviations of the steps of what the model leaves from which a step belongs to the fall.
const PARTS: f64 = 5.0;
/// Time constants of a small thermometer in air, still or blown \[s\].
const LAGS: [f64; 7] = [10.0, 20.0, 40.0, 80.0, 160.0, 320.0, 640.0];

/// A thermometer that follows the model up to an instant, and the chamber from then on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Loose {
    /// The first instant at which it follows the chamber \[s\].
    from: f64,
    /// Its time constant there \[s\].
    lag: f64,
    /// What is left of its readings so, beside its offset, rms \[K\].
    pub(super) would: f64,
}

impl Loose {
    /// The break that explains the readings of the `spool` \[°C\], if there is one; NaN is none. `predicted` is what the model has them be.
    pub(super) fn found(time: &[f64], spool: &[f64], predicted: &[f64], chamber: &[f64]) -> Option<Self> {
        let rows: Vec<usize> = (0..time.len()).filter(|&n| spool[n].is_finite() && chamber[n].is_finite()).collect();
        let sums = |course: &[f64]| {
            let mut sums = vec![[0.0, 0.0]];
            for (k, &n) in rows.iter().enumerate() {
                let off = spool[n] - course[n];
                sums.push([sums[k][0] + off, sums[k][1] + off * off]);
            }
            sums
        };
        let by_model = sums(predicted);
        let count = rows.len();
        let mut best: Option<(f64, Self)> = None;
        // sum of squares about a common offset without a break
        let mut unbroken = f64::INFINITY;
        for lag in LAGS {
            let by_chamber = sums(&lagged(time, chamber, lag));
            let squares = |k: usize| {
                let [sum, squares] = [0, 1].map(|m| by_model[k][m] + by_chamber[count][m] - by_chamber[k][m]);
                squares - sum * sum / count as f64
            };
            unbroken = unbroken.min(squares(0)).min(squares(count));
            for k in 1..count {
                let left = squares(k);
                if best.is_none_or(|(least, _)| left < least) {
                    best = Some((left, Self { from: time[rows[k]], lag, would: (left.max(0.0) / count as f64).sqrt() }));
                }
            }
        }
        let (_, loose) = best.filter(|(left, _)| SUSPECT * SUSPECT * left < unbroken)?;
        Some(Self { from: fell(time, spool, predicted, loose.from), ..loose })
    }

    /// The warning; the model leaves so much of the readings as they stand \[K\].
    pub(super) fn warning(&self, left: f64) -> files::Note {
        let [left, would, lag] = [left, self.would, self.lag].map(|x| significant(x, 2));
        Remark::LooseThermometer.warning(format!(
            "{SPOOL} seems to have come loose at {} s: from then on it follows the chamber, some {lag} s late; the model leaves {left} K rms of it as it \
             stands, {would} K so",
            Seconds(self.from)
        ))
    }
}

/// The instant from which the readings part from the model for good, at or before `from`: a thermometer that falls is in between for some rows.
fn fell(time: &[f64], spool: &[f64], predicted: &[f64], from: f64) -> f64 {
    let before: Vec<usize> = (0..time.len()).filter(|&n| time[n] < from && spool[n].is_finite()).collect();
    let steps: Vec<f64> = before.windows(2).map(|w| (spool[w[1]] - predicted[w[1]]) - (spool[w[0]] - predicted[w[0]])).collect();
    let usual = robust_sd(steps.iter().copied(), 0.0).unwrap_or(f64::INFINITY);
    let parts = steps.iter().rev().take_while(|step| step.abs() > PARTS * usual).count();
    before.get(before.len() - parts).map_or(from, |&row| time[row])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chamber that is warmed and cooled, and a spool that follows it within half an hour, read 0.3 K too high.
    fn courses() -> [Vec<f64>; 3] {
        let time: Vec<f64> = (0..600).map(|n| 60.0 * f64::from(n)).collect();
        let chamber: Vec<f64> =
            time.iter().map(|t| 20.0 + ((t - 3000.0).clamp(0.0, 3000.0) - (t - 20_000.0).clamp(0.0, 6000.0)) / 100.0).collect();
        let spool = lagged(&time, &chamber, 1800.0);
        [time, chamber, spool]
    }

    #[test]
    fn a_thermometer_that_falls_off_is_seen_and_one_that_does_not_is_not() {
        let [time, chamber, spool] = courses();
        let noise = |n: usize| 0.3 + ((n * 7919 % 1000) as f64 / 1000.0 - 0.5) * 0.1;
        let air = lagged(&time, &chamber, 40.0);
        let read = |from: usize, off: f64| -> Vec<f64> {
            (0..600).map(|n| if n < from { spool[n] + off * (spool[n] - 20.0) } else { air[n] } + noise(n)).collect()
        };
        // the model is a hundredth off
        let loose = Loose::found(&time, &read(70, 0.01), &spool, &chamber).expect("it fell off");
        assert!((loose.from - 4200.0).abs() < 300.0 && loose.lag == 40.0 && loose.would < 0.1, "{loose:?}");
        // the first row that is off is told, even where the best break is rows later
        let mut falling = read(72, 0.01);
        falling[70] += (air[70] - spool[70]) / 3.0;
        falling[71] += (air[71] - spool[71]) / 1.5;
        let found = Loose::found(&time, &falling, &spool, &chamber).expect("it fell off");
        assert!((4140.0..=4200.0).contains(&found.from), "{found:?}");
        // one that is fast, or wrong, throughout is another fault
        for sound in [read(600, 0.0), read(600, 0.2), read(0, 0.0)] {
            assert_eq!(Loose::found(&time, &sound, &spool, &chamber), None);
        }
        // rows that say nothing change nothing
        let mut gaps = read(70, 0.01);
        gaps[100..140].fill(f64::NAN);
        assert!((Loose::found(&time, &gaps, &spool, &chamber).expect("it fell off").from - loose.from).abs() < 300.0);
        assert_eq!(Loose::found(&time, &[f64::NAN; 600], &spool, &chamber), None);
    }
}
