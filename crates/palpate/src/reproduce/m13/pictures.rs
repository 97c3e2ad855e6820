use palpate_files::scene::Shading;
use palpate_files::{Pose, Scene};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};
use palpate_viewer::{FRAME_SIZE, RgbaImage, Studio, pick, png};

use super::look;
use crate::failure::Failure;
use crate::reproduce::row::Value;
use crate::reproduce::{Item, Rows};

pub(crate) const FIGURE_7_12: Item = Item {
    name: "figure-7-12",
    title: "the esophagus without a texture, with one, and with a sphere map",
    seconds: 8.5,
    run: figure_7_12,
};

pub(crate) const FIGURE_3_7: Item = Item {
    name: "figure-3-7",
    title: "palpation of a liver with the local model",
    seconds: 3.4,
    run: figure_3_7,
};

pub(crate) const FIGURE_4_7: Item = Item {
    name: "figure-4-7",
    title: "palpation of a kidney with the global model",
    seconds: 3.7,
    run: figure_4_7,
};

const ESOPHAGUS: &str = "format = 1\n[organ]\nbuiltin = \"esophagus\"\ntriangles = 14000\n\
     builtin_tissue = \"pig-esophagus\"\n[[tool]]\nname = \"right\"\n\
     tip = { shape = \"sphere\", radius_m = 0.003, contact = \"slip\" }\n";

const LIVER: &str = "format = 1\n[organ]\nbuiltin = \"liver\"\ntriangles = 20000\n\
     builtin_tissue = \"pig-liver\"\n[[tool]]\nname = \"right\"\n\
     tip = { shape = \"sphere\", radius_m = 0.005, contact = \"slip\" }\n";

/// The shown triangles are the source's "about 10K"; it does not tell how many bore the mechanics.
const KIDNEY: &str = "format = 1\n[organ]\nbuiltin = \"kidney\"\ntriangles = 10000\n\
     builtin_tissue = \"pig-kidney\"\n[model]\nkind = \"hybrid\"\nmechanical_triangles = 688\n\
     [model.enhancement]\nsmoothing = \"shepard\"\n[[tool]]\nname = \"right\"\n\
     tip = { shape = \"sphere\", radius_m = 0.004, contact = \"stick\" }\n";

fn figure_7_12(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let shadings = [
        (Shading::Plain, "left", "polygons without a texture"),
        (
            Shading::Texture,
            "middle",
            "a texture that sticks to the tissue: no seams, no stretched places",
        ),
        (
            Shading::SphereMap,
            "right",
            "the texture under a film of liquid, which a sphere map and a lamp light; without one the tissue is dull",
        ),
    ];
    let mut seen = Vec::new();
    for (shading, name, what) in shadings {
        let made = picture(ESOPHAGUS, 0.002, |studio| {
            studio.view.shading = shading;
            studio.view.looks.relief = shading != Shading::Plain;
        });
        seen.extend(made.as_ref().ok().map(|made| made.pixels.clone()));
        add(rows, Some(name), what, made)?;
    }
    if let [left, middle, right] = seen.as_slice() {
        add_looks(rows, left, [middle, right]);
    }
    Ok(())
}

/// What the film changes, beside what is printed of photographs.
fn add_looks(rows: &mut Rows<'_>, plain: &RgbaImage, [middle, right]: [&RgbaImage; 2]) {
    let tissue = look::tissue(plain);
    let mut add = |name: &str, ours: f64, unit: &'static str, note: &str| {
        let value = Value {
            published: None,
            ours: Some(ours),
            unit,
        };
        rows.add(name, value, note);
    };
    add(
        "wet_unlike_textured",
        100.0 * look::unlike(&tissue, middle, right),
        "%",
        "pixels of tissue that differ between the middle and the right picture by more than 10 of 255 in a channel",
    );
    for (name, picture) in [("middle", middle), ("right", right)] {
        add(
            &format!("highlights/{name}"),
            100.0 * look::highlights(&tissue, picture),
            "%",
            "pixels of tissue with all channels above 200 of 255; in endoscopic photographs about 0.9 % of the pixels, \
             which is computed here from the mean precision, accuracy and F1 that [Highlights 2021] prints and is \
             not printed there",
        );
        add(
            &format!("red_is_strongest/{name}"),
            100.0 * look::red(&tissue, picture),
            "%",
            "pixels of tissue that are no highlights; [Highlights 2021] observes it of endoscopic photographs, \
             without a number",
        );
        add(
            &format!("hue_spread/{name}"),
            look::hue_spread(&tissue, picture),
            "deg",
            "circular standard deviation over tissue without highlights; no published number of photographs was found",
        );
    }
}

fn figure_3_7(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let what = "20,000 triangles, 34 particles around a ball of 5 mm radius that is 10 mm deep";
    add(rows, None, what, picture(LIVER, 0.010, |_| ()))
}

fn figure_4_7(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let what = "the built-in kidney of 10,000 triangles, which 688 boundary elements carry, under a ball of \
                4 mm radius that is 6 mm deep; the source's text calls it pulled, its caption palpated";
    add(rows, None, what, picture(KIDNEY, 0.006, |_| ()))
}

/// The picture with what it shows, or the reason why there is none.
fn add(
    rows: &mut Rows<'_>,
    name: Option<&str>,
    what: &str,
    made: Result<Picture, Failure>,
) -> Result<(), Failure> {
    match made {
        Ok(made) => rows.add_picture(
            name,
            &png(&made.pixels)?,
            format!(
                "{what}; force {:.3} N; drawn by {}",
                made.force, made.adapter
            ),
        ),
        Err(failure) if failure.exit_status() == 1 => {
            rows.add_missing(name.unwrap_or("picture"), "", failure.to_string());
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

/// The organ of `scene` with its tool pressed `depth` [m] into what is in the middle of the picture.
fn picture(scene: &str, depth: f64, arrange: impl Fn(&mut Studio)) -> Result<Picture, Failure> {
    let scene = Scene::parse(scene, "built-in scene")?;
    let simulation = Simulation::new(&scene)?;
    let mut studio = Studio::new(&scene, &simulation, FRAME_SIZE)?;
    arrange(&mut studio);
    let mut state = SimulationState::new(&simulation);
    let mut workspace = SimulationWorkspace::new(&simulation);
    let pose = pressed(&studio, &simulation, (scene.tools[0].tip.radius_m, depth));
    step(&simulation, (0.0, 0.0), &[pose], &mut state, &mut workspace);
    Ok(Picture {
        pixels: studio.picture(&state)?,
        force: state.tools[0].force.norm(),
        adapter: studio.gpu.adapter().to_owned(),
    })
}

/// A ball of `radius` [m] that is `depth` [m] deep, held from the upper right.
fn pressed(studio: &Studio, simulation: &Simulation, (radius, depth): (f64, f64)) -> Option<Pose> {
    let surface = simulation.surface();
    let tree = AabbTree::new(surface.mesh());
    let camera = &studio.view.camera;
    let aspect = f64::from(FRAME_SIZE.0) / f64::from(FRAME_SIZE.1);
    let picked = pick((surface, &tree), camera, (0.48, 0.5), aspect)?;
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
