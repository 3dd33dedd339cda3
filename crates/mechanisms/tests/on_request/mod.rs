//! Mechanisms that are weighed on request: against the chain, against what they must equal, and what a diagnosis says of those that look alike.

use super::{anew, course, design, gyro, of, rms};
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, MechanicalState, Model, STANDARD};
use diagnosis::{Active, ForwardModel, Observation, Settings, Verdict, diagnose};
use mechanisms::{
    CATALOGUE, Chamber, Gyro, Instruments, Library, Mechanism, ON_REQUEST, Prepared, RATE, SPOOL, USUAL_NOISE, find,
};
use std::collections::BTreeMap;

/// Earth's rate of the records \[deg/h\].
const EARTH: f64 = 9.7;

fn library() -> Library {
    gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone()
}

fn all() -> Vec<&'static dyn Mechanism> {
    [CATALOGUE, ON_REQUEST].concat()
}

/// A forward model of one record with further columns, and with Earth's rate told.
fn under(
    library: Library,
    mechanisms: &[&'static dyn Mechanism],
    chamber: &[f64],
    columns: &[(&str, Vec<f64>)],
) -> Gyro<'static> {
    as_noisy(library, mechanisms, chamber, columns, USUAL_NOISE[RATE])
}

/// The same of a gyroscope whose readings have a white noise \[deg/h\].
fn as_noisy(
    library: Library,
    mechanisms: &[&'static dyn Mechanism],
    chamber: &[f64],
    columns: &[(&str, Vec<f64>)],
    white: f64,
) -> Gyro<'static> {
    let time = course().0;
    let prepared = Prepared::under(&library, &time, &Chamber::given(&time, chamber), 60.0).expect("prepared");
    let columns: BTreeMap<String, Vec<f64>> = columns.iter().map(|(name, values)| ((*name).to_owned(), values.clone())).collect();
    let told = Instruments { earth: Some(EARTH), white: [USUAL_NOISE[SPOOL], white], ..Instruments::default() };
    Gyro::fitted_to(library, mechanisms, vec![prepared.with_columns(columns)], 1, &told).expect("gyro")
}

/// Change of a channel by a mechanism.
fn changed(gyro: &Gyro, id: &str, values: &[f64], channel: usize) -> Vec<f64> {
    let middle = diagnosis::expected(gyro.nuisances());
    let active = Active { mechanism: gyro.find(id).expect("a mechanism"), values: values.to_vec(), choice: None };
    let [with, without] = [&[active][..], &[]].map(|active| gyro.respond(0, &middle, active).expect("response"));
    with[channel].iter().zip(&without[channel]).map(|(a, b)| a - b).collect()
}

fn columns(time: &[f64]) -> Vec<(&'static str, Vec<f64>)> {
    let humidity = time.iter().map(|t| if *t < 15_000.0 { 60.0 } else { 10.0 }).collect();
    let field = time.iter().map(|t| 50.0 * (t / 3000.0).sin().signum()).collect();
    vec![("humidity_percent", humidity), ("field_ut", field)]
}

/// Each with values that make it nothing, and with some that do not.
const SIZES: [(&str, &[f64], &[f64]); 10] = [
    ("polarisation-ripple", &[0.0, 0.0, 9.0, 20.0, 40.0], &[0.01, 0.0, 9.0, 20.0, 40.0]),
    ("magneto-optic", &[0.0], &[1e-3]),
    ("constant-field", &[0.0], &[1.0]),
    ("scale-factor-drift", &[0.0], &[50.0]),
    ("modulator-reset", &[0.0], &[50.0]),
    ("moisture", &[0.0, 2.0], &[1e-3, 2.0]),
    ("drying", &[0.0, 2.0], &[5e-4, 2.0]),
    ("stress-free-temperature", &[0.0, 5000.0, 60.0], &[0.2, 5000.0, 60.0]),
    ("racket", &[0.0], &[5e-3]),
    ("ratcheting", &[0.0, 5.0], &[0.2, 5.0]),
];

#[test]
fn exact_what_has_no_size_changes_nothing() {
    let gyro = under(library(), &all(), &course().1, &columns(&course().0));
    assert_eq!(SIZES.map(|(id, ..)| id), ON_REQUEST.iter().map(|m| m.facts().id).collect::<Vec<_>>()[..]);
    for (id, nothing, something) in SIZES {
        // what relaxes is interpolated between moduli
        assert!(rms(&changed(&gyro, id, nothing, RATE)) < 1e-9, "{id}");
        let changes = changed(&gyro, id, something, RATE);
        assert!(rms(&changes) > 1e-5 && changes.iter().all(|x| x.is_finite()), "{id}: {}", rms(&changes));
        // none of them warms the spool
        assert!(changed(&gyro, id, something, SPOOL).iter().all(|kelvin| *kelvin == 0.0), "{id}");
    }
}

