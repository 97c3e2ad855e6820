use std::hash::{BuildHasher, RandomState};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use eframe::egui;
use palpate_files::Scene;
use palpate_files::scene::ModelKind;
use palpate_servo::lower_priority;
use palpate_simulate::{Progress, Resources, draw_variant};

use super::play::Prepared;
use crate::{Error, Gpu};

/// A scene that is being prepared on its own thread. A scene with a model of the whole organ comes twice:
/// at once with the local model, and again when the whole organ is ready. Dropping it cancels it.
pub(super) struct Preparation {
    outcomes: Receiver<Outcome>,
    timed_progress: Arc<Mutex<Option<TimedProgress>>>,
    is_cancelled: Arc<AtomicBool>,
}

/// Progress of a preparation, with the time and the part of its first report.
#[derive(Clone, Copy)]
struct TimedProgress {
    progress: Progress,
    first: (Instant, f64),
}

/// The outcome of a preparation, intermediate or final.
pub(super) struct Outcome {
    pub(super) play: Result<Prepared, Error>,
    /// Whether it is final.
    pub(super) last: bool,
    /// Whether the local model came before, which stays when this is an error.
    pub(super) second: bool,
}

/// Bits of a random number that a seed has no use for: people read it, and may type it.
const SPARE_BITS: u32 = 40;

/// State of the thread.
struct Work {
    scene: Scene,
    /// Of the variant, if the scene draws its numbers.
    seed: u64,
    resources: Resources,
    gpu: Gpu,
    context: egui::Context,
    timed_progress: Arc<Mutex<Option<TimedProgress>>>,
    is_cancelled: Arc<AtomicBool>,
}

impl Preparation {
    /// Starts with `scene`, of which another variant is drawn each time, and wakes the window when there is
    /// something.
    pub(super) fn start(
        scene: Scene,
        resources: &Resources,
        gpu: &Gpu,
        context: egui::Context,
    ) -> Self {
        let (sender, outcomes) = channel();
        let (timed_progress, is_cancelled) = (Arc::default(), Arc::default());
        let work = Work {
            scene,
            seed: RandomState::new().hash_one(()) >> SPARE_BITS,
            resources: resources.clone(),
            gpu: gpu.clone(),
            context,
            timed_progress: Arc::clone(&timed_progress),
            is_cancelled: Arc::clone(&is_cancelled),
        };
        let failed = sender.clone();
        let started = std::thread::Builder::new().spawn(move || work.run(&sender));
        if let Err(error) = started {
            let cause = format!("the system gives no thread ({error}); close other programs");
            let _ = failed.send(Outcome {
                play: Err(Error::Window { cause }),
                last: true,
                second: false,
            });
        }
        Self {
            outcomes,
            timed_progress,
            is_cancelled,
        }
    }

    /// The next outcome; none until it is ready.
    pub(super) fn outcome(&mut self) -> Option<Outcome> {
        match self.outcomes.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Outcome {
                play: Err(Error::Window {
                    cause: "the scene could not be prepared".to_owned(),
                }),
                last: true,
                second: false,
            }),
        }
    }

    /// The progress, if known.
    pub(super) fn progress(&self) -> Option<Progress> {
        Some(self.timed_progress()?.progress)
    }

    /// The time that it still takes [s], if it goes on as until now; none before that can be said.
    pub(super) fn time_left(&self) -> Option<f64> {
        let timed_progress = self.timed_progress()?;
        let (since, from) = timed_progress.first;
        let elapsed = since.elapsed().as_secs_f64();
        time_left(elapsed, from, timed_progress.progress.part)
    }

    fn timed_progress(&self) -> Option<TimedProgress> {
        *self
            .timed_progress
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Preparation {
    fn drop(&mut self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

impl Work {
    fn run(mut self, sender: &Sender<Outcome>) {
        // The touch runs at the same time.
        lower_priority();
        match draw_variant(&self.scene, self.seed) {
            Ok(variant) => self.scene = variant,
            Err(error) => {
                let _ = sender.send(Outcome {
                    play: Err(error.into()),
                    last: true,
                    second: false,
                });
                self.context.request_repaint();
                return;
            }
        }
        let second = self.scene.model.kind != ModelKind::Local;
        if second {
            let mut local = self.scene.clone();
            local.model.kind = ModelKind::Local;
            // Until then the force is not that of the scene.
            local.written = None;
            let play = self.play(local);
            let last = play.is_err();
            // Fails when the choice has changed since.
            let sent = sender.send(Outcome {
                play,
                last,
                second: false,
            });
            self.context.request_repaint();
            if last || sent.is_err() {
                return;
            }
        }
        let play = self.play(self.scene.clone());
        let _ = sender.send(Outcome {
            play,
            last: true,
            second,
        });
        self.context.request_repaint();
    }

    fn play(&self, scene: Scene) -> Result<Prepared, Error> {
        Prepared::of(scene, &self.resources, &self.gpu, &mut |progress| {
            let mut timed_progress = self
                .timed_progress
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            *timed_progress = Some(match *timed_progress {
                // The local model came first, and the whole organ begins anew.
                Some(before) if progress.part >= before.progress.part => {
                    TimedProgress { progress, ..before }
                }
                _ => TimedProgress {
                    progress,
                    first: (Instant::now(), progress.part),
                },
            });
            match self.is_cancelled.load(Ordering::Relaxed) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        })
    }
}

/// Remaining time [s] of work whose finished part grew from `from` to `part` in `elapsed` [s], rounded for people.
/// None before a twentieth and a second.
fn time_left(elapsed: f64, from: f64, part: f64) -> Option<f64> {
    let done = part - from;
    if elapsed < 1.0 || done < 0.05 {
        return None;
    }
    let left = elapsed * (1.0 - part) / done;
    let step = if left < 60.0 { 5.0 } else { 30.0 };
    Some((left / step).ceil().max(1.0) * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_takes_as_long_as_what_was_done() {
        assert_eq!(time_left(20.0, 0.0, 0.5), Some(20.0));
        assert_eq!(time_left(20.0, 0.2, 0.6), Some(20.0));
        assert_eq!(time_left(30.0, 0.0, 0.25), Some(90.0));
        assert_eq!(time_left(30.0, 0.0, 1.0), Some(5.0));
        assert_eq!(time_left(0.5, 0.0, 0.5), None);
        assert_eq!(time_left(20.0, 0.3, 0.32), None);
    }
}
