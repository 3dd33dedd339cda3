//! Time of the coil's mechanics: a model for any temperature, and the steady-ramp sensitivity.
#![allow(missing_docs)]

#[path = "../tests/common/mod.rs"]
mod common;

use coil::{COARSE, Model, ModelEffort, Parameter, ParametricModel, Range, steady_sensitivity};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn sensitivity(c: &mut Criterion) {
    let design = common::reference();
    let mut group = c.benchmark_group("reference coil");
    group.sample_size(10);
    group.bench_function("model and adjoint", |b| {
        b.iter(|| Model::new(black_box(&design), &COARSE).expect("model").sensitivity().expect("solve"));
    });
    group.bench_function("sensitivity with its error estimate", |b| {
        b.iter(|| steady_sensitivity(black_box(&design)).expect("solve"));
    });
    group.finish();
}

/// One step after another from a changed design to its bias under a day at 30 s, and to the derivatives.
fn parametric(c: &mut Criterion) {
    let design = common::reference();
    let model = ParametricModel::new(&design, &Range::usual(&design), &COARSE, &ModelEffort::default(), &|| ()).expect("model");
    let free: Vec<Parameter> = model.ranges().iter().map(|range| range.parameter).collect();
    let changed = model.ranges().iter().fold(design, |design, range| range.parameter.set(&design, range.at(0.6)));
    let time: Vec<f64> = (0..=2880).map(|k| 30.0 * f64::from(k)).collect();
    let drives = vec![time.iter().map(|t| 20.0 + 30.0 * (t / 9000.0).sin()).collect::<Vec<f64>>()];
    let (reduced, slopes) = (model.at(&changed).expect("inside"), model.slopes(&changed, &free).expect("inside"));
    let mut group = c.benchmark_group("parametric model");
    group.bench_function("heat flow of a changed design", |b| {
        b.iter(|| model.in_states(black_box(&changed), &[]).expect("inside"))
    });
    group.bench_function("heat flow and mechanics of a changed design", |b| {
        b.iter(|| model.at(black_box(&changed)).expect("inside"));
    });
    group.bench_function("a day at 30 s", |b| {
        b.iter(|| reduced.run(black_box(&time), &drives, &[20.0]));
    });
    group.sample_size(20);
    group.bench_function("derivatives of a changed design", |b| {
        b.iter(|| model.slopes(black_box(&changed), &free).expect("inside"))
    });
    group.bench_function("a day at 30 s with derivatives", |b| b.iter(|| slopes.run(black_box(&time), &drives, &[20.0])));
    group.finish();
}

criterion_group!(benches, sensitivity, parametric);
criterion_main!(benches);
