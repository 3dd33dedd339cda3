//! Sound recordings pass; each defect is found, said and, where that is right, taken out of use.

use crate::common::Random;
use recording::check::{Clock, Expectation, Expectations, Finding, FindingKind, Offset, Repair, Report, Severity, Unit, check};
use recording::{Channel, Error, Recording, Sampling};

pub(crate) const ROWS: usize = 2000;
const NAN: f64 = f64::NAN;

/// A chamber that ramps, soaks and steps, a rate with noise; both with the resolution of their display.
pub(crate) struct Sample {
    pub(crate) time: Vec<f64>,
    pub(crate) temperature: Vec<f64>,
    pub(crate) rate: Vec<f64>,
}

pub(crate) fn round(value: f64, step: f64) -> f64 {
    (value / step).round() * step
}

pub(crate) fn sound(seed: u64, resolution: f64) -> Sample {
    let mut random = Random::new(seed);
    let time: Vec<f64> = (0..ROWS).map(|i| 30.0 * i as f64).collect();
    // a ramp of 1 °C/min, soaks, and a step through a lag of 200 s
    let course = |t: f64| match t {
        t if t < 6000.0 => 20.0,
        t if t < 9000.0 => 20.0 + (t - 6000.0) / 60.0,
        t if t < 30_000.0 => 70.0,
        t => 70.0 - 90.0 * (1.0 - (-(t - 30_000.0) / 200.0).exp()),
    };
    let temperature = time.iter().map(|&t| round(course(t) + 0.01 * random.normal(), resolution)).collect();
    let rate = time.iter().map(|t| round(0.3 * (t / 5000.0).sin() + 0.02 * random.normal(), 1e-5)).collect();
    Sample { time, temperature, rate }
}

fn clock() -> Clock {
    let units = [("ms", 1e-3), ("min", 60.0), ("h", 3600.0), ("d", 86_400.0)];
    let mistaken = units.map(|(name, scale)| Unit { name: name.into(), scale, offset: 0.0 }).to_vec();
    Clock { span: [60.0, 1e7], usual: 36_000.0, mistaken, key: "time".into() }
}

pub(crate) fn expectations() -> Expectations {
    let unit = |name: &str, scale: f64, offset: f64| Unit { name: name.into(), scale, offset };
    let temperature = Expectation {
        values: [-120.0, 180.0],
        noise: [1e-3, 1.0],
        fastest: 0.5,
        mistaken: vec![unit("K", 1.0, -273.15), unit("0.01 degC", 0.01, 0.0)],
        ..Expectation::default()
    };
    let rate = Expectation {
        values: [-1000.0, 1000.0],
        noise: [1e-4, 100.0],
        mistaken: vec![unit("deg/s", 3600.0, 0.0)],
        offset: Some(Offset { known: 0.0, largest: 0.5, explained: 15.1, of: "Earth rate not removed".into() }),
        essential: true,
        ..Expectation::default()
    };
    Expectations { channels: vec![temperature, rate], fewest_rows: 100, clock: clock() }
}

impl Sample {
    pub(crate) fn report(self) -> Report {
        self.report_of(&expectations())
    }

    pub(crate) fn report_of(self, expectations: &Expectations) -> Report {
        let channel =
            |name: &str, unit: &str, values, sampling| Channel { name: name.into(), unit: unit.into(), values, sampling };
        let channels = vec![
            channel("temperature", "degC", self.temperature, Sampling::Momentary),
            channel("rate", "deg/h", self.rate, Sampling::Mean),
        ];
        check(&Recording::new(self.time, channels).expect("one shape"), expectations)
    }
}

/// A sound recording with a change.
pub(crate) fn altered(change: impl FnOnce(&mut Sample)) -> Sample {
    altered_of(1, change)
}

fn altered_of(seed: u64, change: impl FnOnce(&mut Sample)) -> Sample {
    let mut sample = sound(seed, 0.01);
    change(&mut sample);
    sample
}

/// Adds to every value.
fn add(series: &mut [f64], by: f64) {
    series.iter_mut().for_each(|value| *value += by);
}

