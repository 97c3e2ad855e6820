//! A slit in a tube of 4,000 triangles, as thin as an esophagus.
//!
//! Budgets: one more facet 1 ms, whether it is the 40th or the 128th, in a wall and in a solid; with 40 facets, a
//! tip's load 0.2 ms and the field 2 ms.
//!
//! The response is made up: its numbers do not count, its size does.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use palpate_geometry::{AabbTree, NodeId, Surface, TriangleId, TriangleMesh};
use palpate_mechanics::Vec3;
use palpate_mechanics::surface_response::slit::{CutBody, DiscForce, Slit, SlitFacet};
use palpate_mechanics::surface_response::{
    ResponseParts, Sampling, SurfaceResponse, TipField, TouchableTriangle,
};

const OUTER: f64 = 10e-3;
const WALL: f64 = 2.5e-3;
const LENGTH: f64 = 0.12;

/// `around` by `along` squares outside and inside.
fn tube(around: usize, along: usize) -> Surface {
    let mut line = Vec::new();
    let up = |k: usize| LENGTH * k as f64 / along as f64 - 0.5 * LENGTH;
    line.extend((0..=along).map(|k| (OUTER, up(k))));
    line.extend((0..=along).rev().map(|k| (OUTER - WALL, up(k))));
    let mut vertices = Vec::new();
    for k in 0..around {
        let (sine, cosine) = (TAU * k as f64 / around as f64).sin_cos();
        let places = line.iter();
        vertices.extend(places.map(|&(r, z)| Vec3::new(r * cosine, r * sine, z)));
    }
    let node = |k: usize, i: usize| NodeId((k % around * line.len() + i % line.len()) as u32);
    let mut triangles = Vec::new();
    for k in 0..around {
        for i in 0..line.len() {
            let [a, b, c, d] = [(k, i), (k + 1, i), (k, i + 1), (k + 1, i + 1)];
            let [a, b, c, d] = [a, b, c, d].map(|(k, i)| node(k, i));
            triangles.push([a, b, d]);
            triangles.push([a, d, c]);
        }
    }
    Surface::new(TriangleMesh::new(vertices, triangles).unwrap()).unwrap()
}

/// Those within reach of the slit can be touched; displacements fall off as those of a half-space.
fn response(surface: &Surface) -> SurfaceResponse<f32> {
    let mesh = surface.mesh();
    let centroid = |id: TriangleId| mesh.positions(id).iter().sum::<Vec3>() / 3.0;
    let near = |id: &TriangleId| centroid(*id).x > 0.0 && centroid(*id).z.abs() < 0.045;
    let touchable: Vec<_> = mesh
        .triangle_ids()
        .filter(near)
        .map(|id| TouchableTriangle::of(surface, id).unwrap())
        .collect();
    let rows = 3 * mesh.triangles().len();
    let mut displacements = vec![0.0; 3 * rows * touchable.len()];
    for (j, loaded) in touchable.iter().enumerate() {
        for id in mesh.triangle_ids() {
            let value = 0.3 / ((centroid(id) - loaded.centroid).norm() + 1e-3);
            for axis in 0..3 {
                displacements[rows * (3 * j + axis) + 3 * id.index() + axis] = value as f32;
            }
        }
    }
    SurfaceResponse::new(ResponseParts {
        poissons_ratio: 0.45,
        touchable,
        fixed: Vec::new(),
        triangles: mesh.triangles().len(),
        sampling: Sampling::Means,
        displacements,
    })
    .unwrap()
}

fn facet(number: usize, depth: f64) -> SlitFacet {
    let length = 0.6e-3;
    SlitFacet {
        middle: Vec3::new(OUTER, 0.0, (number as f64 - 63.5) * length),
        along: Vec3::z(),
        normal: Vec3::x(),
        length,
        depth,
    }
}

fn slit(criterion: &mut Criterion) {
    let surface = tube(20, 99);
    let response = response(&surface);
    let tree = AabbTree::new(surface.mesh());
    let body = CutBody {
        surface: &surface,
        tree: &tree,
        response: &response,
    };
    let mut group = criterion.benchmark_group("slit");
    for (name, depth) in [("wall", f64::INFINITY), ("solid", 0.5e-3)] {
        let mut slit = Slit::new(&response, 128);
        for count in [40, 128] {
            for number in slit.facets()..count - 1 {
                slit.open(&body, &facet(number, depth)).unwrap();
            }
            // Where others keep the machine busy, the least says more than the mean.
            let mut least = Duration::MAX;
            group.bench_function(format!("facet {count}, {name}"), |b| {
                b.iter_custom(|times| {
                    let mut spent = Duration::ZERO;
                    for _ in 0..times {
                        slit.truncate(count - 1);
                        let start = Instant::now();
                        slit.open(&body, &facet(count - 1, depth)).unwrap();
                        let took = start.elapsed();
                        spent += took;
                        least = least.min(took);
                    }
                    spent
                });
            });
            eprintln!("facet {count}, {name}: at least {least:.2?}");
        }
    }
    let mut slit = Slit::new(&response, 40);
    for number in 44..84 {
        slit.open(&body, &facet(number, f64::INFINITY)).unwrap();
    }
    let tips = TipField::new(&response, &surface, 1.5e-3).unwrap();
    let spot = DiscForce {
        place: Vec3::new(OUTER, 2e-3, 0.0),
        normal: Vec3::x(),
        radius: 1.5e-3,
    };
    let found = tree.nearest(surface.mesh(), &spot.place);
    let tip = tips.at(&surface, found.triangle, &found.on.barycentric);
    let mut load = slit.load();
    group.bench_function("load of a tip, 40 facets", |b| {
        b.iter(|| {
            slit.put(&response, tip.shares(), Some(&spot), &mut load);
            black_box(slit.added_compliance(&load))
        });
    });
    let mut jumps = slit.jumps();
    let rest = vec![0.0_f32; 3 * response.parts().triangles];
    group.bench_function("jumps and their field, 40 facets", |b| {
        b.iter_batched_ref(
            || rest.clone(),
            |field| {
                let force = 1e-6 * Vec3::x();
                slit.jump([(&load, force)].into_iter(), &mut jumps);
                slit.add_field(&jumps, field);
            },
            BatchSize::SmallInput,
        );
    });
    group.finish();
}

criterion_group!(benches, slit);
criterion_main!(benches);
