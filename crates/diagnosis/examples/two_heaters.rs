//! A board with two heaters: two separate lumps miss slow thermometers, an exchange, and that both heaters draw on one supply.
//!
//! ```sh
//! cargo run --release -p diagnosis --example two_heaters -- fixtures/real/tclab/two_heaters.csv
//! ```

#![allow(clippy::print_stdout, reason = "a program")]

#[path = "models/real/mod.rs"]
mod real;

use real::heaters::{Heaters, Test};
use real::law::{Factor, Law, Of};
use real::offered::{Offered, Part};
use real::plant::Plant;
use real::shapes::Shape;
use real::study::{BREADTH, Records, Told, study, versus};
use real::{load, picture, report};
use std::error::Error;
use std::process::ExitCode;

/// The part that is fitted \[s\].
const FITTED_S: f64 = 350.0;

fn main() -> ExitCode {
    real::told(run())
}

fn run() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: two_heaters PATH")?;
    let recorded = load::heaters(&path)?;
    let cut = recorded.time.partition_point(|t| *t < FITTED_S);
    let (tests, names): (Vec<Test>, Vec<&str>) = [(recorded.clone(), "recorded")].into_iter().chain(further(&recorded)).unzip();
    let all = recorded.time.len();
    let mut parts = vec![Part { test: 0, rows: 0..cut }, Part { test: 0, rows: cut..all }];
    parts.extend((1..tests.len()).map(|test| Part { test, rows: 0..all }));
    let plain = Offered::nothing(Heaters::new(tests, cut), parts);
    let recorded = [0, 1].map(|r| plain.observed(r, &recorded.thermometers));
    let exchange = Law { shape: Shape::Linear, of: Of::Difference(3, 2), factor: Factor::One, at: 1, from: Some(0), also: None };
    let lag = Law { also: Some(5), ..Law::added(Shape::Lag, 2, 4) };
    let supply = Law { shape: Shape::Linear, of: Of::Place(1, 0), factor: Factor::Own, at: 0, from: None, also: Some(1) };
    let told = [
        Told { name: "least squares, told the exchange", laws: vec![exchange] },
        Told { name: "told slow thermometers", laws: vec![lag] },
        Told { name: "told both", laws: vec![exchange, lag] },
        Told { name: "told these and one supply", laws: vec![exchange, lag, supply] },
    ];
    let records = Records { fitted: &[0], held: &[1] };
    let found = study(plain, &recorded, &records, &told, BREADTH)?;
    print!("{}", report::findings(&found));
    print!("{}", report::table(&found, &["350 to 599 s"]));
    let picture = picture::over_time(&found, &recorded, &records, 0, "Two heaters: thermometer 1", &["350 to 599 s"])?;
    picture::write("real-two-heaters.svg", &picture)?;
    // what else a board that warms up might be
    let warm = Law { also: Some(1), ..Law::added(Shape::Linear, 2, 0) };
    for (test, name) in names.iter().enumerate().skip(1) {
        let time = found.model.plant.time(test).to_vec();
        let shown = versus(&found, &exchange, &warm, test + 1, &time)?;
        println!("next test, {name}: the exchange and warmer surroundings would lie {shown:.1} sigma apart");
    }
    Ok(())
}

/// Tests that may be made next, each as long as the recorded one.
fn further(like: &Test) -> Vec<(Test, &'static str)> {
    let with = |heater: &dyn Fn(usize, f64) -> f64| {
        let heaters = [0, 1].map(|k| like.time.iter().map(|t| heater(k, *t)).collect());
        Test { heaters, ..like.clone() }
    };
    let step = |at: f64, t: f64| if t > at { 100.0 } else { 0.0 };
    vec![
        (like.clone(), "the same again"),
        (with(&|k, t| if k == 0 { step(10.0, t) } else { 0.0 }), "heater 1 alone at 100 %"),
        (with(&|k, t| if k == 1 { step(10.0, t) } else { 0.0 }), "heater 2 alone at 100 %"),
        (with(&|_, t| step(10.0, t)), "both heaters at 100 %"),
        (with(&|k, t| if ((t / 60.0) as usize + k) % 2 == 1 { 100.0 } else { 0.0 }), "the heaters by turns, a minute each"),
    ]
}
