use std::cell::Cell;

use palpate_mechanics::finite_elements::estimate;

use crate::ProgressCallback;

/// Reports the progress of a solver to a [`ProgressCallback`].
pub(crate) struct ProgressReporter<'a> {
    watch: &'a dyn ProgressCallback,
    /// The mesh that the solver is working on.
    mesh: Cell<Option<usize>>,
}

impl<'a> ProgressReporter<'a> {
    pub(crate) fn new(watch: &'a dyn ProgressCallback) -> Self {
        watch.report_step("preparing the mesh");
        Self {
            watch,
            mesh: Cell::new(None),
        }
    }

    /// Reports a step of the solver.
    pub(crate) fn at(&self, progress: estimate::Progress) {
        if self.mesh.replace(Some(progress.mesh)) != Some(progress.mesh) {
            self.watch.report_step(&match progress.mesh {
                0 => "coarsest mesh".to_owned(),
                finer => format!("mesh {}", finer + 1),
            });
        }
        self.watch.report_fraction(progress.part.clamp(0.0, 1.0));
    }
}
