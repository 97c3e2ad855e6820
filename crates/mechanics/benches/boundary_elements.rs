//! Boundary elements on the kidney: what is done beforehand, and what is done on line.
//!
//! Budgets on two cores, 5,146 triangles: assembly 6 s; the whole of it 90 s for 500 touchable triangles
//! and 240 s for all; on line, twelve triangles: the force 20 µs, the field 60 µs, beside reading the same
//! memory once. The large mesh is solved when PALPATE_FULL is set; else one of 688 triangles.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_geometry::{Organ, Surface, TriangleId};
use palpate_mechanics::Vec3;
use palpate_mechanics::boundary_elements::{BoundaryProblem, Stage};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::surface_response::{
    MovedTriangle, PatchContact, PatchWorkspace, Reciprocity, SurfaceResponse, TipField, TouchId,
};

/// Triangles of a contact.
const TOUCHED: u32 = 12;

fn triangles() -> usize {
    if std::env::var_os("PALPATE_FULL").is_some() {
        5146
    } else {
        688
    }
}

/// The kidney, what holds it, and the rest.
fn kidney(triangles: usize) -> (Surface, Vec<TriangleId>, Vec<TriangleId>) {
    let surface = Surface::new(Organ::Kidney.surface_mesh(triangles).unwrap()).unwrap();
    let mesh = surface.mesh();
    let (fixed, free) = mesh.triangle_ids().partition(|&triangle| {
        let [a, b, c] = mesh.positions(triangle);
        let centroid = (a + b + c) / 3.0;
        Organ::Kidney
            .anchor()
            .iter()
            .any(|plane| plane.contains(&centroid))
    });
    (surface, fixed, free)
}

/// Solves for `touchable` and prints the times.
fn response(surface: &Surface, fixed: &[TriangleId], touchable: &[TriangleId]) -> SurfaceResponse {
    let problem = BoundaryProblem {
        surface,
        poissons_ratio: 0.45,
        fixed,
        touchable,
    };
    let start = Instant::now();
    let mut ends = [0.0; 3];
    let solved = problem.solve(usize::MAX, &mut |progress| {
        let stage = match progress.stage {
            Stage::Assembly => 0,
            Stage::Factors => 1,
            Stage::Columns => 2,
        };
        ends[stage] = start.elapsed().as_secs_f64();
        ControlFlow::Continue(())
    });
    let unknowns = 3.0 * surface.mesh().triangles().len() as f64;
    let operations = [
        2.0 / 3.0 * unknowns.powi(3),
        6.0 * unknowns.powi(2) * touchable.len() as f64,
    ];
    let rates = [0, 1].map(|k| 1e-9 * operations[k] / (ends[k + 1] - ends[k]));
    eprintln!(
        "{} triangles, {} touchable: assembly {:.2} s, factors {:.2} s ({:.0} Gflop/s), columns {:.2} s \
         ({:.0} Gflop/s), {:.2} s in all, {:.2} GB at most",
        surface.mesh().triangles().len(),
        touchable.len(),
        ends[0],
        ends[1] - ends[0],
        rates[0],
        ends[2] - ends[1],
        rates[1],
        ends[2],
        1e-9 * problem.memory::<f32>().most as f64
    );
    solved.unwrap()
}

fn boundary_elements(c: &mut Criterion) {
    let (surface, fixed, free) = kidney(triangles());
    let some = &free[..500.min(free.len())];
    drop(response(&surface, &fixed, &free));
    let response = response(&surface, &fixed, some);
    let mut group = c.benchmark_group("boundary_elements");
    group.sample_size(50);
    on_line(&mut group, &response);
    tips(&mut group, &response, &surface, some);
    group.finish();
}

fn on_line(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    response: &SurfaceResponse,
) {
    let displacement = Vec3::new(1e-4, 2e-4, -1e-3);
    let moved: Vec<_> = (0..TOUCHED)
        .map(|k| MovedTriangle {
            triangle: TouchId(17 * k),
            displacement,
        })
        .collect();
    let mut workspace = PatchWorkspace::new(TOUCHED as usize);
    for (name, friction) in [
        ("stick", Friction::Bonded),
        ("slip", Friction::Frictionless),
    ] {
        let contact = PatchContact {
            friction,
            reciprocity: Reciprocity::Imposed,
            youngs_modulus: 1e4,
        };
        group.bench_function(format!("force of 12 triangles that {name}"), |b| {
            b.iter(|| {
                response
                    .press(black_box(&moved), &contact, &mut workspace)
                    .unwrap()[0]
            });
        });
    }
    let mut field = vec![0.0_f32; 3 * response.parts().triangles];
    group.bench_function("field of 12 triangles", |b| {
        b.iter(|| {
            field.fill(0.0);
            let forces = moved.iter().map(|touched| (touched.triangle, displacement));
            response.add_fields(black_box(forces), &mut field);
        });
    });
    let rows = 3 * response.parts().triangles;
    group.bench_function("reading the memory of that field", |b| {
        b.iter(|| {
            let columns = moved.iter().map(|touched| {
                let start = 3 * rows * touched.triangle.index();
                let bits = response.parts().displacements[start..start + 3 * rows].iter();
                bits.fold(0_u32, |all, value| all ^ value.to_bits())
            });
            black_box(columns.fold(0, |all, bits| all ^ bits))
        });
    });
}

/// Two tips of 2 mm.
fn tips(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    response: &SurfaceResponse,
    surface: &Surface,
    touchable: &[TriangleId],
) {
    let start = Instant::now();
    let field = TipField::new(response, surface, 2e-3).unwrap();
    eprintln!("a tip made ready: {:.2} s", start.elapsed().as_secs_f64());
    let places = [touchable[3], touchable[touchable.len() / 2]];
    let loads = || places.map(|id| field.at(surface, id, &[0.2, 0.3, 0.5]));
    group.bench_function("what the organ adds to a tip", |b| {
        b.iter(|| loads()[0].structural_compliance());
    });
    group.bench_function("compliance between two tips", |b| {
        b.iter(|| {
            let [one, other] = loads();
            response.between(&one, &other)
        });
    });
}

criterion_group!(benches, boundary_elements);
criterion_main!(benches);
