//! `cargo xtask bench parametric`: the parametric model against the full chain at random points of three boxes.

use super::publish::{Progress, publish};
use ::coil::{
    COARSE, Design, Drive, Dynamics, Fidelity, MODEL_SAFETY, ModelEffort, Parameter, ParametricModel, Profile, Range, Reduced,
    STANDARD, Side, Tolerances,
};
use ::mechanisms::CATALOGUE;
use proof::Failure;
use proof::files::root;
use proof::peers::Stopwatch;
use proof::statistics::middle as median;
use std::fmt::Write as _;

/// Designs with tolerances of their own: the reference coil; 40 mm without a flange; 130 mm with two and a coil from its cell.
const DESIGNS: [(&str, &str); 3] =
    [("reference", "ordinary/A/drawing.ron"), ("small", "ordinary/B/drawing.ron"), ("large", "ordinary/C/drawing.ron")];
/// More modes than a simulation has: its own reduction must not count as this model's error.
const FULL: Fidelity = Fidelity { resolution: COARSE, modes: 60 };
const DRIVES: [Drive; 2] = [Drive::Chamber, Drive::Heaters];
/// Ends of the ranges of heat paths that a design may have besides those of the mechanisms \[W/(m² K), W\].
const ENDS: [(Parameter, f64); 4] = [
    (Parameter::Mount(Side::Left), 18.0),
    (Parameter::Mount(Side::Right), 18.0),
    (Parameter::Heater(Side::Left), 1.0),
    (Parameter::Heater(Side::Right), 1.0),
];
/// Runs of which a time is the median.
const RUNS: usize = 11;
/// Full chains of which a time is the median.
const CHAINS: usize = 5;
/// Largest relative error at 99 % of the points, and at any.
const ALLOWED: [f64; 2] = [1e-3, 1e-2];
/// Share of points at which it must be so, and at which the estimate must cover the error.
const MOST: f64 = 0.99;
/// Bound of the median of the estimate over the error.
const LOOSEST: f64 = 30.0;
/// Fewest parameters; most building \[s\], memory \[MB\], time of a day at a new point and with derivatives \[ms\]; least ratio to a full chain.
const ASKED: [f64; 6] = [25.0, 30.0, 200.0, 3.0, 30.0, 1000.0];

/// Ten hours with ramps, a soak and a ripple.
fn courses() -> Profile {
    let time: Vec<f64> = (0..600).map(|k| 60.0 * f64::from(k)).collect();
    let chamber = |t: &f64| 20.0 + 30.0 * (t / 3000.0).sin().tanh() + 5.0 * (t / 700.0).sin();
    Profile { drives: vec![time.iter().map(chamber).collect(), vec![1.0; time.len()]], time }
}

/// So many intervals of 30 s: a day has 2880.
fn day(rows: u32) -> Profile {
    let time: Vec<f64> = (0..=rows).map(|k| 30.0 * f64::from(k)).collect();
    Profile { drives: vec![time.iter().map(|t| 20.0 + 30.0 * (t / 9000.0).sin()).collect(), vec![1.0; time.len()]], time }
}

/// A pseudo-random number in [0, 1).
fn random(seed: &mut u64) -> f64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

