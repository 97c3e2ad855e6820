//! Cuts in the elements: another thread makes the elements of the cut organ, and the body switches to them.
//!
//! ```text
//! cuts ──▶ RequestedCuts ──▶ thread: slits, factors at rest ──▶ Ready ──after the delay──▶ body, workspace
//! ```
//!
//! The body switches a stated time after the request, whatever time the computer needs: a motion has the same forces on all
//! computers. A step waits for the other thread if that is not ready by then. A cut in progress is requested over and over,
//! each time as far as it has come.

use std::sync::Arc;
use std::sync::mpsc::TryRecvError;
use std::time::Duration;

use palpate_geometry::Vec3;

use super::cut_thread::{Below, Discarded, ElementState, Job, Ready, RequestedCuts, Rims};
use super::slits::key;
use super::target::Now;
use super::{Body, NonlinearOrgan, NonlinearWorkspace, REACH_IN_RADII, jaws_radius};
use crate::cutting::Cuts;
use crate::grip::Grasped;
use crate::simulation::Simulation;
use crate::state::{SimulationState, ToolState};

/// Delay from the request for a cut to the change of the forces, for an organ of a thousand nodes [s]. The time for its
/// factorization grows with a power of their number.
const DELAY: f64 = 0.4;
const POWER: f64 = 1.5;

/// Polling interval of a step that waits for the other thread.
const LOOKS_EVERY: Duration = Duration::from_micros(200);

/// Requested cuts that are not in the elements yet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pending {
    key: u64,
    /// Remaining delay [s].
    left: f64,
}

/// The cuts in a body's elements, and the pending ones.
#[derive(Debug, Clone, Default)]
pub(super) struct FollowedCuts {
    /// Key of its cuts: zero without any.
    key: u64,
    pending: Option<Pending>,
    requested: RequestedCuts,
    /// Version of the cuts at the last check.
    version: u64,
    /// Vertices of the openings, and their displacements [m].
    rims: Option<Arc<Rims>>,
    rims_moved: Vec<Vec3>,
    /// Positions of the points below the surface around the cuts [m].
    below: Vec<Vec3>,
    /// The body without cuts, while it has some, and the body with the cuts before a reset: so neither allocates nor
    /// frees.
    whole: Option<ElementState>,
    left: Option<Discarded>,
}

impl FollowedCuts {
    /// With capacity for requests about an organ with this number of displayed vertices.
    pub(super) fn with_capacity(vertices: usize) -> Self {
        Self {
            requested: RequestedCuts::with_capacity(vertices),
            ..Self::default()
        }
    }

    fn is_uncut(simulation: &Simulation, organ: &Arc<NonlinearOrgan>) -> bool {
        let whole = simulation.nonlinear.as_ref();
        whole.is_some_and(|whole| Arc::ptr_eq(whole, organ))
    }
}

impl Body {
    /// Removes the cuts of `organ`, which is intact again.
    pub(super) fn forget_cuts(&mut self, organ: &Arc<NonlinearOrgan>) {
        self.cuts.key = 0;
        self.cuts.pending = None;
        let rims = self.cuts.rims.take();
        if let Some((state, loads)) = self.cuts.whole.take() {
            let before = std::mem::replace(&mut self.organ, Arc::clone(organ));
            let state = std::mem::replace(&mut self.state, state);
            let loads = std::mem::replace(&mut self.loads, loads);
            self.cuts.left = Some(((state, loads), before, rims));
        }
    }

    /// The vertices of the openings that the elements move, and their displacements [m].
    pub(crate) fn rims(&self) -> impl Iterator<Item = (u32, Vec3)> {
        let own = self.cuts.rims.iter();
        let own = own.flat_map(|rims| rims.numbers.iter().zip(&self.cuts.rims_moved));
        own.map(|(number, by)| (*number, *by))
    }

    /// The vertices around the cuts, and the positions of the points below them [m]: at each depth that a cut can have,
    /// one after the other.
    pub(crate) fn below(&self) -> (&[u32], &[Vec3]) {
        match &self.cuts.rims {
            Some(rims) => (&rims.below.numbers, &self.cuts.below),
            None => (&[], &[]),
        }
    }

