//! The generator against the program's own chain, against finer versions of itself, and its noise against what was drawn.

use super::chamber::{Course, Family, STEP};
use super::effect::{self, Effect};
use super::heat::{Heat, VECTORS};
use super::matched::Whitening;
use super::noise::{Noise, SPAN, Unseen};
use super::outside::{Outside, SHAPES};
use super::plant::{Build, Plant};
use super::random::Random;
use super::record::{Signal, at, signal};
use super::unit::{Generator, Which};
use crate::prove::truth::Truth;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, Drive, Dynamics, Profile, STANDARD};
use std::sync::{Arc, LazyLock};

static DESIGN: LazyLock<Design> = LazyLock::new(|| {
    let file = [env!("CARGO_MANIFEST_DIR"), "..", "fixtures", "coil-reference.ron"].iter().collect::<std::path::PathBuf>();
    fogcoil::input::read_coil(&file).unwrap().design
});
static GENERATOR: LazyLock<Generator> = LazyLock::new(|| Generator::new(DESIGN.clone()).unwrap());

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
fn chain(design: &Design, course: &Course) -> Signal {
    let time: Vec<f64> = (0..course.temperature.len()).map(|n| n as f64 * STEP).collect();
    let dynamics = Dynamics::new(design, &[Drive::Chamber], &STANDARD).unwrap();
    let responses = dynamics.simulate(&Profile { time, drives: vec![course.temperature.clone()] }).unwrap();
    let parts = (SPAN / STEP) as usize;
    let rate = |row: &[coil::Response]| row.iter().map(coil::Response::rate).sum::<f64>() / parts as f64 * DEG_PER_H_PER_RAD_PER_S;
    let rates = std::iter::once(0.0).chain(responses[1..].chunks_exact(parts).map(rate));
    Signal { rate: rates.collect(), spool: responses.iter().step_by(parts).map(|r| r.sensor).collect() }
}

fn course(family: Family) -> Course {
    Course::draw(family, &mut Random::new(7, 7))
}

#[test]
fn a_nominal_unit_agrees_with_the_chain_within_what_no_mesh_resolves() {
    for (n, family) in Family::ALL.into_iter().enumerate() {
        let course = course(family);
        let chain = chain(&DESIGN, &course);
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
    let course = course(Family::P3);
    let of = |vectors: usize| {
        let heat = Heat::new(&DESIGN, vectors).unwrap();
        run(&Plant::on(Arc::new(heat), Build::new(DESIGN.clone())).unwrap(), &course)
    };
    let (few, many) = (of(VECTORS), of(2 * VECTORS));
    let (rate, spool) = (largest(&few.rate, &many.rate) / peak(&many.rate), largest(&few.spool, &many.spool) / peak(&many.spool));
    assert!(rate < 2e-5 && spool < 2e-5, "{rate:e} {spool:e}");
}
