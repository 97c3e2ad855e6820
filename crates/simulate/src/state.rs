use std::sync::Arc;

use palpate_files::Pose;
use palpate_files::scene::EstimatedInclusion;
use palpate_files::session::{Events, SessionRow};
use palpate_geometry::{AabbTree, NodeId, TriangleId, TriangleMesh, Vec3};
use palpate_mechanics::enhance::SurfacePoint;
use palpate_mechanics::finite_spheres::{FiniteSphereWorkspace, Response};
use palpate_mechanics::inclusion::InclusionField;
use palpate_mechanics::{ForceHistory, Limits};

use crate::contact::Clearance;
use crate::cutting::{Blade, Cuts};
use crate::energy::{EnergyAccount, Pressed};
use crate::global::{GlobalWorkspace, OrganField};
use crate::grip::Grip;
use crate::limits::LimitCounts;
use crate::neighbour::Stopped;
use crate::nonlinear::{Body, Moved, NonlinearOrgan, NonlinearWorkspace, Pushed};
use crate::{Contact, Error, Simulation};

/// All that a step changes.
#[derive(Debug, Clone)]
pub struct SimulationState {
    /// Per tool.
    pub tools: Vec<ToolState>,
    /// The organ as it is deformed now.
    pub deformed: TriangleMesh,
    /// What moved it, if the whole organ answers.
    pub whole: Option<OrganField>,
    /// Where the nonlinear model has it, if that answers.
    pub(crate) body: Option<Body>,
    /// Its cuts, if anything can cut it.
    pub cuts: Option<Cuts>,
    /// The inclusions whose effect is estimated.
    pub(crate) estimated: Arc<InclusionField>,
    /// The boxes around it.
    pub(crate) tree: AabbTree,
    /// The vertices that are not at rest.
    pub(crate) moved: MovedVertices,
    /// The least time between two shapes of a whole organ [s]; zero follows every step.
    pub(crate) show_every: f64,
    /// Whether the whole organ was shaped otherwise than at rest.
    pub(crate) shown_deformed: bool,
    /// When the whole organ was shaped last [s].
    pub(crate) shown_at: f64,
    /// The work of the tools on it.
    pub(crate) energy: EnergyAccount,
    /// When the cuts were last taken to where the organ is [s].
    pub(crate) cuts_shown_at: f64,
    /// Where tools touch neighbours, or how far they are from them; those of each tool one after the other.
    pub(crate) touched_neighbours: Vec<(Option<Contact>, Clearance)>,
}

/// Vertices, with room for all of the organ's, which a clone has as well: its steps allocate nothing either.
#[derive(Debug)]
pub(crate) struct MovedVertices(pub(crate) Vec<NodeId>);

impl MovedVertices {
    fn with_room(vertices: usize) -> Self {
        Self(Vec::with_capacity(vertices))
    }
}

impl Clone for MovedVertices {
    fn clone(&self) -> Self {
        let mut own = Self::with_room(self.0.capacity());
        own.0.extend_from_slice(&self.0);
        own
    }
}

/// What one tool does and feels.
#[derive(Debug, Clone)]
pub struct ToolState {
    /// Where it is; none before its motion begins.
    pub pose: Option<Pose>,
    /// What it touches.
    pub contact: Option<Contact>,
    /// How far it is from the organ at rest.
    pub(crate) clearance: Clearance,
    /// Force on the tool [N], of the organ and of the neighbours at which it stops. What bears on the shaft is taken to the
    /// tip: by its work of a tool in a trocar, else with [`Self::torque`].
    pub force: Vec3,
    /// Torque on a free tool about its tip [N m], of tissue that bears on its shaft; what the tip touches makes none.
    pub torque: Vec3,
    /// Stiffness of the contact or of held tissue, in the scene's frame [N/m]; zero without either, and where a thin wall wraps
    /// around the tip.
    pub stiffness: nalgebra::Matrix3<f64>,
    /// With how much each of its jaws presses on the tissue that it holds [N]; zero without.
    pub grip_force: f64,
    /// What the session records of the step.
    pub row: SessionRow,
    /// Bounds of the models that acted in its steps so far.
    pub limits: LimitCounts,
    /// Those of the last answer.
    pub(crate) limited: Limits,
    pub(crate) grip: Grip,
    pub(crate) response: Option<Response>,
    /// Force on the tool as it is displaced now, before relaxation [N].
    pub(crate) elastic: Vec3,
    /// Displacement of the touched point where the whole organ answers [m].
    pub(crate) displaced: Vec3,
    /// Its elastic force at the last solution of the nonlinear model [N], and how the place that it touches has moved.
    pub(crate) solved: Vec3,
    pub(crate) moved: Moved,
    /// Where its tip is beside the organ at rest [m], if it touched nothing in the step before.
    pub(crate) met: Option<Vec3>,
    /// How far its tip moves the organ beside all that others do [m].
    pub(crate) moves: f64,
    /// How it pressed in the last step.
    pub(crate) pressed: Option<Pressed>,
    /// What of it a half-space would yield [m].
    pub(crate) own: Vec3,
    /// Where it touches the whole organ's mechanical surface.
    pub(crate) site: Option<SurfacePoint>,
    /// Whether it touches the whole organ where nothing was prepared.
    pub(crate) off_model: bool,
    /// The force before a pull was taken from it [N]: what it is extrapolated from.
    pub(crate) with_pull: Vec3,
    pub(crate) history: ForceHistory,
    /// Where the history was made [m].
    pub(crate) history_at: Option<Vec3>,
    /// The frame of the contact in which it was made, of a tip that slides against friction [-].
    pub(crate) history_frame: Option<nalgebra::Matrix3<f64>>,
    /// Whether it was not there in the step before.
    pub(crate) is_away: bool,
    pub(crate) shaft_touches: bool,
    /// Whether the direction of its shaft was not known when it was there last.
    pub(crate) shaft_is_unknown: bool,
    /// What neighbours do to it.
    pub(crate) stopped: Stopped,
    /// What tissue does to its shaft.
    pub(crate) pushed: Pushed,
    pub(crate) beyond_trust: bool,
    /// Triangles from the end of an opening to the blade that makes it.
    pub cut_lag: usize,
    /// Where its edge is, while it cuts.
    pub(crate) blade: Option<Blade>,
    /// How many layers have given way to its force since it touches; with one it is a blade.
    pub(crate) broken_layers: usize,
    /// Whether it has opened the innermost layer since it touches.
    pub(crate) perforates: bool,
}

