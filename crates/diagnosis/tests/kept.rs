//! All numbers of some diagnoses as they were: whatever changes one of them is noticed. Whether they are right is for the other tests to say.
//!
//! After a change that is meant, `RENEW=1 cargo test -p diagnosis kept` writes them anew: read the difference.

use crate::common::lines::Lines;
use crate::toy::{Bath, ROWS, observed};
use diagnosis::{
    Active, Breadth, Diagnosis, Fit, Hypothesis, Observation, Plan, Settings, alternatives, compose_within, diagnose, prove,
    sampled, separation, whiteness,
};
use std::fmt::{Debug, Write as _};

/// Relative change of a number that goes unnoticed: far above rounding and the end of a search.
const SAME: f64 = 1e-4;
/// Numbers below are the same as 0.
const NOTHING: f64 = 1e-9;
const DIGITS: usize = 6;

/// Splits a text into numbers and what is between them, in turn.
fn parts(text: &str) -> Vec<Result<f64, String>> {
    let mut parts = Vec::new();
    for word in text.split_inclusive(|c: char| !(c.is_alphanumeric() || "+-._".contains(c))) {
        let bare = word.trim_end_matches(|c: char| !(c.is_alphanumeric() || "._".contains(c)));
        match bare.parse::<f64>() {
            Ok(number) if bare.starts_with(|c: char| c.is_ascii_digit() || c == '-') => {
                parts.push(Ok(number));
                parts.push(Err(word[bare.len()..].to_owned()));
            }
            _ => parts.push(Err(word.to_owned())),
        }
    }
    parts
}

/// Holds `value` against what is kept under its name.
fn kept(name: &str, value: &impl Debug) {
    let path = format!("{}/tests/kept/{name}.txt", env!("CARGO_MANIFEST_DIR"));
    let now = parts(&format!("{value:?}").replace("), ", "),\n").replace("}, ", "},\n"));
    if std::env::var_os("RENEW").is_some() {
        let mut text = String::new();
        for part in &now {
            match part {
                Ok(number) if number.fract() == 0.0 => write!(text, "{number}").expect("text"),
                Ok(number) => write!(text, "{number:.DIGITS$e}").expect("text"),
                Err(between) => text += between,
            }
        }
        std::fs::write(&path, text + "\n").expect("a file");
        return;
    }
    let before = std::fs::read_to_string(&path).expect("kept");
    let before = parts(before.trim_end_matches('\n'));
    assert_eq!(before.len(), now.len(), "{name}: {now:#?}");
    for (place, pair) in before.iter().zip(&now).enumerate() {
        let same = match pair {
            (Ok(before), Ok(now)) => {
                (before - now).abs() <= SAME * before.abs().max(now.abs()) + NOTHING || (before.is_nan() && now.is_nan())
            }
            (before, now) => before == now,
        };
        assert!(same, "{name}, number {place}: {:?} was {:?}, after {:?}", pair.1, pair.0, &now[place.saturating_sub(8)..place]);
    }
}

/// What a fit says besides its residuals.
fn said(fit: &Fit, bath: &Bath) -> impl Debug + use<> {
    let squares = |series: &Vec<f64>| series.iter().map(|r| r * r).sum::<f64>();
    let left: Vec<f64> = fit.residuals.iter().flatten().map(squares).collect();
    (
        fit.hypothesis.clone(),
        fit.active.clone(),
        fit.nuisances.clone(),
        fit.offsets.clone(),
        left,
        fit.posteriors(bath),
        *fit.noise_model(0, 0),
    )
}

/// What a diagnosis says, ln evidence as its distance from the best.
fn summary(bath: &Bath, diagnosis: &Diagnosis) -> impl Debug {
    let best = diagnosis.best();
    let candidates: Vec<_> = diagnosis
        .candidates
        .iter()
        .filter(|c| c.probability > 1e-6)
        .map(|c| {
            let structure = c.rival.as_ref().map(|r| (r.structure, r.at, r.gain));
            (c.fit.hypothesis.clone(), structure, c.log_prior(), best.log_weight - c.log_weight, c.probability)
        })
        .collect();
    (
        (diagnosis.verdict, diagnosis.verdicts(), diagnosis.mechanisms.clone(), diagnosis.set.clone()),
        candidates,
        diagnosis.parameters.clone(),
        diagnosis.stages.clone(),
        [&best.fit, &diagnosis.nominal, &diagnosis.mismatch].map(|fit| said(fit, bath)),
    )
}

