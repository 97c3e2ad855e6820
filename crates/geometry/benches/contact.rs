//! Searches and refits of the bounding-box tree, on the built-in liver.
//!
//! Budgets, of a step of 5 ms: `nearest/liver_20000` no slower than `nearest/liver_20000_parry` of the
//! same run, and `refit/500_of_20000` below 0.5 ms (beside `refit/rebuild_20000`, which it spares).

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    reason = "a bench that fails to unwrap has failed"
)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_geometry::{AabbTree, Organ, TriangleId, TriangleMesh, Vec3};
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::TriMesh;

fn liver() -> TriangleMesh {
    Organ::Liver.surface_mesh(20_000).unwrap()
}

/// Where tips are: around the surface, up to 5 mm from it.
fn tips(mesh: &TriangleMesh) -> Vec<Vec3> {
    let ids: Vec<TriangleId> = mesh.triangle_ids().collect();
    (0..1024)
        .map(|k| {
            let triangle = ids[(k * 7919) % ids.len()];
            let distance = 1e-5 * ((k * 613) % 1000) as f64 - 5e-3;
            let corners = mesh.positions(triangle);
            (corners[0] + corners[1] + corners[2]) / 3.0
                + distance * mesh.area_vector(triangle).normalize()
        })
        .collect()
}

fn nearest(c: &mut Criterion) {
    let mesh = liver();
    let tree = AabbTree::new(&mesh);
    let vector = |v: &Vec3| parry3d_f64::math::Vector::new(v.x, v.y, v.z);
    let vertices = mesh.vertices().iter().map(vector).collect();
    let triangles = mesh.triangles().iter().map(|t| t.map(|n| n.0)).collect();
    let judge = TriMesh::new(vertices, triangles).unwrap();
    let tips = tips(&mesh);
    let mut group = c.benchmark_group("nearest");
    let mut next = (0..tips.len()).cycle();
    group.bench_function("liver_20000", |b| {
        b.iter(|| tree.nearest(&mesh, black_box(&tips[next.next().unwrap()])));
    });
    let theirs: Vec<_> = tips.iter().map(vector).collect();
    group.bench_function("liver_20000_parry", |b| {
        b.iter(|| judge.project_local_point(black_box(theirs[next.next().unwrap()]), false));
    });
    group.finish();
}

fn refit(c: &mut Criterion) {
    let mesh = liver();
    let mut by_distance: Vec<TriangleId> = mesh.triangle_ids().collect();
    let center = mesh.positions(TriangleId(0))[0];
    by_distance.sort_by(|a, b| {
        let to = |t: &TriangleId| (mesh.positions(*t)[0] - center).norm();
        to(a).total_cmp(&to(b))
    });
    let moved = &by_distance[..500];
    let pushed = mesh
        .map_vertices(|v| {
            let near = (1.0 - (v - center).norm() / 0.02).max(0.0);
            v + near * Vec3::new(0.0, 0.0, 3e-3)
        })
        .unwrap();
    let shapes = [mesh, pushed];
    let mut tree = AabbTree::new(&shapes[0]);
    let mut turn = 0;
    let mut group = c.benchmark_group("refit");
    group.bench_function("500_of_20000", |b| {
        b.iter(|| {
            turn = 1 - turn;
            tree.refit(black_box(&shapes[turn]), moved);
        });
    });
    group.bench_function("rebuild_20000", |b| {
        b.iter(|| {
            turn = 1 - turn;
            AabbTree::new(black_box(&shapes[turn]))
        });
    });
    group.finish();
}

criterion_group!(benches, nearest, refit);
criterion_main!(benches);
