//! Every figure of made records, held as it was.
//!
//! A record holds what records hold at once: gaps, repeats, a clock that was set, outliers, codes, values that stick, coloured noise. `figures.txt` has
//! a line for each.

use crate::check::{Sample, altered, expectations, round, sound};
use crate::common::figures::Figures;
use crate::common::{Random, even, simulate};
use recording::condition::{Rest, Thinning, bridged, slopes, span, thinned, unrest};
use recording::lag::lagging;
use recording::noise::{Bounds, NoiseModel, Series, Term, Whitener, fitted, identify, residual};
use recording::ramp::{Input, respond};
use recording::smooth::{resolution, smoothed};
use recording::statistics::{robust_sd, whiteness};
use recording::{Channel, Recording, Sampling, allan};

const NAN: f64 = f64::NAN;
/// The figures as they were.
const KEPT: &str = include_str!("figures.txt");
/// Removes some rows of every series.
fn without(sample: &mut Sample, rows: std::ops::Range<usize>) {
    for series in [&mut sample.time, &mut sample.temperature, &mut sample.rate] {
        series.drain(rows.clone());
    }
}

fn held(values: &mut [f64], rows: usize) {
    (0..values.len()).for_each(|n| values[n] = values[n / rows * rows]);
}

type Change = fn(&mut Sample);

/// Defects, by name.
const DEFECTS: [(&str, Change); 19] = [
    ("none", |_| ()),
    ("gaps", |s| {
        without(s, 300..305);
        without(s, 900..1000);
        s.time[1200..].iter_mut().for_each(|t| *t += 10.3);
        s.time[700] += 7.0;
        s.time[701] -= 4.0;
    }),
    ("repeats", |s| {
        for (row, to) in [(100, 101), (200, 201)] {
            (s.time[to], s.temperature[to], s.rate[to]) = (s.time[row], s.temperature[row], s.rate[row]);
        }
        s.rate[201] += 0.1;
        s.time[1500..].iter_mut().for_each(|t| *t -= 100.0);
    }),
    ("missing", |s| {
        s.rate[40..55].fill(NAN);
        s.temperature[1900..].fill(NAN);
        s.rate[0] = NAN;
    }),
    ("outliers", |s| {
        for (row, by) in [(3, 0.4), (500, -0.9), (501, 0.3), (1999, 5.0)] {
            s.rate[row] += by;
            s.temperature[row] += 20.0 * by;
        }
    }),
    ("codes", |s| {
        s.temperature[60..64].fill(-999.9);
        s.temperature[800] = 850.0;
        s.rate[1000..1003].fill(9999.0);
    }),
    ("stuck", |s| {
        let value = s.rate[700];
        s.rate[700..760].fill(value);
        let value = s.temperature[1300];
        s.temperature[1300..1420].fill(value);
    }),
    ("saturated", |s| s.rate.iter_mut().for_each(|rate| *rate = rate.clamp(-0.33, 0.36))),
    ("held", |s| held(&mut s.temperature, 4)),
    ("held means", |s| {
        held(&mut s.rate, 3);
        s.temperature[1600] = NAN;
    }),
    ("coarse", |s| s.rate.iter_mut().for_each(|rate| *rate = round(*rate, 0.04))),
    ("empty", |s| s.rate.fill(NAN)),
    ("constant", |s| {
        s.rate.fill(0.4);
        s.temperature.fill(20.0);
    }),
    ("short", |s| without(s, 40..2000)),
    ("kelvin", |s| s.temperature.iter_mut().for_each(|t| *t += 273.15)),
    ("per second", |s| s.rate.iter_mut().for_each(|rate| *rate /= 3600.0)),
    ("earth", |s| s.rate.iter_mut().for_each(|rate| *rate -= 9.7)),
    ("minutes", |s| s.time.iter_mut().for_each(|t| *t /= 60.0)),
    ("moved", |s| s.rate[1100..1140].iter_mut().enumerate().for_each(|(n, rate)| *rate += 60.0 * n as f64)),
];

