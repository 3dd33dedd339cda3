//! Columns of the records that nothing reads, and that what is left of the rate follows all the same.

use std::collections::BTreeSet;

use files::{Note, Remark, shown};
use mechanisms::{RATE as RATE_CHANNEL, SPOOL as SPOOL_CHANNEL};
use recording::check::white_noise;

use super::Outcome;
use super::alike::{centred, repeats, sums};
use super::as_drawn::{as_well, rms};
use crate::prepare::Record;
use crate::table::significant;

/// Least share that a column explains of what is left beyond the rows' white noise: with more than a half it is the largest part, whatever else is there.
const MOST_OF_IT: f64 = 0.5;
/// Standard errors by which chance alone puts a correlation off 0 that is told, as many rows counted as are independent.
const PLAIN: f64 = 5.0;
/// A column that what is left of the rate follows.
#[derive(Debug, PartialEq)]
struct Followed {
    /// Change of the rate for each unit of the column \[deg/h\].
    slope: f64,
    /// Share of what is left beyond white noise that it explains.
    share: f64,
    /// Root mean square of what it leaves, of the rate less its mean in each record \[deg/h\].
    left: f64,
}

/// Instants, what is left of the rate and a column, in the rows of a record.
type Rows<'a> = (&'a [f64], &'a [f64], &'a [f64]);

/// Number of rows that count where both series wander: chance correlates two slow courses easily (Bartlett 1935).
fn independent(pairs: &[(f64, f64)], white: f64) -> f64 {
    let [aa, _, bb] = sums(pairs);
    let product = |lag: usize| {
        let (a, b) = pairs.iter().zip(&pairs[lag..]).fold((0.0, 0.0), |(a, b), (x, y)| (a + x.0 * y.0, b + x.1 * y.1));
        a / (aa - white) * (b / bb)
    };
    let alike: f64 = (1..pairs.len()).map(product).take_while(|product| *product > 0.0).sum();
    pairs.len() as f64 / (1.0 + 2.0 * alike)
}

/// The regression of what is left of the rate on a column, if it explains the most of it.
fn followed(records: &[Rows]) -> Option<Followed> {
    let (mut pairs, mut white) = (Vec::new(), 0.0);
    for (time, left, column) in records {
        let used: Vec<bool> = left.iter().zip(*column).map(|(r, x)| r.is_finite() && x.is_finite()).collect();
        let rows = centred(left, column);
        white += rows.len() as f64 * white_noise(time, left, &used)?.powi(2);
        pairs.extend(rows);
    }
    let ([total, product, spread], count) = (sums(&pairs), pairs.len() as f64);
    let (slope, explained) = (product / spread, product * product / spread);
    let share = explained / (total - white);
    // of the correlation over its standard error
    let plain = || share >= 1.0 || share * (independent(&pairs, white) - 2.0) >= PLAIN * PLAIN * (1.0 - share);
    let told = total > white && share >= MOST_OF_IT && explained >= PLAIN * PLAIN * white / count && plain();
    told.then(|| Followed { slope, share: share.min(1.0), left: ((total - explained) / count).sqrt() })
}

