//! Laws that are written as text against the program's own mechanisms, and against what they must do exactly.

use super::common;
use super::{gyro, rms, shared};
use coil::{Contact, Design, Drive, Dynamics, Heater, Mechanics, Profile, STANDARD, Side};
use diagnosis::{Active, ForwardModel, Parameter, Prior};
use laws::{Expression, State, System};
use mechanisms::{Body, CATALOGUE, Gyro, Input, Library, Mechanism, Prepared, RATE, SPOOL, Stage, Target, Written};

/// A mechanism with parameters a and b that sees the spool's thermometer, the coil's temperature, the rate of the former, the chamber and the time.
fn written(states: &[(&str, &str)], target: Target, law: &str) -> Written {
    let mut names = vec!["a", "b", "spool", "coil", "spool_rate", "chamber", "time"];
    let inputs = vec![
        Input::Temperature(Body::Spool, 0),
        Input::Temperature(Body::Coil, 0),
        Input::Temperature(Body::Spool, 1),
        Input::Temperature(Body::Chamber, 0),
        Input::Time,
    ];
    names.extend(["x", "y"].iter().take(states.len()));
    let of = |text: &str| Expression::parse(text, &names).unwrap_or_else(|fault| panic!("{text}: {fault}"));
    let states = states.iter().map(|(rate, first)| State::Rate { rate: of(rate), first: of(first) }).collect();
    let system = System { parameters: 2, inputs: inputs.len(), states, laws: vec![of(law)] };
    let parameter = |name: &str| Parameter::new(name, Prior::Normal { mean: 0.0, sd: 1.0 });
    let text = String::new;
    Written {
        id: "written".into(),
        title: text(),
        stage: Stage::Optics,
        equation: law.into(),
        signature: text(),
        source: text(),
        meaning: text(),
        inspection: text(),
        parameters: vec![parameter("a"), parameter("b")],
        starts: vec![vec![0.0, 0.0]],
        inputs,
        system,
        targets: vec![target],
    }
}

/// Contribution of a law to thermometer and rate, with a and b.
fn adds(written: &Written, values: [f64; 2]) -> [Vec<f64>; 2] {
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let prepared = from(&library, 0.0);
    let kinds: Vec<&dyn Mechanism> = CATALOGUE.iter().copied().chain([written as &dyn Mechanism]).collect();
    added(&Gyro::new(library, &kinds, vec![prepared]).expect("gyro"), "written", values.to_vec(), None)
}

/// A record whose first row is at so many seconds.
fn from(library: &Library, first: f64) -> Prepared {
    let (mut time, chamber) = super::course();
    time.iter_mut().for_each(|t| *t += first);
    Prepared::new(library, &time, &chamber, 60.0).expect("prepared")
}

fn added(gyro: &Gyro, id: &str, values: Vec<f64>, choice: Option<f64>) -> [Vec<f64>; 2] {
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let active = Active { mechanism: gyro.find(id).expect("a mechanism"), values, choice };
    let [with, without] = [&[active][..], &[]].map(|active| gyro.respond(0, &middle, active).expect("a response"));
    [SPOOL, RATE].map(|channel| super::minus(&with[channel], &without[channel]))
}

/// The same of one of the program's own.
fn of_catalogue(id: &str, values: &[f64], choice: Option<f64>) -> [Vec<f64>; 2] {
    added(&gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner), id, values.to_vec(), choice)
}

fn close(what: &str, ours: &[Vec<f64>; 2], theirs: &[Vec<f64>; 2], share: f64) {
    for channel in [SPOOL, RATE] {
        let (off, size) = (rms(&super::minus(&ours[channel], &theirs[channel])), rms(&theirs[channel]));
        assert!(off <= share * size + 1e-9, "{what}, channel {channel}: off by {off:e} of {size:e}");
    }
}

