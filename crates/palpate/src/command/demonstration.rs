//! `palpate` without arguments: two tools on the built-in esophagus.

use std::path::PathBuf;

use palpate_files::{Language, Motion, Overwrite, Scene, write_atomically};
use palpate_simulate::Simulation;
use palpate_viewer::{Start, check_display};

use super::simulate::ESOPHAGUS;
use super::window;
use crate::failure::Failure;
use crate::output;
use crate::preparation;
use crate::progress::Reader;
use crate::recorded::{Recording, claimed, record};

/// Its folder, in the working directory.
const FOLDER: &str = "palpate-demo";

/// Surfaces written for ParaView.
const SURFACES: u64 = 60;

const MOTION: &str = include_str!("../../../../assets/esophagus/motion.csv");

/// The start screen, with texts in `language` or else in that of the settings; where no window can open, a first
/// simulation that needs neither window nor file.
pub(crate) fn run(language: Option<Language>) -> Result<(), Failure> {
    // Before any access to the user's folders.
    if let Err(why) = check_display() {
        return play(&why);
    }
    let training = crate::training::training()?;
    match window::open_in(
        language,
        Start::Home,
        Some(training),
        preparation::resources_with_devices()?,
    ) {
        Ok(()) => Ok(()),
        Err(why) if window::is_absent(&why) => play(&why),
        Err(why) => Err(why.into()),
    }
}

/// The scene and the motion of the demonstration, which a user may change and play again.
const INPUTS: [(&str, &str); 2] = [("scene.toml", ESOPHAGUS), ("motion.csv", MOTION)];

/// The folder of the demonstration: the first of its name that does not exist.
fn folder() -> PathBuf {
    let mut folder = PathBuf::from(FOLDER);
    let mut number = 2;
    while folder.exists() {
        folder = PathBuf::from(format!("{FOLDER}-{number}"));
        number += 1;
    }
    folder
}

/// Plays the demonstration; `why` is the reason that no window opens.
fn play(why: &palpate_viewer::Error) -> Result<(), Failure> {
    let folder = folder();
    let scene = Scene::parse(ESOPHAGUS, "built-in scene")?;
    let simulation = Simulation::new(&scene)?;
    let motion = Motion::parse(MOTION, "built-in motion")?;
    output::text(format!(
        "palpate {}: two tools palpate the built-in esophagus ({} triangles).\n\
         It is played on a virtual clock and no window is opened, for {why}.",
        output::VERSION,
        simulation.surface().mesh().triangles().len(),
    ))?;
    let recording = Recording {
        scene: &scene,
        folder: claimed(&folder, Overwrite::Refused)?,
        surfaces: SURFACES,
        frames: None,
        comparison: None,
        reader: Reader::Person,
    };
    let report = record(&simulation, &motion, recording)?;
    // The inputs, to change and to play again.
    for (name, text) in INPUTS {
        write_atomically(folder.join(name), text.as_bytes())?;
    }
    output::text(report.text())?;
    output::text(format!(
        "written to {name}/:\n\
         \x20 session.csv       force, depth and events at every step\n\
         \x20 force.png         force against time\n\
         \x20 force-depth.png   force against depth\n\
         \x20 surfaces.pvd      {SURFACES} deformed surfaces, for ParaView\n\
         \x20 summary.json      times, peak force and warnings\n\
         \x20 scene.toml and motion.csv, to change and play again:\n\
         \x20   palpate simulate {name}/scene.toml --headless --motion {name}/motion.csv --out mine",
        name = folder.display()
    ))?;
    output::warnings(report.warnings());
    report.outcome()
}