#[test]
fn of_defects() {
    let mut figures = Figures::default();
    for (name, change) in DEFECTS {
        let report = altered(change).report_of(&expectations());
        for (n, finding) in report.findings.iter().enumerate() {
            figures.add(&format!("check {name} {n}"), finding);
            if n == 0 {
                figures.add(&format!("check {name} {n} in words"), &finding.to_string());
            }
        }
        let used = report.masks.iter().map(|mask| mask.iter().filter(|used| **used).count()).collect::<Vec<_>>();
        figures.add(&format!("check {name} rows"), &(report.rows.len(), used, &report.instants));
        figures.add(&format!("check {name} channels"), &report.channels);
    }
    figures.hold(KEPT, "check");
}

#[test]
fn of_conditioning() {
    let (mut figures, mut sample) = (Figures::default(), sound(4, 0.01));
    without(&mut sample, 610..617);
    sample.rate[33..37].fill(NAN);
    let seldom: Vec<f64> = sample.temperature.iter().enumerate().map(|(n, t)| if n % 3 == 1 { *t } else { NAN }).collect();
    let channel =
        |name: &str, values: &[f64], sampling| Channel { name: name.into(), unit: "u".into(), values: values.to_vec(), sampling };
    let channels = vec![
        channel("temperature", &sample.temperature, Sampling::Momentary),
        channel("seldom", &seldom, Sampling::Momentary),
        channel("rate", &sample.rate, Sampling::Mean),
    ];
    let record = Recording::new(sample.time.clone(), channels).expect("one shape");
    let interval = recording::median_interval(&sample.time).expect("many");
    for (many_rows, seconds, most_rows) in [(100, 120.0, 10_000), (100, 10.0, 150), (1993, 120.0, 100), (1992, 74.0, 5000)] {
        let name = format!("condition {many_rows} {seconds} {most_rows}");
        let Some(thin) = thinned(&record, interval, &Thinning { many_rows, interval: seconds, most_rows }) else {
            figures.add(&name, &"as it is");
            continue;
        };
        figures.add(&name, &(thin.every, thin.rows));
        figures.series(&format!("{name} time"), thin.recording.time());
        for channel in thin.recording.channels() {
            figures.series(&format!("{name} {}", channel.name), &channel.values);
        }
    }
    let whole = bridged(&sample.time, &seldom).expect("some are there");
    figures.series("condition bridged", &whole);
    figures.series("condition slopes", &slopes(&sample.time, &whole));
    figures.series("condition lagging", &lagging(&sample.time, &whole, 333.0));
    figures.add("condition span", &(span(&whole), span(&seldom), span(&[])));
    let moved: Vec<f64> = whole.iter().zip(&sample.time).map(|(t, s)| t - 3.0 * (-s / 900.0).exp()).collect();
    for (duration, tolerance) in [(600.0, 0.5), (600.0, 5.0), (7000.0, 0.5), (7000.0, 5.0), (7000.0, 100.0)] {
        let found = unrest(&sample.time, &whole, &moved, &Rest { duration, tolerance });
        figures.add(&format!("condition unrest {duration} {tolerance}"), &found);
    }
    figures.hold(KEPT, "condition");
}

/// Noise with every term.
const NOISE: NoiseModel = NoiseModel {
    averaging: 30.0,
    white: 0.05,
    drift: 0.06,
    drift_time: 900.0,
    walk: 1e-4,
    quantisation: 0.3,
    passed: 0.03,
    passed_time: 5000.0,
};

