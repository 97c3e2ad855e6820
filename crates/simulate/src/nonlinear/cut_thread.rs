//! The thread that makes cut organs while steps go on.

use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

use palpate_geometry::Vec3;
use palpate_mechanics::nonlinear::{EmbeddedPoints, NonlinearState, SpreadLoad, StateTransfer};

use super::slits::{ASIDE, CutPaths};
use super::{NonlinearOrgan, OrganWorkspace};
use crate::Error;
use crate::simulation::Simulation;

/// What lies below the surface is known within this distance of a cut [m], or so many times the depth of the deepest one [-].
const AROUND: f64 = 0.03;
const OF_DEPTH: f64 = 6.0;

/// Room for the points of the cuts: beyond, a step in which a blade is lifted allocates.
const ROOM: usize = 1024;

/// What of a body depends on its elements.
pub(super) type OfElements = (NonlinearState, Vec<SpreadLoad>);

/// What a reset leaves, until the other thread frees it.
pub(super) type Left = (OfElements, Arc<NonlinearOrgan>, Option<Arc<Rims>>);

/// The vertices that openings have added to the shown surface, in the elements.
#[derive(Debug)]
pub(super) struct Rims {
    pub(super) numbers: Vec<u32>,
    pub(super) embedded: EmbeddedPoints,
    pub(super) below: Below,
    /// How many cuts there were.
    pub(super) cuts: usize,
}

/// What lies below the surface around the cuts, in the elements: at each depth that a cut can have, one depth after the other.
#[derive(Debug)]
pub(super) struct Below {
    /// The vertices that it is below.
    pub(super) numbers: Vec<u32>,
    pub(super) rest: Vec<Vec3>,
    pub(super) embedded: EmbeddedPoints,
}

/// An organ that is made while steps go on.
pub(super) struct Job {
    pub(super) key: u64,
    pub(super) whole: Arc<NonlinearOrgan>,
    pub(super) now: Arc<NonlinearOrgan>,
    pub(super) paths: CutPaths,
    /// The vertices of the openings: their numbers, where they are at rest [m], and where to they open [-]; and how many cuts there are.
    pub(super) rims: Vec<(u32, Vec3, Vec3)>,
    pub(super) cuts: usize,
    /// Depths that a cut can have [m].
    pub(super) depths: Vec<f64>,
    pub(super) tools: usize,
    /// What came of it, and whether a body has gone over to it.
    pub(super) ready: Option<Result<Ready, Error>>,
    pub(super) is_used: bool,
}

/// A cut organ, and all that a body needs to go over to it.
pub(super) struct Ready {
    pub(super) organ: Arc<NonlinearOrgan>,
    pub(super) transfer: StateTransfer,
    /// None once they are in use.
    pub(super) body: Option<OfElements>,
    pub(super) workspace: Option<OrganWorkspace>,
    pub(super) rims: Option<Arc<Rims>>,
    pub(super) rims_moved: Vec<Vec3>,
    pub(super) below: Vec<Vec3>,
    /// What resets have left.
    pub(super) left: Option<Left>,
    pub(super) left_workspace: Option<OrganWorkspace>,
    /// Length of cuts that stay closed [m].
    pub(super) closed: f64,
}

/// The thread that makes cut organs. It ends with what holds this.
pub(super) struct CutThread {
    pub(super) jobs: SyncSender<Box<Job>>,
    /// Never locked: a workspace may be shared between threads, and is stepped by one.
    done: Mutex<Receiver<Box<Job>>>,
    /// None while it is on its way.
    pub(super) job: Option<Box<Job>>,
}

impl std::fmt::Debug for CutThread {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("CutThread").finish_non_exhaustive()
    }
}

impl CutThread {
    /// For an organ with so many tools; none where no thread can be had.
    pub(super) fn start(whole: &Arc<NonlinearOrgan>, simulation: &Simulation) -> Option<Self> {
        let (jobs, queue) = sync_channel::<Box<Job>>(1);
        let (results, done) = sync_channel(1);
        let make = move || {
            for mut job in queue {
                // What it replaced is freed here.
                job.ready = None;
                job.ready = Some(job.make());
                if results.send(job).is_err() {
                    break;
                }
            }
        };
        let thread = std::thread::Builder::new().name("palpate-cuts".to_owned());
        thread.spawn(make).ok()?;
        Some(Self {
            jobs,
            done: Mutex::new(done),
            job: Some(Box::new(Job {
                key: 0,
                whole: Arc::clone(whole),
                now: Arc::clone(whole),
                paths: CutPaths::with_room(ROOM),
                rims: Vec::with_capacity(simulation.surface.mesh().vertices().len()),
                cuts: 0,
                depths: simulation.cut_depths(),
                tools: simulation.tools.len(),
                ready: None,
                is_used: false,
            })),
        })
    }
}

