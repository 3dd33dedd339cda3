//! Conditioning of recordings, exactly, and that it does not care for the clock's zero, a channel's unit or the order of channels.

use proptest::prelude::*;
use recording::check::{Expectations, check};
use recording::condition::{Rest, Thinned, Thinning, Unrest, bridged, filled, span, thinned, unrest};
use recording::{Channel, Recording, Sampling};

const NAN: f64 = f64::NAN;

fn channel(name: &str, values: &[f64], sampling: Sampling) -> Channel {
    Channel { name: name.into(), unit: "u".into(), values: values.to_vec(), sampling }
}

fn recording(time: &[f64], reading: &[f64], mean: &[f64]) -> Recording {
    let channels = vec![channel("reading", reading, Sampling::Momentary), channel("mean", mean, Sampling::Mean)];
    Recording::new(time.to_vec(), channels).expect("a recording")
}

const RULE: Thinning = Thinning { many_rows: 6, interval: 4.0, most_rows: 1000 };

/// A thinned recording with intervals of 1 s.
fn thin(recording: &Recording) -> Thinned {
    thinned(recording, 1.0, &RULE).expect("thinned")
}

fn values<'a>(recording: &'a Recording, name: &str) -> &'a [f64] {
    &recording.channel(name).expect("a channel").values
}

#[test]
fn exact_a_gap_has_rows_without_a_value() {
    let whole = recording(&[0.0, 2.0, 4.0, 6.0], &[1.0, 2.0, 3.0, 4.0], &[5.0, 6.0, 7.0, 8.0]);
    assert_eq!(filled(&whole), whole);
    // an interval of one and a half is none, one of 2.4 has room for one row, one of 4 for three
    let time = [0.0, 2.0, 5.0, 9.8, 11.8, 13.8, 15.8, 17.8, 25.8];
    let given: Vec<f64> = (0..9).map(f64::from).collect();
    let found = filled(&recording(&time, &given, &given));
    let rows = [0.0, 2.0, 5.0, 7.8, 9.8, 11.8, 13.8, 15.8, 17.8, 19.8, 21.8, 23.8, 25.8];
    assert!(
        found.time().len() == 13 && found.time().iter().zip(rows).all(|(t, row)| (t - row).abs() < 1e-12),
        "{:?}",
        found.time()
    );
    for name in ["reading", "mean"] {
        let found = values(&found, name);
        assert!([3, 9, 10, 11].iter().all(|&n| found[n].is_nan()), "{found:?}");
        assert_eq!(found.iter().copied().filter(|value| value.is_finite()).collect::<Vec<_>>(), given);
    }
    // one of 1.6 has room for one as well
    let found = filled(&recording(&[0.0, 2.0, 4.0, 7.25], &given[..4], &given[..4]));
    assert_eq!(found.time(), [0.0, 2.0, 4.0, 5.25, 7.25]);
    // no more rows than half of those that there were: the usual interval stays
    let long = filled(&recording(&[0.0, 1.0, 2.0, 1202.0], &[1.0; 4], &[1.0; 4]));
    assert_eq!(long.time(), [0.0, 1.0, 2.0, 402.0, 802.0, 1202.0]);
    // nor is an empty or a short one any other
    for rows in 0..2 {
        let short = recording(&time[..rows], &given[..rows], &given[..rows]);
        assert_eq!(filled(&short), short);
    }
}

/// A chamber that follows its programme within 150 s turns in the middle of seven rows that a logger left out: its course there is that of the programme.
#[test]
fn where_rows_are_left_out_the_chamber_turns_as_its_programme_does() {
    let mut air = 20.0;
    let course: Vec<f64> = (0..24_000_u32)
        .map(|t| {
            let t = f64::from(t);
            let programme = 20.0 + ((t - 6000.0).clamp(0.0, 6000.0) - (t - 12_000.0).clamp(0.0, 6000.0)) / 60.0;
            air += (programme - air) / 150.0;
            air
        })
        .collect();
    let noise = |n: usize| ((n * 7919 % 1000) as f64 / 1000.0 - 0.5) * 0.02;
    let kept: Vec<usize> = (0..400).filter(|n| !(197..204).contains(n)).collect();
    let time: Vec<f64> = kept.iter().map(|n| 60.0 * *n as f64).collect();
    let readings: Vec<f64> = kept.iter().map(|&n| course[60 * n] + noise(n)).collect();
    let found = filled(&recording(&time, &readings, &readings));
    let off = |values: &[f64]| {
        let off = |(value, t): (&f64, &f64)| (value - course[*t as usize]).abs();
        values.iter().zip(found.time()).map(off).fold(0.0, f64::max)
    };
    let likely = recording::smooth::smoothed(found.time(), values(&found, "reading"), None).expect("a course").values;
    let line = bridged(found.time(), values(&found, "reading")).expect("a course");
    let [likely, line] = [off(&likely), off(&line)];
    assert!(line > 1.0 && likely < 0.2 * line, "{likely} K, {line} K on a line");
}

