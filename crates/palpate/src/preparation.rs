//! Simulations are made with a bar of how far it is, from what was prepared before where there is such.

use std::ops::ControlFlow;
use std::path::PathBuf;

use palpate_devices::Places;
use palpate_files::Scene;
use palpate_simulate::{Resources, Simulation};

use crate::failure::Failure;
use crate::interrupt;
use crate::progress::{Progress, Reader};

/// The variable that names the folder of prepared responses.
pub(crate) const FOLDER_VARIABLE: &str = "PALPATE_CACHE";

/// Steps of the bar.
const STEPS: u64 = 1000;

/// Part of the memory that is free now that may be taken [-].
const PART_OF_MEMORY: f64 = 0.8;

/// The folder for what takes minutes and can be made again.
pub(crate) fn folder() -> Option<PathBuf> {
    let named = std::env::var_os(FOLDER_VARIABLE).filter(|name| !name.is_empty());
    named
        .map(PathBuf::from)
        .or_else(|| Some(dirs::cache_dir()?.join("palpate")))
}

/// What this machine offers: its folder for what can be made again, and most of its free memory.
pub(crate) fn resources() -> Resources {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    let offered = match system.available_memory() {
        // Not told on this system.
        0 => Resources::default().memory,
        free => (PART_OF_MEMORY * free as f64) as usize,
    };
    Resources {
        responses: folder(),
        memory: offered,
        devices: Places::default(),
        operating_room: None,
    }
}

/// The same, with the places of haptic devices that the environment names.
pub(crate) fn resources_with_devices() -> Result<Resources, Failure> {
    Ok(Resources {
        devices: Places::from_environment().map_err(Failure::input)?,
        ..resources()
    })
}

/// Makes the simulation of `scene`, and tells `reader` how far it is. Ctrl-C breaks it off.
pub(crate) fn simulation(
    scene: &Scene,
    resources: &Resources,
    reader: Reader,
) -> Result<Simulation, Failure> {
    let bar = Progress::of_parts(reader, STEPS);
    bar.say("preparing the organ and its model");
    let mut last = None;
    let made = Simulation::prepare(scene, resources, &mut |progress| {
        if last.replace(progress.work) != Some(progress.work) {
            bar.say(progress.work.words());
        }
        bar.at((progress.part.clamp(0.0, 1.0) * STEPS as f64) as u64);
        match interrupt::is_asked() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    drop(bar);
    Ok(made?)
}