    /// Moves the vertices of the openings, and the points below, with the elements.
    pub(super) fn move_rims(&mut self) {
        if let Some(rims) = &self.cuts.rims {
            let displacements = rims.embedded.displacements(&self.state);
            for (own, by) in self.cuts.rims_moved.iter_mut().zip(displacements) {
                *own = by;
            }
            let Below { rest, embedded, .. } = &rims.below;
            let each = rest.iter().zip(embedded.displacements(&self.state));
            for (own, (place, by)) in self.cuts.below.iter_mut().zip(each) {
                *own = place + by;
            }
        }
    }
}

impl NonlinearWorkspace {
    /// Switches the organ to its pending cuts when they are due.
    pub(crate) fn follow_cuts(
        &mut self,
        simulation: &Simulation,
        elapsed: f64,
        state: &mut SimulationState,
    ) {
        let SimulationState {
            tools, body, cuts, ..
        } = state;
        let Some(body) = body else {
            return;
        };
        self.fit(simulation, body);
        let Some(cuts) = cuts.as_mut().filter(|_| simulation.forces_follow_cuts()) else {
            return;
        };
        body.request_cuts(simulation, cuts);
        let Some(pending) = &mut body.cuts.pending else {
            return;
        };
        pending.left -= elapsed;
        let pending = *pending;
        if pending.left > 0.0 {
            self.begin(simulation, &pending, body);
            return;
        }
        let made = self.finished(simulation, &pending, body);
        body.cuts.pending = None;
        body.cuts.key = pending.key;
        let Some(mut job) = made else {
            self.closed = cuts.length();
            return;
        };
        match &mut job.ready {
            Some(Ok(ready)) => {
                self.closed = ready.closed;
                ready.replace(simulation, tools, body);
                self.replace(simulation, body, ready);
                body.discard_undone_rims(cuts);
                let rims = body.cuts.rims.iter().flat_map(|rims| {
                    let numbers = rims.numbers.iter().copied();
                    numbers.zip(rims.detached.iter().copied())
                });
                cuts.set_detached(body.organ.detached.of_vertices(), rims);
                state.energy.close();
            }
            _ => self.closed = cuts.length(),
        }
        job.is_used = true;
        if let Some(thread) = &mut self.thread {
            thread.job = Some(job);
        }
    }

    /// Requests the organ with these cuts, if its thread is free.
    fn begin(&mut self, simulation: &Simulation, cut: &Pending, body: &Body) {
        let (Some(thread), Some(whole)) = (&mut self.thread, &simulation.nonlinear) else {
            return;
        };
        if let Ok(job) = thread.done() {
            thread.job = Some(job);
        }
        let idle = &mut thread.job;
        let Some(mut job) = idle.take_if(|job| !job.has_prepared(cut.key, &body.organ)) else {
            return;
        };
        job.is_used = false;
        job.key = cut.key;
        job.uncut = Arc::clone(whole);
        job.now = Arc::clone(&body.organ);
        job.cuts.copy(&body.cuts.requested);
        // A thread that has ended returns nothing: the organ stays unchanged.
        let _ = thread.jobs.send(job);
    }

    /// Waits for the organ with these cuts; none without a thread.
    fn finished(
        &mut self,
        simulation: &Simulation,
        cut: &Pending,
        body: &Body,
    ) -> Option<Box<Job>> {
        loop {
            self.begin(simulation, cut, body);
            let thread = self.thread.as_mut()?;
            let Some(job) = thread.job.take() else {
                match thread.done() {
                    Ok(job) => thread.job = Some(job),
                    // Waiting in the channel would allocate.
                    Err(TryRecvError::Empty) => std::thread::sleep(LOOKS_EVERY),
                    Err(TryRecvError::Disconnected) => return None,
                }
                continue;
            };
            if job.has_prepared(cut.key, &body.organ) {
                return Some(job);
            }
            thread.job = Some(job);
        }
    }

