//! A recording as the engine wants it.

use bias::units::S_PER_MIN;
use diagnosis::Observation;
use recording::check::Severity;

use crate::Error;
use crate::glossary::{Remark, WARNING};
use crate::input::{CHAMBER, InputError, RATE, RecordCase, SPOOL};

/// Fewest rows with a rate from which anything is said.
pub const FEWEST_ROWS: usize = 60;
/// Rows beyond which neighbours are averaged: a week of minutes.
pub const MANY_ROWS: usize = 10_000;
/// Interval to which they are averaged \[s\]: a coil's fastest transients take minutes.
pub const INTERVAL_S: f64 = 30.0;
/// Most rows of a record that are compared; of more, the interval grows.
pub const MOST_ROWS: usize = 30_000;
/// Range of the chamber \[K\] below which it is noted that nothing shows.
const FEWEST_KELVIN: f64 = 5.0;
/// What chamber and spool may differ by at rest, and the chamber move by in the first minutes \[K\]: thermometers' offsets and noise.
const AT_REST: f64 = 0.5;
/// How long the chamber should be steady at first \[s\].
const REST_S: f64 = 600.0;
/// Intervals longer than this many usual ones are gaps.
const GAP: f64 = 1.5;

/// A record as the engine wants it.
pub(crate) struct Ready {
    pub(crate) observation: Observation,
    pub(crate) chamber: Vec<f64>,
    pub(crate) averaging: f64,
}

fn refuse(case: &RecordCase, field: &str, problem: String, remedy: &str) -> Error {
    let file = case.fingerprint.file.clone();
    InputError { file, line: None, field: Some(field.to_owned()), problem, remedy: remedy.to_owned() }.into()
}

/// A recording's usable values, averaged down where there are very many; what was done is added to `notes`.
///
/// # Errors
/// [`Error::Input`] says why it cannot be used.
pub(crate) fn ready(case: &RecordCase, notes: &mut Vec<String>) -> Result<Ready, Error> {
    case.require_usable()?;
    let missing = || {
        let problem = "there is no chamber temperature to drive the model with".to_owned();
        refuse(case, CHAMBER, problem, "give a column with values")
    };
    let mut table = Table::new(case).thinned(case, notes);
    if !bridge(&table.time, &mut table.chamber) {
        return Err(missing());
    }
    let count = table.rate.iter().filter(|r| r.is_finite()).count();
    if count < FEWEST_ROWS {
        let problem = format!("{count} rows with a rate are too few to tell anything");
        return Err(refuse(case, RATE, problem, "record at least an hour, with ramps"));
    }
    let file = case.fingerprint.file.display();
    let warnings = case.report.findings.iter().filter(|finding| finding.severity == Severity::Warning);
    notes.extend(warnings.map(|finding| Remark::of_finding(&finding.kind).says(format!("{WARNING}{file}: {finding}"))));
    // how the file was read, where that is doubtful
    notes.extend(case.notes.iter().filter_map(|note| note.strip_prefix(WARNING)).map(|note| format!("{WARNING}{file}: {note}")));
    let ends = |[low, high]: [f64; 2], t: &f64| [low.min(*t), high.max(*t)];
    let [low, high] = table.chamber.iter().fold([f64::INFINITY, f64::NEG_INFINITY], ends);
    if high - low < FEWEST_KELVIN {
        let range = high - low;
        let message = format!("{file}: the chamber moves by {range:.1} K only: little that depends on temperature can show");
        notes.push(Remark::NarrowRange.says(message));
    }
    if case.number(SPOOL).is_none() {
        let message = format!("{file}: no spool_c: heat paths and the thermometer cannot be told apart");
        notes.push(Remark::NoThermometer.says(message));
    }
    if let Some(off) = unrest(&table) {
        let message = format!("{file}: does not start at rest ({off}), as the model does: what this leaves is no finding");
        notes.push(Remark::NotAtRest.says(message));
    }
    let Table { time, chamber, spool, rate, averaging } = table;
    Ok(Ready { observation: Observation { time, channels: vec![spool, rate] }, chamber, averaging })
}

/// The columns that are compared; NaN where a value is not used.
struct Table {
    time: Vec<f64>,
    chamber: Vec<f64>,
    spool: Vec<f64>,
    rate: Vec<f64>,
    averaging: f64,
}

impl Table {
    fn new(case: &RecordCase) -> Self {
        let rows = &case.report.rows;
        let used = |name: &str| -> Vec<f64> {
            let column = case.number(name).and_then(|n| Some((&case.recording.channels()[n].values, case.report.masks.get(n)?)));
            let Some((values, mask)) = column else { return vec![f64::NAN; rows.len()] };
            rows.iter().zip(mask).map(|(row, used)| if *used { values[*row] } else { f64::NAN }).collect()
        };
        let time = rows.iter().map(|row| case.recording.time()[*row]).collect();
        Self { time, chamber: used(CHAMBER), spool: used(SPOOL), rate: used(RATE), averaging: case.averaging }
    }

