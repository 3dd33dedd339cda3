//! Bias of a coil while it warms from outside, from the turn table and a temperature of one's own: each layer follows the air later than the
//! one around it. The glass is taken to expand freely; the strain that the winding puts on it takes a model of the coil.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use bias::{Optics, Slice, StrainConvention, bias, units::DEG_PER_H_PER_RAD_PER_S};
use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength, Winding, wind};

/// Rate of the temperature \[K/s\] at radius `r` \[m\] after `t` \[s\]: 10 K more from t = 0, followed with 10 min outside and a minute more for
/// each millimetre inwards.
fn temperature_rate(coil: &Winding, r: f64, t: f64) -> f64 {
    let lag = 600.0 + 60.0 * (coil.outer_radius() - r) / 1e-3;
    10.0 / lag * (-t / lag).exp()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let coil = wind(&Spec {
        pattern: Pattern::Quadrupole,
        layers: 36,
        turns_odd_layers: 106,
        turns_even_layers: 105,
        inner_radius: 43.5e-3,
        pitch: 0.170e-3,
        start: 0.0,
        end: None,
        cw_climbs: ClimbSide::Right,
        turn_length: TurnLength::True,
        tails: Tails { cw: 0.0, ccw: 0.0 },
        defect: None,
    })?;
    let optics = Optics {
        refractive_index: 1.45,
        thermo_optic: 1.0e-5,
        thermal_expansion: 0.55e-6,
        p11: 0.121,
        p12: 0.270,
        sagnac_diameter: coil.mean_diameter(),
        strain: StrainConvention::Mechanical,
    };
    let mut course = Vec::new();
    for minute in 0..=60 {
        let slice = |turn: &winding::Turn| {
            let rate = temperature_rate(&coil, turn.r, 60.0 * f64::from(minute));
            let strain_rate = optics.thermal_expansion * rate;
            Slice {
                z_start: turn.z_start,
                z_end: turn.z_end,
                temperature_rate: rate,
                axial_strain_rate: strain_rate,
                radial_strain_rate: strain_rate,
            }
        };
        let slices: Vec<Slice> = coil.turns().iter().map(slice).collect();
        course.push(bias(&optics, coil.length(), &slices)?.total() * DEG_PER_H_PER_RAD_PER_S);
    }
    let largest = course.iter().fold(0.0, |most: f64, rate| if rate.abs() > most.abs() { *rate } else { most });
    println!("minute  rate [deg/h]");
    for (minute, rate) in course.iter().enumerate().step_by(10) {
        println!("{minute:6}  {rate:12.4}");
    }
    assert_eq!(format!("{largest:.4} deg/h, {:.4} after an hour", course[60]), "-0.1265 deg/h, 0.0014 after an hour");
    Ok(())
}
