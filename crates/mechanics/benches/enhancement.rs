//! Local enhancement of a kidney of 5,000 triangles, as a model at 200 Hz needs it.
//!
//! Budgets, of a step of 5 ms on one core: `update/5000` 0.1 ms; `patch/build`, when the contact comes to
//! another triangle (vertex neighbourhood, two levels), 0.5 ms, and `patch/displace` 0.05 ms; `carry/10000`
//! vertices of a finer mesh 0.5 ms, within a frame's 16 ms many times over.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    reason = "a bench that fails to unwrap has failed"
)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_files::scene::{Enhancement, EnhancementArea, Smoothing};
use palpate_geometry::{Organ, Surface, TriangleId};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Tip;
use palpate_mechanics::enhance::{
    EmbeddedDisplayPoints, EnhancedPatch, EnhancementModel, Press, SurfaceField, SurfacePoint,
};

fn kidney(triangles: usize) -> Surface {
    Surface::new(Organ::Kidney.surface_mesh(triangles).unwrap()).unwrap()
}

fn enhancement(c: &mut Criterion) {
    let settings = Enhancement {
        area: EnhancementArea::Vertex,
        levels: 2,
        smoothing: Smoothing::MovingLeastSquares,
    };
    let model = EnhancementModel::new(kidney(5_000), settings).unwrap();
    let interpolation = model.interpolation();
    let moved = vec![Vec3::new(1e-4, 2e-4, 3e-4); 5_000];
    let press = Press {
        at: SurfacePoint::centroid(TriangleId(1_234)),
        tip: Tip::Flat { radius: 2e-3 },
        displacement: Vec3::new(0.0, 0.0, 3e-3),
        own: Vec3::new(0.0, 0.0, 3e-3),
    };
    let mut field = SurfaceField::default();
    c.bench_function("update/5000", |b| {
        b.iter(|| field.update(interpolation, black_box(&moved), &[press]));
    });
    let mut patch = EnhancedPatch::default();
    c.bench_function("patch/build", |b| {
        let mut touched = (0..5_000).cycle();
        b.iter(|| patch.build(&model, &[TriangleId(touched.next().unwrap_or(0))]));
    });
    patch.build(&model, &[press.at.triangle]);
    let mut shown = vec![Vec3::zeros(); patch.places().len()];
    c.bench_function("patch/displace", |b| {
        b.iter(|| patch.displace(black_box(&field), &mut shown));
    });
    let carrier = EmbeddedDisplayPoints::of_surface(interpolation, &kidney(19_996));
    let mut shown = vec![Vec3::zeros(); carrier.places().len()];
    c.bench_function("carry/10000", |b| {
        b.iter(|| carrier.interpolate(black_box(&field), &mut shown));
    });
}

criterion_group!(benches, enhancement);
criterion_main!(benches);
