use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use eframe::egui;

use super::{Make, PreparedRig};

/// A rig that is being made on its own thread.
pub(super) struct Preparation {
    outcome: Receiver<Result<PreparedRig, String>>,
    /// The part that is done [-], as bits.
    part: Arc<AtomicU64>,
}

impl Preparation {
    /// Starts, and wakes the window when there is something.
    pub(super) fn start(make: &Arc<Make>, context: egui::Context) -> Self {
        let (sender, outcome) = channel();
        let part = Arc::new(AtomicU64::new(0));
        let (make, progress) = (make.clone(), part.clone());
        let failed = sender.clone();
        let work = move || {
            palpate_servo::lower_priority();
            let made = make(&mut |part| progress.store(part.to_bits(), Ordering::Relaxed));
            // Fails when another specimen was chosen since.
            let _ = sender.send(made);
            context.request_repaint();
        };
        if let Err(error) = std::thread::Builder::new().spawn(work) {
            let cause = format!("the system gives no thread ({error}); close other programs");
            let _ = failed.send(Err(cause));
        }
        Self { outcome, part }
    }

    /// The outcome; none until it is finished.
    pub(super) fn outcome(&self) -> Option<Result<PreparedRig, String>> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                Some(Err("the specimen could not be prepared".to_owned()))
            }
        }
    }

    /// The part that is done [-].
    pub(super) fn part(&self) -> f64 {
        f64::from_bits(self.part.load(Ordering::Relaxed))
    }
}
