//! Constants of the design beside a mechanism, against the chain with both.

use super::{anew, course, design, gyro, minus, rms};
use coil::{Design, Drive, Dynamics, Profile, STANDARD};
use diagnosis::{Active, ForwardModel};
use mechanisms::{RATE, SPOOL, with_constant};

/// Beside a longer tail a softer coil, or one whose winding ends elsewhere, adds what it adds without; what changes the temperatures changes both.
#[test]
fn constants_beside_a_tail_follow_the_chain() {
    let design = design();
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let tail = Active { mechanism: gyro.find("tail-asymmetry").expect("offered"), values: vec![0.4], choice: None };
    let long = gyro.extended(&design, &tail).expect("a place");
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let without = anew(&long);
    let of_tail = rms(&minus(&without[RATE], &anew(&design)[RATE]));
    // expansions change what every turn adds, too: that is missed
    for (name, bound) in [
        ("E_r and G", 0.012),
        ("end of the winding [mm]", 0.003),
        ("specific heat of the coil", 0.003),
        ("conductivity of the surroundings", 0.003),
        ("spool expansion", 0.013),
    ] {
        let place = gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a constant");
        let mut u = middle.clone();
        u[place] = gyro.nuisances()[place].parameter.prior.value(1.0);
        let of = |u: &[f64]| gyro.respond(0, u, std::slice::from_ref(&tail)).expect("response").swap_remove(RATE);
        let effect = minus(&anew(&with_constant(&long, name, u[place]).expect("a constant"))[RATE], &without[RATE]);
        let off = rms(&minus(&minus(&of(&u), &of(&middle)), &effect));
        assert!(off < bound * of_tail && rms(&effect) > 0.02 * of_tail, "{name}: {off} of {of_tail}, {}", rms(&effect));
    }
}

/// A bond opens on a coil that is pressed apart by its expansion: that changes what opening does, and so does its stiffness.
#[test]
fn constants_beside_an_open_bond_follow_the_chain() {
    let design = design();
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let open = Active { mechanism: gyro.find("debond").expect("offered"), values: vec![28.0, 8.0, 0.2], choice: None };
    let opened = gyro.extended(&design, &open).expect("a place");
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    for (name, bound) in [("alpha_r", 0.002), ("E_r and G", 0.003), ("E_z", 0.002), ("nu_r", 0.002), ("spool expansion", 0.002)] {
        let place = gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a constant");
        let mut u = middle.clone();
        u[place] = gyro.nuisances()[place].parameter.prior.value(1.0);
        let exact = |design: &Design| {
            let [_, rate] = anew(&with_constant(design, name, u[place]).expect("a constant"));
            rate
        };
        let of = |active: &[Active]| gyro.respond(0, &u, active).expect("response").swap_remove(RATE);
        let (effect, told) = (minus(&exact(&opened), &exact(&design)), minus(&of(std::slice::from_ref(&open)), &of(&[])));
        let off = rms(&minus(&told, &effect)) / rms(&effect);
        println!("{name}: {off:.4}");
        assert!(off < bound, "{name}: {off}");
    }
}