impl Outcome<'_> {
    /// A warning of the column, read by nothing, that explains most of what is left of the rate: by the leading explanation, or by the constants alone if they leave
    /// no more beside the column than that explanation does.
    pub(super) fn follows_ignored(&self) -> Option<(String, Note)> {
        let leading = &self.leading().residuals;
        let answered: Vec<f64> = leading.iter().flat_map(|channels| channels[RATE_CHANNEL].iter().copied()).collect();
        let alone = self.diagnosis.candidates.iter().find(|candidate| candidate.is_constants_alone());
        let names: BTreeSet<&str> = self.fits.first()?.ignored.keys().map(String::as_str).collect();
        let told = names.into_iter().filter(|name| self.is_own_course(name)).flat_map(|name| {
            let of = |residuals: &[Vec<Vec<f64>>]| {
                let rows = self.fits.iter().zip(residuals).map(|(record, channels)| {
                    let column = record.ignored.get(name)?.as_slice();
                    Some((record.observed.time.as_slice(), channels[RATE_CHANNEL].as_slice(), column))
                });
                followed(&rows.collect::<Option<Vec<Rows>>>()?)
            };
            let by_leading = of(leading).map(|found| ("the explanation", found));
            let by_constants = alone.and_then(|alone| of(&alone.fit.residuals)).map(|found| ("the design's constants", found));
            let by_constants = by_constants.filter(|(_, found)| as_well(found.left, Some(rms(&answered))));
            by_leading.into_iter().chain(by_constants).map(move |(whose, found)| (name, whose, found))
        });
        let (name, whose, found) = told.max_by(|a, b| a.2.share.total_cmp(&b.2.share))?;
        let text = format!(
            "what {whose} would leave of the rate follows the column `{}`, which the model does not use, {} deg/h for each of its units: it \
             explains {:.0} % of what is left beyond the noise; write it as a mechanism of your own (docs/own-mechanism.md)",
            shown(name),
            significant(found.slope, 2),
            100.0 * found.share
        );
        Some((shown(name), Remark::FollowsColumn.warning(text).at(&self.fits.first()?.fingerprint.file)))
    }

    /// Whether a column is in all records, and neither constant nor a line of the time, of a temperature or of the rate.
    fn is_own_course(&self, name: &str) -> bool {
        let of = |other: fn(&Record) -> &[f64]| {
            repeats(self.fits.iter().filter_map(|record| Some((record.ignored.get(name)?.as_slice(), other(record)))))
        };
        let repeated = [
            of(|record| &record.observed.time),
            of(|record| &record.chamber),
            of(|record| &record.observed.channels[SPOOL_CHANNEL]) && self.has_spool(),
            of(|record| &record.observed.channels[RATE_CHANNEL]),
        ];
        self.fits.iter().all(|record| record.ignored.contains_key(name)) && !repeated.contains(&true)
    }

    fn has_spool(&self) -> bool {
        self.fits.iter().any(|record| record.observed.channels[SPOOL_CHANNEL].iter().any(|value| value.is_finite()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise of a tenth that repeats itself after 101 rows.
    fn noise(row: usize) -> f64 {
        0.1 * ((row * row * 37 % 101) as f64 / 50.0 - 1.0)
    }

    fn column(rows: usize) -> (Vec<f64>, Vec<f64>) {
        ((0..rows).map(|n| 60.0 * n as f64).collect(), (0..rows).map(|n| 24.0 + 0.4 * (n as f64 / 40.0).sin()).collect())
    }

    #[test]
    fn a_rate_that_follows_a_column_is_told_with_its_slope() {
        let (time, volts) = column(600);
        let rate = |slope: f64| -> Vec<f64> { volts.iter().enumerate().map(|(n, v)| 0.3 + slope * v + noise(n)).collect() };
        let found = followed(&[(&time, &rate(0.5), &volts), (&time, &rate(0.5), &volts)]).unwrap();
        assert!((found.slope - 0.5).abs() < 0.02 && found.share > 0.9 && (found.left - 0.06).abs() < 0.02, "{found:?}");
        // noise alone, and something else that is twice as large
        assert_eq!(followed(&[(&time, &rate(0.0), &volts)]), None);
        let beside: Vec<f64> = rate(0.5).iter().zip(&time).map(|(r, t)| r + 0.5 * (t / 2000.0).sin()).collect();
        assert_eq!(followed(&[(&time, &beside, &volts)]), None);
        // a constant has no slope
        assert_eq!(followed(&[(&time, &rate(0.5), &vec![24.0; 600])]), None);
    }

    /// A walk of steps that a linear congruence makes.
    fn walk(seed: u64, rows: usize) -> Vec<f64> {
        let (mut state, mut at) = (seed, 0.0);
        let step = |_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            at += (state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0;
            at
        };
        (0..rows).map(step).collect()
    }

    #[test]
    fn two_walks_follow_one_another_by_chance_alone() {
        let time: Vec<f64> = (0..700).map(|n| 60.0 * f64::from(n)).collect();
        let told =
            (0..200_u64).filter(|n| followed(&[(&time, &walk(2 * n + 1, 700), &walk(1000 + 2 * n, 700))]).is_some()).count();
        assert!(told <= 4, "{told} of 200");
        // one that does follow the other is told
        let column = walk(5, 700);
        let rate: Vec<f64> = column.iter().enumerate().map(|(n, x)| 0.5 * x + noise(n)).collect();
        assert!(followed(&[(&time, &rate, &column)]).is_some());
    }
}
