//! A rate sensor over one thermal cycle: the popular polynomial in temperature, its rate and time fits better and predicts worse.
//!
//! ```sh
//! cargo run --release -p diagnosis --example imu_thermal_cycle -- fixtures/real/imu/thermal_cycle.tsv imu.gyro.x
//! ```
//!
//! Nominal is a cubic of the temperature. The last quarter of the rows, the final cooling, is held out.

#![allow(clippy::print_stdout, reason = "a program")]

#[path = "models/real/mod.rs"]
mod real;
#[path = "models/thermal.rs"]
#[allow(dead_code)] // a test uses the rest
mod thermal;

use diagnosis::{Fit, Hypothesis, alternatives, fitted, prove};
use real::law::Law;
use real::offered::{Offered, Part};
use real::rate_sensor::RateSensor;
use real::shapes::Shape;
use real::study::{BREADTH, Records, Told, study, versus};
use real::{load, picture, report};
use std::error::Error;
use std::process::ExitCode;
use thermal::{RATE_AND_TIME, Thermal, plain};

/// Size of thermal effects of such sensors [rad/s], far below which least squares are free.
const SIZE: f64 = 1.0;

/// The popular fit by least squares, its temperature rate taken by central differences: errors of the fitted and the held-out part, and whether the latter
/// bears it out beside the cubic.
fn popular(time: &[f64], temperature: &[f64], rate: &[f64], cut: usize) -> Result<String, Box<dyn Error>> {
    let white = plain(real::noise::scatter(rate));
    let model = Thermal::new(time.to_vec(), temperature.to_vec(), cut, SIZE, white);
    let observations = model.observations(rate);
    let [known, held] = &observations[..] else { return Err("two parts".into()) };
    let fit = |hypotheses: &[Hypothesis]| fitted(&model, &[0], std::slice::from_ref(known), hypotheses);
    let (cubic, popular) = (fit(&[Hypothesis::NOMINAL])?, fit(&alternatives(&model, RATE_AND_TIME))?);
    let proof = prove(&model, &cubic, &popular, &[(1, held)])?;
    let inside = |fit: &Fit| real::offered::rms(&fit.residuals[0][0]);
    let [before, after] = proof.rmse(0).map(report::digits);
    let said = if proof.accepted { "accepted" } else { "REFUSED" };
    let (cubic, popular) = (report::digits(inside(&cubic)), report::digits(inside(&popular)));
    Ok(format!(
        "cubic, then dT/dt by central differences and time: fitted {cubic}, then {popular}; held out {before}, then {after}: {said}"
    ))
}

const FITTED: f64 = 0.75;

fn main() -> ExitCode {
    real::told(run())
}

fn run() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("usage: imu_thermal_cycle PATH [COLUMN...]")?;
    let mut columns: Vec<String> = arguments.take_while(|a| a != "--pictures").collect();
    if columns.is_empty() {
        columns = ["x", "y", "z"].map(|axis| format!("imu.gyro.{axis}")).to_vec();
    }
    for column in columns {
        println!("\n## {column}");
        let load::Rates { time, temperature, rates } = load::thermal_cycle(&path, &column)?;
        let rate = &rates[0];
        let cut = (FITTED * time.len() as f64) as usize;
        let plant = RateSensor::new(time.clone(), temperature.clone(), rate, cut, 3);
        // tests that may be made next
        let span = time[time.len() - 1] + time[1];
        let twice: Vec<f64> = time.iter().copied().chain(time.iter().map(|t| span + t)).collect();
        let plant = plant
            .with_test(time.clone(), temperature.clone())
            .with_test(twice.clone(), temperature.iter().chain(&temperature).copied().collect());
        let mut parts = vec![Part { test: 0, rows: 0..cut }, Part { test: 0, rows: cut..time.len() }];
        parts.extend([Part { test: 1, rows: 0..time.len() }, Part { test: 2, rows: 0..twice.len() }]);
        let plain = Offered::nothing(plant, parts);
        let recorded = [0, 1].map(|r| plain.observed(r, std::slice::from_ref(rate)));
        let of = |shape| Law::added(shape, 0, 0);
        let told = [
            Told { name: "least squares, cubic in T", laws: vec![] },
            Told { name: "cubic in T and dT/dt", laws: vec![of(Shape::Rate)] },
            Told { name: "the same and time", laws: vec![of(Shape::Rate), Law::added(Shape::Linear, 1, 0)] },
            Told { name: "cubic in T, told the lag", laws: vec![of(Shape::Lag)] },
        ];
        let records = Records { fitted: &[0], held: &[1] };
        let found = study(plain, &recorded, &records, &told, BREADTH)?;
        let title = format!("Rate sensor over a thermal cycle, {column}");
        let picture = picture::over_time(&found, &recorded, &records, 0, &title, &["final cooling"])?;
        picture::write(&format!("real-{}.svg", column.replace('.', "-")), &picture)?;
        print!("{}{}", report::findings(&found), report::table(&found, &["final cooling"]));
        let (drift, fading) = (Law::added(Shape::Linear, 1, 0), Law::added(Shape::Fading, 1, 0));
        for (name, record, time) in [("the same cycle", 2, &time), ("two cycles without a pause", 3, &twice)] {
            let shown = versus(&found, &drift, &fading, record, time)?.max(versus(&found, &fading, &drift, record, time)?);
            if shown > 0.0 {
                println!("next test, {name}: a drift in time and one that fades would lie {shown:.1} sigma apart");
            }
        }
        println!("{}", popular(&time, &temperature, rate, cut)?);
    }
    Ok(())
}
