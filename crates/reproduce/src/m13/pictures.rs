use palpate_files::scene::Shading;
use palpate_files::{Pose, Scene};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};
use palpate_viewer::{FRAME_SIZE, RgbaImage, Studio, pick, png};

use super::visual_measures;
use crate::Error;
use crate::row::Rows;

const ESOPHAGUS: &str = "format = 1\n[organ]\nbuiltin = \"esophagus\"\ntriangles = 14000\n\
     builtin_tissue = \"pig-esophagus\"\n[[tool]]\nname = \"right\"\n\
     tip = { shape = \"sphere\", radius_m = 0.003, contact = \"slip\" }\n";

const LIVER: &str = "format = 1\n[organ]\nbuiltin = \"liver\"\ntriangles = 20000\n\
     builtin_tissue = \"pig-liver\"\n[[tool]]\nname = \"right\"\n\
     tip = { shape = \"sphere\", radius_m = 0.005, contact = \"slip\" }\n";

/// The shown triangles are the source's "about 10K"; it does not say how many the mechanics had.
const KIDNEY: &str = "format = 1\n[organ]\nbuiltin = \"kidney\"\ntriangles = 10000\n\
     builtin_tissue = \"pig-kidney\"\n[model]\nkind = \"hybrid\"\nmechanical_triangles = 688\n\
     [model.enhancement]\nsmoothing = \"shepard\"\n[[tool]]\nname = \"right\"\n\
     tip = { shape = \"sphere\", radius_m = 0.004, contact = \"stick\" }\n";

pub(crate) fn figure_7_12(rows: &mut Rows<'_>) -> Result<(), Error> {
    let shadings = [
        (Shading::Plain, "left"),
        (Shading::Texture, "middle"),
        (Shading::SphereMap, "right"),
    ];
    let mut seen = Vec::new();
    for (shading, name) in shadings {
        let made = picture(ESOPHAGUS, 0.002, |studio| {
            studio.view.shading = shading;
            studio.view.looks.relief = shading != Shading::Plain;
        });
        seen.extend(made.as_ref().ok().map(|made| made.pixels.clone()));
        add(rows, name, made)?;
    }
    if let [left, middle, right] = seen.as_slice() {
        add_looks(rows, left, [middle, right]);
    }
    Ok(())
}

/// Measures that the film changes, versus those printed of photographs.
fn add_looks(rows: &mut Rows<'_>, plain: &RgbaImage, [middle, right]: [&RgbaImage; 2]) {
    let tissue = visual_measures::tissue(plain);
    let unlike = visual_measures::different_part(&tissue, middle, right);
    rows.add("wet_unlike_textured", 100.0 * unlike);
    for (name, picture) in [("middle", middle), ("right", right)] {
        let highlights = visual_measures::highlights(&tissue, picture);
        rows.add(&format!("highlights/{name}"), 100.0 * highlights);
        let red = visual_measures::red(&tissue, picture);
        rows.add(&format!("red_is_strongest/{name}"), 100.0 * red);
        let hues = visual_measures::hue_spread(&tissue, picture);
        rows.add(&format!("hue_spread/{name}"), hues);
    }
}

pub(crate) fn figure_3_7(rows: &mut Rows<'_>) -> Result<(), Error> {
    add(rows, "", picture(LIVER, 0.010, |_| ()))
}

pub(crate) fn figure_4_7(rows: &mut Rows<'_>) -> Result<(), Error> {
    add(rows, "", picture(KIDNEY, 0.006, |_| ()))
}

/// The picture, or the reason why there is none.
fn add(rows: &mut Rows<'_>, name: &str, made: Result<Picture, Error>) -> Result<(), Error> {
    match made {
        Ok(made) => rows
            .figure(name)
            .with("force", format!("{:.3}", made.force))
            .with("adapter", made.adapter)
            .picture(&png(&made.pixels)?),
        Err(why) if !why.is_input() => {
            let name = if name.is_empty() { "picture" } else { name };
            rows.row(name).missing(why);
            Ok(())
        }
        Err(failure) => Err(failure),
    }
}

struct Picture {
    pixels: RgbaImage,
    /// On the tool [N].
    force: f64,
    adapter: String,
}

/// The organ of `scene` with its tool pressed `depth` [m] into the middle of the picture.
fn picture(scene: &str, depth: f64, arrange: impl Fn(&mut Studio)) -> Result<Picture, Error> {
    let scene = Scene::parse(scene, "built-in scene")?;
    let simulation = Simulation::new(&scene)?;
    let mut studio = Studio::new(&scene, &simulation, FRAME_SIZE)?;
    arrange(&mut studio);
    let mut state = SimulationState::new(&simulation);
    let mut workspace = SimulationWorkspace::new(&simulation);
    let pose = pressed(&studio, &simulation, scene.tools[0].tip.radius_m, depth);
    step(&simulation, 0.0, 0.0, &[pose], &mut state, &mut workspace);
    Ok(Picture {
        pixels: studio.picture(&state)?,
        force: state.tools[0].force.norm(),
        adapter: studio.gpu.adapter().to_owned(),
    })
}

/// A ball of `radius` [m] that is `depth` [m] deep, its shaft from the upper right.
fn pressed(studio: &Studio, simulation: &Simulation, radius: f64, depth: f64) -> Option<Pose> {
    let surface = simulation.surface();
    let tree = AabbTree::new(surface.mesh());
    let camera = &studio.view.camera;
    let aspect = f64::from(FRAME_SIZE.0) / f64::from(FRAME_SIZE.1);
    let picked = pick(surface, &tree, camera, (0.48, 0.5), aspect)?;
    let [right, up, _] = camera.axes();
    let shaft: Vec3 = picked.normal + 0.45 * right + 0.55 * up;
    let turned = nalgebra::UnitQuaternion::rotation_between(&Vec3::z(), &shaft)?;
    Some(Pose {
        position_m: (picked.point + (radius - depth) * picked.normal).into(),
        orientation: Some([turned.i, turned.j, turned.k, turned.w]),
        grip: 0.0,
        cut: false,
    })
}
