//! A state that was kept.

use std::sync::Arc;

use pyo3::prelude::*;

use super::Model;
use super::stepper::{SavedState, Stepper};
use crate::failure::Failure;

/// A state of a simulation that was kept, to go on from there to the same bit.
#[pyclass(frozen, module = "palpate")]
pub(crate) struct Snapshot {
    model: Arc<Model>,
    course: SavedState,
}

impl Snapshot {
    pub(super) fn of(model: &Arc<Model>, stepper: &Stepper) -> Self {
        Self {
            model: model.clone(),
            course: stepper.course.clone(),
        }
    }

    /// Takes `stepper`, which is one of `model`, to what was kept.
    pub(super) fn restore(&self, model: &Arc<Model>, stepper: &mut Stepper) -> Result<(), Failure> {
        if !Arc::ptr_eq(model, &self.model) {
            return Err(Failure::input(
                "the snapshot is that of another simulation; take it back where it was taken, or to a batch of that one",
            ));
        }
        stepper.restore(model, self.course.clone());
        Ok(())
    }
}

#[pymethods]
impl Snapshot {
    /// When it was taken [s].
    #[getter]
    fn time(&self) -> f64 {
        self.course.clock.time
    }

    fn __repr__(&self) -> String {
        format!("<palpate.Snapshot at {:?} s>", self.time())
    }
}
