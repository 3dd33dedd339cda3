//! `cargo xtask bench reduced`: a day by the reduced model and by the full one, times and distances.

use super::publish::{Progress, publish, reference_coil};
use ::coil::{Drive, Dynamics, Model, Profile, Response, STANDARD, ThermalModel, functionals};
use proof::Failure;
use proof::peers::Stopwatch;
use proof::statistics::middle as median;
use std::fmt::Write as _;

/// A day \[s\].
const DAY: f64 = 86_400.0;
/// Rest, rise, rest, fall, rest: the corners of the chamber's course \[s, °C\], 0.2 K/min.
const CORNERS: [(f64, f64); 6] =
    [(0.0, -40.0), (3600.0, -40.0), (33_600.0, 60.0), (40_800.0, 60.0), (70_800.0, -40.0), (DAY, -40.0)];
/// Largest error of a step of the full model \[K\].
const TOLERANCE: f64 = 1e-5;
/// Runs of the reduced model.
const RUNS: usize = 21;

/// Two ways of sampling the day: interval, span over which the full model runs \[s\]; days that one reading of the clock takes in, which
/// is good to some milliseconds.
const CASES: [(f64, [f64; 2], usize); 2] = [(30.0, [0.0, DAY], 100), (1.0, [3000.0, 4800.0], 4)];

fn chamber(t: f64) -> f64 {
    let leg = CORNERS.windows(2).find(|w| t <= w[1].0).unwrap_or(&CORNERS[4..]);
    let ((a, from), (b, to)) = (leg[0], leg[1]);
    from + (to - from) * (t - a) / (b - a)
}

fn profile(interval: f64, [begin, end]: [f64; 2]) -> Profile {
    let time: Vec<f64> = (0..=((end - begin) / interval).round() as usize).map(|n| begin + n as f64 * interval).collect();
    let course = time.iter().map(|&t| chamber(t)).collect();
    Profile { time, drives: vec![course] }
}

/// Thermometer and total bias in every interval, by the reduced model.
fn reduced(responses: &[Response]) -> Vec<[f64; 2]> {
    responses[1..].iter().map(|r| [r.sensor, r.bias.total()]).collect()
}

/// The same from the full model's outputs: thermometer, and the phases of the three parts.
fn full(outputs: &[Vec<f64>], interval: f64) -> Vec<[f64; 2]> {
    let phase = |row: &[f64]| row[1..].iter().sum::<f64>();
    outputs.windows(2).map(|w| [w[1][0], (phase(&w[1]) - phase(&w[0])) / interval]).collect()
}

pub(crate) fn run() -> Result<(), Failure> {
    let progress = Progress::new();
    let design = reference_coil()?;
    let mut watch = Stopwatch::start();
    progress.say("reduced model");
    let dynamics = Dynamics::new(&design, &[Drive::Chamber], &STANDARD)?;
    let built = watch.lap();
    let thermal = ThermalModel::new(&design, &STANDARD.resolution, &[Drive::Chamber])?;
    let outputs = functionals(&design, &Model::new(&design, &STANDARD.resolution)?, &thermal)?;
    let outputs: Vec<Vec<f64>> = std::iter::once(outputs.thermometer).chain(outputs.parts.into_iter().flatten()).collect();
    let mut out = String::from(
        "| sampling | full model, CPU s | reduced model, CPU s | full ÷ reduced | full ÷ reduced with its build | thermometer: distance ÷ its range | bias: distance ÷ its peak |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for (interval, span, days) in CASES {
        let day = profile(interval, [0.0, DAY]);
        let time = |_| -> Result<f64, Failure> {
            let mut watch = Stopwatch::start();
            for _ in 0..days {
                std::hint::black_box(dynamics.simulate(&day)?);
            }
            Ok(watch.lap() / days as f64)
        };
        let fast = median((0..RUNS).map(time).collect::<Result<_, _>>()?);
        let part = profile(interval, span);
        progress.say(&format!("full model at {interval} s, {} instants (a minute or more)", part.time.len()));
        let mut watch = Stopwatch::start();
        let slow = thermal.run(&part, &outputs, TOLERANCE)?;
        let share = (span[1] - span[0]) / DAY;
        let seconds = watch.lap() / share;
        let (a, b) = (reduced(&dynamics.simulate(&part)?), full(&slow.outputs, interval));
        let distance = |k: usize| a.iter().zip(&b).fold(0.0, |m: f64, (a, b)| m.max((a[k] - b[k]).abs()));
        let start = part.drives[0][0];
        let range = b.iter().fold(0.0, |m: f64, b| m.max((b[0] - start).abs()));
        let peak = b.iter().fold(0.0, |m: f64, b| m.max(b[1].abs()));
        let measured = if share == 1.0 { String::new() } else { format!(" (measured over {} s of it)", span[1] - span[0]) };
        let _ = writeln!(
            out,
            "| a day at {interval} s{measured} | {seconds:.0} | {fast:.5} | {:.0} | {:.0} | {:.1e} | {:.1e} |",
            seconds / fast,
            seconds / (fast + built),
            distance(0) / range,
            distance(1) / peak
        );
    }
    let _ = writeln!(
        out,
        "\n{} thermal unknowns, {} modes. Building the reduced model: {built:.2} CPU s, once for a design. The full model is stepped \
         with at most {TOLERANCE:.0e} K of error a step on the same mesh; the time to build it is not counted. Reduced: median of {RUNS} runs.",
        thermal.map().reduced(),
        dynamics.reduced().rates().len()
    );
    publish("reduced", &out)
}
