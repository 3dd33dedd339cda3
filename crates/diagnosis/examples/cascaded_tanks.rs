//! The cascaded water tanks of Schoukens and Noël: Bernoulli's law misses something; the engine is to find what, where, and how much it helps.
//!
//! ```sh
//! cargo run --release -p diagnosis --example cascaded_tanks -- cascaded_tanks.csv
//! ```
//!
//! The file (nonlinearbenchmark.org) has columns uEst, uVal, yEst, yVal in volts and, in its first row, Ts in seconds. It is not part of this
//! repository. The levels are fitted on uEst, yEst and judged on uVal, yVal.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

#[path = "models/tanks.rs"]
#[allow(dead_code)] // the test uses the rest
mod tanks;

use std::error::Error;

use diagnosis::{Diagnosis, ForwardModel, Hypothesis, Observation, Settings, diagnose, fitted};
use tanks::{Feed, LOWER_OVERFLOW, Tanks, UPPER_OVERFLOW};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: cascaded_tanks PATH")?;
    let (feeds, observations) = read(&std::fs::read_to_string(&path).map_err(|e| format!("{path}: {e}"))?)?;
    let mut tanks = Tanks::new(feeds, 1.0);
    let nominal = fitted(&tanks, &[0], &observations[..1], &[Hypothesis::NOMINAL])?;
    tanks.settle(&nominal.nuisances[0]);
    let found = diagnose(&tanks, &[0], &observations[..1], &Settings::default(), &|task| eprintln!("{task}"))?;
    say(&tanks, &found, &observations)
}

/// Both halves: feeds, and what was read.
fn read(text: &str) -> Result<(Vec<Feed>, Vec<Observation>), Box<dyn Error>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').map(|name| name.trim_matches(['"', ' '])).collect();
    let find = |name: &str| names.iter().position(|n| *n == name).ok_or(format!("line 1: there is no column {name}"));
    let places = [find("uEst")?, find("uVal")?, find("yEst")?, find("yVal")?];
    let ts = find("Ts")?;
    let mut columns = [const { Vec::new() }; 4];
    let mut step = f64::NAN;
    for (n, line) in lines.filter(|line| !line.trim().is_empty()).enumerate() {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |place: usize| -> Result<f64, String> {
            let field = fields.get(place).copied().unwrap_or_default().trim();
            field.parse().map_err(|_| format!("line {}: {} is `{field}`, not a number", n + 2, names[place]))
        };
        if n == 0 {
            step = number(ts)?;
        }
        for (column, place) in columns.iter_mut().zip(places) {
            column.push(number(place)?);
        }
    }
    let [u, u_held, y, y_held] = columns;
    if u.len() < 100 || step.is_nan() || step <= 0.0 {
        return Err("fewer than 100 rows, or no interval".into());
    }
    let time: Vec<f64> = (0..u.len()).map(|n| step * n as f64).collect();
    let feed = |pump: Vec<f64>, y: &[f64]| Feed { step, pump, start: y[0] };
    let feeds = vec![feed(u, &y), feed(u_held, &y_held)];
    let observation = |y: Vec<f64>| Observation { time: time.clone(), channels: vec![y] };
    Ok((feeds, vec![observation(y), observation(y_held)]))
}

fn say(tanks: &Tanks, found: &Diagnosis, observations: &[Observation]) -> Result<(), Box<dyn Error>> {
    let best = &found.best().fit;
    println!("verdict: {:?}", found.verdict);
    for (mechanism, probability) in found.mechanisms.iter().filter(|(_, p)| *p >= 5e-4) {
        println!("  {:<18} probability {probability:.3}", tanks.mechanisms()[*mechanism].id);
    }
    // an unknown may lie beyond what is named
    for (active, estimates) in best.active.iter().zip(&found.parameters) {
        println!("named: {} (fitted)", tanks.mechanisms()[active.mechanism].id);
        for e in estimates {
            println!("  {} = {:.3}, 90 % interval {:.3} to {:.3}", e.name, e.value, e.ci90[0], e.ci90[1]);
        }
    }
    if let Some(rival) = &found.best().rival {
        println!("not explained: {} (ln evidence +{:.1})", rival.structure.describe(), rival.gain);
    }
    // where Bernoulli's law fails
    let cells = found.nominal.over_state(tanks, (0, 0), 0, &observations[0], best);
    let odd = cells.iter().filter(|c| c.significant).map(|c| c.level);
    if let Some([low, high]) = odd.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]) {
        println!("nominal residual significant at lower levels of {low:.1} to {high:.1} V");
    }
    let course = tanks.run(0, &best.nuisances[0], &best.active);
    for (which, levels, mechanism) in [("upper", &course.upper, UPPER_OVERFLOW), ("lower", &course.lower, LOWER_OVERFLOW)] {
        if best.active.iter().any(|a| a.mechanism == mechanism) {
            // no level is above the rim
            let rim = levels.iter().fold(0.0, |m: f64, level| m.max(*level));
            let spills: Vec<String> = runs(levels, rim - 1e-9)
                .iter()
                .map(|(a, b)| format!("{:.0}-{:.0}", observations[0].time[*a], observations[0].time[*b]))
                .collect();
            println!("the {which} tank is at its rim at {} s", spills.join(", "));
        }
    }
    for (name, record) in [("fitted half", 0), ("held-out half", 1)] {
        let [before, after] = [&found.nominal, best].map(|fit| fit.hold_out(tanks, record, &observations[record], best));
        let (before, after) = (before?.rmse[0], after?.rmse[0]);
        println!("{name}: rms {before:.3} V nominal, {after:.3} V extended");
    }
    Ok(())
}

/// First and last rows of the stretches at or above a level.
fn runs(levels: &[f64], at: f64) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for n in (0..levels.len()).filter(|n| levels[*n] >= at) {
        match runs.last_mut() {
            Some((_, last)) if n - *last <= 2 => *last = n,
            _ => runs.push((n, n)),
        }
    }
    runs
}
