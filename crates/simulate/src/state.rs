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

/// All state that a step changes.
#[derive(Debug, Clone)]
pub struct SimulationState {
    /// Per tool.
    pub tools: Vec<ToolState>,
    /// The deformed organ.
    pub deformed: TriangleMesh,
    /// The displacement field of the organ-scale model, if there is one.
    pub organ_field: Option<OrganField>,
    /// The state of the nonlinear model, if there is one.
    pub(crate) body: Option<Body>,
    /// Its cuts, if anything can cut it.
    pub cuts: Option<Cuts>,
    /// The inclusions whose effect is estimated.
    pub(crate) estimated: Arc<InclusionField>,
    /// The boxes around it.
    pub(crate) tree: AabbTree,
    /// The displaced vertices.
    pub(crate) moved: MovedVertices,
    /// The least time between two updates of an organ-scale shape [s]; zero updates at every step.
    pub(crate) show_every: f64,
    /// Whether the displayed organ-scale shape differs from rest.
    pub(crate) shown_deformed: bool,
    /// Time of the last update of the organ-scale shape [s].
    pub(crate) shown_at: f64,
    /// The work of the tools on it.
    pub(crate) energy: EnergyAccount,
    /// Time of the last update of the cuts' shape [s].
    pub(crate) cuts_shown_at: f64,
    /// Contacts of tools with neighbours, or the clearance; those of each tool in succession.
    pub(crate) touched_neighbours: Vec<(Option<Contact>, Clearance)>,
}

/// Displaced vertices, with capacity for all of the organ's. A clone has the same capacity, so that its steps allocate
/// nothing either.
#[derive(Debug)]
pub(crate) struct MovedVertices(pub(crate) Vec<NodeId>);

impl MovedVertices {
    fn with_capacity(vertices: usize) -> Self {
        Self(Vec::with_capacity(vertices))
    }
}

impl Clone for MovedVertices {
    fn clone(&self) -> Self {
        let mut own = Self::with_capacity(self.0.capacity());
        own.0.extend_from_slice(&self.0);
        own
    }
}

/// The state of one tool.
#[derive(Debug, Clone)]
pub struct ToolState {
    /// Its pose; none before its motion begins.
    pub pose: Option<Pose>,
    /// Its contact.
    pub contact: Option<Contact>,
    /// Its clearance from the organ at rest.
    pub(crate) clearance: Clearance,
    /// Force on the tool [N], by the organ and by the neighbours that stop it. The load on the shaft is transferred to
    /// the tip: by its work for a tool in a trocar, else with [`Self::torque`].
    pub force: Vec3,
    /// Torque on a free tool about its tip [N m], from the load on its shaft; the contact of the tip causes none.
    pub torque: Vec3,
    /// Stiffness of the contact or of held tissue, in the scene's frame [N/m]; zero without either, and where a thin
    /// wall wraps around the tip.
    pub stiffness: nalgebra::Matrix3<f64>,
    /// Force of each of its jaws on the tissue that it holds [N]; zero without.
    pub grip_force: f64,
    /// The row of the step for the session.
    pub row: SessionRow,
    /// Bounds of the models that acted in its steps so far.
    pub limits: LimitCounts,
    /// The bounds that acted in the last solution.
    pub(crate) limited: Limits,
    pub(crate) grip: Grip,
    pub(crate) response: Option<Response>,
    /// Force on the tool at the present displacement, before relaxation [N].
    pub(crate) elastic: Vec3,
    /// Displacement of the touched point in the organ-scale model [m].
    pub(crate) displaced: Vec3,
    /// Its elastic force at the last solution of the nonlinear model [N], and the motion of its contact location.
    pub(crate) solved: Vec3,
    pub(crate) moved: Moved,
    /// Position of its tip relative to the organ at rest [m], if it touched nothing in the step before.
    pub(crate) free_position: Option<Vec3>,
    /// Whether it had a contact before the step.
    pub(crate) had_contact: bool,
    /// Displacement of the organ at its tip that it causes alone, without all others [m].
    pub(crate) self_displacement: f64,
    /// Its pressing state in the last step.
    pub(crate) pressed: Option<Pressed>,
    /// The part of it that a half-space would yield [m].
    pub(crate) own: Vec3,
    /// Its contact point on the mechanical surface of the organ-scale model.
    pub(crate) site: Option<SurfacePoint>,
    /// Whether it touches the organ-scale model where it has no prepared response.
    pub(crate) off_model: bool,
    /// The force before its pull was removed [N]: the basis of the extrapolation.
    pub(crate) with_pull: Vec3,
    pub(crate) history: ForceHistory,
    /// The location to which the history belongs [m].
    pub(crate) history_at: Option<Vec3>,
    /// The contact frame to which the history belongs, for a tip that slides against friction [-].
    pub(crate) history_frame: Option<nalgebra::Matrix3<f64>>,
    /// Whether the tool was absent in the step before.
    pub(crate) was_absent: bool,
    pub(crate) shaft_touches: bool,
    /// Whether its shaft direction was unknown when it was last present.
    pub(crate) shaft_is_unknown: bool,
    /// The action of neighbours on it.
    pub(crate) stopped: Stopped,
    /// The action of tissue on its shaft.
    pub(crate) pushed: Pushed,
    pub(crate) beyond_trust: bool,
    /// Number of triangles between the end of an opening and its blade.
    pub cut_lag: usize,
    /// Its cutting edge, while it cuts.
    pub(crate) blade: Option<Blade>,
    /// Number of layers that have given way to its force in this touch; with one it is a blade.
    pub(crate) broken_layers: usize,
    /// Whether it has opened the innermost layer in this touch.
    pub(crate) perforates: bool,
}

