//! The simulator: one immutable model, and any number of states that are stepped by it.
//!
//! ```text
//! Simulation ─┐                ┌─ Stepper (state, workspace, clock, score)
//!             ├─ Arc<Model> ───┤
//! SimulationBatch ─────────────┼─ Stepper, Stepper, … on several threads
//! Teleoperation ───────────────┴─ Interaction (devices, their loops, the model's thread)
//! ```
//!
//! *How we know*: `tests/test_simulation.py`, `tests/test_batch.py`; what a step costs beyond Rust's own:
//! `benches/overhead.py`.
//!
//! *Limits*: a simulation, or a batch, is stepped by one thread at a time; another one that tries meanwhile gets
//! Python's `RuntimeError`.

mod batch;
pub(crate) mod camera;
pub(crate) mod poses;
mod renderer;
mod resources;
pub(crate) mod score;
mod single;
mod snapshot;
mod state;
mod stepper;
mod steps;
mod teleoperation;

use std::ops::ControlFlow;
use std::sync::Arc;

use palpate_files::Scene;
use palpate_simulate::Simulation as Prepared;
use pyo3::prelude::*;

use crate::failure::Failure;
use crate::waiting::waiting;

pub(crate) use batch::SimulationBatch;
pub(crate) use camera::Camera;
pub(crate) use renderer::Renderer;
pub(crate) use single::Simulation;
pub(crate) use snapshot::Snapshot;
pub(crate) use state::State;
pub(crate) use teleoperation::Teleoperation;

/// What was prepared of a scene.
pub(crate) struct Model {
    pub(crate) scene: Scene,
    pub(crate) prepared: Arc<Prepared>,
}

impl Model {
    /// Prepares `scene`; Ctrl-C breaks it off.
    fn prepare(
        py: Python<'_>,
        scene: &Scene,
        resources: palpate_simulate::Resources,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Arc<Self>> {
        let scene = scene.clone();
        waiting(py, progress, move |told| {
            told.say("preparing the organ and its model");
            let prepared = Prepared::prepare(&scene, &resources, &mut |progress| {
                told.say(progress.work.words());
                told.at(progress.part);
                match told.should_stop() {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            })?;
            let prepared = Arc::new(prepared);
            Ok::<_, Failure>(Arc::new(Self { scene, prepared }))
        })
    }
}
