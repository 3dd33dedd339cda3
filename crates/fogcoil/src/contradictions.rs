//! Contradictions between a record and its meta file.

use files::{Note, Remark};
use recording::Recording;
use recording::check::white_noise;
use recording::statistics::robust_sd;

use crate::input::{CHAMBER, Meta, RATE, RecordCase, SPOOL};
use crate::table::significant;

/// Ratio from which two numbers of one quantity contradict each other: an instrument is two or three times quieter or noisier than its data sheet says,
/// and a slip of a unit (60 for a minute, 57 for a radian, 10 for a digit) is more.
const FACTOR: f64 = 3.0;
/// Standard deviations from which a value is not the one that is declared: one in 370 by chance.
const SIGMAS: f64 = 3.0;
/// Distance of the middle of the rates from Earth's rate negated, as a share of that, up to which the sign is doubted.
const TURNED: f64 = 0.2;
/// Share of the rows' changes smaller than a declared last digit, from which that digit contradicts the record.
const SMALL: f64 = 0.5;
const S_PER_H: f64 = 3600.0;

/// A warning for each number of the meta file that the record contradicts, with both numbers.
pub fn contradictions(case: &RecordCase) -> Vec<Note> {
    let Some(meta) = &case.meta else { return Vec::new() };
    let (used, file) = (case.report.used(&case.recording), &case.fingerprint.file);
    let interval = case.report.instants.as_ref().map_or(0.0, |instants| instants.interval);
    let found = of_interval(meta, interval)
        .into_iter()
        .chain(of_thermometers(meta, &used))
        .chain(of_walk(meta, &used, interval))
        .chain(of_earth(meta, &used));
    found.map(|note| note.at(file)).collect()
}

/// Whether one is several times the other.
fn apart(a: f64, b: f64) -> bool {
    a > 0.0 && b > 0.0 && (a / b).max(b / a) >= FACTOR
}

fn values<'a>(record: &'a Recording, name: &str) -> Option<&'a [f64]> {
    record.channel(name).map(|channel| channel.values.as_slice())
}

/// White noise of a row.
fn noise_of(record: &Recording, name: &str) -> Option<f64> {
    let values = values(record, name)?;
    let mask: Vec<bool> = values.iter().map(|value| value.is_finite()).collect();
    white_noise(record.time(), values, &mask).filter(|noise| *noise > 0.0)
}

fn of_interval(meta: &Meta, interval: f64) -> Option<Note> {
    let told = meta.sample_interval_s;
    let message = || {
        format!(
            "sample_interval_s: the meta file says {told} s, but the rows are {} s apart; a rate is taken as a mean over {told} s",
            significant(interval, 4)
        )
    };
    apart(told, interval).then(|| Remark::IntervalDiffers.warning(message()))
}

/// Declared noise and last digits that are far above the recorded ones.
fn of_thermometers(meta: &Meta, record: &Recording) -> Vec<Note> {
    let digits = meta.resolutions();
    let mut found = Vec::new();
    // what is told of both is that of the coarser
    let of_spool = meta.spool_c.noise.unwrap_or(meta.temperature_sensor.noise_c);
    for (name, told, digit) in [(CHAMBER, meta.chamber_c.noise.unwrap_or(0.0), digits[0]), (SPOOL, of_spool, digits[1])] {
        if let Some(noise) = noise_of(record, name).filter(|noise| told >= FACTOR * noise) {
            found.push(contradiction(format!(
                "{name}: the meta file says a noise of {told} K, but rows differ by {} K from their neighbours",
                significant(noise, 2)
            )));
        }
        let finer = digit.and_then(|digit| Some((digit, finer(values(record, name)?, digit)?)));
        if let Some((digit, step)) = finer {
            found.push(contradiction(format!(
                "{name}: the meta file says a resolution of {digit} K, but the values change by steps such as {} K",
                significant(step, 2)
            )));
        }
    }
    found
}

/// The middle of a record's changes that are not 0, where most of them are far too small for a last digit.
fn finer(values: &[f64], digit: f64) -> Option<f64> {
    let changes = values.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    // decimals are sums of powers of two: what they leave is no change
    let mut changes: Vec<f64> = changes.filter(|change| change.is_finite() && *change > 1e-9 * digit).collect();
    changes.sort_by(f64::total_cmp);
    let small = changes.iter().filter(|change| **change * FACTOR <= digit).count();
    let most = !changes.is_empty() && small as f64 > SMALL * changes.len() as f64;
    most.then(|| changes[changes.len() / 2])
}

/// Angle random walk of the data sheet against that of the rows: σ√(τ/h).
fn of_walk(meta: &Meta, record: &Recording, interval: f64) -> Option<Note> {
    let told = meta.nominal_arw_deg_per_sqrt_h?;
    let walk = noise_of(record, RATE)? * (interval / S_PER_H).sqrt();
    let message = || {
        format!(
            "nominal_arw_deg_per_sqrt_h: the meta file says {told} deg/√h, but the rows' noise is {} deg/√h",
            significant(walk, 2)
        )
    };
    apart(told, walk).then(|| contradiction(message()))
}

