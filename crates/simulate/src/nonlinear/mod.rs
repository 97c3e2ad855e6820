//! The nonlinear model, an organ at large deformation: `model.kind = "nonlinear"`.
//!
//! ```text
//! surface ──fill, coarsen──▶ quadratic tetrahedra ──factors at rest──▶ NonlinearModel
//!                                                                          │
//! tips, jaws ──touch: loads, couplings──▶ one step of Newton's method ◀────┘
//!                                               │
//!                          forces ◀─────────────┴──▶ shape: the displayed surface
//! ```
//!
//! A tip loads the surface around its contact, wide enough for the elements to resolve it, in series with the
//! difference between its own law and such a load, as in the hybrid model ([`TipField`]). Here this applies in the
//! present state: contact location, normal and frame move with the organ, and its compliance is computed anew in every
//! step. Jaws hold tissue like a bonded flat tip with the area of their faces, and pull.
//!
//! *How we know*: `nonlinear::…`.
//!
//! Layers and inclusions are tissues of their own elements (`regions`).
//!
//! Neighbours that collide stop the organ (`neighbours`); those that bend, and further organs, are pieces of the body
//! (`soft`).
//!
//! Shafts are in contact with the pieces of the body (`shafts`).
//!
//! Cavities are empty, under a pressure, or full of a fluid (`merged`).
//!
//! Cuts are slits in the elements (`slits`), which another thread makes (`cut_body`). They may detach pieces (`detached`).
//!
//! *Limits*: quasi-static. A nearly incompressible body has a Poisson's ratio of 0.49.
//!
//! [`TipField`]: palpate_mechanics::surface_response::TipField

mod anchor;
mod composition;
mod cut_body;
mod cut_thread;
mod detached;
mod filling;
mod grasp;
mod hollow;
mod local_compliance;
mod merged;
mod mesh_warnings;
mod moved;
mod neighbours;
mod regions;
mod rim;
mod shaft_skin;
mod shafts;
mod shape;
mod slits;
mod soft;
mod target;
mod touch;
mod validity;

use composition::{Composition, Filled};
use cut_body::FollowedCuts;
use cut_thread::CutThread;
use detached::Detached;
pub(crate) use detached::is_within_one;
use merged::Merged;
pub(crate) use moved::Moved;
use neighbours::{Candidates, Skin};
use shaft_skin::ShaftSkin;
pub(crate) use shafts::Pushed;
use shafts::{Pierced, ShaftMotion};
use slits::CutPaths;
pub(crate) use soft::SoftBody;

use std::ops::ControlFlow;
use std::sync::Arc;

use nalgebra::Rotation3;
use palpate_files::Scene;
use palpate_geometry::{AabbTree, Surface, TriangleMesh, Vec3};
use palpate_mechanics::ForceHistory;
use palpate_mechanics::nonlinear::{
    EmbeddedPoints, NonlinearModel, NonlinearState, SpreadLoad, TouchingBoundary, Workspace,
};

use crate::Error;
use crate::grip::Swept;
use crate::neighbour::Neighbour;
use crate::preparation::{Progress, Work, report_progress};
use crate::regions::Regions;
use crate::shaft::Shaft;
use crate::simulation::Simulation;
use crate::tool::Tool;

/// Part of the preparation time that the tetrahedra take [-].
const FILLED: f64 = 0.5;

/// The same for a body in contact with itself: its parts push one another until they are in equilibrium.
const ITERATIONS_TOUCHING: usize = 8;
/// R of a load over the radius of the contact area [-]: it then yields less than the tip itself.
const REACH_IN_RADII: f64 = 1.7;

/// An organ of the nonlinear model. Built once.
#[derive(Debug, Clone)]
pub(crate) struct NonlinearOrgan {
    composition: Arc<Composition>,
    pub(crate) model: NonlinearModel,
    shown: EmbeddedPoints,
    skin: Skin,
    shaft_skin: ShaftSkin,
    /// The contact of its pieces with one another, if there is any.
    touching: Option<TouchingBoundary>,
    /// The displayed surface as the organ hangs under its weight, if it has any; for an organ without cuts.
    hangs: Option<(TriangleMesh, AabbTree)>,
    cuts: CutPaths,
    /// The pieces of the displayed surface that the cuts have detached.
    detached: Detached,
}

