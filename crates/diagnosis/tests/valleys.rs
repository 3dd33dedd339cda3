//! Fits and samples of a mechanism whose misfit has several minima, each of a known place, width and depth.

use crate::common::valleys::Valleys;
use diagnosis::{Observation, Samples, Settings, diagnose, sampled};

/// Depth of the first valley's ground: −ln p there.
const GROUND: f64 = 8.0;

/// Two parameters, of whose sum the record knows much, and valleys of their difference, the second one lower by `gain`; an offset makes up for what the
/// difference adds to all rows.
fn of_a_difference(gain: f64) -> Valleys {
    begun_at(&[0.0, 0.0], gain)
}

fn begun_at(start: &[f64], gain: f64) -> Valleys {
    let valleys = move |p: &[f64]| {
        let (sum, difference) = (p[0] + p[1], p[0] - p[1]);
        let (middle, ground) = if difference < 1.5 { (0.0, GROUND) } else { (2.0, GROUND - gain) };
        let of_all = 3.0 * difference;
        // of two opposites the offset takes nothing
        let ground = ground.sqrt();
        [20.0 * sum, 100.0 * (difference - middle), ground, -ground, 0.0, 0.0, 0.0, 0.0].map(|row| row + of_all)
    };
    Valleys::new(&[start], &[1.0], valleys).with_any_offset()
}

/// The valley cannot be left by one of the two alone, nor without the offset that goes with them.
#[test]
fn a_better_minimum_is_found_where_one_parameter_moves_against_another_and_the_rest_follows() {
    let (here, there) = (of_a_difference(-1.0).fitted(), of_a_difference(0.6).fitted());
    let places = |fit: &diagnosis::Fit| fit.active[0].values.clone();
    assert!(places(&here).iter().all(|p| p.abs() < 0.01), "{:?}", places(&here));
    let [a, b] = places(&there)[..] else { panic!("two parameters") };
    assert!(
        (a - 1.0).abs() < 0.01 && (b + 1.0).abs() < 0.01 && (there.offsets[0][0] + 6.0).abs() < 1.0,
        "{a} {b} {:?}",
        there.offsets
    );
    // the valleys are alike but for their grounds
    let gained = there.log_evidence - here.log_evidence;
    assert!((gained - 0.6).abs() < 0.01, "{gained}");
}

/// Less than a third of a unit of ln p is worth no round of the search.
#[test]
fn a_minimum_that_is_hardly_better_is_not_gone_to() {
    let fit = of_a_difference(0.15).fitted();
    assert!(fit.active[0].values.iter().all(|p| p.abs() < 0.01), "{:?}", fit.active);
}

/// The poorer minimum leaves more noise, under which the better one looks worse than it is.
#[test]
fn the_noise_is_that_of_the_better_minimum_wherever_the_fit_began() {
    let [gone_to, begun_in] = [[0.0, 0.0], [1.0, -1.0]].map(|start| begun_at(&start, 7.0).with_any_noise().fitted());
    let [white, own] = [&gone_to, &begun_in].map(|fit| fit.noise_model(0, 0).white);
    assert!((gone_to.active[0].values[0] - 1.0).abs() < 0.01 && (white / own - 1.0).abs() < 0.05, "{white} {own}");
    let behind = begun_in.log_evidence - gone_to.log_evidence;
    assert!(behind.abs() < 0.1, "{behind}");
}

/// The valley bends so that one step along it from afar leads elsewhere: as the instants of a switch do where all readings come later.
#[test]
fn a_better_minimum_is_found_along_a_bent_valley_of_a_nuisance() {
    let bent = |around: &[f64]| {
        let valleys = |p: &[f64]| {
            let (place, beside) = (p[0], p[1]);
            let (middle, ground) = if beside < 1.0 { (0.0, GROUND) } else { (2.0, GROUND - 7.0) };
            let off = 100.0 * (place.powi(3) + place - 5.0 * beside.powi(2));
            [off, 2.0 * (beside - middle), (2.0_f64 * ground).sqrt(), 0.0, 0.0, 0.0, 0.0, 0.0]
        };
        Valleys::new(&[&[0.0]], &[0.01], valleys).beside(3.0, around).fitted()
    };
    let path: Vec<f64> = (1..=15).map(|n| 0.2 * f64::from(n)).collect();
    let [stays, at_once, goes] = [&[][..], &[2.0], &path].map(|around| bent(around).active[0].values[0]);
    assert!(stays.abs() < 0.01 && at_once.abs() < 0.01, "{stays} {at_once}");
    // x³ + x = 5 · 1.95², the prior drawing the nuisance back by a fortieth
    assert!((goes - 2.55).abs() < 0.05, "{goes}");
}