#[test]
fn exact_a_law_that_says_what_a_mechanism_says_does_what_it_does() {
    // temperatures here are the design's, there what the thermometer says: a delay of a second of lag
    let drift = written(&[], Target::Rate, "a * (spool - 20)");
    close("drift", &adds(&drift, [2e-3, 0.0]), &of_catalogue("rate-temperature-coefficient", &[2e-3], None), 1e-2);
    let soft = written(&[], Target::Stiffness, "(a - 1) / (1 + exp(-(coil - b) / 5))");
    let theirs = of_catalogue("glass-transition", &[35.0, 5.0, 0.7, 1.0], None);
    close("transition", &adds(&soft, [0.7, 35.0]), &theirs, 2e-3);
    let wide = written(&[], Target::Expansion, "(a - 1) / (1 + exp(-(coil - b) / 5))");
    close("expansion", &adds(&wide, [1.2, 35.0]), &of_catalogue("glass-transition", &[35.0, 5.0, 1.0, 1.2], None), 2e-3);
    let tail = written(&[], Target::Tail, "a");
    close("tail", &adds(&tail, [0.3, 0.0]), &of_catalogue("tail-asymmetry", &[0.3], None), 2e-3);
    // a bond that is open throughout: below a temperature that no record reaches
    let open = written(&[], Target::OpenBond, "a");
    close("bond", &adds(&open, [0.3, 0.0]), &of_catalogue("debond", &[200.0, 5.0, 0.3], Some(1.0)), 1e-9);
}

#[test]
fn a_law_is_offered_where_the_design_has_its_place() {
    let scene = *gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).scene();
    let drawn = super::design();
    let mut relaxing = drawn.clone();
    relaxing.mechanics = Mechanics::Relaxing { fraction: 0.3, time: 9000.0 };
    let mut free = drawn.clone();
    free.spool = None;
    for target in [
        Target::Rate,
        Target::Chamber,
        Target::Tail,
        Target::Bias,
        Target::Stiffness,
        Target::Expansion,
        Target::FlangePower,
        Target::OpenBond,
    ] {
        let is_offered = |design: &Design| written(&[], target, "a").offer(design, &scene).is_some();
        let is_soft = matches!(target, Target::Stiffness | Target::Expansion);
        let is_of_flange = matches!(target, Target::FlangePower | Target::OpenBond);
        assert!(is_offered(&drawn), "{target:?}");
        // stiffness and bonds are a design's own, once they change
        assert_eq!(is_offered(&relaxing), !is_soft && target != Target::OpenBond, "{target:?}");
        assert_eq!(is_offered(&free), !is_of_flange, "{target:?}");
    }
}

#[test]
fn exact_heat_into_a_flange_warms_as_a_heater_does() {
    // on from the first row
    let power = written(&[], Target::FlangePower, "a * step(time - 0.01)");
    let theirs = of_catalogue("self-heating", &[0.05, 0.0], Some(1.0));
    let ours = adds(&power, [0.05, 0.0]);
    let late = 60..720;
    for channel in [SPOOL, RATE] {
        let part = |series: &[f64]| series[late.clone()].to_vec();
        let (off, size) = (rms(&super::minus(&part(&ours[channel]), &part(&theirs[channel]))), rms(&part(&theirs[channel])));
        assert!(off < 0.02 * size, "channel {channel}: off by {off:e} of {size:e}");
    }
}

/// A flange and a film: few models, and nothing that is left to the medium.
fn heated(power: f64) -> Design {
    let mut heated = super::design();
    common::spool(&mut heated).flanges[0].contact = Contact::Gap;
    heated.heat.film = Some(8.0);
    heated.heat.heaters.push(Heater { side: Side::Right, power });
    heated
}

