use std::sync::mpsc::{Receiver, TryRecvError, channel};

use eframe::egui;
use palpate_files::Scene;

use super::play::Play;
use crate::{Error, Gpu};

/// A scene that is being prepared on a thread of its own.
pub(super) struct Preparation(Receiver<Result<Play, Error>>);

impl Preparation {
    /// Starts with `scene`, and wakes the window when it is done.
    pub(super) fn start(scene: Scene, gpu: &Gpu, context: egui::Context) -> Self {
        let (told, outcome) = channel();
        let gpu = gpu.clone();
        std::thread::spawn(move || {
            // Nobody waits any more when the choice has changed since.
            let _ = told.send(Play::start(scene, &gpu));
            context.request_repaint();
        });
        Self(outcome)
    }

    /// What came of it; none yet while it lasts.
    pub(super) fn outcome(&mut self) -> Option<Result<Play, Error>> {
        match self.0.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(Error::Window {
                cause: "the scene could not be prepared".to_owned(),
            })),
        }
    }
}
