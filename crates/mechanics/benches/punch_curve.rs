//! The force of a bonded punch on incompressible neo-Hookean tissue, to a depth of six radii.
//!
//! Budget: 5 s on one core for the curve on the coarsest mesh, without an estimate of its error, and
//! within 1.5 % at every depth. Before the times it prints the difference to the curve on a mesh with
//! every element halved, from which the error follows: it falls with about the size of the elements.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use palpate_mechanics::contact::FrictionLaw;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_mechanics::NeoHookean;
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, IndentationRun, IndentationSettings, Indenter, IndenterShape, Side,
};
use palpate_mechanics::finite_elements::{FiniteElementWorkspace, LinearSystem, Supports};

/// [Pa]
const C10: f64 = 1000.0;
/// [m]
const RADIUS: f64 = 1e-3;
/// Depths of the curve, in radii: every half to six.
const DEPTHS: i32 = 12;

fn punch(halvings: i32) -> IndentationRun {
    IndentationRun::new(&IndentationSettings {
        block: Block {
            radius: 0.05642,
            height: 0.1,
            base: Base::Bonded,
        },
        indenter: Indenter {
            shape: IndenterShape::Flat {
                side: Side::Touches(FrictionLaw::Bonded),
            },
            radius: RADIUS,
            face: FrictionLaw::Bonded,
        },
        law: Arc::new(NeoHookean::incompressible(C10).unwrap()),
        prony: Default::default(),
        deepest: 6.0 * RADIUS,
        halvings,
    })
    .unwrap()
}

/// F/(C10 a²) [-].
fn curve(halvings: i32) -> Vec<f64> {
    let mut run = punch(halvings);
    (1..=DEPTHS)
        .map(|i| {
            let depth = 0.5 * f64::from(i) * RADIUS;
            run.press(depth, depth, |_| {}).unwrap().force / (C10 * RADIUS * RADIUS)
        })
        .collect()
}

fn report() {
    let start = Instant::now();
    let coarse = curve(0);
    let took = start.elapsed().as_secs_f64();
    let fine = curve(1);
    eprintln!(
        "punch curve: {} unknowns, {took:.2} s of the 5 s",
        punch(0).model().size()
    );
    for (i, (coarse, fine)) in coarse.iter().zip(&fine).enumerate() {
        eprintln!(
            "d/a {:.1}: F/(C10 a²) {coarse:.3}, elements halved {fine:.3} ({:+.2} %)",
            0.5 * (i + 1) as f64,
            100.0 * (coarse / fine - 1.0)
        );
    }
}

fn punch_curve(c: &mut Criterion) {
    report();
    let mut group = c.benchmark_group("punch_curve");
    group.sample_size(10);
    group.bench_function(
        "neo-Hookean punch curve to d/a = 6 on the coarsest mesh",
        |b| b.iter(|| black_box(curve(0))),
    );
    parts(&mut group);
    group.finish();
}

/// What an iteration consists of.
fn parts(group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>) {
    let mut run = punch(0);
    run.press(0.0, 0.1 * RADIUS, |_| {}).unwrap();
    let (model, state) = (run.model(), run.state());
    let nodes = |holds: &dyn Fn(f64, f64) -> bool| model.mesh().nodes_where(|x| holds(x.x, x.y));
    let fixed = |r: f64, z: f64| z == -0.1 || (z == 0.0 && r <= RADIUS * (1.0 + 1e-9));
    let supports = Supports::none(model)
        .fix(model, nodes(&|r, _| r == 0.0), 0, 0.0)
        .fix(model, nodes(&fixed), 0, 0.0)
        .fix(model, nodes(&fixed), 1, 0.0);
    let mut workspace = FiniteElementWorkspace::new(model).unwrap();
    group.bench_function("assembly", |b| {
        b.iter(|| LinearSystem::assemble(model, &supports, state, &mut workspace).is_ok());
    });
    let mut system = LinearSystem::assemble(model, &supports, state, &mut workspace).unwrap();
    group.bench_function("factor", |b| b.iter(|| system.factor().is_ok()));
    let mut right = vec![0.0; model.size()];
    group.bench_function("solve", |b| {
        b.iter(|| {
            right.fill(1.0);
            system.solve(black_box(&mut right)).is_ok()
        });
    });
}

criterion_group!(benches, punch_curve);
criterion_main!(benches);