#[test]
fn bounds_neither_a_rule_nor_an_interval_of_nothing_is_divided_by() {
    let ramp: Vec<f64> = (0..18).map(f64::from).collect();
    let recording = recording(&ramp, &ramp, &ramp);
    // as many rows as there are become one, and no row would be left of an interval that is not known
    let one = thinned(&recording, 1.0, &Thinning { most_rows: 0, ..RULE }).expect("thinned");
    assert_eq!((one.every, one.recording.time()), (18, &[17.0][..]));
    assert_eq!(thinned(&recording, 1.0, &Thinning { interval: 0.0, ..RULE }), None);
    for interval in [0.0, -1.0, f64::NAN] {
        assert_eq!(thinned(&recording, interval, &Thinning { most_rows: 3, ..RULE }), None, "{interval}");
    }
}

#[test]
fn means_are_those_of_the_group_and_readings_belong_to_the_instant() {
    // rows 0..10, a gap, rows 10..18: groups of four end at rows 3 and 7, then at 13 and 17
    let time: Vec<f64> = (0..18).map(|n| f64::from(n) + if n < 10 { 0.0 } else { 100.0 }).collect();
    let ramp: Vec<f64> = (0..18).map(f64::from).collect();
    let Thinned { recording: thin, every, rows } = thin(&recording(&time, &ramp, &ramp));
    assert_eq!((every, rows, thin.time()), (4, 18, &[3.0, 7.0, 113.0, 117.0][..]));
    // of a ramp, the mean over a group lies in its middle, and the reading at the instant stays
    assert_eq!(values(&thin, "mean"), [1.5, 5.5, 11.5, 15.5]);
    assert_eq!(values(&thin, "reading"), [3.0, 7.0, 13.0, 17.0]);
    // the reading at the end of a gap has no rows behind it, the one before it has two
    let mut spike = vec![0.0; 18];
    (spike[9], spike[16]) = (5.0, 5.0);
    assert_eq!(values(&readings_of(&time, &spike), "reading"), [0.0, 1.0, 0.0, 0.0]);
}

