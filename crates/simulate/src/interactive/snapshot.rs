use palpate_files::Pose;
use palpate_geometry::Vec3;
use palpate_servo::Fault;

use super::ModelReport;
use crate::cutting::Cuts;
use crate::state::{SimulationState, ToolState};
use crate::{LimitCounts, OrganField, Simulation, Tool};

/// A snapshot for display, after a step of the model.
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// The time of the step [s].
    pub time: f64,
    /// The vertices of the deformed organ [m], in the order of its surface.
    pub vertices: Vec<[f32; 3]>,
    /// The cut mesh that replaces these where the organ is cut.
    pub opened: Option<OpenedSnapshot>,
    /// Whether the model is paused.
    pub paused: bool,
    /// The displacement field of the organ-scale model, if there is one.
    pub organ_field: Option<OrganField>,
    /// Per tool, in the scene's order.
    pub tools: Vec<ToolSnapshot>,
    /// Measurements of the model.
    pub report: ModelReport,
}

/// A tool after a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolSnapshot {
    /// Position of its tip; none while no hand holds it.
    pub pose: Option<Pose>,
    /// The quaternion (qx, qy, qz, qw) that maps tool to scene [-]: the shaft runs along the tool's +z.
    pub orientation: [f64; 4],
    /// The force on it [N], as a session records it: not scaled, not limited.
    pub force: Vec3,
    /// The torque on it about its tip [N m], which no device gets.
    pub torque: Vec3,
    /// The force that its device gets [N]: scaled, extrapolated, limited; in the scene's frame.
    pub rendered_force: Vec3,
    /// Why its device gets no force, if there is a reason.
    pub fault: Option<Fault>,
    /// Its contact.
    pub contact: Option<ContactSnapshot>,
    /// Whether its blade is in the tissue.
    pub cuts: bool,
    /// Force of each of its jaws on the tissue that it holds [N]; zero without.
    pub grip_force: f64,
    /// Whether its jaws hold tissue.
    pub is_grasping: bool,
    /// Bounds of the models that acted in its steps so far.
    pub limits: LimitCounts,
}

/// The rendered force of a tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RenderedForce {
    /// The force that its device gets [N], in the scene's frame.
    pub(super) force: Vec3,
    /// Why its device gets none, if there is a reason.
    pub(super) fault: Option<Fault>,
}

impl RenderedForce {
    pub(super) const NOTHING: Self = Self {
        force: Vec3::new(0.0, 0.0, 0.0),
        fault: None,
    };
}

/// The organ's triangles with their openings.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OpenedSnapshot {
    /// Changes whenever the triangles change; with zero nothing is cut, and the rest is empty.
    pub version: u64,
    /// Positions of the vertices when the organ is at rest and its openings are closed [m].
    pub rest: Vec<[f32; 3]>,
    /// Current positions of the vertices [m].
    pub places: Vec<[f32; 3]>,
    /// The vertices of each triangle, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The detached piece of each vertex, from 1 on, or zero; empty without any.
    pub detached: Vec<u32>,
    /// The edges of openings: two vertices of one piece, in the order of their triangle.
    pub rims: Vec<[u32; 2]>,
    /// The path of the cuts over the surface at rest, where the organ has layers.
    pub parts: Vec<OpenedPart>,
    /// Vertices with known points below the surface.
    pub around: Vec<u32>,
    /// Current positions of the points below these [m]: for each depth that a cut can have, in succession.
    pub below: Vec<[f32; 3]>,
}

/// A straight part of a cut through layers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpenedPart {
    /// Its ends on the surface at rest [m]; the same for a puncture.
    pub ends: [[f32; 3]; 2],
    /// Whether it starts a cut.
    pub begins: bool,
    /// Number of open layers in it, from outside.
    pub layers: usize,
}

/// A contact after a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSnapshot {
    /// The touched point of the rest surface [m].
    pub point: Vec3,
    /// Unit outward normal of the rest surface there [-].
    pub normal: Vec3,
    /// Depth of the tip below the rest surface [m].
    pub depth: f64,
}

impl Snapshot {
    /// The untouched organ.
    pub fn new(simulation: &Simulation) -> Self {
        let vertices = simulation.surface().mesh().vertices();
        let nobody = ToolSnapshot {
            pose: None,
            orientation: [0.0, 0.0, 0.0, 1.0],
            force: Vec3::zeros(),
            torque: Vec3::zeros(),
            rendered_force: Vec3::zeros(),
            fault: None,
            contact: None,
            cuts: false,
            grip_force: 0.0,
            is_grasping: false,
            limits: LimitCounts::default(),
        };
        Self {
            time: 0.0,
            vertices: vertices.iter().map(single).collect(),
            opened: simulation
                .cutting
                .as_ref()
                .map(|_| OpenedSnapshot::default()),
            paused: false,
            organ_field: OrganField::at_rest(simulation),
            tools: vec![nobody; simulation.tools().len()],
            report: ModelReport::default(),
        }
    }