/// By hand, at every row: the optics and the read-out, from the temperatures as designed.
#[test]
fn exact_what_follows_a_temperature_or_a_column_does_so_in_every_row() {
    let (time, chamber) = course();
    let gyro = under(library(), &all(), &chamber, &columns(&time));
    let prepared = Prepared::under(gyro.library(), &time, &Chamber::given(&time, &chamber), 60.0).expect("prepared");
    let field = &columns(&time)[1].1;
    let responsivity = |t: f64| (1.0 + 6.9e-5 * (t - 20.0)) * 880.0 / (900.0 - t);
    let wave = |t: f64| {
        let seen = (-(std::f64::consts::PI * (t - 30.0) / 9.0 / 12.0).powi(2) / (4.0 * std::f64::consts::LN_2)).exp();
        seen * (0.02 * (std::f64::consts::TAU * (t - 20.0) / 9.0).sin() - 0.01 * (std::f64::consts::TAU * (t - 20.0) / 9.0).cos())
    };
    let mean = |series: &[f64], n: usize, of: &dyn Fn(f64) -> f64| (of(series[n]) + of(series[n - 1])) / 2.0;
    let [ripple, field_bias, recorded] = [
        changed(&gyro, "polarisation-ripple", &[0.02, -0.01, 9.0, 30.0, 12.0], RATE),
        changed(&gyro, "constant-field", &[2.0], RATE),
        changed(&gyro, "magneto-optic", &[1e-3], RATE),
    ];
    for n in 1..time.len() {
        assert!((ripple[n] - mean(prepared.spool(), n, &wave)).abs() < 1e-9, "{n}");
        let warm = mean(prepared.coil(), n, &responsivity);
        assert!((field_bias[n] - 2.0 * (warm - 1.0)).abs() < 1e-9, "{n}");
        assert!((recorded[n] - 1e-3 * warm * mean(field, n, &|b| b)).abs() < 1e-9, "{n}");
    }
    // a ramp whose steps are too large reads too little
    let [larger, less] = ["scale-factor-drift", "modulator-reset"].map(|id| changed(&gyro, id, &[50.0], RATE));
    assert!(larger.iter().zip(&less).all(|(a, b)| (a + b).abs() < 1e-12) && rms(&larger) > 1e-3);
}

/// Without the column, or without Earth's rate, there is nothing to say.
#[test]
fn exact_what_a_record_does_not_tell_is_not_offered() {
    let gyro = of(library(), CATALOGUE);
    let beside = gyro.beside(ON_REQUEST);
    for id in ["scale-factor-drift", "modulator-reset"] {
        assert!(beside.find(id).is_none() && find(id).is_some(), "{id}");
    }
    for id in ["moisture", "magneto-optic"] {
        assert!(find(id).is_some_and(|m| m.columns().len() == 1), "{id}");
        assert!(
            changed(&beside, id, SIZES.iter().find(|s| s.0 == id).expect("a size").2, RATE).iter().all(|x| *x == 0.0),
            "{id}"
        );
    }
}

/// A coil that is free of stress where it begins has only what relaxes.
#[test]
fn exact_free_of_stress_at_the_start_it_relaxes_as_any_coil() {
    let gyro = under(library(), &all(), &course().1, &[]);
    let first = {
        let time = course().0;
        Prepared::under(gyro.library(), &time, &Chamber::given(&time, &course().1), 60.0).expect("prepared").coil()[0]
    };
    let stored = changed(&gyro, "stress-free-temperature", &[0.3, 5000.0, first], RATE);
    let plain = changed(&gyro, "viscoelastic-relaxation", &[0.3, 5000.0], RATE);
    assert!(stored.iter().zip(&plain).all(|(a, b)| (a - b).abs() < 1e-12 * rms(&plain)), "{}", rms(&plain));
}

/// Phase of a coil that is warmed evenly, with a factor on its transverse moduli, per kelvin \[deg/h s\].
fn even_phase(design: &Design, transverse_modulus: f64) -> f64 {
    let state = MechanicalState { transverse_modulus, ..MechanicalState::NOMINAL };
    let bias = Model::in_state(design, &STANDARD.resolution, &state).and_then(|model| model.bias_in_ramp()).expect("a ramp");
    DEG_PER_H_PER_RAD_PER_S * bias.total()
}