/// The fit has strayed from what is expected of a nuisance, 0, to the one side; the better minimum is beyond that on the other.
#[test]
fn a_better_minimum_is_found_beyond_what_is_expected_of_a_nuisance_however_far_that_is() {
    let strayed = |around: &[f64], side: f64| {
        let valleys = move |p: &[f64]| {
            let (place, beside) = (p[0], side * p[1]);
            let (middle, ground) = if beside > -0.5 { (2.4, GROUND) } else { (-2.0, GROUND - 7.0) };
            [100.0 * (place - beside), 2.0 * (beside - middle), (2.0_f64 * ground).sqrt(), 0.0, 0.0, 0.0, 0.0, 0.0]
        };
        Valleys::new(&[&[0.0]], &[0.01], valleys).beside(10.0, around).fitted().active[0].values[0]
    };
    for side in [-1.0, 1.0] {
        // distances that increase by 0.2 lead on, one alone does not
        let [stays, goes] = [&[1.0][..], &[0.6, 0.8, 1.0]].map(|around| strayed(around, side));
        assert!((stays - 2.4).abs() < 0.05 && (goes + 2.0).abs() < 0.05, "{stays} {goes}");
    }
}

/// Valleys about 0 and 2, of so many standard deviations' distance and with these grounds.
fn apart(distance: f64, grounds: [f64; 2]) -> Valleys {
    Valleys::new(&[&[0.0], &[2.0]], &[], move |p| {
        let (middle, ground) = if p[0] < 1.0 { (0.0, grounds[0]) } else { (2.0, grounds[1]) };
        [distance / 2.0 * (p[0] - middle), (2.0 * ground).sqrt(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    })
}

fn samples(model: &Valleys, steps: usize, seed: u64) -> Samples {
    sampled(model, &[0], &[Valleys::record()], &model.fitted(), steps, seed).expect("samples")
}

#[test]
fn minima_are_two_beyond_a_standard_deviation_and_where_both_hold_something() {
    for (distance, grounds, minima) in [
        (0.8, [1.0, 1.0], 1),
        (1.2, [1.0, 1.0], 2),
        (30.0, [0.1, 14.0], 2),
        (30.0, [0.1, 16.0], 1),
        (30.0, [50.0, 64.0], 2),
        (30.0, [66.0, 50.0], 1),
    ] {
        assert_eq!(samples(&apart(distance, grounds), 20, 1).minima, minima, "{distance} {grounds:?}");
    }
}

/// Walks that begin within the posterior might agree without having been anywhere.
#[test]
fn walks_begin_farther_from_the_minimum_than_the_posterior_reaches() {
    const STEPS: usize = 20;
    const WALKS: usize = 4;
    let model = Valleys::new(&[&[0.0]], &[], |p| [p[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let fit = model.fitted();
    let mut begun = Vec::new();
    for seed in 0..100 {
        model.asked.take();
        sampled(&model, &[0], &[Valleys::record()], &fit, STEPS, seed).expect("samples");
        // the last to be asked for are the walks' places, of each its beginning and its steps
        let asked = model.asked.take();
        begun.extend(asked[asked.len() - WALKS * (1 + STEPS)..].iter().step_by(1 + STEPS).copied());
    }
    // the posterior's standard deviation is 1
    let spread = (begun.iter().map(|x| x * x).sum::<f64>() / begun.len() as f64).sqrt();
    // of 400 beginnings: known to 4 %
    assert!((spread - 1.5).abs() < 0.2, "{spread}");
}

/// A parameter that acts by its square alone is as likely of either sign: the interval holds both, that of another parameter is none the wider.
#[test]
fn an_interval_holds_every_value_that_does_the_same() {
    let model = Valleys::new(&[&[1.5, 0.3], &[-1.5, 0.3]], &[], |p| {
        let [square, other] = [10.0 * p[0] * p[0], 5.0 * p[1]];
        [square, square, square, square, other, other, other, other]
    });
    let seen = vec![10.0, 10.0, 10.0, 10.0, 5.0, 5.0, 5.0, 5.0];
    let record = Observation { channels: vec![seen], ..Valleys::record() };
    let found = diagnose(&model, &[0], &[record], &Settings::default(), &|_| ()).expect("a diagnosis");
    let [twofold, other] = &found.parameters[0][..] else { panic!("two parameters") };
    assert!((twofold.value.abs() - 1.0).abs() < 0.05, "{twofold:?}");
    assert!(twofold.ci90[0] < -1.0 && twofold.ci90[1] > 1.0 && twofold.ci90[1] - twofold.ci90[0] < 2.3, "{twofold:?}");
    assert!(other.ci90[0] < 1.0 && other.ci90[1] > 1.0 && other.ci90[1] - other.ci90[0] < 0.5, "{other:?}");
}

/// The records know such a parameter best, and a second look has been around it.
#[test]
fn a_parameter_that_is_looked_around_stays_where_it_is() {
    let interval = |around: &[f64]| {
        let model = Valleys::new(&[&[1.5, 0.3], &[-1.5, 0.3]], around, |p| {
            let [square, other] = [10.0 * p[0] * p[0], 5.0 * p[1]];
            [square, square, square, square, other, other, other, other]
        });
        let seen = vec![10.0, 10.0, 10.0, 10.0, 5.0, 5.0, 5.0, 5.0];
        let record = Observation { channels: vec![seen], ..Valleys::record() };
        let found = diagnose(&model, &[0], &[record], &Settings::default(), &|_| ()).expect("a diagnosis");
        let [low, high] = found.parameters[0][0].ci90;
        high - low
    };
    let [goes_elsewhere, stays] = [&[][..], &[0.01]].map(interval);
    assert!(goes_elsewhere > 2.0 && stays < 0.3, "{goes_elsewhere} {stays}");
}

/// Fits that all begin on one side of a square's turning point know of the other side's better ground by looking there.
#[test]
fn the_likeliest_of_several_minima_speaks() {
    let starts: &[&[f64]] = &[&[-1.0, 0.9], &[-1.0, 0.95], &[-1.0, 1.0], &[-1.0, 1.05], &[-1.0, 1.1], &[3.0, 0.3]];
    let model = Valleys::new(starts, &[], |p| {
        let (square, other, ground) = (10.0 * p[0] * p[0], 5.0 * p[1], if p[0] < 0.0 { 4.0 } else { 0.0 });
        [square, square, square, square, other, other, other, ground]
    });
    let record = Observation { channels: vec![vec![10.0, 10.0, 10.0, 10.0, 5.0, 5.0, 5.0, 0.0]], ..Valleys::record() };
    let found = diagnose(&model, &[0], &[record], &Settings::default(), &|_| ()).expect("a diagnosis");
    let place = &found.parameters[0][0];
    assert!((place.value - 1.0).abs() < 0.05 && place.ci90[0] > 0.9 && place.ci90[1] < 1.1, "{place:?}");
}

/// Near a turning point a parameter is hardly known: that minimum reaches to the narrow one beside it, and is another all the same.
#[test]
fn a_wide_minimum_beside_a_narrow_one_stands_in_the_interval() {
    let starts: &[&[f64]] = &[&[-1.0, 0.9], &[-1.0, 0.95], &[-1.0, 1.0], &[-1.0, 1.05], &[-1.0, 1.1], &[2.0, 0.3]];
    let model = Valleys::new(starts, &[], |p| {
        // a hundred times as wide, and as much less likely at its ground
        let (off, ground) = if p[0] < 0.0 { (20.0 * (p[0] + 1.0), 0.0) } else { (0.2 * (p[0] - 3.0), 2.0 * 100.0_f64.ln()) };
        let (row, other) = (10.0 + off, 5.0 * p[1]);
        [row, row, row, row, other, other, other, ground.sqrt()]
    });
    let record = Observation { channels: vec![vec![10.0, 10.0, 10.0, 10.0, 5.0, 5.0, 5.0, 0.0]], ..Valleys::record() };
    let found = diagnose(&model, &[0], &[record], &Settings::default(), &|_| ()).expect("a diagnosis");
    let place = &found.parameters[0][0];
    assert!(place.ci90[0] < -0.9 && (5.0..8.0).contains(&place.ci90[1]), "{place:?}");
}
