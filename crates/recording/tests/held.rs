//! Readings of a slower logger, repeated until the next, are found and used once; what is read in every row is not taken for them.

use crate::check::{ROWS, Sample, altered, expectations, round, sound};
use recording::check::{Expectations, Finding, FindingKind, Repair, check};
use recording::{Channel, Recording, Sampling};

/// Readings of every so many rows, repeated until the next.
fn repeated(values: &[f64], every: f64) -> Vec<f64> {
    let reading = |row: usize| ((row as f64 / every).floor() * every).ceil() as usize;
    (0..values.len()).map(|row| values[reading(row)]).collect()
}

/// Expectations of a channel whose values may be repeated for so long.
fn held_for(longest: f64) -> Expectations {
    let mut expected = expectations();
    expected.channels.iter_mut().for_each(|channel| channel.longest_hold = longest);
    expected
}

fn is_held(finding: &&Finding) -> bool {
    matches!(finding.kind, FindingKind::Held { .. })
}

#[test]
fn readings_of_a_slower_logger_are_used_once() {
    for (every, resolution) in [(2.0, 0.01), (5.0, 0.01), (11.0 / 3.0, 0.01), (5.0, 0.1), (12.0, 0.01)] {
        let sound = sound(3, resolution);
        let temperature = repeated(&sound.temperature, every);
        let report = Sample { temperature, ..sound }.report_of(&held_for(f64::INFINITY));
        let found: Vec<&Finding> = report.findings.iter().filter(is_held).collect();
        let [finding] = found[..] else { panic!("{every}: {:?}", report.findings) };
        let FindingKind::Held { rows, interval } = finding.kind else { unreachable!() };
        assert!((rows / every - 1.0).abs() < 0.02 && interval == 30.0 * rows, "{rows} {interval} {every}");
        // nothing else is said of it: what repeats is neither stuck nor an outlier
        let others = report.findings.iter().filter(|f| f.channel == finding.channel && f.kind != finding.kind);
        assert!(others.clone().all(|f| matches!(f.kind, FindingKind::Quantised { .. })), "{:?}", others.collect::<Vec<_>>());
        assert_eq!(report.rows.len(), ROWS);
        // the first row of each reading, but for some of those that are equal
        let first = |row: usize| row == 0 || (row as f64 / every).floor() > ((row - 1) as f64 / every).floor();
        let (right, wrong): (Vec<usize>, Vec<usize>) = (0..ROWS).filter(|&row| report.masks[0][row]).partition(|&row| first(row));
        let readings = (0..ROWS).filter(|&row| first(row)).count();
        assert!(right.len() * 10 >= readings * 9 && wrong.len() * 10 <= readings, "{every}: {} {}", right.len(), wrong.len());
        assert_eq!(finding.rows, ROWS - right.len() - wrong.len());
        if resolution < 0.1 {
            let noise = report.channels[0].noise.unwrap();
            assert!((noise / 0.01 - 1.0).abs() < 0.2, "{every}: {noise}");
        }
    }
}

/// Neighbours of a reading are those of the slower logger, many rows away.
#[test]
fn a_wrong_reading_of_a_slower_logger_is_masked() {
    const EVERY: usize = 12;
    let mut sample = sound(3, 0.01);
    sample.temperature = repeated(&sample.temperature, EVERY as f64);
    let wrong = 40 * EVERY..41 * EVERY;
    sample.temperature[wrong.clone()].iter_mut().for_each(|value| *value += 3.0);
    let report = sample.report_of(&held_for(f64::INFINITY));
    let found: Vec<&Finding> = report.findings.iter().filter(|f| matches!(f.kind, FindingKind::Outliers(_))).collect();
    let [Finding { kind: FindingKind::Outliers(largest), rows: 1, .. }] = found[..] else { panic!("{:?}", report.findings) };
    assert!((largest.abs() - 3.0).abs() < 0.3, "{largest}");
    assert!(wrong.clone().all(|row| !report.masks[0][row]));
}

#[test]
fn a_mean_that_is_repeated_leaves_the_rows_in_which_it_is_new() {
    let sound = sound(4, 0.01);
    let rate = repeated(&sound.rate, 4.0);
    let report = Sample { rate, ..sound }.report_of(&held_for(f64::INFINITY));
    assert_eq!(report.rows, (0..ROWS).step_by(4).collect::<Vec<_>>());
    assert_eq!(report.instants.as_ref().unwrap().interval, 120.0);
    let held: Vec<&Finding> = report.findings.iter().filter(is_held).collect();
    let [finding] = held[..] else { panic!("{:?}", report.findings) };
    assert_eq!((finding.channel.as_deref(), &*finding.unit, finding.repair), (Some("rate"), "deg/h", Repair::Dropped));
    assert_eq!(finding.span, Some([30.0, 30.0 * 1999.0]));
    assert_eq!(
        finding.to_string(),
        "rate: a value stands for 4 rows (120 s), as a slower logger's, repeated, does, from 30 to 59970 s (1500 rows); dropped"
    );
    // a temperature that was read in every row is momentary: what is left of it is its own
    assert!(report.masks[0].iter().filter(|used| !**used).count() < 5);
}

