use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui;

use crate::window::check_display;
use crate::{Error, Gpu, style};

/// Name of the window.
const TITLE: &str = "palpate";

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
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title(TITLE)
            .with_app_id("palpate")
            .with_inner_size(size)
            .with_min_inner_size(least),
        renderer: eframe::Renderer::Wgpu,
        ..eframe::NativeOptions::default()
    };
    // What goes wrong while the window is made is told in our words, not in those of its library.
    let failure: Arc<Mutex<Option<Error>>> = Arc::default();
    let told = failure.clone();
    let make: eframe::AppCreator<'_> = Box::new(move |context| {
        style::dress(&context.egui_ctx);
        match make(context) {
            Ok(window) => Ok(Box::new(window) as Box<dyn eframe::App>),
            Err(error) => {
                let words = error.to_string();
                *told.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
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