/// A design at a random point of the box, its heaters on. Constants that no solid has together are drawn anew.
fn somewhere(design: &Design, ranges: &[Range], seed: &mut u64) -> Design {
    loop {
        let point = ranges.iter().fold(design.clone(), |design, range| {
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
    let outputs = std::hint::black_box(reduced.run(&profile.time, &profile.drives, &rest(profile)));
    let phase = |n: usize| outputs.parts[0].iter().map(|part| part[n]).sum::<f64>();
    (1..profile.time.len()).map(|n| (phase(n) - phase(n - 1)) / (profile.time[n] - profile.time[n - 1])).collect()
}

/// The chamber as it begins, heaters off.
fn rest(profile: &Profile) -> [f64; 2] {
    [profile.drives[0][0], 0.0]
}

fn full(design: &Design, profile: &Profile, fidelity: &Fidelity) -> Result<Vec<f64>, Failure> {
    let drives = if design.heat.heaters.is_empty() { &DRIVES[..1] } else { &DRIVES };
    let profile = Profile { time: profile.time.clone(), drives: profile.drives[..drives.len()].to_vec() };
    let rows = Dynamics::new(design, drives, fidelity)?.simulate(&profile)?;
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

/// CPU seconds of one of `often` runs, the median of several such.
fn timed(often: usize, mut run: impl FnMut() -> Result<f64, Failure>) -> Result<f64, Failure> {
    let one = |_| -> Result<f64, Failure> {
        // the clock is good to some milliseconds
        let mut watch = Stopwatch::start();
        for _ in 0..often {
            std::hint::black_box(run()?);
        }
        Ok(watch.lap() / often as f64)
    };
    Ok(median((0..RUNS).map(one).collect::<Result<_, _>>()?))
}

/// Times of a model.
struct Times {
    /// CPU s
    building: f64,
    /// ms
    new_point: f64,
    /// ms
    with_slopes: f64,
}

/// Builds a model and times it at a point of its box.
fn measured(
    design: &Design,
    ranges: &[Range],
    day: &Profile,
    seed: &mut u64,
) -> Result<(ParametricModel, Design, Times), Failure> {
    let mut watch = Stopwatch::start();
    let model = ParametricModel::new(design, ranges, &COARSE, &ModelEffort::default(), &|| ())?;
    let building = watch.lap();
    let changed = somewhere(design, model.ranges(), seed);
    let new_point = timed(100, || Ok(bias(&model.at(&changed)?, day)[0]))?;
    let free: Vec<Parameter> = model.ranges().iter().map(|range| range.parameter).collect();
    let with_slopes = timed(10, || {
        let slopes = model.slopes(&changed, &free)?;
        Ok(slopes.run(&day.time, &day.drives, &rest(day)).outputs.thermometer[0])
    })?;
    Ok((model, changed, Times { building, new_point: 1e3 * new_point, with_slopes: 1e3 * with_slopes }))
}

/// Every number of a design that the box may have.
fn box_of(design: &Design, tolerances: &Tolerances) -> Vec<Range> {
    let mut ranges = ::mechanisms::ranges(design, tolerances, CATALOGUE);
    for (parameter, high) in ENDS {
        if ranges.iter().all(|range| range.parameter != parameter) {
            ranges.push(Range { parameter, low: 0.0, high });
        }
    }
    ranges.retain(|range| range.parameter.of(design).is_some());
    ranges
}

/// The power with which times grow, by least squares of the logarithms.
fn exponent(sizes: &[f64], times: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().map(|v| v.ln()).sum::<f64>() / values.len() as f64;
    let (x, y) = (mean(sizes), mean(times));
    let along: f64 = sizes.iter().zip(times).map(|(size, time)| (size.ln() - x) * (time.ln() - y)).sum();
    along / sizes.iter().map(|size| (size.ln() - x).powi(2)).sum::<f64>()
}

/// Growth of times with the number of parameters, turns and rows.
fn scaling(design: &Design, ranges: &[Range], progress: &Progress) -> Result<String, Failure> {
    let mut out = String::from(
        "\n| what grows | of it | building, CPU s | new point, ms | with derivatives, ms |\n|---|---|---|---|---|\n",
    );
    let mut table = |what: &str, cases: Vec<(f64, Times)>| {
        for (size, times) in &cases {
            let (built, point, slopes) = (times.building, times.new_point, times.with_slopes);
            let _ = writeln!(out, "| {what} | {size:.0} | {built:.1} | {point:.2} | {slopes:.1} |");
        }
        let sizes: Vec<f64> = cases.iter().map(|(size, _)| *size).collect();
        let grow = |of: fn(&Times) -> f64| exponent(&sizes, &cases.iter().map(|(_, times)| of(times)).collect::<Vec<_>>());
        let [built, point, slopes] = [grow(|t| t.building), grow(|t| t.new_point), grow(|t| t.with_slopes)];
        let _ = writeln!(out, "| | *exponent* | {built:.2} | {point:.2} | {slopes:.2} |");
    };
    let mut seed = 2027;
    let day = day(2880);
    let mut cases = Vec::new();
    for count in [4, 8, 16, ranges.len()] {
        progress.say(&format!("scaling: {count} parameters"));
        cases.push((count as f64, measured(design, &ranges[..count], &day, &mut seed)?.2));
    }
    table("parameters", cases);
    let mut cases = Vec::new();
    for finer in [1, 2, 3] {
        progress.say(&format!("scaling: fibres {finer} times as thin"));
        let mut thinner = design.clone();
        let winding = &mut thinner.winding;
        winding.pitch /= finer as f64;
        winding.layers *= finer;
        // one turn less in every other layer, as before
        let less = winding.turns_odd_layers - winding.turns_even_layers;
        winding.turns_odd_layers *= finer;
        winding.turns_even_layers = winding.turns_odd_layers - less;
        let turns = ::winding::wind(&thinner.winding)?.turns().len();
        cases.push((turns as f64, measured(&thinner, ranges, &day, &mut seed)?.2));
    }
    table("turns", cases);
    let (model, changed, _) = measured(design, ranges, &day, &mut seed)?;
    let free: Vec<Parameter> = ranges.iter().map(|range| range.parameter).collect();
    let (reduced, slopes) = (model.at(&changed)?, model.slopes(&changed, &free)?);
    let mut cases = Vec::new();
    for rows in [2880, 11520, 46080] {
        progress.say(&format!("scaling: {rows} rows"));
        let day = self::day(rows);
        let new_point = 1e3 * timed(100, || Ok(bias(&reduced, &day)[0]))?;
        let run = || Ok(slopes.run(&day.time, &day.drives, &rest(&day)).outputs.thermometer[0]);
        cases.push((rows as f64, Times { building: f64::NAN, new_point, with_slopes: 1e3 * timed(10, run)? }));
    }
    table("rows (the run alone)", cases);
    Ok(out.replace("NaN", "–"))
}

pub(crate) fn run(points: usize) -> Result<bool, Failure> {
    let progress = Progress::new();
    let mut out = String::from(
        "| design | parameters | fields of temperature, displacement | memory, MB | building, CPU s | full chain, CPU s | a day at 30 s at a new point, ms | with all derivatives, ms | full ÷ new point | relative error: half, 99 %, most | estimate covers, estimate ÷ error |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    let (mut missed, mut reference) = (Vec::new(), None);
    for (name, file) in DESIGNS {
        progress.say(&format!("{name}: building"));
        let case = fogcoil::input::read_coil(&root().join("fixtures").join(file))?;
        let design = case.design;
        let ranges = box_of(&design, &case.tolerances);
        let (profile, day, mut seed) = (courses(), day(2880), 2026);
        let (model, changed, times) = measured(&design, &ranges, &day, &mut seed)?;
        let nominal = full(&design, &profile, &FULL)?;
        let (mut errors, mut ratios) = (Vec::new(), Vec::new());
        for point in 0..points {
            if point % 20 == 0 {
                progress.say(&format!("{name}: point {point} of {points}"));
            }
            let changed = somewhere(&design, model.ranges(), &mut seed);
            let theirs = full(&changed, &profile, &FULL)?;
            let ours = bias(&model.at(&changed)?, &profile);
            let (error, effect) = (distance(&ours, &theirs), distance(&theirs, &nominal));
            let peak = theirs.iter().fold(0.0, |m: f64, b| m.max(b.abs()));
            errors.push(error / effect.max(0.1 * peak));
            let apart = model.coarser(&changed)?.map(|coarser| distance(&ours, &bias(&coarser, &profile)));
            ratios.push(MODEL_SAFETY * apart[0].max(apart[1]) / error);
        }
        let mut chain = Vec::new();
        for _ in 0..CHAINS {
            let mut watch = Stopwatch::start();
            std::hint::black_box(full(&changed, &day, &STANDARD)?);
            chain.push(watch.lap());
        }
        let (chain, [temperatures, displacements]) = (median(chain), model.size());
        let covered = ratios.iter().filter(|ratio| **ratio >= 1.0).count() as f64 / points as f64;
        let [half, most, largest] = [0.5, MOST, 1.0].map(|share| quantile(&errors, share));
        let (megabytes, loose, faster) = (model.bytes() as f64 / 1e6, quantile(&ratios, 0.5), 1e3 * chain / times.new_point);
        let Times { building, new_point, with_slopes } = times;
        let [parameters, longest, room, quick, quick_slopes, ratio] = ASKED;
        let held = [
            ("parameters", ranges.len() as f64 >= parameters),
            ("building", building <= longest),
            ("memory", megabytes <= room),
            ("a new point", new_point <= quick),
            ("derivatives", with_slopes <= quick_slopes),
            ("full chain ÷ new point", faster >= ratio),
            ("error", most <= ALLOWED[0] && largest <= ALLOWED[1]),
            ("cover of the estimate", covered >= MOST),
            ("estimate ÷ error", loose < LOOSEST),
        ];
        missed.extend(held.into_iter().filter(|(_, held)| !held).map(|(what, _)| format!("{name}: {what}")));
        let _ = writeln!(
            out,
            "| {name} | {} | {temperatures}, {displacements} | {megabytes:.0} | {building:.1} | {chain:.2} | {new_point:.2} | {with_slopes:.1} | {faster:.0} | {half:.1e}, {most:.1e}, {largest:.1e} | {:.1} %, {loose:.1} |",
            ranges.len(),
            100.0 * covered,
        );
        reference.get_or_insert((design, ranges));
    }
    let [parameters, longest, room, quick, quick_slopes, ratio] = ASKED;
    let _ = writeln!(
        out,
        "\n{points} points each. Times are CPU seconds of one thread: building once, the full chain (as `simulate` has it, {} modes a drive, under the same day, \
         without the coarser mesh of its error) the median of {CHAINS}, the others the median of {RUNS} runs at one point, heaters on. Memory is that \
         of the model's numbers. All parameters differ at every point. Asked: at least {parameters} parameters; at most {longest} s, {room} MB, {quick} ms and {quick_slopes} ms; a full chain at least \
         {ratio} times as long; a relative error of at most {:.0e} at 99 % of the points and {:.0e} at any; an estimate that covers at 99 %, its median below \
         {LOOSEST}. Not reached: {}.",
        STANDARD.modes,
        ALLOWED[0],
        ALLOWED[1],
        if missed.is_empty() { "nothing".into() } else { missed.join("; ") }
    );
    // at once: how times grow takes minutes more
    publish("parametric", &out)?;
    if let Some((design, ranges)) = reference {
        out += "\nHow times of the reference design grow, with the power by least squares:\n";
        out += &scaling(&design, &ranges, &progress)?;
    }
    publish("parametric", &out)?;
    Ok(missed.is_empty())
}
