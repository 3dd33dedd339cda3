//! A rate sensor at rest in a chamber that grows cold: a constant rate misses something on two axes, and one cooling cannot tell temperature from time.
//!
//! ```sh
//! cargo run --release -p diagnosis --example cold_chamber -- fixtures/real/cold_chamber/gyro.csv
//! ```
//!
//! The first two thirds of the bursts are fitted, the others held out.

#![allow(clippy::print_stdout, reason = "a program")]

#[path = "models/real/mod.rs"]
mod real;

use real::law::Law;
use real::offered::{Offered, Part};
use real::rate_sensor::RateSensor;
use real::shapes::Shape;
use real::study::{BREADTH, Records, Told, study, versus};
use real::{load, picture, report};
use std::error::Error;
use std::process::ExitCode;

/// Tests that may be made next, as long as the recorded one.
const NEXT: [&str; 3] = ["the same cooling", "a warming from the cold", "a cooling and a warming in the same time"];

fn main() -> ExitCode {
    real::told(run())
}

fn run() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: cold_chamber PATH")?;
    let load::Rates { time, temperature, rates } = load::cold_chamber(&path)?;
    let cut = time.len() * 2 / 3 / 5 * 5;
    for (axis, rate) in ["x", "y", "z"].into_iter().zip(&rates) {
        println!("\n## axis {axis}");
        let plant = RateSensor::new(time.clone(), temperature.clone(), rate, cut, 0);
        let again = temperature.iter().copied();
        let plant = plant
            .with_test(time.clone(), again.clone().collect())
            .with_test(time.clone(), again.clone().rev().collect())
            .with_test(time.clone(), again.clone().step_by(2).chain(again.rev().step_by(2)).collect());
        let rows = || 0..time.len();
        let mut parts = vec![Part { test: 0, rows: 0..cut }, Part { test: 0, rows: cut..time.len() }];
        parts.extend((1..=NEXT.len()).map(|test| Part { test, rows: rows() }));
        let plain = Offered::nothing(plant, parts);
        let recorded = [0, 1].map(|r| plain.observed(r, std::slice::from_ref(rate)));
        let of = |shape| Law::added(shape, 0, 0);
        let told = [
            Told { name: "least squares, linear in T", laws: vec![of(Shape::Linear)] },
            Told {
                name: "cubic in T and dT/dt",
                laws: [Shape::Linear, Shape::Square, Shape::Cube, Shape::Rate].map(of).to_vec(),
            },
        ];
        let records = Records { fitted: &[0], held: &[1] };
        let found = study(plain, &recorded, &records, &told, BREADTH)?;
        let title = format!("Rate sensor in a chamber that grows cold, axis {axis}");
        let picture = picture::over_time(&found, &recorded, &records, 0, &title, &["last third"])?;
        picture::write(&format!("real-cold-chamber-{axis}.svg"), &picture)?;
        print!("{}{}", report::findings(&found), report::table(&found, &["last third"]));
        if found.composed.is_some() {
            for (k, name) in NEXT.iter().enumerate() {
                println!(
                    "next test, {name}: temperature and time would lie {:.1} sigma apart",
                    versus(&found, &of(Shape::Linear), &Law::added(Shape::Linear, 1, 0), k + 2, &time)?
                );
            }
        }
    }
    Ok(())
}
