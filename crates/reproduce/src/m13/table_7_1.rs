use std::time::Instant;

use palpate_files::Scene;
use palpate_files::scene::{BuiltinOrgan, Shading, Shape};
use palpate_geometry::{Organ, Surface};
use palpate_viewer::{
    Body, FRAME_SIZE, Gpu, Looks, Orbit, Renderer, Target, Tint, ToolPicture, View,
};

use crate::Error;
use crate::published::TABLE_7_1 as PUBLISHED;
use crate::row::Value;
use crate::{Item, Rows};

pub(crate) const TABLE_7_1: Item = Item {
    name: "table-7-1",
    title: "triangles drawn per second, plain and with environment maps",
    seconds: 24.0,
    run,
};

/// The source's organs with the shape that stands for each. Their numbers of triangles are exact.
const ORGANS: [(&str, Organ); 5] = [
    ("liver", Organ::Liver),
    ("stomach", Organ::Stomach),
    ("lung", Organ::Spleen),
    ("kidney", Organ::Kidney),
    ("intestine", Organ::Stomach),
];

/// What is drawn, and the published column of it.
const SHADINGS: [(Shading, &str, Option<&str>); 3] = [
    (Shading::Plain, "plain", None),
    (
        Shading::SphereMap,
        "sphere_map",
        Some("sphere_map_geforce2"),
    ),
    (Shading::CubeMap, "cube_map", Some("cube_map_geforce2")),
];

const UNIT: &str = "10^6/s";

/// Pictures that are thrown away, and that are measured: an odd number has a middle.
const WARM_UP: usize = 2;
const MOST: usize = 101;
/// Time that the pictures of a row may take altogether [s]; a slow adapter draws fewer.
const LONGEST: f64 = 0.6;

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let gpu = match Gpu::open() {
        Ok(gpu) => gpu,
        Err(why) => {
            for (name, _) in ORGANS {
                for (_, word, _) in SHADINGS {
                    rows.add_missing(&format!("{name}/{word}"), UNIT, why.to_string());
                }
            }
            for (name, ..) in FEATURES {
                rows.add_missing(&format!("cost/{name}"), "ms", why.to_string());
            }
            return Ok(());
        }
    };
    let mut renderer = Renderer::new(&gpu);
    let target = Target::new(&gpu, FRAME_SIZE, 1);
    for (name, organ) in ORGANS {
        let Some(wanted) = PUBLISHED.value(name, "triangles") else {
            rows.add_missing(name, UNIT, "the published table has no such organ");
            continue;
        };
        let surface = Surface::new(organ.surface_mesh(wanted as usize)?)?;
        let triangles = surface.mesh().triangles().len();
        let shape = Shape::Builtin {
            organ: BuiltinOrgan::Liver,
            triangles: None,
        };
        let body = Body::new(&gpu, &surface, Tint::of(&shape));
        for (shading, word, column) in SHADINGS {
            let view = View {
                camera: Orbit::framing(surface.mesh(), 0.785, 1.6).camera(),
                shading,
                looks: Looks::NONE,
                reach: 0.3,
            };
            let time = measure(|| {
                renderer.draw(&gpu, &view, (&[&body], &[]), &target);
                gpu.wait()
            })?;
            let value = Value {
                published: column.and_then(|column| PUBLISHED.value(name, column)),
                ours: Some(1e-6 * triangles as f64 / time.median),
                unit: UNIT,
            };
            let software = PUBLISHED.value(name, "sphere_map_tornado3000");
            rows.add(
                &format!("{name}/{word}"),
                value,
                note(
                    organ,
                    triangles,
                    &gpu,
                    (time, software.filter(|_| column.is_some())),
                ),
            );
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
    let tool = ToolPicture::new(&scene.tools[0], (at.into(), [0.0, 0.0, 0.0, 1.0]));
    let mut renderer = Renderer::new(gpu);
    let (width, height) = FRAME_SIZE;
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
            renderer.draw(gpu, &view, (&[&body], std::slice::from_ref(&tool)), &target);
            gpu.wait()
        })?;
        let value = Value {
            published: None,
            ours: Some(1e3 * time.median),
            unit: "ms",
        };
        let note = format!(
            "a picture of the liver of 20,000 triangles under a tool, {width}x{height} pixels of {samples} samples, \
             with this and all that the rows above have: {:.0} a second; median of {} on {}",
            1.0 / time.median,
            time.pictures,
            gpu.adapter(),
        );
        rows.add(&format!("cost/{name}"), value, note);
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
    times.sort_by(f64::total_cmp);
    Ok(Timing {
        median: times[times.len() / 2],
        pictures: times.len(),
    })
}

fn note(
    organ: Organ,
    triangles: usize,
    gpu: &Gpu,
    (time, tornado): (Timing, Option<f64>),
) -> String {
    let (width, height) = FRAME_SIZE;
    let tornado = tornado.map_or(String::new(), |published| {
        format!(
            "; a Tornado 3000, without environment maps in hardware, drew {published} (sphere map)"
        )
    });
    format!(
        "{triangles} triangles in the shape of the built-in {organ}, {width}x{height} pixels of one sample, \
         median of {} pictures of {:.2} ms on {}; published on a GeForce 2{tornado}",
        time.pictures,
        1e3 * time.median,
        gpu.adapter(),
    )
}
