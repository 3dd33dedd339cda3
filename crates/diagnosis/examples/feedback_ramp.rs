//! A fibre-optic gyroscope at rest, with the feedback ramps of its three axes: a constant rate under white noise misses something.
//!
//! ```sh
//! cargo run --release -p diagnosis --example feedback_ramp -- blueseis
//! ```
//!
//! The folder (blueSeis-3A; repository fbernauer/blueseis_sandbox, which states no licence) holds three_axes_60s.csv and rotation_matrix.txt. It is not part of
//! this repository. The first half is fitted, the second held out.

#![allow(clippy::print_stdout, reason = "a program")]

#[path = "models/real/mod.rs"]
mod real;

use nalgebra::{Matrix3, Vector3};
use real::chart::{Chart, Line};
use real::law::Law;
use real::offered::{Offered, Part};
use real::ramp::Ramp;
use real::shapes::Shape;
use real::study::{BREADTH, Records, Told, study};
use real::{picture, report, table};
use std::error::Error;
use std::process::ExitCode;

/// Counts in a cycle of the ramp.
const CYCLE: f64 = 32_768.0;
/// The Earth's rate [nrad/s].
const EARTH: f64 = 72_921.15;

fn main() -> ExitCode {
    real::told(run())
}

fn run() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: feedback_ramp FOLDER")?;
    let names = ["time_s", "HJ1_nrad_per_s", "HJ2_nrad_per_s", "HJ3_nrad_per_s", "YR1", "YR2", "YR3"];
    let columns = table::read(&format!("{folder}/three_axes_60s.csv"), ',', &names)?;
    let [time, h1, h2, h3, y1, y2, y3] = <[Vec<f64>; 7]>::try_from(columns).map_err(|_| "seven columns")?;
    let matrix = matrix(&std::fs::read_to_string(format!("{folder}/rotation_matrix.txt"))?)?;
    let ramps = [y1, y2, y3].map(|y| y.iter().map(|y| y / CYCLE).collect::<Vec<f64>>());
    let published = [h1, h2, h3];
    let back = matrix.try_inverse().ok_or("the matrix has no inverse")?;
    let sensors = turned(&published, &back);
    let frequencies = [0, 1, 2].map(|k| frequency(&time, &ramps[k]));
    println!("ramps' frequencies [1/s]: {frequencies:.3?}; the Earth's rate is {EARTH} nrad/s");
    for (frame, rates) in
        [("as published", &published), ("by the matrix", &turned(&published, &matrix)), ("by its inverse", &sensors)]
    {
        let mean = [0, 1, 2].map(|k| rates[k].iter().sum::<f64>() / rates[k].len() as f64);
        let per = [0, 1, 2].map(|k| mean[k] / frequencies[k]);
        println!("axes {frame}: mean rates {mean:.0?}, over their ramps' frequencies {per:.1?} nrad; size {:.0}", norm(&mean));
    }
    let cut = time.len() / 2;
    for (axis, rate) in sensors.iter().enumerate() {
        println!("\n## sensor axis {}", axis + 1);
        let plant = Ramp::new(time.clone(), ramps.clone(), &rate[..cut]);
        let parts = vec![Part { test: 0, rows: 0..cut }, Part { test: 0, rows: cut..time.len() }];
        let plain = Offered::nothing(plant, parts);
        let recorded = [0, 1].map(|r| plain.observed(r, std::slice::from_ref(rate)));
        let after = [Shape::AfterReset, Shape::LateAfterReset].map(|shape| Law::added(shape, axis, 0));
        let told = [Told { name: "least squares, told what follows a reset", laws: after.to_vec() }];
        let records = Records { fitted: &[0], held: &[1] };
        let found = study(plain, &recorded, &records, &told, BREADTH)?;
        let left = picture::left(&found, &recorded, &records, 0)?;
        let chart = over_phase(axis, &ramps[axis][cut..], &left.map(|all| all[1].clone()));
        picture::write(&format!("real-feedback-ramp-{}.svg", axis + 1), &chart)?;
        print!("{}{}", report::findings(&found), report::table(&found, &["30 to 60 s"]));
    }
    Ok(())
}

/// Means of what is left of the held-out half, by the phase of a ramp.
fn over_phase(axis: usize, phase: &[f64], left: &[Vec<f64>; 2]) -> Chart {
    const BINS: usize = 96;
    let line = |name: &'static str, left: &[f64]| {
        let mut sums = [(0.0, 0.0_f64); BINS];
        for (phase, y) in phase.iter().zip(left) {
            let bin = &mut sums[((phase * BINS as f64) as usize).min(BINS - 1)];
            (bin.0, bin.1) = (bin.0 + y, bin.1 + 1.0);
        }
        let point = |(k, (sum, count)): (usize, &(f64, f64))| [(k as f64 + 0.5) / BINS as f64, sum / count.max(1.0)];
        Line { name, points: sums.iter().enumerate().map(point).collect() }
    };
    Chart {
        title: format!("Feedback ramp, sensor axis {}: means of the held-out half", axis + 1),
        across: "phase of the axis' own ramp [cycle]".into(),
        up: "rate less predicted [nrad/s]".into(),
        lines: vec![line("by the nominal model", &left[0]), line("with what was found", &left[1])],
        shades: vec![],
    }
}

fn norm(x: &[f64; 3]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Rates in another frame.
fn turned(rates: &[Vec<f64>; 3], by: &Matrix3<f64>) -> [Vec<f64>; 3] {
    let at = |n: usize| by * Vector3::new(rates[0][n], rates[1][n], rates[2][n]);
    [0, 1, 2].map(|k| (0..rates[0].len()).map(|n| at(n)[k]).collect())
}

/// Cycles per second of a ramp that is wrapped, signed.
fn frequency(time: &[f64], ramp: &[f64]) -> f64 {
    let cycles: f64 = ramp.windows(2).map(|w| (w[1] - w[0]) - (w[1] - w[0]).round()).sum();
    cycles / (time[time.len() - 1] - time[0])
}

/// The last three lines of numbers.
fn matrix(text: &str) -> Result<Matrix3<f64>, String> {
    let row =
        |line: &str| line.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>().ok().filter(|row| row.len() == 3);
    let rows: Vec<Vec<f64>> = text.lines().filter_map(row).collect();
    if rows.len() < 3 {
        Err("rotation_matrix.txt has no three rows of three numbers".into())
    } else {
        Ok(Matrix3::from_fn(|i, j| rows[i][j]))
    }
}