    /// Switches to the scratch of the body's new organ.
    fn replace(&mut self, simulation: &Simulation, body: &Body, ready: &mut Ready) {
        let before = std::mem::replace(&mut self.of, Arc::clone(&body.organ));
        let Some(workspace) = ready.workspace.take() else {
            return;
        };
        let own = std::mem::replace(&mut self.own, workspace);
        if FollowedCuts::is_uncut(simulation, &before) {
            ready.workspace = self.whole.replace(own);
            ready.discarded_workspace = self.left.take();
        } else {
            ready.workspace = Some(own);
        }
    }

    /// Switches to scratch for the current organ of `body`.
    fn fit(&mut self, simulation: &Simulation, body: &Body) {
        if Arc::ptr_eq(&self.of, &body.organ) {
            return;
        }
        let is_whole = FollowedCuts::is_uncut(simulation, &body.organ);
        let own = match self.whole.take_if(|_| is_whole) {
            Some(own) => own,
            None => body.organ.workspace_of(body.loads.len()),
        };
        self.left = Some(std::mem::replace(&mut self.own, own));
        self.of = Arc::clone(&body.organ);
    }
}

impl Body {
    /// Requests the cuts that are not in the elements, one request at a time.
    fn request_cuts(&mut self, simulation: &Simulation, cuts: &Cuts) {
        self.discard_undone_rims(cuts);
        let own = &mut self.cuts;
        if own.version == cuts.version() || own.pending.is_some() {
            return;
        }
        own.version = cuts.version();
        let key = key(cuts);
        let nodes = self.organ.composition.nodes as f64 / 1e3;
        let left = DELAY * nodes.powf(POWER);
        own.pending = (key != own.key).then_some(Pending { key, left });
        if let (Some(_), Some(model)) = (own.pending, &simulation.cutting) {
            own.requested.follow(simulation, model, cuts);
        }
    }

    /// Forgets the vertices of openings that have been undone since.
    fn discard_undone_rims(&mut self, cuts: &Cuts) {
        let rims = &mut self.cuts.rims;
        rims.take_if(|rims| rims.cuts > cuts.begun());
    }
}

impl Ready {
    /// Switches a body to the completed organ; the replaced data stay in its place.
    fn replace(&mut self, simulation: &Simulation, tools: &mut [ToolState], body: &mut Body) {
        let (Some((mut state, mut loads)), Some(workspace)) =
            (self.body.take(), &mut self.workspace)
        else {
            return;
        };
        let (before, after) = (&body.organ.model, &self.organ.model);
        let solver = &mut workspace.solver;
        self.transfer
            .transfer(before, &body.state, after, &mut state, solver);
        std::mem::swap(&mut body.organ, &mut self.organ);
        std::mem::swap(&mut body.state, &mut state);
        std::mem::swap(&mut body.loads, &mut loads);
        if FollowedCuts::is_uncut(simulation, &self.organ) {
            self.body = body.cuts.whole.replace((state, loads));
            self.discarded = body.cuts.left.take();
        } else {
            self.body = Some((state, loads));
        }
        std::mem::swap(&mut body.cuts.rims, &mut self.rims);
        std::mem::swap(&mut body.cuts.rims_moved, &mut self.rims_moved);
        std::mem::swap(&mut body.cuts.below, &mut self.below);
        for (number, own) in tools.iter_mut().enumerate() {
            body.keep_holding(simulation, number, own);
        }
    }
}

impl Body {
    /// Jaws keep holding the same tissue, in other elements.
    fn keep_holding(&mut self, simulation: &Simulation, number: usize, own: &mut ToolState) {
        let tool = &simulation.tools[number];
        let (Some(hold), Some(radius)) = (&mut own.grip.grasp, jaws_radius(tool)) else {
            return;
        };
        let turned = *hold.turned();
        let place = hold.displayed.place;
        let Grasped::Area(area) = &mut hold.grasped else {
            return;
        };
        let organ = Arc::clone(&self.organ);
        let normal = area.frame.column(2).into_owned();
        let boundary = organ.model.boundary();
        boundary.spread(
            &place,
            &normal,
            REACH_IN_RADII * radius,
            &mut self.loads[number],
        );
        let now = Now::of(&organ, self, number);
        let compliance = organ.of_jaws(tool, number, &area.frame, self, &now);
        if let Some(compliance) = compliance {
            area.offset = turned.inverse() * -(compliance * (turned * area.force));
        }
    }
}
