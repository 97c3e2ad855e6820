//! Makes simulations, from cached results if there are any.

mod precompute;

use std::ops::ControlFlow;
use std::path::PathBuf;

use palpate_devices::Places;
use palpate_files::Scene;
use palpate_simulate::{Resources, Simulation};

pub use precompute::{Precomputed, precompute};

use crate::{Error, ProgressCallback, memory};

/// The variable that names the cache of prepared responses.
pub const FOLDER_VARIABLE: &str = "PALPATE_CACHE";

/// The cache folder, for results that take minutes and can be computed again.
pub fn folder() -> Option<PathBuf> {
    let named = std::env::var_os(FOLDER_VARIABLE).filter(|name| !name.is_empty());
    named
        .map(PathBuf::from)
        .or_else(|| Some(dirs::cache_dir()?.join("palpate")))
}

/// The resources of this machine: its cache folder, and most of the available memory, see [`memory::offered`].
pub fn resources() -> Resources {
    Resources {
        responses: folder(),
        memory: memory::offered().unwrap_or(Resources::default().memory),
        devices: Places::default(),
        publishers: Vec::new(),
    }
}

/// The same, with the addresses of haptic devices from the environment.
///
/// # Errors
/// When an address in the environment is invalid.
pub fn resources_with_devices() -> Result<Resources, Error> {
    Ok(Resources {
        devices: Places::from_environment()?,
        ..resources()
    })
}

/// Makes the simulation of `scene` and reports progress to `watch`, which may cancel it.
///
/// # Errors
/// When the scene is invalid, memory does not suffice, or the job was cancelled.
pub fn simulation(
    scene: &Scene,
    resources: &Resources,
    watch: &dyn ProgressCallback,
) -> Result<Simulation, Error> {
    watch.report_step("preparing the organ and its model");
    // A caller that records a session draws the variant before; to view an organ any variant will do.
    let scene = &palpate_simulate::draw_variant(scene, 0)?;
    let mut last = None;
    let made = Simulation::prepare(scene, resources, &mut |progress| {
        if last.replace(progress.work) != Some(progress.work) {
            watch.report_step(progress.work.words());
        }
        watch.report_fraction(progress.part.clamp(0.0, 1.0));
        match watch.should_stop() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    Ok(made?)
}
