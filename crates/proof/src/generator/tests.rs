//! The generator against the program's own chain, against finer versions of itself, and its noise against what was drawn.

use super::SOURCES;
use super::build::Build;
use super::chamber::{Course, ProgrammeFamily, STEP};
use super::effect::{self, Effect};
use super::heat::{Heat, VECTORS};
use super::matched::Whitening;
use super::noise::{Noise, SPAN, Unseen};
use super::outside::{Outside, SHAPES};
use super::plant::Plant;
use super::random::Random;
use super::record::{Signal, at, signal};
use super::unit::{Generator, Which};
use crate::truth::Truth;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, Drive, Dynamics, FINE, Fidelity, Profile, STANDARD};
use std::sync::{Arc, LazyLock};

static DESIGN: LazyLock<Design> = LazyLock::new(|| {
    let file = [env!("CARGO_MANIFEST_DIR"), "..", "..", "fixtures", "coil-reference.ron"].iter().collect::<std::path::PathBuf>();
    fogcoil::input::read_coil(&file).unwrap().design
});
static GENERATOR: LazyLock<Generator> = LazyLock::new(|| Generator::new(DESIGN.clone()).unwrap());

/// Items taken from `coil`: designs, and the models assembled from them; no reduced models, integrators or profiles.
const OF_COIL: &str = "Body Bonds Design Drive Error Heater MechanicalState Mechanics MeshFineness Model Mount Opening Outputs Side \
                       ThermalModel functionals";

#[test]
fn no_law_is_shared_with_what_diagnoses() {
    let sources = SOURCES.iter().filter(|(file, _)| file.ends_with(".rs"));
    for (file, source) in sources {
        for root in ["mechanisms", "diagnosis", "recording", "fogcoil", "homogenization", "files", "charts"] {
            assert!(!source.contains(&format!("{root}::")), "{file} names {root}");
        }
        let paths = |root: &'static str| source.split(root).skip(1).map(|rest| rest.split(';').next().unwrap());
        for path in paths("crate::") {
            assert!(path.starts_with("truth") || path.starts_with("Failure"), "{file} names crate::{path}");
        }
        for path in paths("coil::") {
            let names = path.split(|c: char| !c.is_alphanumeric()).filter(|name| !name.is_empty());
            for name in names {
                assert!(OF_COIL.split(' ').any(|of_coil| of_coil == name), "{file} takes {name} of coil");
            }
        }
    }
    // every file of the folder is looked at
    let folder = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/src/generator")).unwrap();
    let mut files: Vec<String> = folder.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    files.retain(|name| name != "mod.rs" && name != "tests.rs");
    files.sort();
    assert_eq!(files, SOURCES[..SOURCES.len() - 1].iter().map(|(file, _)| *file).collect::<Vec<_>>());
}

fn peak(series: &[f64]) -> f64 {
    series.iter().map(|x| (x - series[0]).abs()).fold(0.0, f64::max)
}

fn largest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn even(course: &Course) -> Vec<f64> {
    (0..=((course.temperature.len() - 1) as f64 * STEP / SPAN) as usize).map(|n| n as f64 * SPAN).collect()
}

fn run(plant: &Plant, course: &Course) -> Signal {
    signal(&plant.run(&course.temperature), &even(course), 0.0)
}

/// The same course through `coil`'s chain.
fn chain(design: &Design, course: &Course, fidelity: &Fidelity) -> Signal {
    let time: Vec<f64> = (0..course.temperature.len()).map(|n| n as f64 * STEP).collect();
    let heated = !design.heat.heaters.is_empty();
    let courses = [course.temperature.clone(), vec![1.0; time.len()]];
    let (drives, courses) = ([Drive::Chamber, Drive::Heaters], courses[..1 + usize::from(heated)].to_vec());
    let dynamics = Dynamics::new(design, &drives[..courses.len()], fidelity).unwrap();
    let responses = dynamics.simulate(&Profile { time, drives: courses }).unwrap();
    let parts = (SPAN / STEP) as usize;
    let rate =
        |row: &[coil::Response]| row.iter().map(coil::Response::rate).sum::<f64>() / parts as f64 * DEG_PER_H_PER_RAD_PER_S;
    let rates = std::iter::once(0.0).chain(responses[1..].chunks_exact(parts).map(rate));
    Signal { rate: rates.collect(), spool: responses.iter().step_by(parts).map(|r| r.sensor).collect() }
}

