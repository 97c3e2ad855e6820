//! Finite elements condensed to the surface of the built-in esophagus, whose wall is thin, and the dimple of a tip.
//!
//! Budgets on two cores: the whole of it 240 s, as boundary elements of 5,146 triangles, for 4,000 triangles all of
//! which can be touched (PALPATE_FULL; else 800 of which a hundred can); on line, a tip's field with its dimple 60 µs,
//! as the field of twelve triangles.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use std::ops::ControlFlow;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_geometry::{Organ, Surface, TriangleId};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Tip;
use palpate_mechanics::finite_elements::condensed::CondensedProblem;
use palpate_mechanics::surface_response::{PressedTip, SurfaceResponse, TipField};

/// The wall of the esophagus is 2.5 mm, and edges are seven tenths of it.
const EDGE: f64 = 0.7 * 2.5e-3;

fn condensed_elements(criterion: &mut Criterion) {
    let (triangles, touched) = match std::env::var_os("PALPATE_FULL") {
        Some(_) => (4000, usize::MAX),
        None => (800, 100),
    };
    let surface = Surface::new(Organ::Esophagus.surface_mesh(triangles).unwrap()).unwrap();
    let mesh = surface.mesh();
    let is_held = |triangle: &TriangleId| {
        let [a, b, c] = mesh.positions(*triangle);
        let anchor = Organ::Esophagus.anchor();
        anchor
            .iter()
            .any(|plane| plane.contains(&((a + b + c) / 3.0)))
    };
    let (held, free): (Vec<_>, Vec<_>) = mesh.triangle_ids().partition(is_held);
    let touchable = &free[..touched.min(free.len())];
    let problem = CondensedProblem {
        surface: &surface,
        poissons_ratio: 0.45,
        fixed: &held,
        touchable,
        edge: EDGE,
        regions: None,
    };
    let start = Instant::now();
    let go_on = &mut |_| ControlFlow::Continue(());
    let response: SurfaceResponse = problem.solve(usize::MAX, go_on).unwrap();
    eprintln!(
        "{} triangles, {} touchable: {:.1} s, {:.2} GB at most",
        mesh.triangles().len(),
        touchable.len(),
        start.elapsed().as_secs_f64(),
        1e-9 * problem.memory::<f32>().most as f64
    );
    on_line(
        criterion,
        &surface,
        &response,
        touchable[touchable.len() / 2],
    );
}

/// A tip of 1.5 mm.
fn on_line(
    criterion: &mut Criterion,
    surface: &Surface,
    response: &SurfaceResponse,
    triangle: TriangleId,
) {
    let radius = 1.5e-3;
    let tips = TipField::new(response, surface, radius).unwrap();
    let load = tips.at(surface, triangle, &[0.2, 0.3, 0.5]);
    let corners = surface.mesh().positions(triangle);
    let tip = PressedTip {
        tip: Tip::Flat { radius },
        radius,
        place: corners.iter().sum::<Vec3>() / 3.0,
        normal: (corners[1] - corners[0])
            .cross(&(corners[2] - corners[0]))
            .normalize(),
        own: Vec3::new(0.0, 0.0, -1e-3),
        force: Vec3::new(0.0, 0.0, -1e-6),
    };
    let mut field = vec![0.0_f32; 3 * response.parts().triangles];
    let mut group = criterion.benchmark_group("condensed_elements");
    group.bench_function("field of a tip", |b| {
        b.iter(|| {
            field.fill(0.0);
            response.add_field_of_tip(&load, &tip.force, &mut field);
        });
    });
    group.bench_function("its dimple in that field", |b| {
        b.iter(|| response.sharpen(surface, &load, &tip, &mut field));
    });
    group.finish();
}

criterion_group!(benches, condensed_elements);
criterion_main!(benches);