/// Earth's rate, where the gyroscope's own offset is known: the middle of the rates lies elsewhere.
fn of_earth(meta: &Meta, record: &Recording) -> Option<Note> {
    let (rate, earth) = (&meta.rate_deg_per_h, meta.rate_deg_per_h.earth()?);
    let known = rate.offset_sd.map(|sd| sd.hypot(earth * rate.scale_factor_sd.unwrap_or(0.0)));
    let mut rates: Vec<f64> = values(record, RATE)?.iter().copied().filter(|rate| rate.is_finite()).collect();
    rates.sort_by(f64::total_cmp);
    let middle = *rates.get(rates.len() / 2)?;
    let Some(known) = known else {
        // an offset that nobody knows turns Earth's rate about by chance once in many units
        let message = || {
            format!(
                "rate_deg_per_h: the meta file makes Earth's rate {} deg/h, and the middle of the record's rates is {} deg/h: is the rate's sign, or the axis, the other one?",
                significant(earth, 4),
                significant(middle, 4)
            )
        };
        return ((middle + earth).abs() < TURNED * earth.abs()).then(|| contradiction(message()));
    };
    // what a test does to the rate is no contradiction
    let sd = known.hypot(robust_sd(rates.iter().copied(), middle)?);
    let message = || {
        format!(
            "rate_deg_per_h: the meta file makes Earth's rate {} deg/h, known to {} deg/h, but the middle of the record's rates is {} deg/h",
            significant(earth, 4),
            significant(known, 2),
            significant(middle, 4)
        )
    };
    ((middle - earth).abs() > SIGMAS * sd).then(|| contradiction(message()))
}

fn contradiction(text: String) -> Note {
    Remark::MetaContradicted.warning(text)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::input::{RecordOptions, read_record};

    /// Two hours of minutes: noise of 0.01 K and 0.1 deg/h from a fixed sequence, about 9.8 deg/h.
    fn with(meta: &str) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        let mut state = 1_u32;
        let mut noise = move || {
            let mut one = || {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f64::from(state >> 8) / f64::from(1 << 24) - 0.5
            };
            (one() + one() + one()) * 2.0
        };
        let row = |n: u32| {
            let t = 20.0 + 0.02 * f64::from(n);
            format!("{},{:.3},{:.3},{:.4}\n", 60 * n, t + 0.01 * noise(), t + 0.01 * noise(), 9.8 + 0.1 * noise())
        };
        let rows: String = (0..400).map(row).collect();
        std::fs::write(folder.path().join("r.csv"), "time_s,chamber_c,spool_c,rate_deg_per_h\n".to_owned() + &rows).unwrap();
        std::fs::write(folder.path().join("meta.ron"), meta).unwrap();
        let case = read_record(&folder.path().join("r.csv"), &RecordOptions::default()).unwrap();
        contradictions(&case).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn each_number_that_the_record_contradicts_is_told_with_its_own() {
        // a walk of 0.1·√(60/3600) = 0.0129 deg/√h
        let right = "(sample_interval_s: 60.0, temperature_sensor: (noise_c: 0.02), spool_c: (resolution: Some(0.002)), \
            nominal_arw_deg_per_sqrt_h: Some(0.02), rate_deg_per_h: (earth_rate_deg_per_h: Some(9.9), offset_sd: Some(0.1)))";
        assert_eq!(with(right), Vec::<String>::new());
        for (from, to, says) in [
            ("60.0", "6.0", ["says 6 s", "60.00 s apart"]),
            ("noise_c: 0.02", "noise_c: 0.1", ["spool_c: the meta file says a noise of 0.1 K", "from their neighbours"]),
            ("Some(0.002)", "Some(0.5)", ["spool_c: the meta file says a resolution of 0.5 K", "steps such as 0.02"]),
            ("Some(0.02)", "Some(0.5)", ["0.5 deg/√h", "is 0.01"]),
            ("Some(0.02)", "Some(0.001)", ["0.001 deg/√h", "is 0.01"]),
            ("Some(9.9)", "Some(12.0)", ["Earth's rate 12.00 deg/h, known to 0.10", "rates is 9."]),
            ("Some(9.9), offset_sd: Some(0.1)", "Some(-9.9)", ["Earth's rate -9.900 deg/h", "is the rate's sign"]),
        ] {
            let told = with(&right.replacen(from, to, 1));
            assert!(says.iter().all(|part| told.iter().any(|line| line.contains(part))), "{to}: {told:?}");
            assert_eq!(told.len(), 1, "{told:?}");
        }
    }

    #[test]
    fn no_record_of_the_good_set_is_contradicted() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/ordinary");
        for coil in ["A", "B", "C"] {
            for unit in std::fs::read_dir(root.join(coil).join("open")).unwrap() {
                let case = read_record(&unit.unwrap().path().join("run1.csv"), &RecordOptions::default()).unwrap();
                assert_eq!(contradictions(&case), [], "{:?}", case.fingerprint.file);
            }
        }
    }
}
