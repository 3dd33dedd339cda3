//! Lines of the rate that go on whatever the temperature does: no mechanism makes them, and what is left by each would hide it.

use std::borrow::Cow;

use files::Note;

use crate::check::{lined, without_lines};
use crate::input::RecordCase;

/// Records without such lines, and a warning for each that had some.
pub(super) fn taken_off<'a>(records: impl Iterator<Item = &'a RecordCase>) -> (Vec<Cow<'a, RecordCase>>, Vec<Note>) {
    let mut notes = Vec::new();
    let taken_off = |record: &'a RecordCase| {
        let Some((without, lines)) = without_lines(record) else { return Cow::Borrowed(record) };
        let warning = lined(&lines, "the same whatever the temperature does, and taken off the rate");
        notes.extend(warning.map(|note| note.at(&record.fingerprint.file)));
        Cow::Owned(without)
    };
    (records.map(taken_off).collect(), notes)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::input::{RATE, RecordOptions, read_record};

    const LINE: f64 = 0.05;
    const PERIOD: f64 = 437.0;

    /// A record whose chamber rests, warms by 40 K in an hour, rests and cools, with `ripple` in it \[K\]; `of` is added to the rate at an instant and a
    /// temperature.
    fn record(ripple: f64, of: impl Fn(f64, f64) -> f64) -> RecordCase {
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1_u32 << 24) - 0.5
        };
        let mut coil = 20.0;
        let mut row = |n: usize| {
            let t = 30.0 * n as f64;
            let programme = 20.0 + 40.0 * (((t - 7200.0) / 3600.0).clamp(0.0, 1.0) - ((t - 18_000.0) / 5400.0).clamp(0.0, 1.0));
            coil += (programme - coil) / 40.0;
            let chamber = programme + ripple * (TAU * t / PERIOD).sin();
            let rate = 0.02 * (programme - coil) + of(t, programme) + 0.04 * noise();
            format!("{t},{:.3},{rate:.5}\n", chamber + 0.02 * noise())
        };
        let rows: String = (0..1000).map(&mut row).collect();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.csv");
        std::fs::write(&path, format!("time_s,chamber_c,rate_deg_per_h\n{rows}")).unwrap();
        read_record(&path, &RecordOptions::default()).unwrap()
    }

    #[test]
    fn a_line_is_taken_off_and_what_temperature_makes_stays() {
        let rates = |case: &RecordCase| case.recording.channels()[case.number(RATE).unwrap()].values.clone();
        let line = |t: f64, _: f64| LINE * (TAU * t / PERIOD + 0.4).sin();
        let (case, plain) = (record(0.0, line), record(0.0, |_, _| 0.0));
        let (without, notes) = taken_off([&case].into_iter());
        let [note] = &notes[..] else { panic!("{notes:?}") };
        assert!(
            note.text.contains("a period of 436.999 s") && note.text.contains("taken off the rate") && note.is_warning(),
            "{note}"
        );
        // amplitude and phase of the line are known to a noise over the root of half the rows
        let off = rates(&without[0]).iter().zip(rates(&plain)).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / 1000.0;
        assert!(off.sqrt() < LINE / 20.0, "{off}");
        // a ripple over temperature, and what the chamber has, too, are no lines of their own
        for case in [record(0.0, |_, c| 2.0 * LINE * (TAU * c / 2.0).sin()), record(0.3, line), plain] {
            let (same, notes) = taken_off([&case].into_iter());
            assert!(notes.is_empty() && rates(&same[0]) == rates(&case), "{notes:?}");
        }
    }
}
