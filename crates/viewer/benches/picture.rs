//! What a picture costs.
//!
//! Budgets: deforming and uploading 10,000 vertices 1 ms; a picture with everything in one sample at most 66 ms where
//! two cores draw it, which leaves a window 15 a second. `docs/theory/pictures.md` has the table.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_files::Scene;
use palpate_files::scene::{BuiltinOrgan, Shading, Shape};
use palpate_geometry::{Organ, Surface};
use palpate_viewer::{
    Body, FRAME_SIZE, Gpu, Looks, Orbit, Renderer, Target, Tint, ToolPicture, View,
    single_precision,
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
    let text = "format = 1\n[organ]\nbuiltin = \"liver\"\nbuiltin_tissue = \"pig-liver\"\n[[tool]]\nname = \"right\"\n";
    let scene = Scene::parse(text, "liver.toml").unwrap();
    let (low, high) = surface.mesh().bounds();
    let above = [0.5 * (low.x + high.x), 0.5 * (low.y + high.y), high.z];
    let tool = ToolPicture::new(&scene.tools[0], above, [0.0, 0.0, 0.0, 1.0]);
    let mut group = c.benchmark_group("picture 1280x800");
    group.sample_size(30);
    let looks = |relief, scattering, shadows| Looks {
        relief,
        scattering,
        shadows,
    };
    // Each adds a feature to the one before.
    let rows = [
        ("shape", Shading::Texture, Looks::NONE, 1),
        ("relief", Shading::Texture, looks(true, false, false), 1),
        ("scattering", Shading::Texture, looks(true, true, false), 1),
        ("shadow of a tool", Shading::Texture, Looks::ALL, 1),
        ("film, sphere map", Shading::SphereMap, Looks::ALL, 1),
        ("film, cube map", Shading::CubeMap, Looks::ALL, 1),
        ("film, cube map, 4 samples", Shading::CubeMap, Looks::ALL, 4),
    ];
    for (name, shading, looks, samples) in rows {
        let target = Target::new(&gpu, FRAME_SIZE, samples);
        let view = View {
            camera: Orbit::framing(surface.mesh(), 0.785, 1.6).camera(),
            shading,
            looks,
            reach: 0.3,
        };
        group.bench_function(name, |b| {
            b.iter(|| {
                renderer.draw(&gpu, &view, &[&body], std::slice::from_ref(&tool), &target);
                gpu.wait().unwrap();
            });
        });
    }
    group.finish();
}

criterion_group!(benches, deform_and_upload, picture);
criterion_main!(benches);