    /// Means over whole numbers of rows, if there are very many.
    fn thinned(self, case: &RecordCase, notes: &mut Vec<String>) -> Self {
        let rows = self.time.len();
        let interval = case.report.instants.as_ref().map_or(0.0, |instants| instants.interval);
        let wished = if interval > 0.0 { (INTERVAL_S / interval).round() as usize } else { 1 };
        let every = wished.max(rows.div_ceil(MOST_ROWS));
        if rows <= MANY_ROWS || every < 2 {
            return self;
        }
        let mut thin = Self { averaging: self.averaging * every as f64, ..Self::empty() };
        let near = |n: usize| self.time[n] - self.time[n - 1] <= GAP * interval;
        let mut first = 0;
        for n in 1..=rows {
            if n < rows && near(n) && n - first < every {
                continue;
            }
            // what a gap cuts short is no mean over the interval
            if n - first == every {
                let last = n - 1;
                thin.time.push(self.time[last]);
                thin.rate.push(mean(&self.rate[first..n]));
                // a temperature belongs to the instant: the rows about it, as many on either side, are a reading with less noise
                let side = (1..=every / 2).take_while(|k| last + k < rows && near(last + k)).count();
                let about = last - side..last + side + 1;
                thin.chamber.push(mean(&self.chamber[about.clone()]));
                thin.spool.push(mean(&self.spool[about]));
            }
            first = n;
        }
        let (file, left) = (case.fingerprint.file.display(), thin.time.len());
        let message = format!("{file}: {rows} rows are averaged by {every} to {left} of {:.3} s", interval * every as f64);
        notes.push(Remark::Averaged.says(message));
        thin
    }

    fn empty() -> Self {
        Self { time: Vec::new(), chamber: Vec::new(), spool: Vec::new(), rate: Vec::new(), averaging: 0.0 }
    }
}

/// Mean of what is there; NaN if that is less than half.
fn mean(values: &[f64]) -> f64 {
    let (sum, count) = values.iter().filter(|v| v.is_finite()).fold((0.0, 0), |(s, n), v| (s + v, n + 1));
    if 2 * count < values.len() { f64::NAN } else { sum / count as f64 }
}

/// Why a record does not start at rest, if it does not.
fn unrest(table: &Table) -> Option<String> {
    let (start, first) = (table.time[0], table.chamber[0]);
    let spool = table.spool.iter().find(|t| t.is_finite()).map_or(0.0, |t| (t - first).abs());
    let early = table.time.iter().zip(&table.chamber).take_while(|(t, _)| *t - start <= REST_S);
    let moved = early.fold(0.0_f64, |most, (_, c)| most.max((c - first).abs()));
    if spool > AT_REST {
        Some(format!("spool and chamber differ by {spool:.1} K"))
    } else {
        (moved > AT_REST).then(|| format!("the chamber moves by {moved:.1} K in the first {} min", REST_S / S_PER_MIN))
    }
}

/// Fills gaps on straight lines; false if there is nothing to draw them through.
pub(super) fn bridge(time: &[f64], values: &mut [f64]) -> bool {
    let known: Vec<usize> = (0..values.len()).filter(|&n| values[n].is_finite()).collect();
    let (Some(&first), Some(&last)) = (known.first(), known.last()) else { return false };
    for n in 0..values.len() {
        if !values[n].is_finite() {
            let at = known.partition_point(|k| *k < n);
            values[n] = match (at.checked_sub(1).map(|k| known[k]), known.get(at)) {
                (Some(a), Some(&b)) => values[a] + (values[b] - values[a]) * (time[n] - time[a]) / (time[b] - time[a]),
                (Some(_), None) => values[last],
                _ => values[first],
            };
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_mean_is_none() {
        assert_eq!(mean(&[1.0, f64::NAN, 3.0, 5.0]), 3.0);
        assert!(mean(&[1.0, f64::NAN, f64::NAN]).is_nan() && mean(&[]).is_nan());
    }

    /// 12 000 rows of a second, the rate rising by 1 deg/h a row; from row 6000 on all is an hour later.
    #[test]
    fn very_many_rows_are_averaged_by_whole_numbers() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.csv");
        let row = |n: usize| {
            let (time, rate) = (n + if n < 6015 { 0 } else { 3600 }, 0.001 * n as f64 + 0.0001 * (n % 3) as f64);
            format!("{time},{},{},{rate:.4}\n", 20.0 + 0.001 * n as f64, 20.0 + 0.0005 * n as f64 + 0.01 * (n % 2) as f64)
        };
        std::fs::write(&path, "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &(0..12_000).map(row).collect::<String>())
            .unwrap();
        let case = crate::input::read_record(&path, &crate::input::RecordOptions::default()).unwrap();
        let mut notes = Vec::new();
        let ready = ready(&case, &mut notes).unwrap();
        let [spool, rate] = &ready.observation.channels[..] else { panic!() };
        let time = &ready.observation.time;
        // 200 whole groups before the gap, of which 15 rows are cut off, and 199 after it
        assert_eq!((time.len(), time[0], time[199], time[200]), (399, 29.0, 5999.0, 6044.0 + 3600.0));
        assert_eq!(ready.averaging, 30.0);
        assert!((rate[0] - (0.0145 + 0.0001)).abs() < 1e-12 && (rate[200] - (6.0295 + 0.0001)).abs() < 1e-9, "{rate:?}");
        assert!((ready.chamber[0] - 20.029).abs() < 1e-12 && (spool[0] - 20.0195).abs() < 1e-3, "{}", spool[0]);
        assert!(notes.iter().any(|note| note.contains("12000 rows are averaged by 30 to 399 of 30.000 s")), "{notes:?}");
    }

    #[test]
    fn gaps_are_bridged() {
        let nan = f64::NAN;
        let mut values = [nan, 1.0, nan, 4.0, nan];
        assert!(bridge(&[0.0, 1.0, 2.0, 4.0, 5.0], &mut values));
        assert_eq!(values, [1.0, 1.0, 2.0, 4.0, 4.0]);
        assert!(!bridge(&[0.0], &mut [nan]));
    }
}
