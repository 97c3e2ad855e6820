//! The window, as the commands open it.

use palpate_files::{Language, Scene};
use palpate_simulate::Resources;
use palpate_viewer::training::Training;
use palpate_viewer::{Error, Start, WindowOptions, open_window};

use super::simulate::ESOPHAGUS;
use crate::interrupt;

/// Opens a window with `resources` and waits until it is closed.
pub(super) fn open(
    start: Start,
    training: Option<Training>,
    resources: Resources,
) -> Result<(), Error> {
    open_in(None, start, training, resources)
}

/// The same, with texts in `language`.
pub(super) fn open_in(
    language: Option<Language>,
    start: Start,
    training: Option<Training>,
    resources: Resources,
) -> Result<(), Error> {
    let way_out = Scene::parse(ESOPHAGUS, "built-in scene")?;
    // Asked once, so that signals are heard from now on.
    let _ = interrupt::is_asked();
    let options = WindowOptions {
        way_out,
        resources,
        training,
        settings: crate::settings::of_window(language),
        is_ended: interrupt::is_asked,
    };
    open_window(start, options)
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