/// One row that is missing is a gap, in whatever unit of time.
#[test]
fn a_missing_row_cuts_a_group() {
    let rows = [0.0, 1.0, 2.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    for unit in [1.0, 0.125, 64.0] {
        let time = rows.map(|row| unit * row);
        let Thinned { recording: thin, .. } =
            thinned(&recording(&time, &rows, &rows), unit, &Thinning { interval: 4.0 * unit, ..RULE }).expect("thinned");
        assert_eq!((thin.time(), values(&thin, "mean")), (&[7.0 * unit][..], &[5.5][..]));
    }
}

fn readings_of(time: &[f64], reading: &[f64]) -> Recording {
    thin(&recording(time, reading, reading)).recording
}

#[test]
fn half_a_group_is_enough_and_less_is_nothing() {
    let time: Vec<f64> = (0..8).map(f64::from).collect();
    let mean = [1.0, NAN, 3.0, NAN, NAN, NAN, 5.0, NAN];
    let left = thin(&recording(&time, &time, &mean)).recording;
    assert_eq!(values(&left, "mean")[0], 2.0);
    assert!(values(&left, "mean")[1].is_nan());
}

#[test]
fn few_rows_and_long_intervals_stay() {
    let time: Vec<f64> = (0..7).map(f64::from).collect();
    let whole = recording(&time, &time, &time);
    assert!(thinned(&whole, 1.0, &RULE).is_some());
    assert_eq!(thinned(&whole, 1.0, &Thinning { many_rows: 7, ..RULE }), None);
    assert_eq!(thinned(&whole, 4.0, &RULE), None);
    // unless there are more than the most
    assert_eq!(
        thinned(&whole, 4.0, &Thinning { most_rows: 3, ..RULE }).map(|t| (t.every, t.recording.time().len())),
        Some((3, 2))
    );
}

#[test]
fn gaps_are_bridged_in_time_not_by_rows() {
    assert_eq!(bridged(&[0.0, 1.0, 2.0, 5.0, 6.0], &[NAN, 1.0, NAN, 9.0, NAN]), Some(vec![1.0, 1.0, 3.0, 9.0, 9.0]));
}

#[test]
fn what_a_check_masks_or_drops_is_not_used() {
    let time: Vec<f64> = [0.0, 1.0, 1.0].into_iter().chain((2..60).map(f64::from)).collect();
    let mut noisy: Vec<f64> = time.iter().map(|t| (t * t) % 7.0).collect();
    noisy[40] = 1e4;
    let whole = recording(&time, &noisy, &noisy);
    let used = check(&whole, &Expectations::default()).used(&whole);
    assert_eq!(used.time().len(), 60);
    let [kept, before] = [values(&used, "mean"), &noisy].map(|v| v.iter().filter(|v| v.is_finite()).count());
    assert_eq!((kept, before, values(&used, "mean")[39].is_nan()), (59, 61, true));
}

#[test]
fn rest_is_that_both_stay_and_do_not_close_in() {
    let rest = Rest { duration: 10.0, tolerance: 0.5 };
    let time = [100.0, 105.0, 110.0, 115.0];
    let of = |driver: [f64; 4], follower: [f64; 4]| unrest(&time, &driver, &follower, &rest);
    assert_eq!(of([20.0, 20.5, 20.0, 90.0], [NAN, 19.5, 0.0, 0.0]), None);
    assert_eq!(of([20.0, 21.0, 20.0, 20.0], [20.25; 4]), Some(Unrest::Moving(1.0)));
    assert_eq!(of([20.0, 21.0, 20.0, 20.0], [NAN, 18.0, 20.0, 20.0]), Some(Unrest::Apart(2.0)));
    // thermometers that differ by a constant are at rest all the same
    assert_eq!(of([20.0; 4], [18.7; 4]), None);
    // or come nearer by no more than what is tolerated
    assert_eq!(of([20.0; 4], [18.0, 18.5, 18.0, 18.0]), None);
    assert_eq!(of([20.0; 4], [NAN; 4]), None);
    assert_eq!(unrest(&[], &[], &[], &rest), None);
}

#[test]
fn the_span_of_some_values() {
    assert_eq!(span(&[2.0, NAN, -1.0]), 3.0);
    assert_eq!(span(&[NAN]), f64::NEG_INFINITY);
}

/// Values on a lattice of 1/8, so that sums are exact in any order; a fifth of them missing.
fn series(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(prop_oneof![4 => (-400..400_i32).prop_map(|k| f64::from(k) / 8.0), 1 => Just(NAN)], count)
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9 * (1.0 + b.abs()) || (a.is_nan() && b.is_nan()))
}

