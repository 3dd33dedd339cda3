//! A measured thermal cycle of a rate sensor: the popular polynomial in temperature, its rate and time fits better and predicts worse; the engine
//! is to find the history effect, to refuse what the held-out part refutes, and to say what it does not explain.
//!
//! ```sh
//! cargo run --release -p diagnosis --example imu_thermal_cycle -- imu_thermal_cycle.tsv [COLUMN]
//! ```
//!
//! The file (repository tofupilot/examples, MIT licence, © 2024 tofupilot) has tab-separated columns timestamp (taken as µs), imu.gyro.x, …,
//! imu.temperature. It is not part of this repository. The last quarter, the final cooling, is held out.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

#[path = "models/thermal.rs"]
#[allow(dead_code)] // the test uses the rest
mod thermal;

use std::error::Error;

use diagnosis::{Fit, ForwardModel, Hypothesis, Settings, alternatives, diagnose, fitted};
use thermal::{RATE_AND_TIME, Thermal, coloured, plain};

/// Rows averaged into one, about ten seconds.
const GROUP: usize = 20;
/// Share of the rows that are fitted.
const FITTED: f64 = 0.75;
/// Size of thermal effects of such sensors [rad/s].
const SIZE: f64 = 0.01;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("usage: imu_thermal_cycle PATH [COLUMN]")?;
    let column = arguments.next().unwrap_or_else(|| "imu.gyro.x".into());
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{path}: {e}"))?;
    let [time, temperature, rate] = read(&text, &column)?;
    let white = scatter(&rate);
    let [time, temperature, rate] = [time, temperature, rate].map(|series| means(&series));
    let cut = (FITTED * time.len() as f64) as usize;
    let mean_white = white / (GROUP as f64).sqrt();
    let of = |size: f64, noise| Thermal::new(time.clone(), temperature.clone(), cut, size, noise);
    let model = of(SIZE, coloured(mean_white));
    let observations = model.observations(&rate);
    let found = diagnose(&model, &[0], &observations[..1], &Settings::default(), &|_| ())?;
    let best = &found.best().fit;
    println!("{column}: {} means of {GROUP} rows, {cut} of them fitted; noise of a row {white:.1e} rad/s", rate.len());
    println!("verdict: {:?}", found.verdict);
    for (active, estimates) in best.active.iter().zip(&found.parameters) {
        println!("named: {} (fitted)", model.mechanisms()[active.mechanism].id);
        for e in estimates {
            println!("  {} = {:.4}, 90 % interval {:.4} to {:.4}", e.name, e.value, e.ci90[0], e.ci90[1]);
        }
    }
    if let Some(rival) = &found.best().rival {
        println!("not explained: {} (ln evidence +{:.1})", rival.structure.describe(), rival.gain);
    }
    // the cubic and the popular fit by least squares: white noise and hardly any prior
    let squares = of(100.0 * SIZE, plain(mean_white));
    let by_squares = |hypotheses: &[Hypothesis]| fitted(&squares, &[0], &observations[..1], hypotheses);
    let cubic = by_squares(&[Hypothesis::NOMINAL])?;
    let popular = by_squares(&alternatives(&squares, RATE_AND_TIME))?;
    let judged = |model: &Thermal, fit: &Fit| -> Result<[f64; 2], Box<dyn Error>> {
        Ok([rms(&fit.residuals[0][0]), fit.hold_out(model, 1, &observations[1], best)?.rmse[0]])
    };
    let reference = judged(&squares, &cubic)?[1];
    println!("\n{:<44} fitted part  held-out part [rad/s]", "rms of what is left by");
    let rows = [
        ("a cubic in temperature, least squares", &squares, &cubic),
        ("  with its rate and time, least squares", &squares, &popular),
        ("  with what was named", &model, best),
    ];
    let shown = if best.active.is_empty() { 2 } else { 3 };
    for (name, model, fit) in &rows[..shown] {
        let [inside, outside] = judged(model, fit)?;
        let accepted = if outside <= reference { "" } else { "  worse than the cubic: not accepted" };
        println!("{name:<44} {inside:.2e}     {outside:.2e}{accepted}");
    }
    let outside = judged(&model, best)?[1];
    println!(
        "a mean's noise is {mean_white:.1e}, {:.0} % of the held-out rms: the rest is not explained",
        100.0 * mean_white / outside
    );
    Ok(())
}

fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt()
}

/// Standard deviation of the noise of a row, from second differences: slow changes cancel.
fn scatter(series: &[f64]) -> f64 {
    let mut d: Vec<f64> = series.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs()).collect();
    d.sort_by(f64::total_cmp);
    // of a normal variable the median magnitude is 0.6745 σ
    d[d.len() / 2] / 0.6745 / 6.0_f64.sqrt()
}

fn means(series: &[f64]) -> Vec<f64> {
    series.chunks_exact(GROUP).map(|c| c.iter().sum::<f64>() / GROUP as f64).collect()
}

/// Time from the start \[s\], temperature \[°C\] and one column.
fn read(text: &str, column: &str) -> Result<[Vec<f64>; 3], Box<dyn Error>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split('\t').map(str::trim).collect();
    let find = |name: &str| names.iter().position(|n| *n == name).ok_or(format!("line 1: there is no column {name}"));
    let places = [find("timestamp")?, find("imu.temperature")?, find(column)?];
    let mut columns = [const { Vec::new() }; 3];
    for (n, line) in lines.enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let fields: Vec<&str> = line.split('\t').collect();
        for (column, place) in columns.iter_mut().zip(places) {
            let field = fields.get(place).copied().unwrap_or_default().trim();
            let number: f64 =
                field.parse().map_err(|_| format!("line {}: {} is `{field}`, not a number", n + 2, names[place]))?;
            column.push(number);
        }
    }
    // the first row is read before the sensor has settled
    let [time, temperature, rate] = columns.map(|mut c: Vec<f64>| c.split_off(1.min(c.len())));
    if time.len() < 100 * GROUP {
        return Err(format!("{} rows are too few", time.len()).into());
    }
    let start = time[0];
    Ok([time.iter().map(|t| 1e-6 * (t - start)).collect(), temperature, rate])
}