/// Places of a mismatch, and how a held-out record is predicted and judged.
fn places(bath: &Bath, diagnosis: &Diagnosis, record: &Observation, held: &Observation) -> impl Debug {
    let judge = &diagnosis.best().fit;
    let nominal = &diagnosis.nominal;
    let mut judged = diagnosis.clone();
    let judgement = judged.judge(bath, bath, None, (0, record), &[(1, held)], 0).expect("a judgement");
    (
        nominal.in_time(0, 0, record, judge),
        nominal.over_state(bath, (0, 0), 0, record, judge),
        nominal.in_frequency(bath, (0, 0), 0, record),
        whiteness(&nominal.whitened_residual(0, 0, record, judge).1),
        diagnosis.mismatch.resolution(bath, &[0], 2.0).expect("a resolution"),
        (judgement, judged.verdict, judged.verdicts()),
        prove(bath, nominal, judge, &[(1, held)]).expect("a proof"),
    )
}

/// The diagnosis of one unit, of what is concealed in each of its two records.
fn unit(name: &str, concealed: impl Fn(&Bath, usize) -> Vec<f64>, seed: u64) -> (Bath, [Observation; 2], Diagnosis) {
    let bath = Bath::new();
    let records = [0, 1].map(|number| observed(&bath, &concealed(&bath, number), seed + 100 * number as u64));
    let found = diagnose(&bath, &[0], &records[..1], &Settings::default(), &|_| ()).expect("a diagnosis");
    kept(name, &summary(&bath, &found));
    (bath, records, found)
}

#[test]
fn of_nothing() {
    unit("nothing", |bath, record| bath.truth(record, None), 5);
}

#[test]
fn of_a_lag() {
    let (bath, [record, held], found) = unit("lag", |bath, record| bath.truth(record, Some((0, 45.0))), 6);
    kept("lag-places", &places(&bath, &found, &record, &held));
}

#[test]
fn of_a_bend() {
    unit("bend", |bath, record| bath.truth(record, Some((1, 1.5))), 7);
}

#[test]
fn of_a_ripple_beside_a_bend() {
    let rippled = |bath: &Bath, record: usize| -> Vec<f64> {
        let level = bath.level(record);
        bath.truth(record, Some((1, 1.0))).iter().zip(level).map(|(y, l)| y + 0.12 * (l / 1.1).sin()).collect()
    };
    let (bath, [record, held], found) = unit("ripple", rippled, 8);
    kept("ripple-places", &places(&bath, &found, &record, &held));
}

#[test]
fn of_a_step() {
    let stepped = |bath: &Bath, record: usize| -> Vec<f64> {
        bath.truth(record, None).iter().enumerate().map(|(n, y)| if n < ROWS / 2 + 18 { *y } else { y + 0.35 }).collect()
    };
    unit("step", stepped, 9);
}

/// Two records at once.
#[test]
fn of_two_records() {
    let bath = Bath::new();
    let records = [0, 1].map(|number| observed(&bath, &bath.truth(number, Some((0, 60.0))), 11 + number as u64));
    let found = diagnose(&bath, &[0, 1], &records, &Settings::default(), &|_| ()).expect("a diagnosis");
    kept("two", &summary(&bath, &found));
}

/// How well a record would tell two mechanisms apart, what draws say of a fit, and laws that are composed.
#[test]
fn of_plans_draws_and_laws() {
    let bath = Bath::new();
    let record = observed(&bath, &bath.truth(0, Some((0, 45.0))), 12);
    let records = std::slice::from_ref(&record);
    let truth = [Active { mechanism: 0, values: vec![45.0], choice: None }];
    let plan = Plan { records: &[0], instants: records, noise: None };
    let apart = separation(&bath, &plan, &truth, &alternatives(&bath, 1)).expect("a separation");
    let nothing = diagnosis::fitted(&bath, &[0], records, &[Hypothesis::NOMINAL]).expect("a fit");
    let with = diagnosis::fitted(&bath, &[0], records, &alternatives(&bath, 0)).expect("a fit");
    let draws = sampled(&bath, &[0], records, &with, 500, 3).expect("samples");
    let composed = compose_within(&bath, 0..2, &[0], records, &nothing, Breadth::default(), &|_| ())
        .expect("composed")
        .map(|c| (c.laws, c.gain, c.log_weight(-1.0), said(&c.fit, &bath)));
    kept("plans", &(apart.squared, apart.own, apart.log_odds(), draws, composed));
}

/// Sizes of two lines in white noise.
#[test]
fn of_lines() {
    let lines = Lines::with_either(200);
    let mut normal = crate::common::normal(3);
    let y: Vec<f64> = lines.column(1).iter().map(|x| 1.2 * x + 0.5 * normal()).collect();
    let records = [lines.observed(&y)];
    let found = diagnose(&lines, &[0], &records, &Settings::default(), &|_| ()).expect("a diagnosis");
    let weights: Vec<_> = found.candidates.iter().map(|c| (c.fit.hypothesis.clone(), c.probability, c.log_prior())).collect();
    kept("lines", &(found.verdict, found.verdicts(), found.mechanisms, found.parameters, weights));
}
