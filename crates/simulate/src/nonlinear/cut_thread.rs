//! The thread that makes cut organs in the background of the steps.

use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

use palpate_geometry::{NodeId, Vec3};
use palpate_mechanics::nonlinear::{EmbeddedPoints, NonlinearState, SpreadLoad, StateTransfer};

use super::slits::{CLEARANCE, CutPaths};
use super::{NonlinearOrgan, OrganWorkspace};
use crate::Error;
use crate::cutting::{Cuts, CuttingModel};
use crate::simulation::Simulation;

/// Points below the surface are known within this distance of a cut [m], or within this many times the depth of the
/// deepest one [-].
const AROUND: f64 = 0.03;
const OF_DEPTH: f64 = 6.0;

/// Capacity for the points of the cuts: beyond, a step in which a blade is lifted allocates.
const CAPACITY: usize = 1024;

/// The parts of a body that depend on its elements.
pub(super) type ElementState = (NonlinearState, Vec<SpreadLoad>);

/// The data that a reset discards, until the other thread frees them.
pub(super) type Discarded = (ElementState, Arc<NonlinearOrgan>, Option<Arc<Rims>>);

/// The vertices that openings have added to the displayed surface, embedded in the elements.
#[derive(Debug)]
pub(super) struct Rims {
    pub(super) numbers: Vec<u32>,
    pub(super) embedded: EmbeddedPoints,
    /// The detached piece of each, from 1 on, or zero.
    pub(super) detached: Vec<u32>,
    pub(super) below: Below,
    /// Number of cuts that had begun at that time.
    pub(super) cuts: usize,
}

/// The points below the surface around the cuts, embedded in the elements: at each depth that a cut can have, one depth
/// after the other.
#[derive(Debug)]
pub(super) struct Below {
    /// The vertices above these points.
    pub(super) numbers: Vec<u32>,
    pub(super) rest: Vec<Vec3>,
    pub(super) embedded: EmbeddedPoints,
}

/// The cuts of an organ when they were requested.
#[derive(Debug, Clone, Default)]
pub(super) struct RequestedCuts {
    paths: CutPaths,
    /// The vertices of the openings: their numbers, their positions at rest [m], and the directions in which they open
    /// [-].
    rims: Vec<(u32, Vec3, Vec3)>,
    /// Number of cuts that had begun.
    begun: usize,
}

impl RequestedCuts {
    /// With capacity for the cuts of an organ with this number of displayed vertices.
    pub(super) fn with_capacity(vertices: usize) -> Self {
        Self {
            paths: CutPaths::with_capacity(CAPACITY),
            rims: Vec::with_capacity(vertices),
            begun: 0,
        }
    }

    /// Takes over `cuts`.
    pub(super) fn follow(&mut self, simulation: &Simulation, model: &CuttingModel, cuts: &Cuts) {
        self.paths.follow(model, cuts);
        self.rims.clear();
        self.rims.extend(cuts.openings(simulation));
        self.begun = cuts.begun();
    }

    /// Takes over `other`; nothing is allocated within the capacity.
    pub(super) fn copy(&mut self, other: &Self) {
        self.paths.copy(&other.paths);
        self.rims.clear();
        self.rims.extend_from_slice(&other.rims);
        self.begun = other.begun;
    }
}

/// A request for a cut organ, in the background of the steps.
pub(super) struct Job {
    pub(super) key: u64,
    pub(super) uncut: Arc<NonlinearOrgan>,
    pub(super) now: Arc<NonlinearOrgan>,
    pub(super) cuts: RequestedCuts,
    /// Depths that a cut can have [m].
    pub(super) depths: Vec<f64>,
    pub(super) tools: usize,
    /// The result, and whether a body uses it already.
    pub(super) ready: Option<Result<Ready, Error>>,
    pub(super) is_used: bool,
}

/// A cut organ, with all that a body needs to switch to it.
pub(super) struct Ready {
    pub(super) organ: Arc<NonlinearOrgan>,
    pub(super) transfer: StateTransfer,
    /// None once they are in use.
    pub(super) body: Option<ElementState>,
    pub(super) workspace: Option<OrganWorkspace>,
    pub(super) rims: Option<Arc<Rims>>,
    pub(super) rims_moved: Vec<Vec3>,
    pub(super) below: Vec<Vec3>,
    /// Data of earlier resets, to be freed.
    pub(super) discarded: Option<Discarded>,
    pub(super) discarded_workspace: Option<OrganWorkspace>,
    /// Total length of the cuts that stay closed [m].
    pub(super) closed: f64,
}

/// The thread that makes cut organs. It ends when this is dropped.
pub(super) struct CutThread {
    pub(super) jobs: SyncSender<Box<Job>>,
    /// Never contended: a workspace may be shared between threads, but only one steps it.
    done: Mutex<Receiver<Box<Job>>>,
    /// None while the thread has it.
    pub(super) job: Option<Box<Job>>,
}

impl std::fmt::Debug for CutThread {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("CutThread").finish_non_exhaustive()
    }
}

