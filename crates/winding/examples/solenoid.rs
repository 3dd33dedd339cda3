//! A solenoid of round wire: from the turn table its wire, its resistance and the field at its centre, beside the formula for a
//! thick coil of even current density.

#![allow(clippy::print_stdout, reason = "the example is a program")]

use std::f64::consts::PI;
use winding::{ClimbSide, Error, Pattern, Spec, Tails, TurnLength, wind};

/// μ0 \[T m/A\].
const VACUUM: f64 = 4e-7 * PI;
/// Resistivity of copper at 20 °C \[Ω m\].
const COPPER: f64 = 1.68e-8;
const CURRENT: f64 = 1.0;
const WIRE: f64 = 0.5e-3;

fn main() -> Result<(), Error> {
    let coil = wind(&Spec {
        pattern: Pattern::Cylindrical,
        layers: 12,
        turns_odd_layers: 80,
        turns_even_layers: 79,
        inner_radius: 10e-3,
        pitch: WIRE,
        start: 0.0,
        end: None,
        cw_climbs: ClimbSide::Right,
        turn_length: TurnLength::True,
        tails: Tails { cw: 0.0, ccw: 0.0 },
        defect: None,
    })?;
    let turns = coil.turns();
    let wire: f64 = turns.iter().map(winding::Turn::length).sum();
    let resistance = COPPER * wire / (PI * WIRE * WIRE / 4.0);

    // Biot and Savart: a loop of radius r at the distance y
    let middle = turns.iter().map(|t| t.y).sum::<f64>() / turns.len() as f64;
    let of_loop = |r: f64, y: f64| VACUUM * CURRENT * r * r / (2.0 * (r * r + y * y).powf(1.5));
    let field: f64 = turns.iter().map(|t| of_loop(t.r, t.y - middle)).sum();

    // even current density between the radii a and b over the height 2h
    let (radii, height) =
        (|layer| turns.iter().find(move |t| t.layer == layer).map_or(f64::NAN, |t| t.r), turns.len() as f64 / 12.0 * WIRE);
    let step = WIRE * 0.75_f64.sqrt();
    let (a, b, h) = (radii(1) - step / 2.0, radii(12) + step / 2.0, height / 2.0);
    let density = CURRENT * turns.len() as f64 / (height * (b - a));
    let thick = VACUUM * density * h * ((b + b.hypot(h)) / (a + a.hypot(h))).ln();
    assert!((field / thick - 1.0).abs() < 3e-3, "{field:e} {thick:e}");
    let found = format!("{wire:.2} m, {resistance:.2} ohm, {:.2} mT/A", 1e3 * field);
    println!("wire, resistance, field at the centre: {found}");
    assert_eq!(found, "75.71 m, 6.48 ohm, 25.45 mT/A");
    Ok(())
}
