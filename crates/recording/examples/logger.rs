//! A logger's table, from a file or the small one below: what is wrong with it, its noise, and its Allan deviation. The first column holds
//! instants \[s\], the others means of rates since the row before.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the example is a program")]

use recording::allan::allan;
use recording::check::{Expectations, check};
use recording::noise::{Bounds, Series, identify};
use recording::{Channel, Error, Recording, Sampling, Seconds, median_interval};
use std::process::ExitCode;

/// A recording from a header of names and rows of numbers; what is no number is missing.
fn read(text: &str, unit: &str) -> Result<Recording, Error> {
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    let mut rows = lines.map(|line| line.split(',').map(str::trim).collect::<Vec<_>>());
    let names = rows.next().unwrap_or_default();
    let rows: Vec<Vec<f64>> = rows.map(|row| row.iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()).collect();
    let column = |i: usize| rows.iter().map(|row| row.get(i).copied().unwrap_or(f64::NAN)).collect::<Vec<_>>();
    let channel = |(i, name): (usize, &&str)| Channel {
        name: (*name).into(),
        unit: unit.into(),
        values: column(i),
        sampling: Sampling::Mean,
    };
    Recording::new(column(0), names.iter().enumerate().skip(1).map(channel).collect())
}

/// A rate of 400 rows, 10 s apart: noise of standard deviation 1, a row that the logger wrote twice, and a value that is none.
fn small() -> String {
    let mut state = 1_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut text = String::from("time_s,rate");
    for row in 0..400 {
        let noise = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let value = if row == 200 { 500.0 } else { 15.0 + noise };
        (0..if row == 100 { 2 } else { 1 }).for_each(|_| text += &format!("\n{},{value:.4}", 10 * row));
    }
    text
}

/// Prints what is found; standard deviation of the white noise of the last channel.
fn report(recording: &Recording) -> Result<f64, Error> {
    let report = check(recording, &Expectations::default());
    report.findings.iter().for_each(|finding| println!("{finding}"));
    let used = report.used(recording);
    let mut white = f64::NAN;
    for (channel, mask) in used.channels().iter().zip(&report.masks) {
        let (time, offset) = (used.time(), vec![1.0; used.time().len()]);
        let series = Series { time, values: &channel.values, mask, columns: &[&offset] };
        let noise = identify(&series, &Bounds::new(median_interval(time).unwrap_or(0.0), time))?;
        println!("{}: white noise of {:.3} {} a row", channel.name, noise.model.white, channel.unit);
        for point in allan(time, &channel.values, mask)? {
            println!(
                "  {} s: {:.3} ({:.3} to {:.3}) {}",
                Seconds(point.tau),
                point.deviation,
                point.low,
                point.high,
                channel.unit
            );
        }
        white = noise.model.white;
    }
    Ok(white)
}

fn main() -> ExitCode {
    let Err(error) = run() else { return ExitCode::SUCCESS };
    eprintln!("error: {error}");
    ExitCode::FAILURE
}

fn run() -> Result<(), Box<dyn std::error::Error>> {
    if let Some(path) = std::env::args().nth(1) {
        report(&read(&std::fs::read_to_string(path)?, "u")?)?;
        return Ok(());
    }
    let white = report(&read(&small(), "deg/h")?)?;
    assert!((white - 1.0).abs() < 0.1, "{white}");
    Ok(())
}
