use palpate_files::scene::{Region, RegionSphere};
use palpate_files::{Motion, Scene};
use palpate_simulate::{Flow, Simulation, play};
use palpate_viewer::{FRAME_SIZE, Studio, png};

use crate::Error;
use crate::row::Rows;
use palpate_jobs::preparation;

/// The scene of the trainer.
pub(super) const TRAINER: &str = include_str!("../../../../assets/esophagus/trainer.toml");
const MYOTOMY: &str = include_str!("../../../../assets/esophagus/myotomy.csv");
const PULL: &str = include_str!("../../../../assets/esophagus/pull.csv");
const PALPATE: &str = include_str!("../../../../assets/esophagus/palpate.csv");

/// Triangles that carry the mechanics of a picture, and where the organ is touched in it [m].
const TRIANGLES: usize = 2_000;
const TOUCHED: RegionSphere = RegionSphere {
    center_m: [0.0, -0.0075, 0.0],
    radius_m: 0.02,
};

/// Where the eye is [m].
const EYE: [f64; 3] = [0.008, -0.115, 0.012];

pub(crate) fn figure_7_18(rows: &mut Rows<'_>) -> Result<(), Error> {
    let (scene, simulation) = trainer(rows)?;
    add(rows, "left", &scene, &simulation, PULL)?;
    add(rows, "right", &scene, &simulation, PALPATE)
}

pub(crate) fn figure_7_19(rows: &mut Rows<'_>) -> Result<(), Error> {
    let (scene, simulation) = trainer(rows)?;
    add(rows, "", &scene, &simulation, MYOTOMY)
}

/// The scene of the trainer, touched in the middle only.
fn trainer(rows: &Rows<'_>) -> Result<(Scene, Simulation), Error> {
    let mut scene = Scene::parse(TRAINER, "built-in scene")?;
    // Nearer than a hand would like it.
    scene.view.eye_m = Some(EYE);
    scene.model.mechanical_triangles = Some(TRIANGLES);
    scene.organ.touchable = Some(Region {
        spheres: vec![TOUCHED],
        ..Region::default()
    });
    let resources = preparation::resources();
    let simulation = preparation::simulation(&scene, &resources, rows)?;
    Ok((scene, simulation))
}

/// The last picture of a motion, or the reason why there is none.
fn add(
    rows: &mut Rows<'_>,
    name: &str,
    scene: &Scene,
    simulation: &Simulation,
    motion: &str,
) -> Result<(), Error> {
    let motion = Motion::parse(motion, "built-in motion")?;
    let mut studio = match Studio::new(scene, simulation, FRAME_SIZE) {
        Ok(studio) => studio,
        Err(why) => {
            let name = if name.is_empty() { "picture" } else { name };
            rows.row(name).missing(why);
            return Ok(());
        }
    };
    let mut last = None;
    let summary = play(simulation, &motion, |frame| -> Result<Flow, Error> {
        if frame.number + 1 == frame.steps {
            let forces = frame.state.tools.iter().map(|tool| tool.force.norm());
            last = Some((studio.picture(frame.state)?, forces.fold(0.0, f64::max)));
        }
        Ok(Flow::Continue)
    })?;
    let Some((picture, force)) = last else {
        return Ok(());
    };
    let cut = summary.cuts.map_or(0.0, |cuts| cuts.length);
    let cut = match cut > 0.0 {
        true => format!(", {:.1} mm cut", 1e3 * cut),
        false => String::new(),
    };
    rows.figure(name)
        .with("force", format!("{force:.3}"))
        .with("cut", cut)
        .with("adapter", studio.gpu.adapter())
        .picture(&png(&picture)?)
}
