//! How well each pattern cancels a radial temperature gradient: the first radial moment of 40 layers, relative to a cylinder.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use winding::{ClimbSide, Error, Pattern, Spec, Tails, TurnLength, wind};

fn radial_moment(pattern: Pattern) -> Result<f64, Error> {
    let spec = Spec {
        pattern,
        layers: 40,
        turns_odd_layers: 100,
        turns_even_layers: 100,
        inner_radius: 50e-3,
        pitch: 0.2e-3,
        start: 0.0,
        end: None,
        cw_climbs: ClimbSide::Right,
        turn_length: TurnLength::Equal,
        tails: Tails { cw: 0.0, ccw: 0.0 },
        defect: None,
    };
    Ok(wind(&spec)?.moment(1, 0).abs())
}

fn main() -> Result<(), Error> {
    let cylinder = radial_moment(Pattern::Cylindrical)?;
    let quadrupole = radial_moment(Pattern::Quadrupole)?;
    println!("pattern              radial moment, of a cylinder's");
    for pattern in [Pattern::Cylindrical, Pattern::Dipole, Pattern::Quadrupole, Pattern::PracticalQuadrupole, Pattern::Octupole] {
        println!("{:20} {:.1e}", format!("{pattern:?}"), radial_moment(pattern)? / cylinder);
    }
    // m layers of equal length: m(m² − 1)/6 against m/2
    assert!((cylinder / quadrupole - (40.0 * 40.0 - 1.0) / 3.0).abs() < 1e-6);
    Ok(())
}