/// The only finding of a sample.
fn only(sample: Sample) -> (Finding, Report) {
    let report = sample.report();
    let texts: Vec<String> = report.findings.iter().map(ToString::to_string).collect();
    assert_eq!(texts.len(), 1, "{texts:?}");
    (report.findings[0].clone(), report)
}

#[test]
fn sound_recordings_pass() {
    for seed in 0..200 {
        for resolution in [1e-6, 0.01] {
            let report = sound(seed, resolution).report();
            assert!(report.findings.is_empty(), "seed {seed}, {resolution}: {:?}", report.findings);
            assert_eq!(report.rows.len(), ROWS);
            assert!(report.masks.iter().flatten().all(|used| *used));
        }
        let (finding, report) = only(sound(seed, 0.0625));
        assert!(matches!(finding.kind, FindingKind::Quantised { step, .. } if (step - 0.0625).abs() < 1e-9), "{finding}");
        assert!(report.usable());
    }
}

#[test]
fn a_rate_of_few_counts_is_coarse_and_not_stuck() {
    // noise in counts, the mean between two of them: two to seven different values
    for (seed, noise) in (0..30).flat_map(|seed| [0.3, 0.45, 0.8].map(|noise| (seed, noise))) {
        let (mut sample, mut random) = (sound(seed, 0.01), Random::new(seed + 500));
        let count = |_: &f64| 0.7 * (0.4 + noise * random.normal()).round();
        sample.rate = sample.time.iter().map(count).collect();
        let report = sample.report();
        let coarse =
            |finding: &Finding| matches!(finding.kind, FindingKind::Quantised { step, .. } if (step / 0.7 - 1.0).abs() < 1e-9);
        assert!(report.findings.iter().all(coarse), "seed {seed}, {noise}: {:?}", report.findings);
        assert!(report.masks.iter().flatten().all(|used| *used));
        assert!((report.channels[1].step.unwrap() / 0.7 - 1.0).abs() < 1e-9);
    }
}

#[test]
fn levels_of_a_programme_are_no_resolution() {
    let mut sample = sound(1, 0.01);
    sample.temperature = sample.time.iter().map(|t| if (t / 3000.0).rem_euclid(2.0) < 1.0 { -20.0 } else { 50.0 }).collect();
    assert_eq!(sample.report().channels[0].step, None);
}

#[test]
fn moving_temperatures_pass_at_any_resolution() {
    for seed in 0..100 {
        for (resolution, amplitude) in [(0.01, 40.0), (0.0625, 40.0), (0.0625, 0.5), (0.1, 3.0), (0.5, 40.0)] {
            let (mut sample, mut random) = (sound(seed, 0.01), Random::new(seed + 1000));
            let course = |t: &f64| round(amplitude * (t / 4000.0).sin() + 0.01 * random.normal(), resolution);
            sample.temperature = sample.time.iter().map(course).collect();
            let report = sample.report();
            let sound = report.findings.iter().all(|finding| matches!(finding.kind, FindingKind::Quantised { .. }));
            assert!(sound, "seed {seed}, {resolution}: {:?}", report.findings);
            assert!((report.channels[0].step.unwrap() / resolution - 1.0).abs() < 1e-6);
        }
    }
}

#[test]
fn records_without_noise_pass() {
    for digits in [1e-2, 1e-3, 1e-4, 1e-6] {
        let mut sample = sound(1, 0.01);
        // dwells that the course approaches, and ramps that begin at once
        let lagged = |t: f64| 30.0 * (1.0 - (-t / 150.0).exp());
        let course =
            |t: f64| (t / 6000.0).floor() * 30.0 + if t < 30_000.0 { lagged(t % 6000.0) } else { (t % 6000.0).min(600.0) / 20.0 };
        sample.temperature = sample.time.iter().map(|&t| round(course(t) / 5.0, digits)).collect();
        let report = sample.report();
        let quiet =
            |finding: &Finding| matches!(finding.kind, FindingKind::Quantised { .. } | FindingKind::Unit { what: "noise", .. });
        assert!(report.findings.iter().all(quiet), "{digits}: {:?}", report.findings);
        assert!(report.masks.iter().flatten().all(|used| *used));
    }
}

