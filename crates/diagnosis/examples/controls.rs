//! Negative controls on the real recordings: in records that are shuffled in time, or noise of the same spectrum, there is no law to compose.
//!
//! ```sh
//! cargo run --release -p diagnosis --example controls -- fixtures/real 30
//! ```
//!
//! The last number is that of the draws of each control.

#![allow(clippy::print_stdout, reason = "a program")]

#[path = "models/real/mod.rs"]
mod real;

use diagnosis::{Observation, proven};
use real::cell::{Cell, Test};
use real::control::{shuffled, surrogate};
use real::load;
use real::offered::{Offered, Part};
use real::plant::Plant;
use real::rate_sensor::RateSensor;
use real::study::{BREADTH, Records, composed};
use std::error::Error;
use std::process::ExitCode;

type Control = fn(&[f64], u64) -> Vec<f64>;
const CONTROLS: [(&str, Control); 2] = [("shuffled", shuffled), ("noise of the same spectrum", surrogate)];
/// Capacity of the cells \[Ah\].
const CAPACITY: f64 = 2.58;
/// Between the seeds of one draw's records.
const APART: u64 = 1000;

fn main() -> ExitCode {
    real::told(run())
}

fn run() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("usage: controls FOLDER [DRAWS]")?;
    let draws: u64 = arguments.next().map_or(Ok(30), |n| n.parse())?;
    println!("| control | composed, of {draws} | borne out |\n|---|---|---|");
    chamber(&folder, draws)?;
    cycle(&folder, draws)?;
    cells(&folder, draws)
}

/// Counts draws in which something is composed, and those of them of which what was held out bears something out.
fn counted<P: Plant + Clone>(
    name: &str,
    draws: u64,
    records: &Records<'_>,
    draw: impl Fn(u64) -> (Offered<P>, Vec<Observation>),
) -> Result<(), Box<dyn Error>> {
    let (mut some, mut proved) = (0, 0);
    for seed in 1..=draws {
        let (plain, recorded) = draw(seed);
        let (model, nominal, found) = composed(plain, &recorded, records, BREADTH)?;
        let Some(found) = found else { continue };
        some += 1;
        let held: Vec<_> = records.held.iter().map(|r| (*r, &recorded[*r])).collect();
        proved += usize::from(proven(&model, &nominal, &found.steps, &held)?.is_some());
    }
    let of_them = if records.held.is_empty() { "not asked".to_owned() } else { proved.to_string() };
    println!("| {name} | {some} | {of_them} |");
    Ok(())
}

const HALVES: Records<'_> = Records { fitted: &[0], held: &[1] };

fn rate_sensor(record: &load::Rates, rate: &[f64], cut: usize, degree: usize) -> (Offered<RateSensor>, Vec<Observation>) {
    let plant = RateSensor::new(record.time.clone(), record.temperature.clone(), rate, cut, degree);
    let plain = Offered::nothing(plant, vec![Part { test: 0, rows: 0..cut }, Part { test: 0, rows: cut..rate.len() }]);
    let recorded = [0, 1].map(|r| plain.observed(r, &[rate.to_vec()])).to_vec();
    (plain, recorded)
}

fn chamber(folder: &str, draws: u64) -> Result<(), Box<dyn Error>> {
    let record = load::cold_chamber(&format!("{folder}/cold_chamber/gyro.csv"))?;
    let cut = record.time.len() * 2 / 3 / 5 * 5;
    for (name, control) in CONTROLS {
        for (axis, rate) in ["x", "y", "z"].into_iter().zip(&record.rates) {
            counted(&format!("cold chamber, axis {axis}, {name}"), draws, &HALVES, |seed| {
                rate_sensor(&record, &control(rate, seed), cut, 0)
            })?;
        }
    }
    Ok(())
}