    /// Shows the `state` of a replayed session, at `time` [s], without forces on a hand.
    pub fn show(&mut self, time: f64, state: &SimulationState) {
        let nobody = [RenderedForce::NOTHING; 2];
        self.fill(time, state, &nobody);
    }

    /// Copies `state`; allocates only for triangles that a cut has added.
    pub(super) fn fill(&mut self, time: f64, state: &SimulationState, rendered: &[RenderedForce]) {
        self.time = time;
        for (seen, vertex) in self.vertices.iter_mut().zip(state.deformed.vertices()) {
            *seen = single(vertex);
        }
        if let (Some(seen), Some(cuts)) = (&mut self.opened, &state.cuts) {
            seen.fill(cuts, state);
        }
        if let (Some(seen), Some(whole)) = (&mut self.organ_field, &state.organ_field) {
            seen.copy(whole);
        }
        for ((seen, tool), rendered) in self.tools.iter_mut().zip(&state.tools).zip(rendered) {
            *seen = ToolSnapshot::new(tool, *rendered);
        }
    }
}

impl Snapshot {
    /// Sentences about the bounds that acted so far, for the `tools` of the simulation.
    pub fn warnings(&self, tools: &[Tool]) -> Vec<String> {
        let tools = tools.iter().zip(&self.tools);
        tools
            .flat_map(|(tool, seen)| seen.limits.warnings(&tool.name))
            .collect()
    }
}

impl OpenedSnapshot {
    /// Copies the `cuts` of `state`.
    pub fn fill(&mut self, cuts: &Cuts, state: &SimulationState) {
        if !cuts.has_openings() {
            return self.clear();
        }
        self.places.clear();
        self.places.extend(cuts.places().iter().map(single));
        self.around.clear();
        self.below.clear();
        if let Some(body) = &state.body {
            let (around, below) = body.below();
            self.around.extend_from_slice(around);
            let each = below.iter().zip(around.iter().cycle());
            self.below
                .extend(each.map(|(place, &vertex)| single(&(place + cuts.gape_of_rim(vertex)))));
        }
        self.parts.clear();
        self.parts
            .extend(cuts.parts().iter().map(|part| OpenedPart {
                ends: [single(&part.ends[0]), single(&part.ends[1])],
                begins: part.begins,
                layers: part.layers,
            }));
        if self.version == cuts.version() {
            return;
        }
        self.version = cuts.version();
        let mesh = cuts.mesh();
        self.rest.clear();
        self.rest.extend(mesh.vertices().iter().map(single));
        self.triangles.clear();
        self.rims.clear();
        self.detached.clear();
        self.detached.extend_from_slice(cuts.detached());
        let shown = cuts.triangles().iter();
        self.triangles
            .extend(shown.map(|corners| corners.map(|node| node.0)));
        for id in mesh.triangle_ids() {
            let corners = mesh.corners(id).map(|node| node.0);
            for (edge, side) in cuts.surface().sides(id).into_iter().enumerate() {
                let ends = [corners[edge], corners[(edge + 1) % 3]];
                let [from, to] = ends.map(|end| self.detached.get(end as usize));
                if side.is_some() && from == to {
                    self.rims.push(ends);
                }
            }
        }
    }

    fn clear(&mut self) {
        self.version = 0;
        self.rest.clear();
        self.places.clear();
        self.triangles.clear();
        self.detached.clear();
        self.rims.clear();
        self.parts.clear();
        self.around.clear();
        self.below.clear();
    }
}

impl ToolSnapshot {
    fn new(tool: &ToolState, rendered: RenderedForce) -> Self {
        Self {
            pose: tool.pose,
            orientation: tool.row.orientation,
            force: tool.force,
            torque: tool.torque,
            rendered_force: rendered.force,
            fault: rendered.fault,
            contact: tool.contact.map(|contact| ContactSnapshot {
                point: contact.point(),
                normal: contact.normal(),
                depth: contact.depth,
            }),
            cuts: tool.blade.is_some(),
            grip_force: tool.grip_force,
            is_grasping: tool.is_grasping(),
            limits: tool.limits,
        }
    }
}

fn single(vertex: &Vec3) -> [f32; 3] {
    [vertex.x as f32, vertex.y as f32, vertex.z as f32]
}