#[test]
fn noise_is_measured_under_ramps_and_outliers() {
    let mut sample = sound(1, 1e-6);
    (0..ROWS).step_by(50).for_each(|row| sample.rate[row] += 100.0);
    let report = sample.report();
    let noise = report.channels.iter().map(|channel| channel.noise.unwrap());
    for (found, truth) in noise.zip([0.01, 0.02]) {
        assert!((found / truth - 1.0).abs() < 0.06, "{found} {truth}");
    }
}

#[test]
fn curvature_is_no_noise() {
    let (mut sample, mut random) = (sound(1, 0.01), Random::new(1));
    // second differences of the course alone would be 0.036 rms, those of the noise are 0.024
    sample.temperature = sample.time.iter().map(|t| 57.0 * (t / 1000.0).sin() + 0.01 * random.normal()).collect();
    let noise = sample.report().channels[0].noise.unwrap();
    assert!((noise / 0.01 - 1.0).abs() < 0.06, "{noise}");
}

#[test]
fn a_staircase_without_noise_passes() {
    for lag in [40.0, 120.0, 300.0] {
        let mut sample = sound(1, 0.01);
        let mut state = 20.0;
        let follow = |t: &f64| {
            // 10 °C up at 2 °C/min, then 50 minutes' rest
            let target = 20.0 + 10.0 * (t / 3300.0).floor() + (t % 3300.0 - 3000.0).max(0.0) / 30.0;
            state += (target - state) * (1.0 - (-30.0_f64 / lag).exp());
            round(state, 1e-4)
        };
        sample.temperature = sample.time.iter().map(follow).collect();
        let stuck = |finding: &&Finding| matches!(finding.kind, FindingKind::Stuck { .. } | FindingKind::Saturation { .. });
        let report = sample.report();
        assert_eq!(report.findings.iter().find(stuck), None, "lag {lag}");
    }
}

#[test]
fn printing_does_not_hide_a_resolution() {
    let mut sample = sound(3, 0.0625);
    sample.temperature.iter_mut().for_each(|value| *value = round(*value, 0.01));
    let (finding, _) = only(sample);
    assert!(matches!(finding.kind, FindingKind::Quantised { step, .. } if (step / 0.0625 - 1.0).abs() < 0.01), "{finding}");
}

#[test]
fn outliers_are_masked_and_nothing_else() {
    for seed in 0..50 {
        let mut sample = sound(seed, 0.01);
        let rows = [2, 205, 400, 402, 1001, 1500, ROWS - 3]; // in the ramp, close to each other, in the step, at the ends
        rows.iter().for_each(|&row| sample.rate[row] += if row % 2 == 0 { 0.3 } else { -0.4 });
        sample.temperature[300] += 5.0;
        let report = sample.report();
        assert_eq!(report.findings.len(), 2, "{:?}", report.findings);
        let masked = |channel: usize| (0..ROWS).filter(|&row| !report.masks[channel][row]).collect::<Vec<_>>();
        assert_eq!((masked(0), masked(1)), (vec![300], rows.to_vec()), "seed {seed}");
        assert!(report.findings.iter().all(|finding| finding.repair == Repair::Masked));
    }
}

/// A row that was cut in its last number, and one from before the unit was warm.
#[test]
fn an_outlier_at_an_end_is_masked_and_a_bend_there_is_none() {
    for seed in 0..50 {
        let masked = |sample: Sample| {
            let report = sample.report();
            (0..ROWS).filter(|&row| !report.masks[1][row]).collect::<Vec<_>>()
        };
        assert_eq!(masked(altered_of(seed, |s| (s.rate[0], s.rate[ROWS - 1]) = (1.0, -1.0))), [0, ROWS - 1], "seed {seed}");
        assert_eq!(masked(sound(seed, 0.01)), [0_usize; 0], "seed {seed}");
        // a ramp of six noises a row that begins at the last one
        assert_eq!(masked(altered_of(seed, |s| s.rate[ROWS - 1] += 0.12)), [0_usize; 0], "seed {seed}");
        let steep = altered_of(seed, |s| (ROWS - 40..ROWS).for_each(|row| s.rate[row] += 2.0 * (row + 40 - ROWS) as f64));
        assert_eq!(masked(steep), [0_usize; 0], "seed {seed}");
    }
}

