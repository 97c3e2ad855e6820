use std::cell::Cell;

use palpate_mechanics::finite_elements::estimate;

use crate::failure::Failure;
use crate::interrupt;
use crate::output;
use crate::progress::{Progress, Reader};

/// Steps of the bar.
const STEPS: u64 = 1000;

/// Tells who waits how far a solution has come; Ctrl-C ends it without leaving half a file.
pub(super) struct Waiting {
    bar: Progress,
    /// Halvings of the mesh that is being solved.
    halvings: Cell<Option<u32>>,
}

impl Waiting {
    pub(super) fn new(reader: Reader) -> Self {
        interrupt::ends_between_files(|| {
            output::error(&Failure::failed("interrupted; no answer was found"));
        });
        let bar = Progress::new(reader, Some(STEPS));
        bar.say("preparing the mesh");
        Self {
            bar,
            halvings: Cell::new(None),
        }
    }

    /// What a solver tells.
    pub(super) fn at(&self, progress: estimate::Progress) {
        if self.halvings.replace(Some(progress.halvings)) != Some(progress.halvings) {
            self.bar.say(match progress.halvings {
                0 => "coarsest mesh".to_owned(),
                1 => "elements halved once".to_owned(),
                times => format!("elements halved {times} times"),
            });
        }
        self.bar
            .at((progress.part.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }
}
