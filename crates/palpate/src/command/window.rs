//! The window, as the commands open it.

use palpate_files::Scene;
use palpate_files::scene::Shape;
use palpate_viewer::{Error, open_window};

use super::simulate::ESOPHAGUS;
use crate::failure::Failure;
use crate::preparation;

/// Triangles of the built-in esophagus in a window: enough to see the dimple of its tip.
const TRIANGLES: usize = 14_000;

/// The built-in esophagus, fine enough to be looked at.
pub(super) fn esophagus() -> Result<Scene, Failure> {
    let mut scene = Scene::parse(ESOPHAGUS, "built-in scene")?;
    if let Shape::Builtin { triangles, .. } = &mut scene.organ.shape {
        *triangles = Some(TRIANGLES);
    }
    Ok(scene)
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
