//! Constants of the design beside a mechanism, against the chain with both.

use super::{anew, design, gyro, minus, rms};
use coil::Design;
use diagnosis::{Active, ForwardModel};
use mechanisms::{RATE, with_constant};

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

/// A bond opens on a coil that is pressed apart by its expansion: that changes what opening does, stiffnesses hardly do.
#[test]
fn constants_beside_an_open_bond_follow_the_chain() {
    let design = design();
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let open = Active { mechanism: gyro.find("debond").expect("offered"), values: vec![28.0, 8.0, 0.2], choice: None };
    let opened = gyro.extended(&design, &open).expect("a place");
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    for (name, bound) in [("alpha_r", 0.006), ("E_r and G", 0.015), ("E_z", 0.006), ("spool expansion", 0.012)] {
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
