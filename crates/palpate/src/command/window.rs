//! The window, as the commands open it.

use palpate_files::{Language, Scene};
use palpate_simulate::Resources;
use palpate_viewer::training::Training;
use palpate_viewer::{Error, Start, WindowOptions, open_window};

use super::simulate::ESOPHAGUS;
use crate::interrupt;

/// Opens a window with `resources` and returns when it is closed.
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
    let fallback = Scene::parse(ESOPHAGUS, "built-in scene")?;
    // The first call starts listening for signals.
    let _ = interrupt::is_requested();
    let options = WindowOptions {
        fallback,
        resources,
        training,
        settings: crate::settings::of_window(language),
        is_ended: interrupt::is_requested,
    };
    open_window(start, options)
}

/// Whether this machine can open no window, whatever the scene.
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
