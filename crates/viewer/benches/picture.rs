//! What a picture costs.
//!
//! Budgets: deforming and uploading 10,000 vertices 1 ms; a picture with a sphere map or a cube map at most
//! 10 % longer than a plain one on the same adapter.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_files::scene::{BuiltinOrgan, Shading, Shape};
use palpate_geometry::{Organ, Surface};
use palpate_viewer::{
    Body, FRAME_SIZE, Gpu, Looks, Orbit, Renderer, Target, Tint, View, single_precision,
};

fn liver(gpu: &Gpu) -> (Surface, Body) {
    // A closed surface of V vertices has 2 V - 4 triangles.
    let surface = Surface::new(Organ::Liver.surface_mesh(19_996).unwrap()).unwrap();
    let shape = Shape::Builtin {
        organ: BuiltinOrgan::Liver,
        triangles: None,
    };
    let body = Body::new(gpu, &surface, Tint::of(&shape));
    (surface, body)
}

fn deform_and_upload(c: &mut Criterion) {
    let Ok(gpu) = Gpu::open() else {
        eprintln!("no adapter: nothing to measure");
        return;
    };
    let (surface, mut body) = liver(&gpu);
    let positions = single_precision(surface.mesh().vertices());
    assert_eq!(positions.len(), 10_000);
    c.bench_function("deform and upload 10,000 vertices", |b| {
        b.iter(|| {
            body.deform(&gpu, &positions);
            gpu.submit();
        });
    });
}

fn picture(c: &mut Criterion) {
    let Ok(gpu) = Gpu::open() else {
        eprintln!("no adapter: nothing to measure");
        return;
    };
    eprintln!("on {}", gpu.adapter());
    let (surface, body) = liver(&gpu);
    let mut renderer = Renderer::new(&gpu);
    let target = Target::new(&gpu, FRAME_SIZE, 4);
    let mut group = c.benchmark_group("picture 1280x800");
    group.sample_size(30);
    for (word, shading) in Shading::WORDS {
        let view = View {
            camera: Orbit::framing(surface.mesh(), 0.785, 1.6).camera(),
            shading: *shading,
            looks: Looks::ALL,
            reach: 0.3,
        };
        group.bench_function(*word, |b| {
            b.iter(|| {
                renderer.draw(&gpu, &view, (&[&body], &[]), &target);
                gpu.wait().unwrap();
            });
        });
    }
    group.finish();
}

criterion_group!(benches, deform_and_upload, picture);
criterion_main!(benches);