/// Scratch of a step. Its loss changes no result.
pub struct SimulationWorkspace {
    pub(crate) models: Vec<FiniteSphereWorkspace>,
    pub(crate) global: Option<GlobalWorkspace>,
    pub(crate) nonlinear: Option<NonlinearWorkspace>,
    pub(crate) seen: Vec<u32>,
    pub(crate) seen_triangles: Vec<u32>,
    pub(crate) turn: u32,
    pub(crate) near: Vec<NodeId>,
    pub(crate) refit: Vec<TriangleId>,
}

impl SimulationState {
    /// Nothing touched yet.
    pub fn new(simulation: &Simulation) -> Self {
        let tools = (0..simulation.tools().len()).map(ToolState::new).collect();
        let (rest, boxes) = simulation.untouched();
        Self {
            tools,
            cuts: simulation
                .cutting
                .as_ref()
                .map(|model| Cuts::new(simulation, model)),
            deformed: rest.clone(),
            whole: OrganField::at_rest(simulation),
            body: simulation
                .nonlinear
                .as_ref()
                .map(|organ| Body::at_rest(organ, simulation.tools.len())),
            estimated: Arc::clone(&simulation.estimated),
            tree: boxes.clone(),
            moved: MovedVertices::with_room(simulation.surface.mesh().vertices().len()),
            show_every: 0.0,
            shown_deformed: false,
            shown_at: f64::NEG_INFINITY,
            cuts_shown_at: f64::NEG_INFINITY,
            energy: EnergyAccount::default(),
            touched_neighbours: vec![
                Default::default();
                simulation.tools.len() * simulation.neighbours.len()
            ],
        }
    }

    /// The organ at rest and whole, as if nothing had been touched yet. It allocates nothing, so that a model in real time
    /// may do it between two steps.
    pub fn reset(&mut self, simulation: &Simulation) {
        let Self {
            tools,
            deformed,
            whole,
            body,
            cuts,
            estimated: _,
            tree,
            moved,
            show_every: _,
            shown_deformed,
            shown_at,
            energy,
            cuts_shown_at,
            touched_neighbours,
        } = self;
        touched_neighbours.fill(Default::default());
        for (number, tool) in tools.iter_mut().enumerate() {
            *tool = ToolState::new(number);
        }
        let is_local = whole.is_none() && body.is_none();
        if !is_local || !moved.0.is_empty() {
            let (rest, boxes) = simulation.untouched();
            deformed.move_vertices_to(rest);
            tree.copy_boxes(boxes);
            moved.0.clear();
        }
        if let Some(whole) = whole {
            whole.return_to_rest();
        }
        if let (Some(body), Some(organ)) = (body, &simulation.nonlinear) {
            body.reset(organ);
        }
        if let Some(cuts) = cuts {
            cuts.reset();
        }
        *energy = EnergyAccount::default();
        *shown_deformed = false;
        (*shown_at, *cuts_shown_at) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
    }

    /// Replaces the estimated inclusions of the scene: one model serves organs that differ in nothing else. After an error
    /// nothing has changed.
    ///
    /// # Errors
    /// When the middle of one is not in the organ.
    pub fn set_estimated_inclusions(
        &mut self,
        simulation: &Simulation,
        inclusions: &[EstimatedInclusion],
    ) -> Result<(), Error> {
        self.estimated = Arc::new(simulation.estimate(inclusions)?);
        Ok(())
    }

