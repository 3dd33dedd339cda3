//! `cargo xtask bench parametric`: the parametric model against the full chain at random points of three boxes.

use super::publish::{Progress, publish};
use ::coil::{
    COARSE, Design, Drive, Dynamics, Fidelity, MODEL_SAFETY, ModelEffort, Parameter, ParametricModel, Profile, Range, Reduced,
};
use ::mechanisms::CATALOGUE;
use proof::Failure;
use proof::files::root;
use proof::peers::Stopwatch;
use proof::statistics::middle as median;
use std::fmt::Write as _;

const DESIGNS: [(&str, &str); 3] =
    [("reference", "coil-reference.ron"), ("small", "designs/small.ron"), ("large", "designs/large.ron")];
/// More modes than a simulation has: its own reduction must not count as this model's error.
const FULL: Fidelity = Fidelity { resolution: COARSE, modes: 60 };
/// Runs of which a time is the median.
const RUNS: usize = 11;
/// What the relative error may be at 99 % of the points, and at any.
const ALLOWED: [f64; 2] = [1e-3, 1e-2];
/// Share of points at which it must be so, and at which the estimate must cover the error.
const MOST: f64 = 0.99;

/// Ten hours with ramps, a soak and a ripple.
fn courses() -> Profile {
    let time: Vec<f64> = (0..600).map(|k| 60.0 * f64::from(k)).collect();
    let chamber = |t: &f64| 20.0 + 30.0 * (t / 3000.0).sin().tanh() + 5.0 * (t / 700.0).sin();
    Profile { drives: vec![time.iter().map(chamber).collect()], time }
}

/// A day at 30 s.
fn day() -> Profile {
    let time: Vec<f64> = (0..=2880).map(|k| 30.0 * f64::from(k)).collect();
    Profile { drives: vec![time.iter().map(|t| 20.0 + 30.0 * (t / 9000.0).sin()).collect()], time }
}

/// A pseudo-random number in [0, 1).
fn random(seed: &mut u64) -> f64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

/// A design at a random point of the box; heaters act in proportion and are left out. Constants that no solid has together are drawn anew.
fn somewhere(design: &Design, ranges: &[Range], seed: &mut u64) -> Design {
    loop {
        let unheated = ranges.iter().filter(|range| !matches!(range.parameter, Parameter::Heater(_)));
        let point = unheated.fold(design.clone(), |design, range| {
            let share = random(seed);
            range.parameter.set(&design, range.at(share))
        });
        if point.body.elastic.indefinite_at_e_r_factor() > 1.0 {
            return point;
        }
    }
}

/// Total bias in every interval \[rad/s\], all outputs computed.
fn bias(reduced: &Reduced, profile: &Profile) -> Vec<f64> {
    let mut steps = reduced.steps(&profile.time, &profile.drives, &[profile.drives[0][0]]);
    let mut phase: f64 = reduced.parts().iter().map(|part| part.of(steps.state())).sum();
    let mut rates = Vec::with_capacity(profile.time.len());
    while let Some(step) = steps.next() {
        std::hint::black_box((reduced.thermometer().of(steps.state()), reduced.coil_mean().of(steps.state())));
        let now = reduced.parts().iter().map(|part| part.of(steps.state())).sum();
        rates.push((now - std::mem::replace(&mut phase, now)) / step.dt);
    }
    rates
}

fn full(design: &Design, profile: &Profile) -> Result<Vec<f64>, Failure> {
    let rows = Dynamics::new(design, &[Drive::Chamber], &FULL)?.simulate(profile)?;
    Ok(rows[1..].iter().map(|row| row.bias.total()).collect())
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The value below which a share of the values lies.
fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[((share * sorted.len() as f64).ceil() as usize).clamp(1, sorted.len()) - 1]
}