/// Strains are homogeneous in all that expands: an open bond does a hundredth more where coil and spool expand by as much more, whatever their stiffness.
#[test]
fn exact_what_an_open_bond_does_grows_with_all_expansions() {
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let mut wider = middle.clone();
    for name in ["alpha_z", "alpha_r", "spool expansion"] {
        wider[gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a constant")] *= 1.01;
    }
    for share in [0.03, 0.2, 0.47] {
        let open = Active { mechanism: gyro.find("debond").expect("offered"), values: vec![28.0, 8.0, share], choice: None };
        let of = |u: &[f64], active: &[Active]| gyro.respond(0, u, active).expect("response").swap_remove(RATE);
        let effect = |u: &[f64]| minus(&of(u, std::slice::from_ref(&open)), &of(u, &[]));
        let (drawn, more) = (effect(&middle), effect(&wider));
        let off = rms(&minus(&more, &drawn.iter().map(|x| 1.01 * x).collect::<Vec<_>>())) / rms(&drawn);
        println!("{share}: {off:.1e} of {}", rms(&drawn));
        assert!(off < 1e-3, "{share}: {off}");
    }
}

/// A bond's temperatures are those that the coil has where it opens and closes: constants that warm the coil there carry them along.
#[test]
fn constants_carry_the_temperatures_at_which_a_bond_opens_and_closes() {
    const OPENS: f64 = 28.0;
    const CLOSES: f64 = 36.0;
    let design = design();
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let bond =
        Active { mechanism: gyro.find("debond").expect("offered"), values: vec![OPENS, CLOSES - OPENS, 0.2], choice: None };
    let coil = |design: &Design| -> Vec<f64> {
        let (time, chamber) = course();
        let dynamics = Dynamics::new(design, &[Drive::Chamber], &STANDARD).expect("dynamics");
        let rows = dynamics.simulate(&Profile { time, drives: vec![chamber] }).expect("run");
        rows.iter().map(|row| row.coil).collect()
    };
    let drawn = coil(&design);
    let mut open = drawn[0] < OPENS;
    let mut passed = [Vec::new(), Vec::new()];
    for (n, coil) in drawn.iter().enumerate() {
        if if open { *coil > CLOSES } else { *coil < OPENS } {
            passed[usize::from(open)].push(n);
            open = !open;
        }
    }
    assert!(passed.iter().all(|rows| !rows.is_empty()), "{passed:?}");
    for name in ["k_r", "specific heat of the coil", "conductivity of the surroundings", "spool density", "E_z"] {
        let place = gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a constant");
        let [low, high] = [-0.05, 0.05].map(|by| gyro.nuisances()[place].parameter.prior.value(by));
        let [colder, warmer] = [low, high].map(|value| coil(&with_constant(&design, name, value).expect("a constant")));
        let warms = |n: usize| (warmer[n] - colder[n]) / (high - low);
        let [opens, closes] = passed.each_ref().map(|rows| rows.iter().map(|n| warms(*n)).sum::<f64>() / rows.len() as f64);
        let told = gyro.carries(place, &bond);
        println!("{name}: {told:?}, {opens} {closes}");
        for (told, exact) in told.iter().zip([opens, closes - opens]) {
            assert!((told - exact).abs() <= 0.02 * opens.abs().max(closes.abs()), "{name}: {told} for {exact}");
        }
        assert!(told.len() == 2 || name == "E_z" && told.is_empty(), "{name}");
    }
    let of = |name: &str| gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a sensor");
    assert!(gyro.carries(of("lag of the spool's thermometer"), &bond).is_empty());
    // a chamber that was read late was ahead, one that was read with a gain moved by less, from rest
    let mean = |which: usize, warms: &dyn Fn(usize) -> f64| {
        passed[which].iter().map(|n| warms(*n)).sum::<f64>() / passed[which].len() as f64
    };
    let ahead = |n: usize| (drawn[n + 1] - drawn[n - 1]) / 120.0;
    let less = |n: usize| drawn[0] - drawn[n];
    for (name, warms) in
        [("delay of the chamber's readings [s]", &ahead as &dyn Fn(usize) -> f64), ("gain of the chamber's thermometer", &less)]
    {
        let told = gyro.carries(of(name), &bond);
        let [opens, closes] = [0, 1].map(|which| mean(which, warms));
        assert!(
            (told[0] - opens).abs() < 0.02 * opens.abs()
                && (told[1] - (closes - opens)).abs() < 0.02 * opens.abs().max(closes.abs()),
            "{name}: {told:?} for {opens}, {closes}"
        );
    }
}

/// What a watt does depends on conductances and capacities in its own way, at the switch above all: not as what the chamber does.
#[test]
fn constants_beside_a_heated_flange_follow_the_chain() {
    let design = design();
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let heated = Active { mechanism: gyro.find("self-heating").expect("offered"), values: vec![0.3, 0.0], choice: None };
    let hot = gyro.extended(&design, &heated).expect("a place");
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    for (name, bound) in [
        ("k_r", 0.003),
        ("specific heat of the coil", 0.003),
        ("spool specific heat", 0.003),
        // a tenth more each: its square is what is missed
        ("conductivity of the surroundings", 0.015),
        ("E_r and G", 0.01),
        ("end of the winding [mm]", 0.003),
    ] {
        let place = gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a constant");
        let mut u = middle.clone();
        u[place] = gyro.nuisances()[place].parameter.prior.value(1.0);
        let exact = |design: &Design| anew(&with_constant(design, name, u[place]).expect("a constant"));
        let of = |active: &[Active]| gyro.respond(0, &u, active).expect("response");
        let (with, without, told, alone) = (exact(&hot), exact(&design), of(std::slice::from_ref(&heated)), of(&[]));
        for channel in [SPOOL, RATE] {
            let effect = minus(&with[channel], &without[channel]);
            let off = rms(&minus(&minus(&told[channel], &alone[channel]), &effect)) / rms(&effect);
            println!("{name}, channel {channel}: {off:.5}");
            assert!(off < bound, "{name}, channel {channel}: {off}");
        }
    }
}
