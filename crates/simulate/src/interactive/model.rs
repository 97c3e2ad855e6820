//! The model of a running touch, and its replacement: the local model comes first, and the organ-scale model replaces
//! it once it has been prepared in the background.
//!
//! The devices stay open and their loops keep running. Nothing is allocated, copied or freed on the model thread: it
//! swaps one box for the other and sends the old one back. Forces are off until every loop has seen the swap, and are
//! armed again with the new model.
//!
//! *How we know*: `take_over::…`.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

use palpate_devices::publisher::Publisher;
use palpate_servo::{Sample, Stage, Supervisor, latest};

use super::Snapshot;
use super::model_loop::DISPLAY;
use super::published::published_by;
use crate::{Error, Simulation, SimulationState, SimulationWorkspace};

/// A model with its state and scratch, and the outputs of its steps.
pub(super) struct Model {
    pub(super) simulation: Arc<Simulation>,
    pub(super) state: SimulationState,
    pub(super) workspace: SimulationWorkspace,
    /// One output for each viewer.
    pub(super) snapshots: Vec<latest::Sender<Snapshot>>,
}

/// A model that is ready to run. Making it copies the organ, so this happens off the model thread.
pub struct PreparedModel {
    pub(super) model: Box<Model>,
    pub(super) viewer: latest::Receiver<Snapshot>,
}

impl PreparedModel {
    /// `simulation` with its organ at rest.
    pub fn new(simulation: Arc<Simulation>) -> Self {
        let (snapshots, viewer) = latest::channel(&Snapshot::new(&simulation));
        let model = Box::new(Model {
            state: SimulationState::new(&simulation).show_every(DISPLAY),
            workspace: SimulationWorkspace::new(&simulation),
            snapshots: vec![snapshots],
            simulation,
        });
        Self { model, viewer }
    }

    /// The same, also published by these servers.
    pub(super) fn published_by(mut self, publishers: &[Publisher]) -> Self {
        for publisher in publishers {
            let shown = published_by(publisher, &self.model.simulation);
            self.model.snapshots.push(shown);
        }
        self
    }
}

/// The caller's end of a replacement.
pub(super) struct ReplacementSender {
    next: SyncSender<Box<Model>>,
    replaced: Receiver<Box<Model>>,
    /// The model that runs, or will within a moment.
    touched: Arc<Simulation>,
}

/// The model thread's end of a replacement, used between two steps.
pub(super) struct ReplacementReceiver {
    next: Receiver<Box<Model>>,
    replaced: SyncSender<Box<Model>>,
    supervisor: Supervisor,
    waiting: Option<Box<Model>>,
    /// Whether forces were on, or about to be, when the new model arrived.
    resumes: bool,
}

/// Both ends, for the session of `supervisor` with the model `touched`.
pub(super) fn replacement(
    touched: &Arc<Simulation>,
    supervisor: &Supervisor,
) -> (ReplacementSender, ReplacementReceiver) {
    let (next, waiting) = sync_channel(1);
    let (give_back, replaced) = sync_channel(1);
    let replacing = ReplacementSender {
        next,
        replaced,
        touched: touched.clone(),
    };
    let taking_over = ReplacementReceiver {
        next: waiting,
        replaced: give_back,
        supervisor: supervisor.clone(),
        waiting: None,
        resumes: false,
    };
    (replacing, taking_over)
}

impl ReplacementSender {
    /// Sends `prepared` to the model thread, and returns the viewer's end of its output.
    pub(super) fn replace(
        &mut self,
        prepared: PreparedModel,
    ) -> Result<latest::Receiver<Snapshot>, Error> {
        // A model that was replaced earlier is freed here, not on the model thread.
        while self.replaced.try_recv().is_ok() {}
        let PreparedModel { model, viewer } = prepared;
        let refused = |why| Error::NoTakeOver { why };
        if !have_one_touch(&self.touched, &model.simulation) {
            return Err(refused("its tools, step or scale of forces differ"));
        }
        let touched = model.simulation.clone();
        let sent = self.next.try_send(model);
        sent.map_err(|_| {
            refused("another model is just taking over, or the model thread has ended")
        })?;
        self.touched = touched;
        Ok(viewer)
    }
}

/// Whether the loops of one model fit the other.
fn have_one_touch(one: &Simulation, other: &Simulation) -> bool {
    let fulcrums = |simulation: &Simulation| -> Vec<_> {
        let tools = simulation.tools().iter();
        tools
            .map(|tool| (tool.name.clone(), tool.fulcrum))
            .collect()
    };
    one.step() == other.step()
        && one.force_scale() == other.force_scale()
        && one.hand_over() == other.hand_over()
        && fulcrums(one) == fulcrums(other)
}

impl ReplacementReceiver {
    /// The model that takes over now; none if there is none, or if a loop still displays a force of the old one,
    /// according to its last of `samples`.
    pub(super) fn next(&mut self, samples: &[Option<Sample>]) -> Option<Box<Model>> {
        if self.waiting.is_none() {
            self.waiting = Some(self.next.try_recv().ok()?);
            self.resumes = self.supervisor.state().allows_force();
            // A pause by a person stays.
            if self.resumes {
                self.supervisor.pause();
            }
        }
        let displays = |sample: &Sample| matches!(sample.stage, Stage::Ramping(_) | Stage::Live);
        if samples.iter().flatten().any(displays) {
            return None;
        }
        self.waiting.take()
    }

    /// Sends `old` away to be freed, and permits forces again, unless a person has `paused` meanwhile.
    pub(super) fn finish(&mut self, old: Box<Model>, paused: bool) {
        // There is capacity: the earlier replaced model was taken out when this one was sent.
        let _ = self.replaced.try_send(old);
        if self.resumes && !paused {
            self.supervisor.resume();
        }
    }
}