/// CPU seconds of the median of several runs.
fn timed(mut run: impl FnMut() -> Result<f64, Failure>) -> Result<f64, Failure> {
    let one = |_| -> Result<f64, Failure> {
        // the clock is good to some milliseconds
        let mut watch = Stopwatch::start();
        for _ in 0..20 {
            std::hint::black_box(run()?);
        }
        Ok(watch.lap() / 20.0)
    };
    Ok(median((0..RUNS).map(one).collect::<Result<_, _>>()?))
}

pub(crate) fn run(points: usize) -> Result<bool, Failure> {
    let progress = Progress::new();
    let mut out = String::from(
        "| design | parameters | fields of temperature, displacement | memory, MB | building, CPU s | full chain, CPU s | a day at 30 s at a new point, ms | with all derivatives, ms | full ÷ new point | relative error: half, 99 %, most | estimate covers, estimate ÷ error |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    let mut good = true;
    for (name, file) in DESIGNS {
        progress.say(&format!("{name}: building"));
        let design = fogcoil::input::read_coil(&root().join("fixtures").join(file))?.design;
        let ranges = ::mechanisms::ranges(&design, &::coil::Tolerances::default(), CATALOGUE);
        let mut watch = Stopwatch::start();
        let model = ParametricModel::new(&design, &ranges, &COARSE, &ModelEffort::default(), &|| ())?;
        let built = watch.lap();
        let (profile, mut seed) = (courses(), 2026);
        let nominal = full(&design, &profile)?;
        let (mut errors, mut ratios, mut chain) = (Vec::new(), Vec::new(), Vec::new());
        for point in 0..points {
            if point % 20 == 0 {
                progress.say(&format!("{name}: point {point} of {points}"));
            }
            let changed = somewhere(&design, model.ranges(), &mut seed);
            let mut watch = Stopwatch::start();
            let theirs = full(&changed, &profile)?;
            chain.push(watch.lap());
            let ours = bias(&model.at(&changed)?, &profile);
            let (error, effect) = (distance(&ours, &theirs), distance(&theirs, &nominal));
            let peak = theirs.iter().fold(0.0, |m: f64, b| m.max(b.abs()));
            errors.push(error / effect.max(0.1 * peak));
            ratios.push(MODEL_SAFETY * distance(&ours, &bias(&model.coarser(&changed)?, &profile)) / error);
        }
        let changed = somewhere(&design, model.ranges(), &mut seed);
        let day = day();
        let new_point = timed(|| Ok(bias(&model.at(&changed)?, &day)[0]))?;
        let free: Vec<Parameter> = model.ranges().iter().map(|range| range.parameter).collect();
        let with_slopes = timed(|| {
            let slopes = model.slopes(&changed, &free)?;
            Ok(slopes.run(&day.time, &day.drives, &[day.drives[0][0]]).outputs.thermometer[0])
        })?;
        let covered = ratios.iter().filter(|ratio| **ratio >= 1.0).count() as f64 / points as f64;
        let [half, most, largest] = [0.5, MOST, 1.0].map(|share| quantile(&errors, share));
        good &= most <= ALLOWED[0] && largest <= ALLOWED[1] && covered >= MOST;
        let (chain, [temperatures, displacements]) = (median(chain), model.size());
        let _ = writeln!(
            out,
            "| {name} | {} | {temperatures}, {displacements} | {:.0} | {built:.1} | {chain:.2} | {:.2} | {:.1} | {:.0} | {half:.1e}, {most:.1e}, {largest:.1e} | {:.1} %, {:.1} |",
            ranges.len(),
            model.bytes() as f64 / 1e6,
            1e3 * new_point,
            1e3 * with_slopes,
            chain / new_point,
            100.0 * covered,
            quantile(&ratios, 0.5)
        );
    }
    let _ = writeln!(
        out,
        "\n{points} points each. Times are CPU seconds, medians of {RUNS} runs, on one thread but for building and the full chain. Asked: a relative error of at \
         most {:.0e} at 99 % of the points and {:.0e} at any, an estimate that covers at 99 %.",
        ALLOWED[0], ALLOWED[1]
    );
    publish("parametric", &out)?;
    Ok(good)
}
