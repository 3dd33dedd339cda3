//! Flexible inputs at every stage, by what they are made of: the mechanisms' own effects, and hats over the coil's temperature that add up to one.

use super::{Gyro, Prepared, course, gyro, minus, rms};
use diagnosis::{Active, ForwardModel, Latent};
use mechanisms::{RATE, SPOOL};

const HATS: usize = 9;

/// Change of a channel by a mechanism, all else as expected; `choice` where it has one.
fn effect(gyro: &Gyro, id: &str, values: &[f64], choice: Option<f64>, channel: usize) -> Vec<f64> {
    let u = diagnosis::expected(gyro.nuisances());
    let active = Active { mechanism: gyro.find(id).expect("a mechanism"), values: values.to_vec(), choice };
    let [with, without] = [&[active][..], &[]].map(|active| gyro.respond(0, &u, active).expect("response"));
    minus(&with[channel], &without[channel])
}

/// Sum of some functions in a channel.
fn sum(functions: &[Vec<Vec<f64>>], channel: usize) -> Vec<f64> {
    let rows = functions[0][channel].len();
    (0..rows).map(|n| functions.iter().map(|function| function[channel][n]).sum()).collect()
}

/// The same series, but for the first row, whose reading begins nowhere.
fn same(what: &str, told: &[f64], exact: &[f64]) {
    let (told, exact) = (&told[1..], &exact[1..]);
    let off = rms(&minus(told, exact));
    assert!(off <= 1e-7 * rms(exact) && rms(exact) > 0.0, "{what}: {off:e} of {:e}", rms(exact));
}

fn stage<'a>(all: &'a [Latent], name: &str) -> &'a [Vec<Vec<f64>>] {
    &all.iter().find(|latent| latent.stage == name).expect("a stage").functions
}

/// A first-order filter at rest before the first row, of a course that goes straight from row to row.
fn filtered(time: &[f64], course: &[f64], lag: f64) -> Vec<f64> {
    const PARTS: u32 = 400;
    let mut y = course[0];
    let mut all = vec![y];
    for n in 1..time.len() {
        let dt = (time[n] - time[n - 1]) / f64::from(PARTS);
        let kept = (-dt / lag).exp();
        for k in 0..PARTS {
            let middle = course[n - 1] + (course[n] - course[n - 1]) * (f64::from(k) + 0.5) / f64::from(PARTS);
            y = middle + (y - middle) * kept;
        }
        all.push(y);
    }
    all
}

