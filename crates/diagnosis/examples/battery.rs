//! Two cells in a chamber: heat against the open-circuit voltage misses something.
//!
//! ```sh
//! cargo run --release -p diagnosis --example battery -- fixtures/real/battery
//! ```

#![allow(clippy::print_stdout, reason = "a program")]

#[path = "models/real/mod.rs"]
mod real;

use real::cell::Cell;
use real::law::{Factor, Law};
use real::offered::{Offered, Part};
use real::shapes::Shape;
use real::study::{BREADTH, Records, Told, study};
use real::{load, picture, report};
use std::error::Error;
use std::process::ExitCode;

/// Capacity of both cells, as their slow discharges give it \[Ah\].
const CAPACITY: f64 = 2.58;
const TESTS: [(&str, &str); 8] = [
    ("R1", "one_c"),
    ("R1", "pulse"),
    ("R1", "two_c"),
    ("R1", "half_c"),
    ("R2", "one_c"),
    ("R2", "pulse"),
    ("R2", "half_c"),
    ("R2", "two_c"),
];

fn main() -> ExitCode {
    real::told(run())
}

fn run() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: battery FOLDER")?;
    let tests = TESTS.iter().map(|(cell, name)| load::cell(&folder, cell, name)).collect::<Result<Vec<_>, _>>()?;
    let names: Vec<String> = TESTS.iter().map(|(cell, name)| format!("{cell} {name}")).collect();
    for (title, fitted, held) in [
        ("fitted on R1's 1 C, pulse and 2 C", vec![0, 1, 2], vec![3, 4, 5, 6, 7]),
        ("the trap: fitted on R1's 1 C and pulse", vec![0, 1], vec![2, 3, 4, 5, 6, 7]),
    ] {
        println!("\n## {title}");
        let plain = Offered::nothing(
            Cell::new(tests.clone(), CAPACITY, &fitted),
            (0..tests.len()).map(|test| Part { test, rows: 0..tests[test].time.len() }).collect(),
        );
        let recorded: Vec<_> =
            tests.iter().enumerate().map(|(r, t)| plain.observed(r, std::slice::from_ref(&t.surface))).collect();
        let entropy =
            [Shape::Linear, Shape::Square, Shape::Cube].map(|shape| Law { factor: Factor::Flow(0), ..Law::added(shape, 1, 0) });
        let told = [Told { name: "least squares, told current times a cubic in charge", laws: entropy.to_vec() }];
        let records = Records { fitted: &fitted, held: &held };
        let found = study(plain, &recorded, &records, &told, BREADTH)?;
        print!("{}", report::findings(&found));
        let held: Vec<&str> = held.iter().map(|r| names[*r].as_str()).collect();
        print!("{}", report::table(&found, &held));
        let file = if fitted.len() == 3 { "real-battery.svg" } else { "real-battery-trap.svg" };
        picture::write(file, &picture::over_time(&found, &recorded, &records, 0, &format!("Two cells, {title}"), &held)?)?;
    }
    Ok(())
}