/// Scratch of a step. Losing it changes no result.
pub struct SimulationWorkspace {
    pub(crate) models: Vec<FiniteSphereWorkspace>,
    pub(crate) global: Option<GlobalWorkspace>,
    pub(crate) nonlinear: Option<NonlinearWorkspace>,
    pub(crate) visited: Vec<u32>,
    pub(crate) visited_triangles: Vec<u32>,
    pub(crate) turn: u32,
    pub(crate) near: Vec<NodeId>,
    pub(crate) refit: Vec<TriangleId>,
}

impl SimulationState {
    /// An untouched organ.
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
            organ_field: OrganField::at_rest(simulation),
            body: simulation
                .nonlinear
                .as_ref()
                .map(|organ| Body::at_rest(organ, simulation.tools.len())),
            estimated: Arc::clone(&simulation.estimated),
            tree: boxes.clone(),
            moved: MovedVertices::with_capacity(simulation.surface.mesh().vertices().len()),
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

    /// Resets to the intact organ at rest, as if untouched. It allocates nothing, so that a real-time model may do it
    /// between two steps.
    pub fn reset(&mut self, simulation: &Simulation) {
        let Self {
            tools,
            deformed,
            organ_field: whole,
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

    /// Replaces the estimated inclusions of the scene: one model serves organs that differ only in these. An error
    /// changes nothing.
    ///
    /// # Errors
    /// When the centre of one is not in the organ.
    pub fn set_estimated_inclusions(
        &mut self,
        simulation: &Simulation,
        inclusions: &[EstimatedInclusion],
    ) -> Result<(), Error> {
        self.estimated = Arc::new(simulation.estimate(inclusions)?);
        Ok(())
    }

    /// Sentences about the bounds of the models that acted in the steps so far.
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

    /// Undoes the last cut. Returns whether there was one; while a blade is in the tissue there is none.
    pub fn undo_cut(&mut self) -> bool {
        self.cuts_shown_at = f64::NEG_INFINITY;
        // A closed organ is stiffer under the tools that press on it.
        self.energy.close();
        self.cuts.as_mut().is_some_and(Cuts::undo)
    }

    /// Updates the shape no more often than every `period` [s]; forces are those of every step, and a shaft touches the
    /// last updated shape. For displays: one with 60 frames a second needs no more.
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
    /// The organ's part of its force [N].
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
            free_position: None,
            had_contact: false,
            self_displacement: 0.0,
            pressed: None,
            own: Vec3::zeros(),
            off_model: false,
            with_pull: Vec3::zeros(),
            history: ForceHistory::default(),
            history_at: None,
            history_frame: None,
            was_absent: true,
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
    /// Warnings about the forces of the cuts in the last step, as sentences.
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
            visited: vec![0; mesh.vertices().len()],
            visited_triangles: vec![0; mesh.triangles().len()],
            turn: 0,
            near: Vec::with_capacity(mesh.vertices().len()),
            refit: Vec::with_capacity(mesh.triangles().len()),
        }
    }

    /// A number that marks no vertex and no triangle yet.
    pub(crate) fn next_turn(&mut self) -> u32 {
        self.turn = self.turn.wrapping_add(1);
        if self.turn == 0 {
            self.visited.fill(0);
            self.visited_triangles.fill(0);
            self.turn = 1;
        }
        self.turn
    }
}