#[test]
fn a_steep_ramp_hides_no_outlier_and_its_corners_are_none() {
    for seed in 0..20 {
        let mut sample = sound(seed, 0.01);
        // a triangle of 40 noises a row
        let noise = sound(seed, 0.01).report().channels[1].noise.unwrap();
        let rows = [330, 450, 451, 570, 1130];
        sample.rate.iter_mut().enumerate().for_each(|(row, rate)| *rate += 40.0 * noise * (row % 200).abs_diff(100) as f64);
        rows.iter().for_each(|&row| sample.rate[row] += if row % 3 == 0 { 60.0 } else { -60.0 } * noise);
        let report = sample.report();
        let masked: Vec<usize> = (0..ROWS).filter(|&row| !report.masks[1][row]).collect();
        assert_eq!(masked, rows, "seed {seed}: {:?}", report.findings);
    }
}

#[test]
fn codes_are_masked_and_a_short_signal_is_not() {
    let codes = [0, 1, 700, 701, 702, 703, 704, 1200];
    let (finding, report) =
        only(altered(|s| codes.iter().for_each(|&row| s.rate[row] = if row < 703 { 9999.0 } else { -9999.0 })));
    assert!(matches!(finding.kind, FindingKind::Impossible(size) if size.abs() == 9999.0), "{finding}");
    assert_eq!((0..ROWS).filter(|&row| !report.masks[1][row]).collect::<Vec<_>>(), codes);
    // one alone is a code at an end; elsewhere its neighbours tell it, and it is an outlier
    for (row, is_code) in [(0, true), (1, true), (2, false), (700, false), (ROWS - 3, false), (ROWS - 1, true)] {
        let (finding, report) = only(altered(|s| s.rate[row] = 9999.0));
        assert_eq!(matches!(finding.kind, FindingKind::Impossible(_)), is_code, "{row}: {finding}");
        assert_eq!((0..ROWS).filter(|&row| !report.masks[1][row]).collect::<Vec<_>>(), [row]);
    }
    // a pulse of twenty minutes, 500 times the noise of a quiet day
    let pulse = |row: usize| {
        if (600..640).contains(&row) { 10.0 * ((row - 600) as f64 / 40.0 * std::f64::consts::PI).sin() } else { 0.0 }
    };
    let quiet = altered(|s| s.rate.iter_mut().enumerate().for_each(|(row, rate)| *rate = 0.05 * *rate + pulse(row)));
    let report = quiet.report();
    assert!(report.masks[1].iter().all(|used| *used), "{:?}", report.findings);
}

#[test]
fn gaps_jitter_and_clock_steps() {
    let (finding, report) = only(altered(|s| add(&mut s.time[700..], 1800.0)));
    assert_eq!(finding.kind, FindingKind::Gap { length: 1830.0, missing: 60 });
    assert_eq!(report.instants.unwrap().gaps.len(), 1);

    let mut random = Random::new(8);
    let (finding, _) = only(altered(|s| s.time.iter_mut().for_each(|t| *t += 2.0 * random.uniform())));
    assert!(
        matches!(finding.kind, FindingKind::Jitter { rms, largest } if rms > 0.5 && rms < largest && largest < 2.0),
        "{finding}"
    );

    let report = altered(|s| add(&mut s.time[700..], 1813.0)).report();
    assert_eq!(report.findings[0].kind, FindingKind::ClockStep(1843.0));
    assert!(matches!(report.findings[1].kind, FindingKind::Gap { .. }));

    let report = altered(|s| add(&mut s.time[700..], -20.0)).report();
    assert!(report.findings.iter().any(|finding| finding.kind == FindingKind::ClockStep(10.0)), "{:?}", report.findings);

    // one instant between two others: the clock goes on as before
    for by in [10.0, 20.0] {
        let report = altered(|s| s.time[700] -= by).report();
        assert!(
            report.findings.iter().all(|finding| !matches!(finding.kind, FindingKind::ClockStep(_))),
            "{:?}",
            report.findings
        );
    }
}

