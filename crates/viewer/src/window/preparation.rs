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

/// A scene that is being prepared on a thread of its own. One with a model of the whole organ comes twice:
/// at once with the local model, and again when the whole organ is ready. Dropping it breaks it off.
pub(super) struct Preparation {
    outcomes: Receiver<Outcome>,
    told: Arc<Mutex<Option<Told>>>,
    given_up: Arc<AtomicBool>,
}

/// How far a preparation is, and when it was first told where.
#[derive(Clone, Copy)]
struct Told {
    progress: Progress,
    first: (Instant, f64),
}

/// What came of a scene, so far or at last.
pub(super) struct Outcome {
    pub(super) play: Result<Prepared, Error>,
    /// Whether nothing more comes.
    pub(super) last: bool,
    /// Whether the local model came before, which stays when this is an error.
    pub(super) second: bool,
}

/// Bits of a random number that a seed has no use for: people read it, and may type it.
const SPARE_BITS: u32 = 40;

/// What the thread needs.
struct Work {
    scene: Scene,
    /// Of the variant, if the scene draws its numbers.
    seed: u64,
    resources: Resources,
    gpu: Gpu,
    context: egui::Context,
    told: Arc<Mutex<Option<Told>>>,
    given_up: Arc<AtomicBool>,
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
        let (tell, outcomes) = channel();
        let (told, given_up) = (Arc::default(), Arc::default());
        let work = Work {
            scene,
            seed: RandomState::new().hash_one(()) >> SPARE_BITS,
            resources: resources.clone(),
            gpu: gpu.clone(),
            context,
            told: Arc::clone(&told),
            given_up: Arc::clone(&given_up),
        };
        let refused = tell.clone();
        let started = std::thread::Builder::new().spawn(move || work.run(&tell));
        if let Err(error) = started {
            let cause = format!("the system gives no thread ({error}); close other programs");
            let _ = refused.send(Outcome {
                play: Err(Error::Window { cause }),
                last: true,
                second: false,
            });
        }
        Self {
            outcomes,
            told,
            given_up,
        }
    }

    /// What came of it; none yet while it lasts.
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

    /// How far it is, if that is known.
    pub(super) fn progress(&self) -> Option<Progress> {
        Some(self.told()?.progress)
    }

    /// The time that it still takes [s], if it goes on as until now; none before that can be said.
    pub(super) fn time_left(&self) -> Option<f64> {
        let told = self.told()?;
        let (since, from) = told.first;
        let elapsed = since.elapsed().as_secs_f64();
        time_left(elapsed, from, told.progress.part)
    }

    fn told(&self) -> Option<Told> {
        *self.told.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Preparation {
    fn drop(&mut self) {
        self.given_up.store(true, Ordering::Relaxed);
    }
}

impl Work {
    fn run(mut self, tell: &Sender<Outcome>) {
        // The touch goes on beside it.
        lower_priority();
        match draw_variant(&self.scene, self.seed) {
            Ok(variant) => self.scene = variant,
            Err(error) => {
                let _ = tell.send(Outcome {
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
            // What is felt until then is not what the scene says.
            local.written = None;
            let play = self.play(local);
            let last = play.is_err();
            // Nobody waits any more when the choice has changed since.
            let heard = tell.send(Outcome {
                play,
                last,
                second: false,
            });
            self.context.request_repaint();
            if last || heard.is_err() {
                return;
            }
        }
        let play = self.play(self.scene.clone());
        let _ = tell.send(Outcome {
            play,
            last: true,
            second,
        });
        self.context.request_repaint();
    }

    fn play(&self, scene: Scene) -> Result<Prepared, Error> {
        Prepared::of(scene, &self.resources, &self.gpu, &mut |progress| {
            let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
            *told = Some(match *told {
                // The local model came first, and the whole organ begins anew.
                Some(before) if progress.part >= before.progress.part => {
                    Told { progress, ..before }
                }
                _ => Told {
                    progress,
                    first: (Instant::now(), progress.part),
                },
            });
            match self.given_up.load(Ordering::Relaxed) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        })
    }
}

/// What is left [s] of work of which the part grew from `from` to `part` in `elapsed` [s], in steps that people count in.
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
