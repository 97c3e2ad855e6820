//! The whole organ at large deformation: `model.kind = "nonlinear"`.
//!
//! ```text
//! surface ──fill, coarsen──▶ quadratic tetrahedra ──factors at rest──▶ NonlinearModel
//!                                                                          │
//! tips, jaws ──touch: loads, couplings──▶ one step of Newton's method ◀────┘
//!                                               │
//!                          forces ◀─────────────┴──▶ shape: the surface that is seen
//! ```
//!
//! A tip loads the surface around the place that it touches, wide enough for the elements to resolve it, and is in
//! series with what such a load leaves out of its own law, as with the hybrid model ([`TipField`]). Here it is so about
//! the present state: place, normal and frame go with the organ, and what the organ yields is solved anew in every step.
//! Jaws hold as a bonded flat tip of their faces' area does, and pull.
//!
//! *How we know*: `nonlinear::…`.
//!
//! Layers and inclusions are tissues of their own elements (`regions`).
//!
//! Neighbours that collide keep the organ out (`neighbours`); those that bend, and further organs, are pieces of the body
//! (`soft`).
//!
//! Shafts are in contact with what bends (`shafts`).
//!
//! Cavities are empty, under a pressure, or full of a fluid (`merged`).
//!
//! Cuts are slits in the elements (`slits`), which another thread makes (`cut_body`).
//!
//! *Limits*: quasi-static. A body that is nearly incompressible is taken with a Poisson's ratio of 0.49.
//!
//! [`TipField`]: palpate_mechanics::surface_response::TipField

mod anchor;
mod composition;
mod cut_body;
mod cut_thread;
mod filling;
mod hold;
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
mod soundness;
mod target;
mod touch;

use composition::{Composition, Filled};
use cut_body::FollowedCuts;
use cut_thread::CutThread;
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
use crate::preparation::{Progress, Work, tell};
use crate::regions::Regions;
use crate::shaft::Shaft;
use crate::simulation::Simulation;
use crate::tool::Tool;

/// Part of the time to make it that the tetrahedra take [-].
const FILLED: f64 = 0.5;

/// The same where the body touches itself: bodies push one another until they are in equilibrium.
const ITERATIONS_TOUCHING: usize = 8;
/// R of a load over the touching area's radius [-]: it then yields less than the tip itself.
const REACH_IN_RADII: f64 = 1.7;

/// An organ that bends. Built once.
#[derive(Debug, Clone)]
pub(crate) struct NonlinearOrgan {
    composition: Arc<Composition>,
    pub(crate) model: NonlinearModel,
    shown: EmbeddedPoints,
    skin: Skin,
    shaft_skin: ShaftSkin,
    /// How they touch one another, if anything does.
    touching: Option<TouchingBoundary>,
    /// The shown surface as the organ hangs under its weight, if it has any; of an organ without cuts.
    hangs: Option<(TriangleMesh, AabbTree)>,
    cuts: CutPaths,
}

/// Where the organ is, and what the tools do to it.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    state: NonlinearState,
    /// Whether it has come back to rest since it was touched.
    is_at_rest: bool,
    /// Steps on end in which nothing loads it and it does not come nearer to rest.
    late: u32,
    /// Per tool.
    loads: Vec<SpreadLoad>,
    /// Which piece each tool touched last.
    on: Vec<usize>,
    /// Which tools act on it; those that have let go, for so many steps more at most.
    is_loaded: Vec<bool>,
    lets_go: Vec<u32>,
    /// Elastic forces of the tools in the past, and how what they load was turned then.
    histories: Vec<ForceHistory>,
    turns: Vec<Rotation3<f64>>,
    /// Where the shaft of each tool is, and how far it may go before it may touch the body at rest [m].
    shafts: Vec<Option<Shaft>>,
    clear_of_shafts: Vec<f64>,
    pierced: Vec<Pierced>,
    cuts: FollowedCuts,
    /// With its cuts.
    pub(crate) organ: Arc<NonlinearOrgan>,
}

