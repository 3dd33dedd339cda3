//! Time to homogenise the reference cell.

#![allow(missing_docs, reason = "criterion_group! generates undocumented functions")]

#[path = "../tests/common/mod.rs"]
mod common;

use criterion::{Criterion, criterion_group, criterion_main};
use homogenization::{Discretization, Extent, effective, homogenize, multipoles};
use std::hint::black_box;

fn reference_cell(criterion: &mut Criterion) {
    let cell = common::reference();
    let quarter = Discretization::standard(&cell);
    let whole = Discretization { extent: Extent::Whole, ..quarter.clone() };
    criterion.bench_function("multipoles up to order 41", |b| b.iter(|| multipoles(black_box(&cell), 41)));
    criterion.bench_function("homogenize, 1e-6 with errors", |b| b.iter(|| homogenize(black_box(&cell))));
    criterion.bench_function("quarter cell, order 6", |b| b.iter(|| effective(black_box(&cell), &quarter)));
    criterion.bench_function("whole cell, order 6", |b| b.iter(|| effective(black_box(&cell), &whole)));
}

criterion_group!(benches, reference_cell);
criterion_main!(benches);