#[test]
fn repeats_conflicts_and_time_that_goes_back() {
    let repeat = |conflict: f64| {
        let sample = altered(|s| {
            s.temperature[400] = NAN;
            [&mut s.time, &mut s.temperature, &mut s.rate].into_iter().for_each(|series| series.insert(400, series[400]));
            s.rate[401] += conflict;
        });
        sample.report()
    };
    let report = repeat(0.0);
    assert_eq!(report.findings.iter().filter(|finding| finding.kind == FindingKind::Duplicate).count(), 1);
    assert!(report.usable() && report.rows.len() == ROWS && !report.rows.contains(&401));
    let report = repeat(0.01);
    assert_eq!(report.findings[0].kind, FindingKind::Conflict);
    assert!(!report.usable());
    // so is a value beside none
    let report = repeat(NAN);
    assert_eq!((&report.findings[0].kind, report.usable()), (&FindingKind::Conflict, false));

    // a block that was written twice
    let twice = |s: &mut Sample| {
        for series in [&mut s.time, &mut s.temperature, &mut s.rate] {
            let block = series[400..440].to_vec();
            series.splice(440..440, block);
        }
    };
    let report = altered(twice).report();
    assert_eq!(report.findings.iter().filter(|finding| finding.kind == FindingKind::Duplicate).count(), 40);
    assert!(report.usable() && report.rows.len() == ROWS && report.rows[440] == 480);

    let report = altered(|s| s.time[700] -= 100.0).report();
    assert!(matches!(report.findings[0].kind, FindingKind::Backwards { .. }) && !report.usable());
    assert!(report.findings[0].to_string().contains("sort the rows"));

    // a clock that is put back and runs on: one mistake, and one finding
    let back = |s: &mut Sample| s.time[700..].iter_mut().for_each(|t| *t -= 3000.0);
    let report = altered(back).report();
    let told: Vec<&Finding> = report.findings.iter().filter(|finding| finding.severity == Severity::Error).collect();
    assert!(
        matches!(told[..], [Finding { kind: FindingKind::Backwards(2970.0), rows: 100, .. }]) && !report.usable(),
        "{told:?}"
    );
    assert_eq!(told[0].span, Some([18_000.0, 20_970.0]));
}

#[test]
fn missing_and_empty() {
    let (finding, report) = only(altered(|s| s.temperature[100..120].fill(NAN)));
    assert_eq!((finding.kind.clone(), finding.rows, finding.span), (FindingKind::Missing, 20, Some([3000.0, 3570.0])));
    assert_eq!(report.channels[0].used, ROWS - 20);

    let (finding, report) = only(altered(|s| s.temperature.fill(NAN)));
    assert!(finding.kind == FindingKind::Empty && report.usable(), "a channel that can be spared");
    assert!(!only(altered(|s| s.rate.fill(NAN))).1.usable());
    let (finding, report) = only(altered(|s| s.rate.fill(0.1)));
    assert!(finding.kind == FindingKind::Constant(0.1) && !report.usable());
}

#[test]
fn stuck() {
    for (resolution, may_jump) in [(0.01, true), (0.0625, true), (0.0625, false)] {
        let mut sample = sound(1, resolution);
        let value = sample.temperature[240];
        sample.temperature[240..290].fill(value); // in the ramp: it jumps when it comes back
        let mut expected = expectations();
        expected.channels[0].may_jump = may_jump;
        let report = sample.report_of(&expected);
        let finding = &report.findings[0];
        assert_eq!((finding.kind.clone(), finding.rows), (FindingKind::Stuck(value), 50), "{:?}", report.findings);
        // where the resolution hides the noise a true step looks the same, if there can be one
        let masked = resolution < 0.02 || !may_jump;
        assert!((240..290).all(|row| report.masks[0][row] != masked) && report.masks[0][239] && report.masks[0][290]);
    }
}

