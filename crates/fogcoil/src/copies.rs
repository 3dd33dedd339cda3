//! Records whose rows stand in another one, from its first row or from elsewhere.

use recording::{Recording, median_interval};

use crate::input::{RATE, RecordCase};

/// Fewest rows with a rate from which records are compared.
const FEWEST_ROWS: usize = 10;
/// Differences of instants, as a share of the interval between rows, and of rates, relative, that are none: decimals and units.
const SAME_INSTANT: f64 = 1e-3;
const SAME_RATE: f64 = 1e-9;

/// Instants and rates of the rows that have one.
fn rates(record: &Recording) -> Vec<(f64, f64)> {
    let Some(rate) = record.channel(RATE) else { return Vec::new() };
    record.time().iter().copied().zip(rate.values.iter().copied()).filter(|(_, rate)| rate.is_finite()).collect()
}

fn same_rate(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_RATE * a.abs().max(b.abs())
}

/// Whether all rows of one record stand in another one, wherever that begins.
pub(crate) fn contains(whole: &RecordCase, part: &RecordCase) -> bool {
    let slack = SAME_INSTANT * median_interval(part.recording.time()).unwrap_or(1.0);
    let [whole, part] = [whole, part].map(|case| rates(&case.recording));
    let Some((begin, first)) = part.first().copied() else { return false };
    // a rate that never changes is in any record
    if part.len() < FEWEST_ROWS || part.len() > whole.len() || part.iter().all(|(_, rate)| same_rate(*rate, first)) {
        return false;
    }
    let starts = whole.iter().enumerate().take(whole.len() + 1 - part.len()).filter(|(_, (_, rate))| same_rate(*rate, first));
    starts.into_iter().any(|(k, (start, _))| {
        let mut rest = whole[k..].iter();
        part.iter().all(|(time, rate)| {
            let instant = time - begin + start;
            // rows between may be left out
            rest.find(|(other, _)| *other >= instant - slack)
                .is_some_and(|(other, own)| *other <= instant + slack && same_rate(*rate, *own))
        })
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::input::check_record;

    fn record(rows: impl Iterator<Item = (f64, f64)>) -> RecordCase {
        let rows: String = rows.map(|(time, rate)| format!("{time},20,20,{rate}\n")).collect();
        check_record(Path::new("r.csv"), "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows, None, &[]).unwrap()
    }

    #[test]
    fn a_part_is_found_wherever_it_begins() {
        let rate = |n: u32| f64::from(n * n % 97) / 10.0;
        let rows = |from: u32, to: u32, every: usize, origin: f64| {
            record((from..to).step_by(every).map(move |n| (60.0 * f64::from(n) - origin, rate(n))))
        };
        let whole = rows(0, 300, 1, 0.0);
        for part in [rows(0, 150, 1, 0.0), rows(150, 300, 1, 9000.0), rows(20, 200, 2, 1200.0), rows(0, 300, 1, -5e4)] {
            assert!(contains(&whole, &part));
        }
        assert!(!contains(&rows(0, 150, 1, 0.0), &whole));
        let other = record((0..150).map(|n| (60.0 * f64::from(n), rate(n) + if n == 140 { 0.1 } else { 0.0 })));
        assert!(!contains(&whole, &other), "a row differs");
        assert!(!contains(&whole, &record((0..150).map(|n| (61.0 * f64::from(n), rate(n))))), "other instants");
        assert!(!contains(&whole, &record((0..150).map(|n| (60.0 * f64::from(n), 0.1)))), "never changes");
    }
}
