//! The window, as the commands open it.

use palpate_files::Scene;
use palpate_viewer::{Error, open_window};

use super::TRAINER;
use super::simulate::ESOPHAGUS;
use crate::failure::Failure;
use crate::preparation;

/// The lower esophagus where it lies, with a grasper and scissors.
pub(super) fn trainer() -> Result<Scene, Failure> {
    Ok(Scene::parse(TRAINER, "built-in scene")?)
}

/// Opens `scene` and waits until the window is closed.
pub(super) fn open(scene: Scene) -> Result<(), Error> {
    let way_out = Scene::parse(ESOPHAGUS, "built-in scene")?;
    open_window(scene, way_out, preparation::resources())
}

/// Whether there can be no window here, whatever the scene.
pub(super) fn is_absent(why: &Error) -> bool {
    matches!(
        why,
        Error::NoDisplay
            | Error::NoWindowLibrary { .. }
            | Error::NoAdapter { .. }
            | Error::NoDevice { .. }
            | Error::Window { .. }
    )
}