#[test]
fn of_noise() {
    let mut figures = Figures::default();
    let (interval, rows) = (30.0, 600);
    let mut time = even(rows, interval);
    time[200..].iter_mut().for_each(|t| *t += 95.0);
    let mask: Vec<bool> = (0..rows).map(|n| n % 41 != 7).collect();
    let (one, slope) = (vec![1.0; rows], time.iter().map(|t| t / 1e4).collect::<Vec<f64>>());
    let double: Vec<f64> = slope.iter().map(|t| 2.0 * t - 1.0).collect();
    let columns: [&[f64]; 3] = [&one, &slope, &double];
    for (name, model, averaging) in [
        ("white", NoiseModel::white(0.1, 30.0), 30.0),
        ("drift", NoiseModel { walk: 0.0, quantisation: 0.0, drift: 0.15, drift_time: 400.0, ..NOISE }, 30.0),
        ("walk", NoiseModel { drift: 0.0, quantisation: 0.0, walk: 1e-3, ..NOISE }, 30.0),
        ("rounded", NoiseModel { drift: 0.0, walk: 0.0, quantisation: 3.0, ..NOISE }, 30.0),
        ("momentary", NoiseModel { walk: 0.0, quantisation: 0.0, ..NOISE }, 0.0),
    ] {
        let mut values = simulate(&model, rows, &mut Random::new(11));
        values.iter_mut().zip(&slope).for_each(|(value, t)| *value += 2.0 + 0.3 * t);
        let series = Series { time: &time, values: &values, mask: &mask, columns: &columns };
        let mut bounds = Bounds::new(averaging, &time);
        if averaging > 0.0 {
            bounds.terms.push(Term::Quantisation);
        }
        figures.add(&format!("noise {name} bounds"), &bounds);
        let found = identify(&series, &bounds).expect("noise");
        figures.add(&format!("noise {name} model"), &(found.model, found.log_likelihood, &found.terms, found.rows, found.group));
        // a curvature of the likelihood, by differences
        let errors = found.standard_errors;
        let rounded = |error: Option<f64>| error.map(|error| (error * 1e3).round());
        let all = [errors.white, errors.drift, errors.drift_time, errors.walk, errors.quantisation].map(rounded);
        figures.add(&format!("noise {name} errors in thousandths"), &all);
        let candidates: Vec<_> = found.candidates.iter().map(|c| (&c.terms, c.log_likelihood, c.bic)).collect();
        figures.add(&format!("noise {name} candidates"), &candidates);
        figures.add(&format!("noise {name} about"), &found.about().len());
        figures.add(&format!("noise {name} whiteness"), &[3, 10].map(|lags| whiteness(&values[20..70], lags)));
        let model = NoiseModel { averaging, ..NOISE };
        let whitener = Whitener::new(&model, &time, &mask).map(|w| (w.rows().len(), w.log_det(), w.log_likelihood(&values)));
        figures.add(&format!("noise {name} likelihood of another"), &whitener);
        let model = if averaging > 0.0 { model } else { NoiseModel { quantisation: 0.0, ..model } };
        let amounts = fitted(&series, &model).expect("amounts");
        let sums =
            [&[(0, 1.0)][..], &[(0, 1.0), (1, -2.0)], &[(2, 1.0)], &[(2, 0.0), (1, 0.5)]].map(|weights| amounts.sum(weights));
        figures.add(&format!("noise {name} amounts"), &sums);
        figures.series(&format!("noise {name} left"), &residual(&series, &model).expect("a residual"));
        let points = allan::allan(&time, &values, &mask).expect("long enough");
        for point in &points {
            figures.add(&format!("noise {name} Allan"), point);
        }
    }
    let deviations: Vec<f64> = (0..12).map(|n| NOISE.allan_deviation(30.0 * f64::from(1 << n), 30.0)).collect();
    figures.add("noise deviation", &(deviations, NOISE.bias_instability(), NOISE.angle_random_walk()));
    let momentary = NoiseModel { averaging: 0.0, quantisation: 0.0, ..NOISE };
    figures.add("noise floor", &[NOISE, momentary].map(|model| model.floor([30.0, 40_000.0], 30.0)));
    figures.add("noise no floor", &NoiseModel::white(0.1, 30.0).floor([30.0, 40_000.0], 30.0));
    figures.hold(KEPT, "noise");
}