#[test]
fn exact_a_flexible_input_is_made_of_what_the_mechanisms_do() {
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let all = gyro.latent(0).expect("inputs");
    let names: Vec<&str> = all.iter().map(|latent| latent.stage.as_str()).collect();
    assert_eq!(names, ["thermal", "material", "bond", "winding", "optics", "electronics", "sensor"]);
    let (time, chamber) = course();
    let record = Prepared::new(gyro.library(), &time, &chamber, 60.0).expect("prepared");

    let coil = record.coil();
    let [low, high] = gyro.scene().temperatures;
    let electronics = stage(&all, "electronics");
    assert_eq!(electronics.len(), HATS + 2);
    for (k, function) in electronics[..HATS].iter().enumerate() {
        let at = low + (high - low) * k as f64 / (HATS - 1) as f64;
        let hat: Vec<f64> = coil.iter().map(|t| (1.0 - (t - at).abs() * (HATS - 1) as f64 / (high - low)).max(0.0)).collect();
        same(&format!("hat {k}"), &function[RATE], &hat);
        assert!(function[SPOOL].iter().all(|x| *x == 0.0));
    }
    assert!(sum(&electronics[..HATS], RATE).iter().all(|one| (one - 1.0).abs() < 1e-12));

    // material: stiffness and expansion that are other throughout, and the former late
    let material = stage(&all, "material");
    let softer = effect(&gyro, "glass-transition", &[-200.0, 1.0, 0.95, 1.0], None, RATE);
    same("softer", &sum(&material[..HATS], RATE), &softer);
    same(
        "wider",
        &sum(&material[HATS..2 * HATS], RATE),
        &effect(&gyro, "glass-transition", &[-200.0, 1.0, 1.0, 1.02], None, RATE),
    );
    for (function, lag) in material[2 * HATS..].iter().zip([1000.0, 4000.0, 12_000.0]) {
        let exact = filtered(&time, &softer, lag);
        let off = rms(&minus(&function[RATE][1..], &exact[1..]));
        assert!(off < 2e-3 * rms(&exact), "late by {lag} s: {off:e} of {:e}", rms(&exact));
    }
    // and constants of mechanics, by a tolerance of each
    let by_constant = |name: &str| {
        let place = gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a constant");
        let mut u = diagnosis::expected(gyro.nuisances());
        let without = gyro.respond(0, &u, &[]).expect("response").swap_remove(RATE);
        u[place] = gyro.nuisances()[place].parameter.prior.value(1.0);
        minus(&gyro.respond(0, &u, &[]).expect("response").swap_remove(RATE), &without)
    };
    let has = |functions: &[Vec<Vec<f64>>], series: &[f64]| {
        functions.iter().any(|function| rms(&minus(&function[RATE][1..], &series[1..])) < 1e-7 * rms(series))
    };
    let of_mechanics = &material[2 * HATS + 3..];
    assert!(has(of_mechanics, &by_constant("E_r and G")) && has(of_mechanics, &by_constant("alpha_r")));
    assert!(!has(of_mechanics, &by_constant("k_r")) && !has(of_mechanics, &by_constant("end of the winding [mm]")));

    // bond: open throughout, at the least share, the middle one of those that lie half a layer apart, and the largest
    let bond = stage(&all, "bond");
    assert_eq!(bond.len(), 3 * HATS);
    for (functions, share) in bond.chunks(HATS).zip([0.01, 0.11 + 23.0 / 72.0, 0.9]) {
        let open = effect(&gyro, "debond", &[200.0, 1.0, share], None, RATE);
        let off = rms(&minus(&sum(functions, RATE)[1..], &open[1..]));
        assert!(off < 1e-7 * rms(&open), "{share} open: {off:e} of {:e}", rms(&open));
    }

    let winding = stage(&all, "winding");
    same("tail", &winding[0][RATE], &effect(&gyro, "tail-asymmetry", &[0.05], None, RATE));
    assert!(has(winding, &by_constant("end of the winding [mm]")));
    let layers = gyro.library().design().winding.layers;
    for layer in (1..=layers).step_by(6) {
        assert!(has(winding, &effect(&gyro, "winding-defect", &[1.0], Some(layer as f64), RATE)), "layer {layer}");
    }
    assert!(!has(winding, &effect(&gyro, "winding-defect", &[1.0], Some(2.0), RATE)));

    let optics = stage(&all, "optics");
    same("Shupe", &sum(&optics[..HATS], RATE), &record.parts()[0]);
    let curved = effect(&gyro, "thermo-optic-curvature", &[1e-8], None, RATE);
    same("curved", &optics[HATS][RATE].iter().map(|x| 1e-8 * x).collect::<Vec<_>>(), &curved);

    let sensor = stage(&all, "sensor");
    let late = minus(&filtered(&time, record.spool(), 30.0), record.spool());
    assert!(rms(&minus(&sensor[0][SPOOL], &late)) < 1e-3 * rms(&late));
    assert!(sum(&sensor[1..], SPOOL).iter().all(|one| (one - 1.0).abs() < 1e-12));

    // a tenth of a watt, on before the first row, in the only flange; a mount of 0.1 W/(m² K)
    let thermal = stage(&all, "thermal");
    let heaters = &thermal[thermal.len() - 4..];
    for (function, before) in heaters.iter().zip([1.0, 60.0, 300.0, 1500.0]) {
        for channel in [SPOOL, RATE] {
            same("heater", &function[channel], &effect(&gyro, "self-heating", &[0.1, before], Some(1.0), channel));
        }
    }
    let mounted = [SPOOL, RATE].map(|channel| effect(&gyro, "axial-heat-path", &[0.1], None, channel));
    let is_mount = |functions: &[Vec<Vec<f64>>]| {
        let off = [SPOOL, RATE].map(|channel| rms(&minus(&sum(functions, channel)[1..], &mounted[channel][1..])));
        off[SPOOL] < 1e-7 * rms(&mounted[SPOOL]) && off[RATE] < 1e-7 * rms(&mounted[RATE])
    };
    assert!(thermal[..thermal.len() - 4].chunks(HATS).any(is_mount));
}

/// From the end of a path of heat a step goes back along it.
#[test]
fn exact_at_the_end_of_a_path_a_step_goes_back() {
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let u = diagnosis::expected(gyro.nuisances());
    let mount = |conductance: f64| Active {
        mechanism: gyro.find("axial-heat-path").expect("offered"),
        values: vec![conductance],
        choice: None,
    };
    // coordinate 0.99 of h/(h + 12)
    let about = gyro.about(&u, &[mount(1188.0)]).expect("a model").expect("another place");
    let back = 0.99 - 0.1 / 12.1;
    let there = [1188.0, 12.0 * back / (1.0 - back)].map(|h| about.respond(0, &u, &[mount(h)]).expect("response"));
    let all = about.latent(0).expect("inputs");
    let functions = stage(&all, "thermal");
    for channel in [SPOOL, RATE] {
        let exact = minus(&there[1][channel], &there[0][channel]);
        let is_it = |functions: &[Vec<Vec<f64>>]| rms(&minus(&sum(functions, channel)[1..], &exact[1..])) < 1e-6 * rms(&exact);
        assert!(functions[..functions.len() - 4].chunks(HATS).any(is_it), "{channel}");
    }
}

/// Each layer with one turn more.
#[test]
fn exact_members_are_the_layers() {
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let members = gyro.members(0).expect("members").expect("a coil has layers");
    assert_eq!((members.stage.as_str(), members.functions.len()), ("winding", gyro.library().design().winding.layers));
    for layer in [1, 2, members.functions.len()] {
        let exact = effect(&gyro, "winding-defect", &[1.0], Some(layer as f64), RATE);
        same(&format!("layer {layer}"), &members.functions[layer - 1][RATE], &exact);
        assert!(members.functions[layer - 1][SPOOL].iter().all(|x| *x == 0.0));
    }
    let [coldest, hottest] = gyro.chamber_range(1);
    let (_, chamber) = course();
    let ends = chamber.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| [low.min(*t), high.max(*t)]);
    assert!((coldest - ends[0]).abs() < 0.1 && (hottest - ends[1]).abs() < 0.1, "{coldest} {hottest} {ends:?}");
}