fn cycle(folder: &str, draws: u64) -> Result<(), Box<dyn Error>> {
    let record = load::thermal_cycle(&format!("{folder}/imu/thermal_cycle.tsv"), "imu.gyro.x")?;
    let rate = &record.rates[0];
    let cut = rate.len() * 3 / 4;
    let (plain, recorded) = rate_sensor(&record, rate, cut, 3);
    let nominal = plain.nominal(&[0], &recorded[..1])?;
    let all = plain.plant.run(0, &nominal.nuisances[0], &mut |_| ()).remove(0);
    let left: Vec<f64> = rate.iter().zip(&all).map(|(y, p)| y - p).collect();
    for (name, control) in CONTROLS {
        counted(&format!("thermal cycle, gyro x, residual, {name}"), draws, &HALVES, |seed| {
            let drawn: Vec<f64> = all.iter().zip(control(&left, seed)).map(|(p, left)| p + left).collect();
            rate_sensor(&record, &drawn, cut, 3)
        })?;
    }
    Ok(())
}

fn cells(folder: &str, draws: u64) -> Result<(), Box<dyn Error>> {
    let tests = ["one_c", "pulse", "two_c"].map(|test| load::cell(&format!("{folder}/battery"), "R1", test));
    let tests: Vec<Test> = tests.into_iter().collect::<Result<_, _>>()?;
    let of = |tests: &[Test]| {
        let parts = (0..tests.len()).map(|test| Part { test, rows: 0..tests[test].time.len() }).collect();
        let plain = Offered::nothing(Cell::new(tests.to_vec(), CAPACITY, &[0, 1, 2]), parts);
        let recorded: Vec<_> =
            tests.iter().enumerate().map(|(r, t)| plain.observed(r, std::slice::from_ref(&t.surface))).collect();
        (plain, recorded)
    };
    let (plain, recorded) = of(&tests);
    let nominal = plain.nominal(&[0, 1, 2], &recorded)?;
    let all = CONTROLS.map(|(name, control)| (name, control, APART)).into_iter();
    for (name, control, apart) in all.chain([("noise with the same phases in all three", surrogate as Control, 0)]) {
        let records = Records { fitted: &[0, 1, 2], held: &[] };
        counted(&format!("cells, residual, {name}"), draws, &records, |seed| {
            let mut tests = tests.clone();
            for (k, (test, left)) in tests.iter_mut().zip(&nominal.residuals).enumerate() {
                let noise = control(&left[0], seed + apart * k as u64);
                test.surface.iter_mut().zip(&left[0]).zip(&noise).for_each(|((y, left), noise)| *y += noise - left);
            }
            of(&tests)
        })?;
    }
    for (name, apart) in [("phases of its own in each record", APART), ("the same phases in all", 0)] {
        println!(
            "cells, noise with {name}: what a record shares with another is {:.2}",
            shared(&nominal.residuals, draws, apart)
        );
    }
    Ok(())
}

/// Instants, in parts of a record, at which two records are compared.
const PARTS: usize = 100;

/// Mean square of the correlation between the noises of two records at the same part of each: what a function of that part, such as of the charge, explains.
fn shared(residuals: &[Vec<Vec<f64>>], draws: u64, apart: u64) -> f64 {
    let mut squares = Vec::new();
    for seed in 1..=draws {
        let drawn: Vec<Vec<f64>> = residuals
            .iter()
            .enumerate()
            .map(|(k, left)| {
                let noise = surrogate(&left[0], seed + apart * k as u64);
                (0..PARTS).map(|part| noise[part * noise.len() / PARTS]).collect()
            })
            .collect();
        squares.extend([[0, 1], [0, 2], [1, 2]].map(|[a, b]| correlation(&drawn[a], &drawn[b]).powi(2)));
    }
    squares.iter().sum::<f64>() / squares.len().max(1) as f64
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let (middle_a, middle_b) = (mean(a), mean(b));
    let of = |x: &[f64], m: f64, y: &[f64], n: f64| x.iter().zip(y).map(|(x, y)| (x - m) * (y - n)).sum::<f64>();
    of(a, middle_a, b, middle_b) / (of(a, middle_a, a, middle_a) * of(b, middle_b, b, middle_b)).sqrt()
}