#[test]
fn saturated() {
    let report = altered(|s| s.rate.iter_mut().for_each(|rate| *rate = rate.min(0.25))).report();
    assert!(!report.findings.is_empty());
    assert!(report.findings.iter().all(|finding| finding.kind == FindingKind::Saturation(0.25)), "{:?}", report.findings);
}

#[test]
fn units_and_offsets() {
    type Change = fn(&mut Sample);
    let cases: [(Change, &str); 3] = [
        (|s| add(&mut s.temperature, 273.15), "K"),
        (|s| s.temperature.iter_mut().for_each(|value| *value *= 100.0), "0.01 degC"),
        (|s| s.rate.iter_mut().for_each(|value| *value /= 3600.0), "deg/s"),
    ];
    for (change, unit) in cases {
        let (finding, _) = only(altered(change));
        assert!(matches!(&finding.kind, FindingKind::Unit { candidates, .. } if candidates == &[unit]), "{finding}");
    }
    let (finding, _) = only(altered(|s| add(&mut s.rate, 10.1)));
    assert!(
        matches!(&finding.kind, FindingKind::Offset { of, .. } if of == "Earth rate not removed")
            && finding.severity == Severity::Note
    );
}

/// Rates that no resting gyroscope reports: a few are outliers, more say that it was moved.
#[test]
fn rates_of_a_gyroscope_that_was_moved_are_an_error() {
    let moved = |rows: std::ops::Range<usize>| {
        altered(|s| s.rate[rows].iter_mut().enumerate().for_each(|(k, rate)| *rate += 5000.0 - 40.0 * k as f64)).report()
    };
    let found = |report: &Report| {
        let moving = report.findings.iter().filter_map(|f| match f.kind {
            FindingKind::Moving { largest, range } => Some((largest.round(), range, f.rows, f.severity)),
            _ => None,
        });
        moving.collect::<Vec<_>>()
    };
    let (long, short) = (moved(700..730), moved(700..702));
    assert_eq!(found(&long), [(5000.0, [-1000.0, 1000.0], 30, Severity::Error)], "{:?}", long.findings);
    assert!((700..730).all(|row| !long.masks[1][row]) && !long.usable());
    assert_eq!(found(&short), []);
    // of some as large the first is told
    let swung = altered(|s| (0..8).for_each(|k| s.rate[700 + k] = [1500.0, -2500.0, 2500.0, -2000.0][k % 4])).report();
    assert_eq!(found(&swung), [(-2500.0, [-1000.0, 1000.0], 8, Severity::Error)], "{:?}", swung.findings);
    assert!(short.usable() && (700..702).all(|row| !short.masks[1][row]));
}

/// Noise in another unit than expected, of values that are no larger than it: the unit is wrong. Large values beside it are what they seem.
#[test]
fn noise_of_a_wrong_size_is_an_error_where_the_values_are_small_too() {
    let mut expected = expectations();
    expected.channels[1].least_size = 0.01;
    for (size, severity) in [(1.0 / 3600.0, Severity::Error), (40.0, Severity::Warning)] {
        let sample = altered(|s| {
            let sine = s.time.iter().map(|t| size * 0.3 * (t / 5000.0).sin());
            let mut random = Random::new(3);
            s.rate = sine.map(|rate| rate + 1e-5 * random.normal()).collect();
        });
        let report = sample.report_of(&expected);
        let noise: Vec<Severity> = report
            .findings
            .iter()
            .filter(|f| matches!(f.kind, FindingKind::Unit { what: "noise", .. }))
            .map(|f| f.severity)
            .collect();
        assert_eq!(noise, [severity], "{:?}", report.findings);
    }
}