impl CutThread {
    /// Why the last organ could not be made.
    pub(super) fn error(&self) -> Option<&Error> {
        self.job.as_ref()?.ready.as_ref()?.as_ref().err()
    }

    /// The job that is done, if one is.
    pub(super) fn done(&mut self) -> Result<Box<Job>, TryRecvError> {
        let done = self.done.get_mut();
        done.unwrap_or_else(PoisonError::into_inner).try_recv()
    }
}

impl Job {
    /// Whether it made the organ with the cuts of this key for bodies of `now`, which none has gone over to yet.
    pub(super) fn made(&self, key: u64, now: &Arc<NonlinearOrgan>) -> bool {
        let is_done = self.ready.is_some() && !self.is_used;
        is_done && self.key == key && Arc::ptr_eq(&self.now, now)
    }

    fn make(&self) -> Result<Ready, Error> {
        let (organ, closed) = match self.key {
            0 => (Arc::clone(&self.whole), 0.0),
            _ => {
                let (organ, closed) = self.whole.slit(&self.paths)?;
                (Arc::new(organ), closed)
            }
        };
        let places = self.rims.iter();
        let places: Vec<Vec3> = places
            .map(|(_, place, opens)| place + ASIDE * opens)
            .collect();
        let all = 0..organ.model.mesh().tetrahedra().len();
        let rims = Rims {
            numbers: self.rims.iter().map(|(number, ..)| *number).collect(),
            embedded: organ.model.embed(&places, all)?,
            below: self.below(&organ)?,
            cuts: self.cuts,
        };
        Ok(Ready {
            transfer: StateTransfer::new(&self.now.model, &organ.model)?,
            body: Some((
                NonlinearState::at_rest(&organ.model, self.tools),
                vec![organ.model.spread_load(); self.tools],
            )),
            workspace: Some(organ.workspace_of(self.tools)),
            rims_moved: vec![Vec3::zeros(); self.rims.len()],
            below: vec![Vec3::zeros(); rims.below.rest.len()],
            left: None,
            left_workspace: None,
            rims: Some(Arc::new(rims)),
            organ,
            closed,
        })
    }
}

impl Job {
    /// What lies below the surface around the cuts of `organ`.
    fn below(&self, organ: &NonlinearOrgan) -> Result<Below, Error> {
        let (shown, tree) = (&organ.composition.shown, &organ.composition.tree);
        let deepest = self.depths.iter().copied().fold(0.0, f64::max);
        let reach = AROUND.min(OF_DEPTH * deepest);
        let on_rim = |number: u32| self.rims.iter().any(|(rim, ..)| *rim == number);
        let vertices = shown.mesh().vertices().iter().enumerate();
        let near = vertices.filter(|(number, place)| {
            self.paths.is_within(place, reach) && !on_rim(*number as u32)
        });
        let near = near.map(|(number, place)| PointBelow {
            number: number as u32,
            place: *place,
            aside: self.paths.aside(place) - place,
            normal: shown.vertex_normals()[number],
        });
        let rims = self.rims.iter().map(|(number, place, opens)| {
            let nearest = tree.nearest(shown.mesh(), place);
            PointBelow {
                number: *number,
                place: *place,
                aside: ASIDE * opens,
                normal: shown.mesh().area_vector(nearest.triangle).normalize(),
            }
        });
        let all: Vec<PointBelow> = near.chain(rims).collect();
        let depths = self.depths.iter();
        let pairs = depths.flat_map(|depth| all.iter().map(move |own| (own, *depth)));
        let rest: Vec<Vec3> = pairs
            .map(|(own, depth)| own.place - depth * own.normal)
            .collect();
        let asides = all.iter().map(|own| own.aside).cycle();
        let moved: Vec<Vec3> = rest.iter().zip(asides).map(|(at, by)| at + by).collect();
        let elements = 0..organ.model.mesh().tetrahedra().len();
        Ok(Below {
            numbers: all.iter().map(|own| own.number).collect(),
            embedded: organ.model.embed(&moved, elements)?,
            rest,
        })
    }
}

/// A vertex below which there is more: away from the cut by `aside` are the elements that it goes with [m].
struct PointBelow {
    number: u32,
    place: Vec3,
    aside: Vec3,
    normal: Vec3,
}
