use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui;

use crate::window::check_display;
use crate::{Error, Gpu, style};

/// Name of the window.
const TITLE: &str = "palpate";
/// Picture of the window where the desktop has no other: assets/palpate.svg, 128 pixels wide.
const ICON: &[u8] = include_bytes!("../assets/palpate.png");

/// Opens a window of a size and a least size in which what `make` gives is shown, and waits until it is closed.
///
/// # Errors
/// When there is no display, no adapter, or the window breaks down.
pub(crate) fn open<App: eframe::App + 'static>(
    [size, least]: [[f32; 2]; 2],
    make: impl FnOnce(&eframe::CreationContext<'_>) -> Result<App, Error> + 'static,
) -> Result<(), Error> {
    check_display()?;
    // Opened once without a window: its error has a name that a window's has not.
    drop(Gpu::open()?);
    let mut viewport = egui::ViewportBuilder::default()
        .with_title(TITLE)
        .with_app_id("palpate")
        .with_inner_size(size)
        .with_min_inner_size(least);
    viewport.icon = eframe::icon_data::from_png_bytes(ICON).ok().map(Arc::new);
    let options = eframe::NativeOptions {
        viewport,
        renderer: eframe::Renderer::Wgpu,
        ..eframe::NativeOptions::default()
    };
    // An error while the window is made is reported in our words, not in those of its library.
    let failure: Arc<Mutex<Option<Error>>> = Arc::default();
    let shared_failure = failure.clone();
    let make: eframe::AppCreator<'_> = Box::new(move |context| {
        style::apply(&context.egui_ctx);
        match make(context) {
            Ok(window) => Ok(Box::new(window) as Box<dyn eframe::App>),
            Err(error) => {
                let words = error.to_string();
                *shared_failure
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner) = Some(error);
                Err(words.into())
            }
        }
    });
    let outcome = eframe::run_native(TITLE, options, make);
    let own = failure
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .take();
    match (own, outcome) {
        (Some(error), _) => Err(error),
        (None, Err(cause)) => Err(Error::Window {
            cause: cause.to_string(),
        }),
        (None, Ok(())) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_icon_is_a_picture() {
        let icon = eframe::icon_data::from_png_bytes(ICON).unwrap();
        assert_eq!((icon.width, icon.height), (128, 128));
    }
}
