use std::cell::Cell;

use palpate_mechanics::finite_elements::estimate;

use crate::Watch;

/// Tells who waits how far a solver is.
pub(crate) struct Telling<'a> {
    watch: &'a dyn Watch,
    /// Halvings of the mesh that is being solved.
    halvings: Cell<Option<u32>>,
}

impl<'a> Telling<'a> {
    pub(crate) fn to(watch: &'a dyn Watch) -> Self {
        watch.say("preparing the mesh");
        Self {
            watch,
            halvings: Cell::new(None),
        }
    }

    /// What a solver tells.
    pub(crate) fn at(&self, progress: estimate::Progress) {
        if self.halvings.replace(Some(progress.halvings)) != Some(progress.halvings) {
            self.watch.say(&match progress.halvings {
                0 => "coarsest mesh".to_owned(),
                1 => "elements halved once".to_owned(),
                times => format!("elements halved {times} times"),
            });
        }
        self.watch.at(progress.part.clamp(0.0, 1.0));
    }
}
