//! Time to wind the reference coil of 3798 turns.

#![allow(missing_docs, reason = "criterion_group! generates undocumented functions")]

#[path = "../tests/common/mod.rs"]
mod common;

use common::REFERENCE;
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use winding::wind;

fn reference_coil(criterion: &mut Criterion) {
    criterion.bench_function("wind the reference coil", |bencher| bencher.iter(|| wind(black_box(&REFERENCE))));
}

criterion_group!(benches, reference_coil);
criterion_main!(benches);