    /// Plain sentences on the bounds of the models that acted in the steps so far.
    pub fn warnings(&self, simulation: &Simulation) -> Vec<String> {
        let tools = simulation.tools().iter().zip(&self.tools);
        tools
            .flat_map(|(tool, state)| state.limits.warnings(&tool.name))
            .collect()
    }

    /// The organ that bends, with its cuts.
    pub(crate) fn bent_organ(&self) -> Option<Arc<NonlinearOrgan>> {
        let body = self.body.as_ref();
        body.map(|body| Arc::clone(&body.organ))
    }

    /// Closes the last cut again. Whether there was one; while a blade is in the tissue there is none.
    pub fn undo_cut(&mut self) -> bool {
        self.cuts_shown_at = f64::NEG_INFINITY;
        // An organ that is whole again is stiffer under what presses on it.
        self.energy.close();
        self.cuts.as_mut().is_some_and(Cuts::undo)
    }

    /// Shapes the organ no more often than every `period` [s]; forces are those of every step, and a shaft touches the
    /// organ as it was shaped last. For who only looks at it: a display that shows 60 pictures a second needs no more.
    #[must_use]
    pub fn show_every(mut self, period: f64) -> Self {
        self.set_show_every(period);
        self
    }

    /// The same in place.
    pub fn set_show_every(&mut self, period: f64) {
        self.show_every = period;
    }
}

impl ToolState {
    /// The part of its force that is the organ's [N].
    pub(crate) fn force_of_organ(&self) -> Vec3 {
        self.force - self.stopped.force
    }

    fn new(number: usize) -> Self {
        Self {
            pose: None,
            contact: None,
            clearance: Clearance::default(),
            force: Vec3::zeros(),
            torque: Vec3::zeros(),
            stiffness: nalgebra::Matrix3::zeros(),
            grip_force: 0.0,
            row: SessionRow {
                time_s: 0.0,
                tool: number,
                position_m: [0.0; 3],
                orientation: [0.0, 0.0, 0.0, 1.0],
                grip: 0.0,
                cut: false,
                force_n: [0.0; 3],
                torque_nm: [0.0; 3],
                contact: false,
                depth_m: 0.0,
                events: Events::NONE,
                grip_force_n: 0.0,
                stated_diameter_m: None,
            },
            limits: LimitCounts::default(),
            limited: Limits::NONE,
            grip: Grip::default(),
            response: None,
            elastic: Vec3::zeros(),
            site: None,
            displaced: Vec3::zeros(),
            solved: Vec3::zeros(),
            moved: Moved::default(),
            met: None,
            moves: 0.0,
            pressed: None,
            own: Vec3::zeros(),
            off_model: false,
            with_pull: Vec3::zeros(),
            history: ForceHistory::default(),
            history_at: None,
            history_frame: None,
            is_away: true,
            shaft_touches: false,
            shaft_is_unknown: false,
            stopped: Stopped::default(),
            pushed: Pushed::default(),
            beyond_trust: false,
            cut_lag: 0,
            blade: None,
            broken_layers: 0,
            perforates: false,
        }
    }
}

impl SimulationWorkspace {
    /// What to be careful about in the forces of the cuts that the last step followed, as sentences.
    pub fn warnings(&self) -> Vec<String> {
        let global = self.global.iter().flat_map(GlobalWorkspace::warnings);
        let nonlinear = self.nonlinear.iter().flat_map(NonlinearWorkspace::warnings);
        global.chain(nonlinear).collect()
    }

    /// Scratch for `simulation`.
    pub fn new(simulation: &Simulation) -> Self {
        let mesh = simulation.surface.mesh();
        Self {
            models: simulation
                .tools()
                .iter()
                .map(|tool| tool.model.workspace())
                .collect(),
            global: simulation.global.as_ref().map(|global| {
                global.workspace(simulation.tools.len(), simulation.forces_follow_cuts())
            }),
            nonlinear: simulation
                .nonlinear
                .as_ref()
                .map(|organ| NonlinearWorkspace::new(organ, simulation)),
            seen: vec![0; mesh.vertices().len()],
            seen_triangles: vec![0; mesh.triangles().len()],
            turn: 0,
            near: Vec::with_capacity(mesh.vertices().len()),
            refit: Vec::with_capacity(mesh.triangles().len()),
        }
    }

    /// A number that no vertex and no triangle has been marked with.
    pub(crate) fn next_turn(&mut self) -> u32 {
        self.turn = self.turn.wrapping_add(1);
        if self.turn == 0 {
            self.seen.fill(0);
            self.seen_triangles.fill(0);
            self.turn = 1;
        }
        self.turn
    }
}
