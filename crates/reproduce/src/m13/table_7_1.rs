use std::time::Instant;

use palpate_files::Scene;
use palpate_files::scene::{BuiltinOrgan, Shading, Shape};
use palpate_geometry::{Organ, Surface};
use palpate_viewer::{
    Body, FRAME_SIZE, Gpu, Looks, Orbit, Renderer, Target, Tint, ToolPicture, View,
};

use crate::Error;
use crate::machine::median;
use crate::published::cell;
use crate::row::Rows;

/// The source's organs with the shape that stands for each. Their numbers of triangles are exact.
const ORGANS: [(&str, Organ); 5] = [
    ("liver", Organ::Liver),
    ("stomach", Organ::Stomach),
    ("lung", Organ::Spleen),
    ("kidney", Organ::Kidney),
    ("intestine", Organ::Stomach),
];

/// What is drawn.
const SHADINGS: [(Shading, &str); 3] = [
    (Shading::Plain, "plain"),
    (Shading::SphereMap, "sphere_map"),
    (Shading::CubeMap, "cube_map"),
];

/// Pictures that are thrown away, and that are measured: an odd number has a middle.
const WARM_UP: usize = 2;
const MOST: usize = 101;
/// Time that the pictures of a row may take altogether [s]; a slow adapter draws fewer.
const LONGEST: f64 = 0.6;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let gpu = match Gpu::open() {
        Ok(gpu) => gpu,
        Err(why) => {
            for (name, _) in ORGANS {
                for (_, word) in SHADINGS {
                    rows.row(&format!("{name}/{word}")).missing(&why);
                }
            }
            for (name, ..) in FEATURES {
                rows.row(&format!("cost/{name}")).missing(&why);
            }
            return Ok(());
        }
    };
    let mut renderer = Renderer::new(&gpu);
    let target = Target::new(&gpu, FRAME_SIZE, 1);
    for (name, organ) in ORGANS {
        let wanted = cell(&format!("table-7-1 {name} triangles"))?;
        let tornado = cell(&format!("table-7-1 {name} sphere_map_tornado3000"))?;
        let surface = Surface::new(organ.surface_mesh(wanted as usize)?)?;
        let triangles = surface.mesh().triangles().len();
        let shape = Shape::Builtin {
            organ: BuiltinOrgan::Liver,
            triangles: None,
        };
        let body = Body::new(&gpu, &surface, Tint::of(&shape));
        for (shading, word) in SHADINGS {
            let view = View {
                camera: Orbit::framing(surface.mesh(), 0.785, 1.6).camera(),
                shading,
                looks: Looks::NONE,
                reach: 0.3,
            };
            let time = measure(|| {
                renderer.draw(&gpu, &view, &[&body], &[], &target);
                gpu.wait()
            })?;
            rows.row(&format!("{name}/{word}"))
                .with("triangles", triangles)
                .with("shape", organ)
                .with("width", FRAME_SIZE.0)
                .with("height", FRAME_SIZE.1)
                .with("pictures", time.pictures)
                .with("median", format!("{:.2}", 1e3 * time.median))
                .with("adapter", gpu.adapter())
                .with("tornado", tornado)
                .is(1e-6 * triangles as f64 / time.median);
        }
    }
    add_costs(rows, &gpu)
}

/// What each feature adds: every row has all that those above it have.
const FEATURES: [(&str, Shading, [bool; 3], u32); 7] = [
    ("shape", Shading::Texture, [false, false, false], 1),
    ("relief", Shading::Texture, [true, false, false], 1),
    ("scattering", Shading::Texture, [true, true, false], 1),
    ("shadow", Shading::Texture, [true, true, true], 1),
    ("film", Shading::SphereMap, [true, true, true], 1),
    ("film_cube_map", Shading::CubeMap, [true, true, true], 1),
    ("four_samples", Shading::CubeMap, [true, true, true], 4),
];

const SCENE: &str = "format = 1\n[organ]\nbuiltin = \"liver\"\nbuiltin_tissue = \"pig-liver\"\n";

/// The time of a picture of the liver under a tool.
fn add_costs(rows: &mut Rows<'_>, gpu: &Gpu) -> Result<(), Error> {
    let scene = Scene::parse(SCENE, "built-in scene")?;
    let surface = Surface::new(Organ::Liver.surface_mesh(20_000)?)?;
    let body = Body::new(gpu, &surface, Tint::of(&scene.organ.shape));
    let camera = Orbit::framing(surface.mesh(), 0.785, 1.6).camera();
    let at = camera.target + 0.5 * (camera.eye - camera.target);
    let tool = ToolPicture::new(&scene.tools[0], at.into(), [0.0, 0.0, 0.0, 1.0]);
    let mut renderer = Renderer::new(gpu);
    for (name, shading, [relief, scattering, shadows], samples) in FEATURES {
        let target = Target::new(gpu, FRAME_SIZE, samples);
        let view = View {
            camera,
            shading,
            looks: Looks {
                relief,
                scattering,
                shadows,
            },
            reach: 0.3,
        };
        let time = measure(|| {
            renderer.draw(gpu, &view, &[&body], std::slice::from_ref(&tool), &target);
            gpu.wait()
        })?;
        rows.row(&format!("cost/{name}"))
            .with("width", FRAME_SIZE.0)
            .with("height", FRAME_SIZE.1)
            .with("samples", samples)
            .with("rate", format!("{:.0}", 1.0 / time.median))
            .with("pictures", time.pictures)
            .with("adapter", gpu.adapter())
            .is(1e3 * time.median);
    }
    Ok(())
}

/// What was measured.
#[derive(Debug, Clone, Copy)]
struct Timing {
    /// Of a picture [s].
    median: f64,
    pictures: usize,
}

fn measure(mut draw: impl FnMut() -> Result<(), palpate_viewer::Error>) -> Result<Timing, Error> {
    for _ in 0..WARM_UP {
        draw()?;
    }
    let begin = Instant::now();
    let mut times = Vec::new();
    while times.len() < MOST && (begin.elapsed().as_secs_f64() < LONGEST || times.len() < 3) {
        let start = Instant::now();
        draw()?;
        times.push(start.elapsed().as_secs_f64());
    }
    Ok(Timing {
        median: median(&mut times),
        pictures: times.len(),
    })
}
