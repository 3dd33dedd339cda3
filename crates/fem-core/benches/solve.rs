//! Time to assemble, to condense, to factorise and to solve a thermo-elastic ring of some 7 000 unknowns.

#![allow(missing_docs, reason = "criterion_group! generates undocumented functions")]

#[path = "../tests/common/mod.rs"]
mod common;

use criterion::{Criterion, criterion_group, criterion_main};
use fem_core::{Constraints, Factor, Form, Problem, SymbolicFactor};
use std::hint::black_box;

fn ring(criterion: &mut Criterion) {
    let form = Form::AXISYMMETRIC_ELASTICITY;
    let mesh = common::mapped(6, [10, 10], |[x, y]| [43.5e-3 + 5.325e-3 * x, 18.02e-3 * y], |_| 0);
    let problem = Problem::new(&mesh, form, 7);
    let mut constraints = Constraints::new(2 * mesh.nodes().len());
    constraints.hold(1).expect("an unknown");
    let map = constraints.eliminate(&problem.used(|_| true));
    let laws = [Some(common::stiffness(form, &common::coil()))];
    let matrix = problem.stiffness(&map, &laws).expect("a stiffness");
    let symbolic = SymbolicFactor::new(&matrix).expect("an ordering");
    let factor = Factor::new(matrix.clone()).expect("positive definite");
    let load = vec![vec![1.0; factor.unknowns()]];
    let name = |what: &str| format!("{what} {} unknowns", matrix.rows());
    criterion.bench_function(&name("assemble"), |b| b.iter(|| problem.stiffness(black_box(&map), &laws)));
    criterion.bench_function(&name("condense, factorise and check"), |b| b.iter(|| problem.condense(black_box(&map), &laws)));
    criterion.bench_function(&name("order"), |b| b.iter(|| SymbolicFactor::new(black_box(&matrix))));
    criterion.bench_function(&name("factorise and check"), |b| b.iter(|| symbolic.factor(black_box(&matrix).clone())));
    criterion.bench_function(&name("solve one load"), |b| b.iter(|| factor.solve(black_box(&load))));
}

criterion_group!(benches, ring);
criterion_main!(benches);