/// Scratch of its part in a step.
#[derive(Debug)]
pub(crate) struct NonlinearWorkspace {
    /// Which organ `own` is for.
    of: Arc<NonlinearOrgan>,
    own: OrganWorkspace,
    /// That for the organ without cuts, while `own` is for one with cuts, and what a reset has left of one with cuts.
    whole: Option<OrganWorkspace>,
    left: Option<OrganWorkspace>,
    thread: Option<CutThread>,
    /// Length of the cuts that change no force [m].
    closed: f64,
    targets: Vec<Option<target::Target>>,
    shafts: Vec<Option<ShaftMotion>>,
    /// Displacements of the shown vertices [m].
    shown: Vec<Vec3>,
}

/// What of it depends on the elements.
#[derive(Debug)]
struct OrganWorkspace {
    solver: Workspace,
    candidates: Candidates,
}

impl Body {
    /// `organ` at rest, which so many tools may touch.
    pub(crate) fn at_rest(organ: &Arc<NonlinearOrgan>, tools: usize) -> Self {
        Self {
            state: NonlinearState::at_rest(&organ.model, tools),
            is_at_rest: true,
            late: 0,
            loads: vec![organ.model.spread_load(); tools],
            on: vec![0; tools],
            is_loaded: vec![false; tools],
            lets_go: vec![0; tools],
            histories: vec![ForceHistory::default(); tools],
            turns: vec![Rotation3::identity(); tools],
            shafts: vec![None; tools],
            clear_of_shafts: vec![0.0; tools],
            pierced: vec![0; tools],
            cuts: FollowedCuts::default(),
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

    /// What to be careful about in the forces of cuts, as sentences.
    pub(crate) fn warnings(&self) -> Option<String> {
        let thread = self.thread.as_ref();
        if let Some(error) = thread.and_then(CutThread::error) {
            return Some(format!("the last cut changes no force: {error}"));
        }
        (self.closed > 0.0).then(|| match thread {
            None => "cuts change no force: the thread for them could not be started".to_owned(),
            Some(_) => format!(
                "{:.0} mm of the cuts are seen and do not change the force: they turn back within an element (raise `model.nodes`), or \
                 would cut a piece off, which nothing holds, or would open a cavity",
                1e3 * self.closed
            ),
        })
    }
}

/// What is beside the organ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beside<'a> {
    /// The tools that may touch it.
    pub(crate) tools: &'a [Tool],
    /// The neighbours that bend.
    pub(crate) soft: &'a [SoftBody],
    /// The rigid ones that keep it out.
    pub(crate) neighbours: &'a [Neighbour],
}

impl NonlinearOrgan {
    /// That of the organ of `scene` with this surface and its tissues, which is seen as `shown` together with the neighbours
    /// that bend; with warnings.
    pub(crate) fn new(
        scene: &Scene,
        shown: &Surface,
        tree: &AabbTree,
        surface: &Surface,
        regions: Regions,
        beside: Beside<'_>,
        watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<(Self, Vec<String>), Error> {
        tell(watch, Progress::begin(Work::Tetrahedra))?;
        let mut report = |part| {
            let (work, part) = (Work::Tetrahedra, FILLED * part);
            watch(Progress { work, part })
        };
        let (composition, warnings) =
            Composition::new(scene, shown, tree, surface, regions, beside, &mut report)?;
        let (work, part) = (Work::Factors, FILLED);
        tell(watch, Progress { work, part })?;
        let composition = Arc::new(composition);
        let (filled, cuts) = (&composition.filled, CutPaths::default());
        let mut organ = Self::of_pieces(&composition, filled, cuts, None)?;
        organ.hangs = composition.hangs(&organ.model, &organ.shown);
        Ok((organ, warnings))
    }

    /// That of the elements of its pieces: those of its composition, or what cuts made of those of the `whole` body; vertices of the shown surface go with
    /// the elements beside `cuts`.
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

    /// The shown surface and its boxes as the organ hangs under its weight and what presses in its cavities, if anything does.
    pub(crate) fn hangs(&self) -> Option<(&TriangleMesh, &AabbTree)> {
        self.hangs.as_ref().map(|(mesh, tree)| (mesh, tree))
    }

    /// Scratch of this organ for so many tools.
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