#[test]
fn a_power_that_is_switched_within_a_row_acts_from_its_instant() {
    const POWER: f64 = 0.25;
    let design = heated(POWER);
    let mut unheated = design.clone();
    unheated.heat.heaters.clear();
    let library = shared::library(&unheated, CATALOGUE, &|_| ());
    let power = written(&[], Target::FlangePower, "a * step(time - b)");
    let (time, chamber) = super::course();
    let prepared = Prepared::new(&library, &time, &chamber, 60.0).expect("prepared");
    let gyro = Gyro::new(library, &[&power], vec![prepared]).expect("gyro");
    let ours = |when: f64| added(&gyro, "written", vec![POWER, when], None);
    // the chain, whose courses are straight lines, at seconds: off, on from the second that follows, 60 means a row
    let scale = bias::units::DEG_PER_H_PER_RAD_PER_S;
    let dynamics = Dynamics::new(&design, &[Drive::Chamber, Drive::Heaters], &STANDARD).expect("dynamics");
    let exact = |when: u32| {
        let rows = 720;
        let seconds: Vec<u32> = (0..=60 * (rows - 1)).filter(|t| *t % 60 == 0 || (18_000..24_000).contains(t)).collect();
        let instants: Vec<f64> = seconds.iter().map(|t| f64::from(*t)).collect();
        let on = seconds.iter().map(|t| f64::from(u8::from(*t >= when))).collect();
        let told = dynamics.simulate(&Profile { time: instants, drives: vec![vec![20.0; seconds.len()], on] }).expect("run");
        let (mut spool, mut rate, mut sum) = (Vec::new(), Vec::new(), 0.0);
        for (n, response) in told.iter().enumerate() {
            let dt = if n > 0 { f64::from(seconds[n] - seconds[n - 1]) } else { 0.0 };
            sum += scale * response.rate() * dt;
            if seconds[n].is_multiple_of(60) {
                spool.push(response.sensor - 20.0);
                rate.push(std::mem::take(&mut sum) / 60.0);
            }
        }
        [spool, rate]
    };
    // half a second of the straight line that rises in the second before
    for when in [19_980, 19_981, 20_010, 20_035, 20_040] {
        close(&format!("on at {when} s"), &ours(f64::from(when) - 0.5), &exact(when), 1e-2);
    }
    // from row to row the response follows the instant without a jump, and its slope, too
    let change = |from: f64, by: f64| {
        let [later, sooner] = [ours(from + by), ours(from)];
        [SPOOL, RATE].map(|channel| super::minus(&later[channel], &sooner[channel]))
    };
    let whole = change(19_990.0, 40.0);
    let mut parts = [vec![0.0; 720], vec![0.0; 720]];
    for k in 0..8 {
        let part = change(19_990.0 + 5.0 * f64::from(k), 5.0);
        for channel in [SPOOL, RATE] {
            let share = rms(&part[channel]) / rms(&whole[channel]);
            assert!((0.1..0.2).contains(&share), "part {k}, channel {channel}: {share} of the change");
            parts[channel].iter_mut().zip(&part[channel]).for_each(|(sum, x)| *sum += x);
        }
    }
    close("all parts together", &parts, &whole, 1e-9);
}

#[test]
fn exact_a_rate_that_jumps_within_a_row_is_the_mean_of_that_row() {
    let steps = written(&[], Target::Rate, "a * step(time - b)");
    let rate = &adds(&steps, [0.3, 6015.0])[RATE];
    assert!(rate[..101].iter().all(|r| r.abs() < 1e-12) && rate[102..].iter().all(|r| (r - 0.3).abs() < 1e-12));
    assert!((rate[101] - 0.3 * 45.0 / 60.0).abs() < 1e-6, "{}", rate[101]);
}

#[test]
fn exact_a_warmer_chamber_warms_everything() {
    let nominal = |channel: usize| {
        let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
        gyro.respond(0, &middle, &[]).expect("a response").swap_remove(channel)
    };
    // from 20 degC on, where the course begins: a chamber that moves by a hundredth more moves all by as much
    let gain = adds(&written(&[], Target::Chamber, "a * (chamber - 20)"), [0.01, 0.0]);
    let by = |series: Vec<f64>, rest: f64| series.into_iter().map(|x| 0.01 * (x - rest)).collect::<Vec<_>>();
    close("gain", &gain, &[by(nominal(SPOOL), 20.0), by(nominal(RATE), 0.0)], 1e-3);
    let warmer = adds(&written(&[], Target::Chamber, "a"), [1.5, 0.0]);
    assert!(warmer[SPOOL].iter().all(|t| (t - 1.5).abs() < 1e-9) && warmer[RATE].iter().all(|r| r.abs() < 1e-9));
}