#[test]
fn short_and_misshapen() {
    let cut = |rows: usize| {
        altered(|s| [&mut s.time, &mut s.temperature, &mut s.rate].into_iter().for_each(|series| series.truncate(rows))).report()
    };
    for rows in [0, 1, 2] {
        assert!(!cut(rows).usable(), "{rows}");
    }
    let short = |rows: usize| {
        let report = cut(rows);
        report.findings.iter().find(|finding| finding.kind == FindingKind::TooShort(rows)).map(|finding| finding.severity)
    };
    let (error, warning) = (Some(Severity::Error), Some(Severity::Warning));
    assert_eq!([2, 3, 99, 100].map(short), [error, warning, warning, None]);
    let report = cut(50);
    assert!(report.usable());
    assert!(report.findings.iter().any(|finding| finding.kind == FindingKind::TooShort(50)));

    let channel = |name: &str, values| Channel { name: name.into(), unit: String::new(), values, sampling: Sampling::Mean };
    let new = |time: Vec<f64>, channels| Recording::new(time, channels).unwrap_err();
    assert!(matches!(new(vec![0.0], vec![channel("a", vec![])]), Error::Length { .. }));
    assert!(matches!(new(vec![0.0], vec![channel("a", vec![0.0]), channel("a", vec![0.0])]), Error::Name(_)));
    let no_instant = new(vec![0.0, NAN], vec![]);
    assert!(matches!(no_instant, Error::Value { row: 1, .. }));
    assert_eq!(no_instant.to_string(), "`time` is NaN in row 1, and every row needs an instant; drop the row");
}

/// The unit of the instants is asked for where the chamber is faster than any, or the recording too short or too long.
#[test]
fn instants_in_another_unit() {
    for (scale, kind, unit) in [(60.0, "fast", "min"), (86_400.0, "span", "d"), (1e-3, "span", "ms"), (3600.0, "span", "h")] {
        let report = altered(|sample| sample.time.iter_mut().for_each(|t| *t /= scale)).report();
        let found: Vec<(&str, &Vec<String>)> = report
            .findings
            .iter()
            .filter_map(|finding| match &finding.kind {
                FindingKind::TooFast { candidates, .. } => Some(("fast", candidates)),
                FindingKind::Span { candidates, .. } => Some(("span", candidates)),
                _ => None,
            })
            .collect();
        assert!(found.iter().any(|(which, units)| *which == kind && units[0] == unit), "{scale}: {found:?}");
        let said = format!("; if so, say it: --unit time={unit}");
        assert!(report.findings.iter().any(|finding| finding.to_string().contains(&said)), "{:?}", report.findings);
    }
    // all rows of a ramp that is too fast are told: of 1600 rows that alternate by 50 K in 100 rows of half a second, those of every stretch
    let triangle = |row: usize| 0.5 * (row % 200).abs_diff(100) as f64;
    let fast = altered(|sample| {
        sample.time.iter_mut().enumerate().for_each(|(n, t)| *t = 0.5 * n as f64);
        sample.temperature = (0..ROWS).map(triangle).collect();
    });
    let fast = fast.report();
    let told = fast.findings.iter().find(|finding| matches!(finding.kind, FindingKind::TooFast { .. })).unwrap();
    assert!(told.rows > ROWS / 2 && told.rows < ROWS, "{told:?}");
    // of several as fast the first is shown
    assert_eq!(told.span.map(|[from, _]| from), Some(0.0), "{told:?}");
    // a jump from row to row is none of a chamber, nor is noise in close rows
    let jump = altered(|sample| add(&mut sample.temperature[1000..], 60.0)).report();
    assert!(jump.findings.iter().all(|finding| !matches!(finding.kind, FindingKind::TooFast { .. })), "{:?}", jump.findings);
    let close = altered(|sample| {
        sample.time.iter_mut().for_each(|t| *t /= 3000.0);
        sample.temperature = sound(2, 0.01).temperature[..200].iter().copied().cycle().take(ROWS).collect();
        sample.time.iter_mut().enumerate().for_each(|(n, t)| *t = 0.04 * n as f64);
    });
    let close = close.report();
    assert!(close.findings.iter().all(|finding| !matches!(finding.kind, FindingKind::TooFast { .. })), "{:?}", close.findings);
}