proptest! {
    #[test]
    fn the_clock_s_zero_and_the_unit_do_not_matter(
        intervals in prop::collection::vec(prop_oneof![9 => Just(1.0), 1 => Just(8.0)], 40),
        reading in series(40),
        mean in series(40),
        shift in -1000..1000_i32,
        (scale, offset) in (prop_oneof![-3.0..-0.1_f64, 0.1..3.0_f64], -50.0..50.0_f64),
    ) {
        let time: Vec<f64> = intervals.iter().scan(0.0, |t, dt| { *t += dt; Some(*t) }).collect();
        let later: Vec<f64> = time.iter().map(|t| t + 64.0 * f64::from(shift)).collect();
        let convert = |series: &[f64]| series.iter().map(|x| scale * x + offset).collect::<Vec<_>>();
        let (plain, other) = (thin(&recording(&time, &reading, &mean)), thin(&recording(&later, &convert(&reading), &convert(&mean))));
        prop_assert_eq!(plain.recording.time().len(), other.recording.time().len());
        for name in ["reading", "mean"] {
            prop_assert!(same(&convert(values(&plain.recording, name)), values(&other.recording, name)), "{name}");
        }
        // so for lines across gaps, which stay between their ends
        match (bridged(&time, &mean), bridged(&later, &convert(&mean))) {
            (Some(plain), Some(other)) => {
                prop_assert!(same(&convert(&plain), &other));
                prop_assert!(plain.iter().all(|x| x.is_finite()) && span(&plain) <= span(&mean) + 1e-12);
                prop_assert!(plain.iter().zip(&mean).all(|(a, b)| b.is_nan() || a == b));
            }
            (a, b) => prop_assert!(a.is_none() && b.is_none() && mean.iter().all(|x| x.is_nan())),
        }
        let rest = Rest { duration: 6.0, tolerance: 3.05 };
        let elsewhere = Rest { tolerance: 3.05 * scale.abs(), ..rest };
        let driver = bridged(&time, &reading).unwrap_or_else(|| vec![0.0; 40]);
        let sizes = |found: Option<Unrest>| found.map(|unrest| match unrest {
            Unrest::Apart(by) => ("apart", by),
            Unrest::Moving(by) => ("moving", by),
        });
        let (plain, other) = (
            sizes(unrest(&time, &driver, &mean, &rest)),
            sizes(unrest(&later, &convert(&driver), &convert(&mean), &elsewhere)),
        );
        prop_assert_eq!(plain.map(|p| p.0), other.map(|p| p.0));
        prop_assert!(plain.zip(other).is_none_or(|(p, o)| (scale.abs() * p.1 - o.1).abs() < 1e-9 * o.1));
    }

    #[test]
    fn the_order_of_channels_and_a_recording_backwards_do_not_matter(reading in series(40), mean in series(40)) {
        let time: Vec<f64> = (0..40).map(f64::from).collect();
        let plain = thin(&recording(&time, &reading, &mean)).recording;
        let channels = vec![channel("mean", &mean, Sampling::Mean), channel("reading", &reading, Sampling::Momentary)];
        let swapped = thin(&Recording::new(time.clone(), channels).unwrap()).recording;
        for name in ["reading", "mean"] {
            prop_assert!(same(values(&plain, name), values(&swapped, name)));
        }
        let back = |series: &[f64]| series.iter().rev().copied().collect::<Vec<_>>();
        let mirrored: Vec<f64> = time.iter().rev().map(|t| -t).collect();
        let of = |time: &[f64], series: &[f64]| bridged(time, series).unwrap_or_default();
        prop_assert!(same(&back(&of(&time, &mean)), &of(&mirrored, &back(&mean))));
        // forty rows are ten whole groups of four: so are the same backwards
        let mirror = thin(&recording(&mirrored, &back(&reading), &back(&mean))).recording;
        prop_assert!(same(&back(values(&plain, "mean")), values(&mirror, "mean")));
    }
}

#[test]
fn a_slower_sensor_is_read_on_lines_between_its_readings() {
    // a reading in every fifth row, or every third; groups of four
    for every in [3, 5] {
        let time: Vec<f64> = (0..60).map(f64::from).collect();
        let sparse: Vec<f64> = (0..60).map(|n| if n % every == 0 { 2.0 * n as f64 } else { NAN }).collect();
        let thin = thin(&recording(&time, &sparse, &time)).recording;
        for (n, value) in values(&thin, "reading").iter().enumerate() {
            let (from, to) = (4 * n, 4 * n + 3);
            let has_own = (from..=to).any(|row| row % every == 0);
            // of a ramp the value at the instant; behind the last reading there is no line
            if to + 2 <= (59 / every) * every {
                assert_eq!(value.is_finite(), has_own, "{every}: {n}");
                assert!(!has_own || (value - 2.0 * to as f64).abs() < 1e-12, "{every}: {value} at {to}");
            }
        }
    }
    // a gap of its own is not bridged: readings of every second row, none for twelve; beside it, and at the end, half of a group is missing
    let time: Vec<f64> = (0..40).map(f64::from).collect();
    let gap: Vec<f64> = (0..40).map(|n| if n % 2 == 0 && !(10..22).contains(&n) { 1.0 } else { NAN }).collect();
    let thin = thin(&recording(&time, &gap, &time)).recording;
    let there: Vec<bool> = values(&thin, "reading").iter().map(|value| value.is_finite()).collect();
    assert_eq!(there, [true, true, false, false, false, true, true, true, true, false]);
}