impl CutThread {
    /// For an organ with this number of tools; none if the system provides no thread.
    pub(super) fn start(whole: &Arc<NonlinearOrgan>, simulation: &Simulation) -> Option<Self> {
        let (jobs, queue) = sync_channel::<Box<Job>>(1);
        let (results, done) = sync_channel(1);
        let make = move || {
            for mut job in queue {
                // Its replaced data are freed here.
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
                uncut: Arc::clone(whole),
                now: Arc::clone(whole),
                cuts: RequestedCuts::with_capacity(simulation.surface.mesh().vertices().len()),
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

    /// The completed job, if there is one.
    pub(super) fn done(&mut self) -> Result<Box<Job>, TryRecvError> {
        let done = self.done.get_mut();
        done.unwrap_or_else(PoisonError::into_inner).try_recv()
    }
}

impl Job {
    /// Whether it made the organ with the cuts of this key for bodies of `now`, and no body uses it yet.
    pub(super) fn has_prepared(&self, key: u64, now: &Arc<NonlinearOrgan>) -> bool {
        let is_done = self.ready.is_some() && !self.is_used;
        is_done && self.key == key && Arc::ptr_eq(&self.now, now)
    }

    fn make(&self) -> Result<Ready, Error> {
        let (organ, closed) = match self.key {
            0 => (Arc::clone(&self.uncut), 0.0),
            _ => {
                let (organ, closed) = self.uncut.slit(&self.cuts.paths)?;
                (Arc::new(organ), closed)
            }
        };
        let openings = &self.cuts.rims;
        let places = openings.iter();
        let places: Vec<Vec3> = places
            .map(|(_, place, opens)| place + CLEARANCE * opens)
            .collect();
        let all = 0..organ.model.mesh().tetrahedra().len();
        let embedded = organ.model.embed(&places, all)?;
        let detached: Vec<u32> = embedded.free_pieces(&organ.model).collect();
        let rims = Rims {
            numbers: openings.iter().map(|(number, ..)| *number).collect(),
            below: self.below(&organ, &detached)?,
            detached,
            embedded,
            cuts: self.cuts.begun,
        };
        Ok(Ready {
            transfer: StateTransfer::new(&self.now.model, &organ.model)?,
            body: Some((
                NonlinearState::at_rest(&organ.model, self.tools),
                vec![organ.model.spread_load(); self.tools],
            )),
            workspace: Some(organ.workspace_of(self.tools)),
            rims_moved: vec![Vec3::zeros(); openings.len()],
            below: vec![Vec3::zeros(); rims.below.rest.len()],
            discarded: None,
            discarded_workspace: None,
            rims: Some(Arc::new(rims)),
            organ,
            closed,
        })
    }
}

impl Job {
    /// The points below the surface around the cuts of `organ`, as far as they are in the piece of their vertex; `detached` are the
    /// pieces of the openings' vertices.
    fn below(&self, organ: &NonlinearOrgan, detached: &[u32]) -> Result<Below, Error> {
        let (shown, tree) = (&organ.composition.shown, &organ.composition.tree);
        let deepest = self.depths.iter().copied().fold(0.0, f64::max);
        let reach = AROUND.min(OF_DEPTH * deepest);
        let on_rim = |number: u32| self.cuts.rims.iter().any(|(rim, ..)| *rim == number);
        let vertices = shown.mesh().vertices().iter().enumerate();
        let near = vertices.filter(|(number, place)| {
            self.cuts.paths.is_within(place, reach) && !on_rim(*number as u32)
        });
        let near = near.map(|(number, place)| PointBelow {
            number: number as u32,
            place: *place,
            aside: self.cuts.paths.aside(place) - place,
            normal: shown.vertex_normals()[number],
            piece: organ.detached.piece(NodeId(number as u32)),
        });
        let rims = self.cuts.rims.iter().zip(detached);
        let rims = rims.map(|((number, place, opens), piece)| {
            let nearest = tree.nearest(shown.mesh(), place);
            PointBelow {
                number: *number,
                place: *place,
                aside: CLEARANCE * opens,
                normal: shown.mesh().area_vector(nearest.triangle).normalize(),
                piece: *piece,
            }
        });
        let mut all: Vec<PointBelow> = near.chain(rims).collect();
        let (mut rest, mut embedded) = self.embed_below(organ, &all)?;
        let pieces = embedded.free_pieces(&organ.model);
        let mut is_own = vec![true; all.len()];
        for (piece, number) in pieces.zip((0..all.len()).cycle()) {
            is_own[number] &= piece == all[number].piece;
        }
        if is_own.contains(&false) {
            let mut is_own = is_own.into_iter();
            all.retain(|_| is_own.next().unwrap_or(true));
            (rest, embedded) = self.embed_below(organ, &all)?;
        }
        Ok(Below {
            numbers: all.iter().map(|own| own.number).collect(),
            embedded,
            rest,
        })
    }

    /// The points below `all` at rest [m], one depth after the other, embedded on their side of a cut.
    fn embed_below(
        &self,
        organ: &NonlinearOrgan,
        all: &[PointBelow],
    ) -> Result<(Vec<Vec3>, EmbeddedPoints), Error> {
        let depths = self.depths.iter();
        let pairs = depths.flat_map(|depth| all.iter().map(move |own| (own, *depth)));
        let rest: Vec<Vec3> = pairs
            .map(|(own, depth)| own.place - depth * own.normal)
            .collect();
        let asides = all.iter().map(|own| own.aside).cycle();
        let moved: Vec<Vec3> = rest.iter().zip(asides).map(|(at, by)| at + by).collect();
        let elements = 0..organ.model.mesh().tetrahedra().len();
        let embedded = organ.model.embed(&moved, elements)?;
        Ok((rest, embedded))
    }
}

/// A vertex with points below it: offset away from the cut by `aside`, to select the elements on its side [m].
struct PointBelow {
    number: u32,
    place: Vec3,
    aside: Vec3,
    normal: Vec3,
    /// The detached piece, from 1 on, or zero.
    piece: u32,
}