#[test]
fn exact_relative_changes_are_shares_of_the_parts() {
    let all = adds(&written(&[], Target::Bias, "a"), [0.1, 0.0]);
    let parts = [Target::Shupe, Target::Axial, Target::Radial].map(|target| adds(&written(&[], target, "a"), [0.1, 0.0]));
    let sum: Vec<f64> = (0..720).map(|n| parts.iter().map(|part| part[RATE][n]).sum()).collect();
    assert!(rms(&super::minus(&sum, &all[RATE])) < 1e-9 * rms(&all[RATE]) && rms(&all[RATE]) > 0.0);
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    for (part, designed) in parts.iter().zip(from(&library, 0.0).parts()) {
        let tenth: Vec<f64> = designed.iter().map(|rate| 0.1 * rate).collect();
        assert!(rms(&super::minus(&part[RATE], &tenth)) < 1e-9 * rms(&tenth));
    }
}

#[test]
fn a_state_of_its_own_follows_the_record() {
    // a board that is behind the spool by its time constant times the rate, once it follows a slow course
    let slow = written(&[("(spool - x) / a", "spool")], Target::Rate, "b * (spool - x)");
    let fast = written(&[], Target::Rate, "a * b * spool_rate");
    let [lagged, at_once] = [adds(&slow, [20.0, 0.5]), adds(&fast, [20.0, 0.5])];
    assert!(rms(&super::minus(&lagged[RATE], &at_once[RATE])) < 0.05 * rms(&at_once[RATE]));
}

#[test]
fn exact_a_law_of_thermometer_and_tail_is_what_it_says() {
    let [thermometer, rate] = adds(&written(&[], Target::Thermometer, "a * time + b"), [1e-4, 0.3]);
    let (time, _) = super::course();
    let exact: Vec<f64> = time.iter().map(|t| 1e-4 * t + 0.3).collect();
    assert!(rms(&super::minus(&thermometer, &exact)) < 1e-12 && rate.iter().all(|x| *x == 0.0));
    let [thermometer, rate] = adds(&written(&[], Target::Tail, "a"), [0.05, 0.0]);
    let [_, tail] = of_catalogue("tail-asymmetry", &[0.05], None);
    // the longer fibre, by a metre, counts for a thousandth
    let off = rms(&super::minus(&rate[1..], &tail[1..]));
    assert!(off < 2e-3 * rms(&tail) && thermometer.iter().all(|x| *x == 0.0), "{off:e} of {:e}", rms(&tail));
}

#[test]
fn exact_a_law_s_time_begins_with_the_record() {
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let ageing = written(&[], Target::Thermometer, "a * time");
    let later = Gyro::new(library.clone(), &[&ageing], vec![from(&library, 5000.0)]).expect("gyro");
    let [thermometer, _] = added(&later, "written", vec![1e-4, 0.0], None);
    let (time, _) = super::course();
    let exact: Vec<f64> = time.iter().map(|t| 1e-4 * t).collect();
    assert!(rms(&super::minus(&thermometer, &exact)) < 1e-12);
}

#[test]
fn a_law_says_which_columns_it_sees() {
    let plain = written(&[], Target::Rate, "a");
    assert!(plain.columns().is_empty());
    let mut inputs = plain.inputs.clone();
    inputs.extend(["humidity", "field"].map(|name| Input::Column(name.into())));
    let seeing = Written { inputs, ..plain };
    assert_eq!(seeing.columns(), ["humidity", "field"]);
    // a coil file holds no laws
    let active = Active { mechanism: 0, values: vec![0.0; 2], choice: None };
    assert_eq!(seeing.extended(&common::reference(), &active), Some(common::reference()));
}