/// At rest the stored stress is given off whole: the phase moves from that of the stiff coil to that of the relaxed one, by e^(−t/τ).
#[test]
fn exact_at_rest_what_is_stored_is_given_off() {
    let (time, _) = course();
    let gyro = under(library(), &all(), &vec![20.0; time.len()], &[]);
    let (fraction, tau, free) = (0.05, 4000.0, 60.0);
    let rate = changed(&gyro, "stress-free-temperature", &[fraction, tau, free], RATE);
    let given = rate.windows(2).zip(time.windows(2)).map(|(r, t)| r[1] * (t[1] - t[0])).sum::<f64>();
    let expected = (20.0 - free) * (even_phase(&design(), 1.0 - fraction) - even_phase(&design(), 1.0));
    assert!((given - expected).abs() < 0.02 * expected.abs(), "{given} for {expected}");
    // a little of the stiffness: all decays with its time constant, but for the coil's own share of the relaxation
    let (early, late) = (rate[1], rate[201]);
    assert!(((early / late).ln() - 200.0 * 60.0 / tau).abs() < 0.1, "{early} {late}");
    // colder than free, or warmer: mirrored
    let mirrored = changed(&gyro, "stress-free-temperature", &[fraction, tau, -20.0], RATE);
    assert!(rate.iter().zip(&mirrored).all(|(a, b)| (a + b).abs() < 1e-6 * rms(&rate)));
}

/// A coil that swells at once as the humidity says, at rest: the bias of an expansion across the fibre at the same rate.
#[test]
fn exact_a_coil_swells_as_it_would_expand_across_its_fibre() {
    let (time, _) = course();
    let humidity: Vec<f64> = time.iter().map(|t| 50.0 * t / time[time.len() - 1]).collect();
    let gyro = under(library(), &all(), &vec![20.0; time.len()], &[("humidity_percent", humidity)]);
    // so fast that the water is everywhere at once
    let rate = changed(&gyro, "moisture", &[1e-3, 1e7], RATE);
    let strain_rate = 1e-3 * 0.5 / time[time.len() - 1];
    let alpha = design().body.elastic.alpha_r;
    let wider = |by: f64| {
        let mut design = design();
        design.body.elastic.alpha_r = alpha * (1.0 + by);
        even_phase(&design, 1.0)
    };
    let expected = (wider(0.5) - wider(-0.5)) / alpha * strain_rate;
    assert!(rate[5..].iter().all(|r| (r - expected).abs() < 0.02 * expected.abs()), "{} for {expected}", rate[300]);
}

/// Drying in one record mirrors swelling in another whose humidity steps at the first row; twice the step has twice the effect.
#[test]
fn symmetry_what_dries_is_what_was_taken_up() {
    let (time, chamber) = course();
    let stepped = (0..time.len()).map(|n| if n == 0 { 80.0 } else { 0.0 }).collect();
    let gyro = under(library(), &all(), &chamber, &[("humidity_percent", stepped)]);
    let moist = changed(&gyro, "moisture", &[5e-4, 3.0], RATE);
    let dries = changed(&gyro, "drying", &[4e-4, 3.0], RATE);
    // the humidity is linear between rows: the first minute apart
    let late = |x: &[f64]| x[60..].to_vec();
    let off: Vec<f64> = late(&moist).iter().zip(late(&dries)).map(|(a, b)| a - b).collect();
    assert!(rms(&off) < 0.01 * rms(&late(&dries)), "{} of {}", rms(&off), rms(&late(&dries)));
    let twice = changed(&gyro, "drying", &[-8e-4, 3.0], RATE);
    assert!(twice.iter().zip(&dries).all(|(a, b)| (a + 2.0 * b).abs() < 1e-9 * rms(&dries)));
}

/// The tabulated stiffness in the chain, modelled anew.
#[test]
fn a_stiffness_that_follows_temperature_follows_the_chain() {
    let gyro = of(library(), &all());
    let active = Active { mechanism: gyro.find("racket").expect("a mechanism"), values: vec![4e-3], choice: None };
    let extended = gyro.extended(&design(), &active).expect("a place in the design");
    let effect: Vec<f64> = anew(&extended)[RATE].iter().zip(&anew(&design())[RATE]).map(|(a, b)| a - b).collect();
    let off: Vec<f64> = changed(&gyro, "racket", &[4e-3], RATE).iter().zip(&effect).map(|(a, b)| a - b).collect();
    assert!(rms(&off) < super::SHARE * rms(&effect), "{} of {}", rms(&off), rms(&effect));
}