fn course(family: ProgrammeFamily) -> Course {
    Course::draw(family, &mut Random::new(7, 7))
}

#[test]
fn a_nominal_unit_agrees_with_the_chain_within_what_no_mesh_resolves() {
    a_nominal_unit_agrees(&ProgrammeFamily::ALL[2..3]);
}

#[test]
#[ignore = "a minute"]
fn a_nominal_unit_agrees_with_the_chain_in_every_programme() {
    a_nominal_unit_agrees(&ProgrammeFamily::ALL);
}

fn a_nominal_unit_agrees(families: &[ProgrammeFamily]) {
    for (n, &family) in families.iter().enumerate() {
        let course = course(family);
        let chain = chain(&DESIGN, &course, &STANDARD);
        let exact = run(&Plant::new(Build::new(DESIGN.clone()), None).unwrap(), &course);
        let specimen = run(&Plant::new(GENERATOR.specimen(&mut Random::new(3, n as u64)), None).unwrap(), &course);
        for (unit, name) in [(exact, "design"), (specimen, "specimen")] {
            let rate = largest(&unit.rate, &chain.rate) / peak(&chain.rate);
            let spool = largest(&unit.spool, &chain.spool) / peak(&chain.spool);
            println!("{family:?} {name}: rate {rate:.2e}, spool {spool:.2e} of the peak");
            assert!(rate < 3e-3 && spool < 3e-3, "{family:?}, {name}: rate {rate}, spool {spool}");
        }
    }
}

#[test]
fn twice_the_vectors_change_nothing() {
    let course = course(ProgrammeFamily::P3);
    let of = |vectors: usize| {
        let heat = Heat::new(&DESIGN, vectors).unwrap();
        run(&Plant::on(Arc::new(heat), Build::new(DESIGN.clone())).unwrap(), &course)
    };
    let (few, many) = (of(VECTORS), of(2 * VECTORS));
    let (rate, spool) = (largest(&few.rate, &many.rate) / peak(&many.rate), largest(&few.spool, &many.spool) / peak(&many.spool));
    assert!(rate < 2e-5 && spool < 2e-5, "{rate:e} {spool:e}");
}

/// The unit with an effect through `coil`'s own chain, where that holds it.
fn chained(effect: Effect, course: &Course, fidelity: &Fidelity) -> Signal {
    let mut build = Build::new(DESIGN.clone());
    effect.build_into(&mut build);
    let mut design = build.design;
    design.sensor.lag = build.lag;
    design.drifts.thermo_optic_curvature = build.curvature;
    design.drifts.read_out = build.read_out / DEG_PER_H_PER_RAD_PER_S;
    if let Some((fraction, time)) = build.relaxing {
        design.mechanics = coil::Mechanics::Relaxing { fraction, time };
    }
    if let Some(step) = build.softening {
        let row = |k: i32| {
            let x = f64::from(k) / 5.0;
            let share = 1.0 / (1.0 + (-x).exp());
            coil::FactorsAt {
                temperature: step.at + step.width * x,
                transverse_modulus: 1.0 + (step.modulus - 1.0) * share,
                transverse_expansion: 1.0 + (step.expansion - 1.0) * share,
            }
        };
        design.mechanics = coil::Mechanics::TemperatureTable((-50..=50).map(row).collect());
    }
    chain(&design, course, fidelity)
}

