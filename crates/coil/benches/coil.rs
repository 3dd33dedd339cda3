//! Time of the coil's mechanics: a model for any temperature, and the steady-ramp sensitivity.
#![allow(missing_docs)]

#[path = "../tests/common/mod.rs"]
mod common;

use coil::{COARSE, Model, steady_sensitivity};
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

criterion_group!(benches, sensitivity);
criterion_main!(benches);