/// By hand: a record in which the coil goes where it was before, and where it was not.
#[test]
fn exact_a_ratchet_takes_its_share_where_it_is_new() {
    let gyro = of(library(), &all());
    let (time, chamber) = course();
    let prepared = Prepared::new(gyro.library(), &time, &chamber, 60.0).expect("prepared");
    let (coil, [_, axial, radial]) = (prepared.coil(), prepared.parts());
    let change = changed(&gyro, "ratcheting", &[0.25, 5.0], RATE);
    let (mut low, mut high) = (coil[0] - 5.0, coil[0] + 5.0);
    let mut seen = [false; 2];
    for n in 1..coil.len() {
        let whole = -0.25 * (axial[n] + radial[n]);
        let (new, old) = (coil[n - 1].min(coil[n]) >= high || coil[n - 1].max(coil[n]) <= low, coil[n] <= high && coil[n] >= low);
        // the gain of the mechanism on the parts acts on them once
        if old {
            assert!(change[n].abs() < 1e-9, "{n}");
            seen[0] |= whole.abs() > 1e-3;
        } else if new {
            assert!((change[n] - whole).abs() < 1e-9, "{n}: {} for {whole}", change[n]);
            seen[1] |= whole.abs() > 1e-3;
        }
        (low, high) = (low.min(coil[n]), high.max(coil[n]));
    }
    assert_eq!(seen, [true; 2]);
}

/// A record of a unit with a mechanism: white noise of the size that the channels' priors expect.
fn recorded(gyro: &Gyro, id: &str, values: &[f64]) -> Observation {
    let mut state = 7_u64;
    let mut uniform = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut noise = move |sd: f64| sd * ((0..12).map(|_| uniform()).sum::<f64>() - 6.0);
    let active = Active { mechanism: gyro.find(id).expect("a mechanism"), values: values.to_vec(), choice: None };
    let with = gyro.respond(0, &diagnosis::expected(gyro.nuisances()), &[active]).expect("response");
    let noisy = |(series, channel): (&Vec<f64>, &diagnosis::Channel)| -> Vec<f64> {
        series.iter().map(|x| x + noise(channel.noise.white.0)).collect()
    };
    Observation { time: course().0, channels: with.iter().zip(gyro.channels()).map(noisy).collect() }
}

/// Four that follow the temperature of a unit that stands still: none of them is named alone.
#[test]
fn what_no_record_tells_apart_is_one_set() {
    let alike = ["rate-temperature-coefficient", "scale-factor-drift", "modulator-reset", "constant-field"];
    let mechanisms: Vec<_> = alike.iter().chain(&["tail-asymmetry"]).map(|id| find(id).expect("known")).collect();
    let gyro = under(library(), &mechanisms, &course().1, &[]);
    let record = recorded(&gyro, "scale-factor-drift", &[80.0]);
    let found = diagnose(&gyro, &[0], &[record], &Settings::default(), &|_| ()).expect("diagnosis");
    assert_eq!(found.verdict, Verdict::Explained);
    let set: Vec<&str> = found.set.iter().map(|m| gyro.mechanisms()[*m].id.as_str()).collect();
    assert!(set.len() >= 3 && set.iter().all(|id| alike.contains(id)), "{set:?}");
    assert!(set.contains(&"scale-factor-drift"), "{set:?}");
}

/// A field that was recorded, and a humidity, are named, with their coefficients.
#[test]
fn what_was_recorded_is_named() {
    let (time, chamber) = course();
    for (id, values, first) in [("magneto-optic", vec![1e-4], 1e-4), ("moisture", vec![8e-3, 20.0], 8e-3)] {
        let known = ["tail-asymmetry", "rate-temperature-coefficient", "viscoelastic-relaxation", "magneto-optic", "moisture"];
        let mechanisms: Vec<_> = known.iter().map(|id| find(id).expect("known")).collect();
        let gyro = as_noisy(library(), &mechanisms, &chamber, &columns(&time), 1e-3);
        let record = recorded(&gyro, id, &values);
        let found = diagnose(&gyro, &[0], &[record], &Settings::default(), &|_| ()).expect("diagnosis");
        assert_eq!(found.verdict, Verdict::Explained, "{id}: {:?}", found.set);
        assert_eq!(found.set, [gyro.find(id).expect("its own")], "{id}");
        let [low, high] = found.parameters[0][0].ci90;
        assert!(low < first && first < high, "{id}: {first} in {low} to {high}");
    }
}
