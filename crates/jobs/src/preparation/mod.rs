//! Simulations are made from what was prepared before where there is such.

mod precompute;

use std::ops::ControlFlow;
use std::path::PathBuf;

use palpate_devices::Places;
use palpate_files::Scene;
use palpate_simulate::{Resources, Simulation};

pub use precompute::{Precomputed, precompute};

use crate::{Error, Watch, memory};

/// The variable that names the folder of prepared responses.
pub const FOLDER_VARIABLE: &str = "PALPATE_CACHE";

/// The folder for what takes minutes and can be made again.
pub fn folder() -> Option<PathBuf> {
    let named = std::env::var_os(FOLDER_VARIABLE).filter(|name| !name.is_empty());
    named
        .map(PathBuf::from)
        .or_else(|| Some(dirs::cache_dir()?.join("palpate")))
}

/// What this machine offers: its folder for what can be made again, and most of the memory that is left, see
/// [`memory::offered`].
pub fn resources() -> Resources {
    Resources {
        responses: folder(),
        memory: memory::offered().unwrap_or(Resources::default().memory),
        devices: Places::default(),
        publishers: Vec::new(),
    }
}

/// The same, with the places of haptic devices that the environment names.
///
/// # Errors
/// When the environment names no place.
pub fn resources_with_devices() -> Result<Resources, Error> {
    Ok(Resources {
        devices: Places::from_environment()?,
        ..resources()
    })
}

/// Makes the simulation of `scene`, and tells `watch` how far it is, which may break it off.
///
/// # Errors
/// When the scene describes none, memory does not suffice, or it was cancelled.
pub fn simulation(
    scene: &Scene,
    resources: &Resources,
    watch: &dyn Watch,
) -> Result<Simulation, Error> {
    watch.say("preparing the organ and its model");
    // Whoever keeps a session draws before; to look at an organ any variant will do.
    let scene = &palpate_simulate::draw_variant(scene, 0)?;
    let mut last = None;
    let made = Simulation::prepare(scene, resources, &mut |progress| {
        if last.replace(progress.work) != Some(progress.work) {
            watch.say(progress.work.words());
        }
        watch.at(progress.part.clamp(0.0, 1.0));
        match watch.is_asked_to_stop() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    Ok(made?)
}