#[test]
fn of_ramps() {
    let mut figures = Figures::default();
    let corners = [
        (0.0, -40.0),
        (3000.0, -40.0),
        (6000.0, 10.0),
        (9000.0, 10.0),
        (12_000.0, 60.0),
        (15_000.0, 60.0),
        (17_000.0, 10.0),
        (21_000.0, 10.0),
        (24_000.0, -40.0),
        (27_000.0, -40.0),
    ];
    let course = |t: f64| {
        let pair = corners.windows(2).find(|w| t <= w[1].0).expect("within");
        pair[0].1 + (pair[1].1 - pair[0].1) * (t - pair[0].0) / (pair[1].0 - pair[0].0)
    };
    let time = even(450, 60.0);
    let mask: Vec<bool> = (0..450).map(|n| n % 37 != 5).collect();
    let exact: Vec<f64> = time.iter().map(|t| course(*t)).collect();
    for (name, step, factor) in [("fine", 0.0, 1.0), ("coarse", 0.25, 1.0), ("steep", 0.0, 40.0)] {
        let mut random = Random::new(5);
        let drive: Vec<f64> =
            exact.iter().map(|t| if step > 0.0 { round(*t, step) } else { t + 0.01 * random.normal() }).collect();
        let seat: Vec<f64> = exact.iter().zip(lagging(&time, &exact, 700.0)).map(|(t, behind)| t - behind).collect();
        let slow = lagging(&time, &exact, 400.0);
        let noise = simulate(
            &NoiseModel { averaging: 60.0, quantisation: 0.0, walk: 0.0, drift: 0.01, passed: 0.0, ..NOISE },
            450,
            &mut random,
        );
        let hysteresis = |n: usize| if time[n] > 16_000.0 { -0.2 } else { 0.0 };
        let values: Vec<f64> = (0..450)
            .map(|n| {
                factor * (-0.7 * slow[n] / 400.0 * 60.0 + 1e-3 * seat[n] + 2e-5 * seat[n].powi(2) + hysteresis(n)) + noise[n]
            })
            .collect();
        let input = Input {
            time: &time,
            values: &values,
            mask: &mask,
            drive: &drive,
            reading: [0.01, step],
            seat: &seat,
            interval: 60.0,
            averaging: 60.0,
        };
        let told = respond(&input).expect("there are ramps");
        let estimates = [&told.sensitivity, &told.heating, &told.cooling, &told.asymmetry, &told.hysteresis, &told.span];
        for (what, estimate) in ["sensitivity", "heating", "cooling", "asymmetry", "hysteresis", "span"].iter().zip(estimates) {
            figures.add(&format!("ramp {name} {what}"), estimate);
        }
        figures.add(&format!("ramp {name} peak"), &told.peak);
        figures.add(&format!("ramp {name} lags"), &told.lags);
    }
    figures.hold(KEPT, "ramp");
}

#[test]
fn of_smoothing() {
    let (mut figures, sample) = (Figures::default(), sound(9, 0.01));
    // ramps of a programme behind a lag, read with noise
    let time = &sample.time[..600];
    let course: Vec<f64> = time.iter().map(|t| if *t < 5000.0 { 20.0 } else { (20.0 + (t - 5000.0) / 90.0).min(80.0) }).collect();
    let lagged: Vec<f64> = lagging(time, &course, 240.0).iter().zip(&course).map(|(behind, t)| t - behind).collect();
    let mut random = Random::new(3);
    let noisy: Vec<f64> = lagged.iter().map(|t| t + 0.05 * random.normal()).collect();
    let mut rounded: Vec<f64> = noisy.iter().map(|t| round(*t, 0.1)).collect();
    figures.add("smooth resolution", &[&noisy, &rounded, &course].map(|values| resolution(values)));
    for (name, digit) in [("noisy", None), ("rounded", None), ("rounded to a digit", Some(0.1)), ("with holes", None)] {
        if name == "with holes" {
            rounded[250..262].fill(NAN);
            rounded[30] = NAN;
        }
        let found = smoothed(time, if name == "noisy" { &noisy } else { &rounded }, digit).expect("many rows");
        figures.add(&format!("smooth {name}"), &(found.noise, found.left, found.of));
        figures.series(&format!("smooth {name} course"), &found.values);
        let left: Vec<f64> = found.values.iter().zip(&lagged).map(|(a, b)| a - b).collect();
        figures.add(&format!("smooth {name} error"), &robust_sd(left.iter().copied(), 0.0));
    }
    figures.hold(KEPT, "smooth");
}