/// The state of the organ, and of the tools on it.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    state: NonlinearState,
    /// Whether it has returned to rest since it was touched.
    is_at_rest: bool,
    /// Successive steps in which nothing loads it and it does not approach rest.
    stalled: u32,
    /// The load of each tool.
    loads: Vec<SpreadLoad>,
    /// The piece that each tool touched last.
    on: Vec<usize>,
    /// Which tools act on it, and for how many more steps a released tool still does.
    is_loaded: Vec<bool>,
    release_steps: Vec<u32>,
    /// Past elastic forces of the tools, and the rotation of their loads at that time.
    histories: Vec<ForceHistory>,
    turns: Vec<Rotation3<f64>>,
    /// The shaft of each tool, and how far it may move before it may touch the body at rest [m].
    shafts: Vec<Option<Shaft>>,
    clear_of_shafts: Vec<f64>,
    pierced: Vec<Pierced>,
    cuts: FollowedCuts,
    /// The organ with its cuts.
    pub(crate) organ: Arc<NonlinearOrgan>,
}

/// Scratch of the nonlinear model in a step.
#[derive(Debug)]
pub(crate) struct NonlinearWorkspace {
    /// The organ to which `own` belongs.
    of: Arc<NonlinearOrgan>,
    own: OrganWorkspace,
    /// Scratch for the organ without cuts, while `own` is for one with cuts, and the scratch of one with cuts after a
    /// reset.
    whole: Option<OrganWorkspace>,
    left: Option<OrganWorkspace>,
    thread: Option<CutThread>,
    /// Total length of the cuts that change no force [m].
    closed: f64,
    targets: Vec<Option<target::Target>>,
    shafts: Vec<Option<ShaftMotion>>,
    /// Displacements of the displayed vertices [m].
    shown: Vec<Vec3>,
}

/// The part of the scratch that depends on the elements.
#[derive(Debug)]
struct OrganWorkspace {
    solver: Workspace,
    candidates: Candidates,
}

impl Body {
    /// `organ` at rest, for this number of tools.
    pub(crate) fn at_rest(organ: &Arc<NonlinearOrgan>, tools: usize) -> Self {
        let vertices = organ.shown.len();
        Self {
            state: NonlinearState::at_rest(&organ.model, tools),
            is_at_rest: true,
            stalled: 0,
            loads: vec![organ.model.spread_load(); tools],
            on: vec![0; tools],
            is_loaded: vec![false; tools],
            release_steps: vec![0; tools],
            histories: vec![ForceHistory::default(); tools],
            turns: vec![Rotation3::identity(); tools],
            shafts: vec![None; tools],
            clear_of_shafts: vec![0.0; tools],
            pierced: vec![0; tools],
            cuts: FollowedCuts::with_capacity(vertices),
            organ: Arc::clone(organ),
        }
    }
}

impl Body {
    /// The pressures in its cavities [Pa].
    pub(crate) fn cavity_pressures(&self) -> impl Iterator<Item = f64> {
        let numbers = 0..self.organ.cavities().count();
        numbers.map(|number| self.state.cavity_pressure(number))
    }

    /// The volumes of its cavities [m³].
    pub(crate) fn cavity_volumes(&self) -> impl Iterator<Item = f64> {
        let numbers = 0..self.organ.cavities().count();
        numbers.map(|number| self.organ.model.cavity_volumes(&self.state, number)[0])
    }
}

impl NonlinearWorkspace {
    pub(crate) fn new(organ: &Arc<NonlinearOrgan>, simulation: &Simulation) -> Self {
        let tools = simulation.tools.len();
        let thread = simulation.forces_follow_cuts();
        Self {
            own: organ.workspace_of(tools),
            of: Arc::clone(organ),
            whole: None,
            left: None,
            thread: thread
                .then(|| CutThread::start(organ, simulation))
                .flatten(),
            closed: 0.0,
            targets: vec![None; tools],
            shafts: vec![None; tools],
            shown: vec![Vec3::zeros(); organ.shown.len()],
        }
    }

