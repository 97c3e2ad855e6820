//! Steps of a blade over the built-in stomach of 4,000 triangles.
//!
//! Budget: a step of a third of an edge, averaged over a cut of 100 steps with its beginning and its
//! end, below 50 µs: `stroke/…` below 5 ms.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    reason = "a bench that fails to unwrap has failed"
)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_geometry::{AabbTree, CutMethod, CutSurface, Organ, Surface, Vec3};

fn cut_path(c: &mut Criterion) {
    let surface = Surface::new(Organ::Stomach.surface_mesh(4_000).unwrap()).unwrap();
    let mesh = surface.mesh();
    let tree = AabbTree::new(mesh);
    let (low, high) = mesh.bounds();
    let edge = (4.0 * mesh.area() / mesh.triangles().len() as f64 / 3f64.sqrt()).sqrt();
    let way: Vec<Vec3> = (0..=100)
        .map(|k| edge * (f64::from(k) / 3.0 - 16.7))
        .map(|shift| 0.5 * (low + high) + Vec3::new(0.4 * shift, 0.9 * shift, high.z))
        .map(|point| tree.nearest(mesh, &point).on.position)
        .collect();
    let near = tree.nearest(mesh, &way[0]).triangle;
    let mut group = c.benchmark_group("stroke");
    for (name, method) in [
        ("snap_4000", CutMethod::SnapVertices),
        ("split_4000", CutMethod::SplitTriangles),
    ] {
        let mut cut = CutSurface::new(&surface, method);
        group.bench_function(name, |b| {
            b.iter(|| {
                cut.begin(&surface, near, &way[0]).unwrap();
                for to in &way[1..] {
                    black_box(cut.advance(&surface, to).unwrap());
                }
                cut.end(&surface).unwrap();
                cut.undo().unwrap()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, cut_path);
criterion_main!(benches);