#[test]
fn heat_and_bonds_agree_with_the_chain() {
    agree_with_the_chain(&[effect::EffectFamily::HubResistance, effect::EffectFamily::Debond]);
}

#[test]
#[ignore = "minutes"]
fn every_family_agrees_with_the_chain() {
    agree_with_the_chain(&effect::EffectFamily::ALL);
}

/// Effects beside the chain of the program, which has its own laws for them: their largest difference, relative to what the effect changes.
fn agree_with_the_chain(families: &[effect::EffectFamily]) {
    let course = course(ProgrammeFamily::P5);
    let nominal = Plant::new(Build::new(DESIGN.clone()), None).unwrap();
    let base = run(&nominal, &course);
    let standard = chain(&DESIGN, &course, &STANDARD);
    // in the contact's skin the standard mesh is a hundredth of the effect off, the fine one 3e-5
    let fine_mesh = Fidelity { resolution: FINE, ..STANDARD };
    let fine = chain(&DESIGN, &course, &fine_mesh);
    let mut random = Random::new(11, 0);
    for &family in families {
        let effect = Effect::draw(family, &mut random);
        let effect = effect.scaled(3.0).unwrap_or(effect);
        let mut build = Build::new(DESIGN.clone());
        effect.build_into(&mut build);
        let rest = build.read_out * (course.temperature[0] - 20.0);
        let plant = Plant::new(build, Some(&nominal)).unwrap();
        let ours = signal(&plant.run(&course.temperature), &even(&course), rest);
        let in_skin = family == effect::EffectFamily::HubResistance;
        // a bond that can open is meshed more finely: without effect it is one that stays closed
        let closed = match effect {
            Effect::Debond { hysteresis, fraction, .. } => {
                Some(chained(Effect::Debond { below: -150.0, hysteresis, fraction }, &course, &STANDARD))
            }
            _ => None,
        };
        let (fidelity, base_chain) =
            if in_skin { (&fine_mesh, &fine) } else { (&STANDARD, closed.as_ref().unwrap_or(&standard)) };
        let theirs = chained(effect, &course, fidelity);
        let change = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>();
        let pairs = [
            (change(&ours.rate, &base.rate), change(&theirs.rate, &base_chain.rate)),
            (change(&ours.spool, &base.spool), change(&theirs.spool, &base_chain.spool)),
        ];
        let off = pairs.map(|(ours, theirs)| {
            // the first row of the chain is no reading
            let size = theirs[1..].iter().map(|x| x.abs()).fold(0.0, f64::max);
            let rms = |x: &[f64]| (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt();
            if size < 1e-6 {
                largest(&ours[1..], &theirs[1..])
            } else {
                rms(&change(&ours[1..], &theirs[1..])) / rms(&theirs[1..])
            }
        });
        println!("{family:?}: rate {:.1e}, spool {:.1e}", off[0], off[1]);
        let most = if family == effect::EffectFamily::Debond { 0.05 } else { 0.01 };
        assert!(off[0] < most && off[1] < 0.01, "{effect:?}: {off:?}");
    }
}

#[test]
fn an_effect_of_no_size_is_no_effect() {
    let course = course(ProgrammeFamily::P2);
    let nominal = Plant::new(Build::new(DESIGN.clone()), None).unwrap();
    let base = run(&nominal, &course);
    let mut random = Random::new(5, 0);
    for family in effect::EffectFamily::ALL {
        // turns are whole, and the size of an opening is no matter of degree
        let effect = match Effect::draw(family, &mut random).scaled(1e-6) {
            Some(effect) if family != effect::EffectFamily::Defect => effect,
            _ => continue,
        };
        let mut build = Build::new(DESIGN.clone());
        effect.build_into(&mut build);
        let unit = run(&Plant::new(build, Some(&nominal)).unwrap(), &course);
        let (rate, spool) = (largest(&unit.rate, &base.rate), largest(&unit.spool, &base.spool));
        assert!(rate < 1e-5 && spool < 1e-4, "{effect:?}: {rate:e} deg/h, {spool:e} K");
    }
}

fn noises() -> Vec<Noise> {
    let plain = Noise { arw: 0.0008, drift: (0.003, 6000.0), walk: 0.0, offset: 0.0, unseen: None };
    let unseen = [
        Unseen::SecondDrift(0.002, 400.0),
        Unseen::Telegraph(0.002, 5000.0),
        Unseen::Flicker(0.001),
        Unseen::Daily(0.002, 8e4, 0.3),
        Unseen::HeavyTails(5),
        Unseen::Breathing(0.5, 2e4, 1.0),
    ];
    let walking = Noise { walk: 0.001, ..plain.clone() };
    let with = |unseen| Noise { unseen: Some(unseen), ..plain.clone() };
    [plain.clone(), walking].into_iter().chain(unseen.map(with)).collect()
}

/// Innovations of the true noise are white and of unit variance, whatever the family.
#[test]
fn a_null_s_whitened_noise_is_white() {
    let time: Vec<f64> = (0..2000).map(|n| f64::from(n) * SPAN).collect();
    for (k, noise) in noises().into_iter().enumerate() {
        let whitening = Whitening::new(&noise, &time);
        let (mut squares, mut products, mut count) = (0.0, [0.0; 3], 0.0);
        for stream in 0..20 {
            let mut random = Random::new(17 + k as u64, stream);
            // a daily sine is of random phase to the filter
            let since = random.uniform(0.0, 8e4);
            let white = whitening.apply(&noise.sample(&time, since, &mut random));
            squares += white.iter().map(|w| w * w).sum::<f64>();
            for (lag, product) in [1, 10, 100].into_iter().zip(&mut products) {
                *product += white.iter().zip(&white[lag..]).map(|(a, b)| a * b).sum::<f64>();
            }
            count += white.len() as f64;
        }
        // 40 000 rows: a standard deviation of 0.007 in the variance of normal noise, of 0.005 in a correlation
        let (variance, correlations) = (squares / count, products.map(|p| p / squares));
        let most = if matches!(noise.unseen, Some(Unseen::HeavyTails(_))) { 0.06 } else { 0.03 };
        assert!((variance - 1.0).abs() < most, "{:?}: variance {variance}", noise.unseen);
        assert!(correlations.iter().all(|c| c.abs() < 0.02), "{:?}: {correlations:?}", noise.unseen);
    }
}

/// The whitened length is that by the covariance matrix, written down from the autocorrelations.
#[test]
fn exact_the_matched_filter_is_that_of_the_covariance() {
    use nalgebra::{DMatrix, DVector};
    let time: Vec<f64> = (0..40).map(|n| f64::from(n * 30 + n * n)).collect();
    let mut random = Random::new(1, 2);
    let signal: Vec<f64> = time.iter().map(|t| (t / 300.0).sin() + 0.3 * random.normal()).collect();
    for noise in noises() {
        let covariance = DMatrix::from_fn(time.len(), time.len(), |i, j| {
            let (dt, earlier) = ((time[i] - time[j]).abs(), time[i].min(time[j]));
            let markov = |size: f64, tau: f64| size * size * (-dt / tau).exp();
            let unseen = match noise.unseen {
                Some(Unseen::SecondDrift(size, tau)) => markov(size, tau),
                Some(Unseen::Telegraph(size, dwell)) => size * size * (-2.0 * dt / dwell).exp(),
                Some(Unseen::Flicker(size)) => (0..6).map(|k| markov(size, 60.0 * 4.0_f64.powi(k))).sum(),
                Some(Unseen::Daily(size, period, _)) => size * size / 2.0 * (std::f64::consts::TAU * dt / period).cos(),
                Some(Unseen::HeavyTails(_) | Unseen::Breathing(..)) | None => 0.0,
            };
            let white = if i == j { noise.white(time[i]).powi(2) } else { 0.0 };
            white + markov(noise.drift.0, noise.drift.1) + noise.walk.powi(2) * earlier / 3600.0 + unseen
        });
        let s = DVector::from_vec(signal.clone());
        let exact = s.dot(&covariance.cholesky().unwrap().solve(&s));
        let whitened: f64 = Whitening::new(&noise, &time).apply(&signal).iter().map(|w| w * w).sum();
        assert!((whitened / exact - 1.0).abs() < 1e-8, "{:?}: {whitened} {exact}", noise.unseen);
    }
}

#[test]
fn a_unit_is_the_same_for_one_seed_and_reads_as_it_was_written() {
    let make = |seed, n| GENERATOR.unit(seed, Which::Concealed(n)).unwrap_or_else(|e| panic!("{}", e.0));
    let (first, again, other) = (make(1, 0), make(1, 0), make(2, 0));
    assert_eq!(first, again);
    assert_ne!(first.fit, other.fit);
    let truth: Truth = ron::from_str(&first.truth).unwrap();
    assert_eq!(truth.mechanisms[0].id, "tail-asymmetry");
    assert!((3.0 / 1.2..=200.0 * 1.2).contains(&truth.snr[0].snr), "{:?}", truth.snr);
    let rows: Vec<Vec<f64>> = first.fit.lines().skip(1).map(|l| l.split(',').map(|v| v.parse().unwrap()).collect()).collect();
    assert!(rows.len() > 1200 && rows.iter().all(|row| row.len() == 4) && rows.windows(2).all(|w| w[1][0] > w[0][0]));
    // recorded is what was computed but for noise of some thousandths, and an offset
    let rms = |x: &[f64]| (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt();
    let rate: Vec<f64> = rows.iter().map(|row| row[3] - truth.noise.offset_deg_per_h).collect();
    assert!((rms(&rate) / truth.noise_free_rms_deg_per_h.fit_true - 1.0).abs() < 0.05);
}

#[test]
fn programmes_are_as_described() {
    for family in ProgrammeFamily::ALL {
        for stream in 0..6 {
            let course = Course::draw(family, &mut Random::new(23, stream));
            let hours = (course.temperature.len() - 1) as f64 * STEP / 3600.0;
            assert!((10.0..27.0).contains(&hours), "{family:?}: {hours} h");
            let rest = &course.temperature[..(20.0 * 60.0 / STEP) as usize];
            assert!(peak(rest) < 0.2, "{family:?} does not rest: {}", peak(rest));
            let [low, high] = [f64::min, f64::max].map(|of| course.temperature.iter().copied().fold(course.temperature[0], of));
            assert!(low > -43.0 && high < 63.0 && high - low > 70.0, "{family:?}: {low} {high}");
        }
    }
}

#[test]
fn exact_a_cubic_is_read_between_its_points() {
    let cubic = |t: f64| 1.0 + 0.1 * t - 0.02 * t * t + 0.001 * t.powi(3);
    let course: Vec<f64> = (0..20).map(|n| cubic(f64::from(n) * STEP)).collect();
    for t in [0.0, 1.3, 7.9, 50.0, 94.9, 95.0] {
        assert!((at(&course, t) - cubic(t)).abs() < 1e-9);
    }
}

#[test]
fn effects_outside_the_library_have_their_sizes() {
    let course = course(ProgrammeFamily::P1);
    let plant = Plant::new(Build::new(DESIGN.clone()), None).unwrap();
    let base = run(&plant, &course);
    for kind in 0..SHAPES {
        let outside = Outside { size: 0.01, ..Outside::draw(kind, &mut Random::new(29, kind as u64)) };
        let mut with = plant.run(&course.temperature);
        outside.act(&course.temperature, &mut with);
        let with = signal(&with, &even(&course), 0.0);
        let most = largest(&with.rate[2..], &base.rate[2..]);
        assert!((0.0001..0.025).contains(&most), "{outside:?}: {most}");
    }
}