    /// Warnings about the forces of cuts, as sentences.
    pub(crate) fn warnings(&self) -> Option<String> {
        let thread = self.thread.as_ref();
        if let Some(error) = thread.and_then(CutThread::error) {
            return Some(format!("the last cut changes no force: {error}"));
        }
        (self.closed > 0.0).then(|| match thread {
            None => "cuts change no force: the thread for them could not be started".to_owned(),
            Some(_) => format!(
                "{:.0} mm of the cuts are seen and do not change the force: they turn back within an element (raise `model.nodes`), or \
                 would open a cavity",
                1e3 * self.closed
            ),
        })
    }
}

/// The bodies around the organ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactBodies<'a> {
    /// The tools that may touch it.
    pub(crate) tools: &'a [Tool],
    /// The neighbours that bend.
    pub(crate) soft: &'a [SoftBody],
    /// The rigid ones that stop it.
    pub(crate) neighbours: &'a [Neighbour],
}

impl NonlinearOrgan {
    /// The model of the organ of `scene` with this surface and its tissues, displayed as `shown` together with the
    /// neighbours that bend; with warnings.
    pub(crate) fn new(
        scene: &Scene,
        shown: &Surface,
        tree: &AabbTree,
        surface: &Surface,
        regions: Regions,
        contact_bodies: ContactBodies<'_>,
        on_progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(Self, Vec<String>), Error> {
        report_progress(on_progress, Progress::begin(Work::Tetrahedra))?;
        let mut report = |part| {
            let (work, part) = (Work::Tetrahedra, FILLED * part);
            on_progress(Progress { work, part })
        };
        let (composition, warnings) = Composition::new(
            scene,
            shown,
            tree,
            surface,
            regions,
            contact_bodies,
            &mut report,
        )?;
        let (work, part) = (Work::Factors, FILLED);
        report_progress(on_progress, Progress { work, part })?;
        let composition = Arc::new(composition);
        let (filled, cuts) = (&composition.filled, CutPaths::default());
        let mut organ = Self::of_pieces(&composition, filled, cuts, None)?;
        organ.hangs = composition.hangs(&organ.model, &organ.shown);
        Ok((organ, warnings))
    }

    /// The model from the elements of its pieces: those of its composition, or those that cuts made from the elements
    /// of the `whole` body; vertices of the displayed surface belong to the elements on their side of `cuts`.
    fn of_pieces(
        composition: &Arc<Composition>,
        filled: &[Filled],
        cuts: CutPaths,
        whole: Option<&NonlinearModel>,
    ) -> Result<Self, Error> {
        let merged = Merged::new(filled, &composition.pieces)?;
        let model = composition.model(&merged, whole)?;
        let Composition {
            shown,
            tree,
            neighbours,
            pieces,
            ..
        } = &**composition;
        let embedded = composition.embed(&model, &merged, |place| cuts.aside(place))?;
        Ok(Self {
            shaft_skin: ShaftSkin::new(&model, shown, tree, pieces),
            skin: Skin::new(&model, shown, tree, neighbours),
            hangs: None,
            touching: composition.touching(&model, &merged)?,
            detached: Detached::new(&model, &embedded),
            shown: embedded,
            model,
            composition: Arc::clone(composition),
            cuts,
        })
    }

    /// The names of its cavities.
    pub(crate) fn cavities(&self) -> impl Iterator<Item = &str> {
        let pieces = self.composition.pieces.iter();
        let cavities = pieces.flat_map(|piece| &piece.regions.cavities);
        cavities.map(|own| own.name.as_str())
    }

    /// The displayed surface and its boxes as the organ hangs under its weight and the pressures in its cavities, if
    /// there are any.
    pub(crate) fn hangs(&self) -> Option<(&TriangleMesh, &AabbTree)> {
        self.hangs.as_ref().map(|(mesh, tree)| (mesh, tree))
    }

    /// Scratch of this organ for this number of tools.
    fn workspace_of(&self, tools: usize) -> OrganWorkspace {
        OrganWorkspace {
            solver: self.model.workspace(tools),
            candidates: Candidates::new(self, tools),
        }
    }
}

/// Radius of a disc with the area of a jaw's face [m].
fn jaws_radius(tool: &Tool) -> Option<f64> {
    let face = Swept::face(&tool.jaws?);
    Some((face / std::f64::consts::PI).sqrt())
}
