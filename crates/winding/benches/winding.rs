//! Time to wind the reference coil of 3798 turns.

#![allow(missing_docs, reason = "criterion_group! generates undocumented functions")]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength, wind};

const REFERENCE: Spec = Spec {
    pattern: Pattern::PracticalQuadrupole,
    layers: 36,
    turns_odd_layers: 106,
    turns_even_layers: 105,
    inner_radius: 43.5e-3,
    pitch: 0.170e-3,
    cw_climbs: ClimbSide::Right,
    turn_length: TurnLength::True,
    tails: Tails { cw: 0.0, ccw: 0.0 },
};

fn reference_coil(criterion: &mut Criterion) {
    criterion.bench_function("wind the reference coil", |bencher| bencher.iter(|| wind(black_box(&REFERENCE))));
}

criterion_group!(benches, reference_coil);
criterion_main!(benches);
