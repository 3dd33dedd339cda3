//! The cascaded water tanks of Schoukens and Noël: Bernoulli's law misses something.
//!
//! ```sh
//! cargo run --release -p diagnosis --example cascaded_tanks -- cascaded_tanks.csv
//! ```
//!
//! The file (nonlinearbenchmark.org) has columns uEst, uVal, yEst, yVal in volts and, in its first row, Ts in seconds. It is not part of this
//! repository. uEst and yEst are fitted, uVal and yVal held out.

#![allow(clippy::print_stdout, reason = "a program")]

#[path = "models/real/mod.rs"]
mod real;

use real::cascade::{Cascade, Feed};
use real::law::Law;
use real::offered::{Offered, Part};
use real::shapes::Shape;
use real::study::{BREADTH, Records, Told, study};
use real::{picture, report, table};
use std::error::Error;
use std::process::ExitCode;

fn main() -> ExitCode {
    real::told(run())
}

fn run() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: cascaded_tanks PATH")?;
    let columns = table::read(&path, ',', &["uEst", "uVal", "yEst", "yVal", "Ts"])?;
    let [u, u_held, y, y_held, ts] = <[Vec<f64>; 5]>::try_from(columns).map_err(|_| "five columns")?;
    let time: Vec<f64> = (0..u.len()).map(|n| ts[0] * n as f64).collect();
    let feed = |pump: Vec<f64>, lower: &[f64]| Feed { time: time.clone(), pump, lower: lower.to_vec() };
    let feeds = vec![feed(u, &y), feed(u_held, &y_held)];
    let rows = 0..time.len();
    let plain = Offered::nothing(Cascade::new(feeds), vec![Part { test: 0, rows: rows.clone() }, Part { test: 1, rows }]);
    let recorded = [plain.observed(0, &[y]), plain.observed(1, &[y_held])];
    let spill = Law { from: Some(0), ..Law::added(Shape::Knee, 1, 1) };
    let told = [Told { name: "least squares, told the overflow", laws: vec![Law::added(Shape::Knee, 1, 0), spill] }];
    let records = Records { fitted: &[0], held: &[1] };
    let found = study(plain, &recorded, &records, &told, BREADTH)?;
    let picture = picture::over_time(&found, &recorded, &records, 0, "Cascaded tanks", &["the other record"])?;
    picture::write("real-tanks.svg", &picture)?;
    print!("{}{}", report::findings(&found), report::table(&found, &["the other record"]));
    Ok(())
}
