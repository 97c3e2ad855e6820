//! Reading a mesh file and finding out what is wrong with it, as every import does.
//!
//! Budget: `import/stl_20000` below 1 s, so that opening an organ does not feel like waiting.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    reason = "a bench that fails to unwrap has failed"
)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_geometry::{LengthUnit, Organ, Surface, inspect, read_mesh, repair};

fn import(c: &mut Criterion) {
    let mesh = Organ::Liver.surface_mesh(20_000).unwrap();
    let triangles: Vec<_> = mesh
        .triangle_ids()
        .map(|t| stl_io::Triangle {
            normal: stl_io::Normal::default(),
            vertices: mesh
                .positions(t)
                .map(|p| stl_io::Vertex::new([p.x as f32, p.y as f32, p.z as f32])),
        })
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("liver.stl");
    let mut file = std::fs::File::create(&path).unwrap();
    stl_io::write_stl(&mut file, triangles.iter()).unwrap();
    drop(file);
    let mut group = c.benchmark_group("import");
    group.sample_size(10);
    group.bench_function("stl_20000", |b| {
        b.iter(|| {
            let read = read_mesh(black_box(&path), Some(LengthUnit::Metre)).unwrap();
            let report = inspect(&read.mesh);
            let (repaired, _) = repair(&read.mesh).unwrap();
            (report, Surface::new(repaired).unwrap())
        });
    });
    group.finish();
}

criterion_group!(benches, import);
criterion_main!(benches);