#[test]
fn a_mean_is_not_repeated_for_longer_than_a_logger_is_slow() {
    // four rows of 30 s
    let kept = |longest| {
        let sound = sound(4, 0.01);
        let rate = repeated(&sound.rate, 4.0);
        Sample { rate, ..sound }.report_of(&held_for(longest)).rows.len()
    };
    assert_eq!([kept(119.0), kept(120.0)], [ROWS, ROWS / 4]);
}

#[test]
fn where_a_repeated_mean_is_missing_the_other_channels_go_on() {
    let sound = sound(4, 0.01);
    let mut rate = repeated(&sound.rate, 4.0);
    // for 400 rows, and for one beside
    rate[800..1200].fill(f64::NAN);
    rate[1501] = f64::NAN;
    let report = Sample { rate, ..sound }.report_of(&held_for(f64::INFINITY));
    assert_eq!(report.rows, (0..ROWS).step_by(4).collect::<Vec<_>>());
    let held: Vec<&Finding> = report.findings.iter().filter(is_held).collect();
    // every row that is dropped is told
    assert_eq!(held.iter().map(|finding| finding.rows).sum::<usize>(), ROWS - report.rows.len());
    assert!(report.findings.iter().all(|f| !matches!(f.kind, FindingKind::Gap { .. } | FindingKind::ClockStep(_))));
}

/// Means of four rows and of five by turns: where they are missing it goes on by five.
#[test]
fn where_a_mean_of_four_rows_and_a_half_is_missing_every_fifth_row_goes_on() {
    let mut sample = sound(4, 0.01);
    let start = |row: usize| row / 9 * 9 + if row % 9 < 4 { 0 } else { 4 };
    sample.rate = (0..ROWS).map(|row| sample.rate[start(row)]).collect();
    // whole pairs, of which as many of four rows are left as of five
    sample.rate[900..1260].fill(f64::NAN);
    sample.rate.truncate(1989);
    sample.time.truncate(1989);
    sample.temperature.truncate(1989);
    let report = sample.report_of(&held_for(f64::INFINITY));
    let kept = |rows: std::ops::Range<usize>| report.rows.iter().copied().filter(|row| rows.contains(row)).collect::<Vec<_>>();
    assert_eq!(kept(0..20), [0, 4, 9, 13, 18]);
    assert_eq!(kept(895..1260), (895..1260).step_by(5).collect::<Vec<_>>());
}

#[test]
fn what_is_read_in_every_row_is_not_taken_for_repeats() {
    // coarse, slow or a programme's levels: neither is a slower logger's
    let levels = |row: usize| [20.0, 33.0, 51.0, -10.0, 7.3, 44.1, -31.7, 62.9, 12.2][row / 40 % 9];
    for resolution in [1e-4, 0.01, 0.0625, 0.5, 1.0] {
        for seed in 0..5 {
            let report = sound(seed, resolution).report_of(&held_for(f64::INFINITY));
            assert!(!report.findings.iter().any(|f| is_held(&f)), "{resolution}: {:?}", report.findings);
        }
    }
    let slow = altered(|sample| sample.temperature = (0..ROWS).map(|row| round(0.003 * row as f64, 0.1)).collect());
    assert!(!slow.report_of(&held_for(f64::INFINITY)).findings.iter().any(|f| is_held(&f)));
    // levels of twenty minutes, where a logger is not that slow
    let programme = |longest| {
        let sample = altered(|sample| sample.temperature = (0..ROWS).map(levels).collect());
        sample.report_of(&held_for(longest)).findings.iter().any(|f| is_held(&f))
    };
    assert!(!programme(1199.0) && programme(1200.0));
    // where nothing is expected, what repeats was read
    let channel = |values| Channel { name: "level".into(), unit: "W".into(), values, sampling: Sampling::Momentary };
    let own = Recording::new((0..ROWS).map(|n| n as f64).collect(), vec![channel((0..ROWS).map(levels).collect())]).unwrap();
    assert!(check(&own, &Expectations::default()).findings.iter().all(|f| !is_held(&f)));
    // too few readings tell no rhythm: 19 runs between the ends, and 20
    for (runs, is_told) in [(21, false), (22, true)] {
        let level = |row: usize| 20.0 + 0.1 * ((row * runs / ROWS) as f64).powi(2);
        let few = altered(|sample| sample.temperature = (0..ROWS).map(level).collect());
        assert_eq!(few.report_of(&held_for(f64::INFINITY)).findings.iter().any(|f| is_held(&f)), is_told, "{runs}");
    }
}
