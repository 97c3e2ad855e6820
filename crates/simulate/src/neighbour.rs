//! Neighbours that stop tools: rigid bodies that push a tip back along their surface normal.
//!
//! At the depth d a neighbour pushes a tip with k d, k being its stiffness. A tip that sticks is held with the same k,
//! up to its friction. A tool touches a neighbour once it comes from outside: a neighbour lets out a tool that first
//! appears inside it, as where an organ grows through the diaphragm.
//!
//! *How we know*: `neighbours::…`.
//!
//! *Limits*: no contact with shafts, and only an organ of the nonlinear model stays out of them
//! (`nonlinear::neighbours`).

use nalgebra::Matrix3;
use palpate_files::Scene;
use palpate_files::scene::Shape;
use palpate_geometry::{AabbTree, PatchField, Surface, TriangleId, Vec3};
use palpate_mechanics::contact::Friction;

use crate::contact::{Contact, RestSurface};
use crate::simulation::{Simulation, radius_of_hemisphere};
use crate::state::{SimulationState, ToolState};
use crate::tool::Tool;
use crate::{Error, organ};

/// A body that stops tools.
#[derive(Debug, Clone)]
pub(crate) struct Neighbour {
    pub(crate) surface: Surface,
    tree: AabbTree,
    /// Its normals for each tool.
    patches: Vec<PatchField>,
    radius: f64,
    /// Coulomb friction coefficient between it and the organ [-].
    pub(crate) friction: f64,
    /// The force on a tip per depth [N/m].
    pub(crate) stiffness: f64,
}

/// The action of neighbours on one tool.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Stopped {
    /// The tip in the last step [m].
    tip: Option<Vec3>,
    /// Force on the tool [N], its derivative with the tip's position [N/m], and the normal of the last contact [-].
    pub(crate) force: Vec3,
    pub(crate) gradient: Matrix3<f64>,
    pub(crate) normal: Option<Vec3>,
}

/// The point of a neighbour that is closest to another point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ClosestPoint {
    /// Signed distance, negative inside [m].
    pub(crate) distance: f64,
    /// Smooth normal there [-].
    pub(crate) normal: Vec3,
    pub(crate) triangle: TriangleId,
}

impl Neighbour {
    /// The neighbours of `scene` that stop its tools. The others are read too, so that a missing file is reported here.
    pub(crate) fn all(scene: &Scene, tools: &[Tool]) -> Result<Vec<Self>, Error> {
        let mut all = Vec::new();
        for neighbour in &scene.neighbours {
            let is_file = matches!(neighbour.shape, Shape::Mesh { .. });
            if !neighbour.collides && !is_file {
                continue;
            }
            let (surface, _) = organ::read_neighbour(neighbour)?;
            if neighbour.collides {
                all.push(Self {
                    tree: AabbTree::new(surface.mesh()),
                    patches: tools
                        .iter()
                        .map(|tool| PatchField::new(&surface, tool.shaft_radius()))
                        .collect(),
                    radius: radius_of_hemisphere(&surface),
                    friction: neighbour.friction,
                    stiffness: neighbour.stiffness_n_per_m,
                    surface,
                });
            }
        }
        Ok(all)
    }

    /// The point closest to `place` [m]; the search is faster if `near` is a triangle close to it.
    pub(crate) fn nearest(&self, place: &Vec3, near: Option<TriangleId>) -> ClosestPoint {
        let (nearest, distance) = self.surface.signed_distance_from(&self.tree, place, near);
        let corners = self.surface.mesh().corners(nearest.triangle);
        let normals = self.surface.vertex_normals();
        let normal: Vec3 = corners
            .iter()
            .zip(nearest.on.barycentric)
            .map(|(node, weight)| normals[node.index()] * weight)
            .sum();
        ClosestPoint {
            distance,
            normal: normal.normalize(),
            triangle: nearest.triangle,
        }
    }

    fn surface(&self, tool: usize) -> RestSurface<'_> {
        RestSurface {
            surface: &self.surface,
            tree: &self.tree,
            patches: &self.patches[tool],
            radius: self.radius,
            structural_compliance: None,
        }
    }
}

/// Adds the forces of neighbours on tool `number`.
pub(crate) fn press(simulation: &Simulation, number: usize, state: &mut SimulationState) {
    let neighbours = &simulation.neighbours;
    let own = &mut state.tools[number];
    let all = number * neighbours.len()..(number + 1) * neighbours.len();
    let touched = state.touched_neighbours[all].iter_mut();
    let tool = &simulation.tools[number];
    let tip = own.pose.map(|pose| Vec3::from(pose.position_m));
    let before = std::mem::replace(
        &mut own.stopped,
        Stopped {
            tip,
            ..Stopped::default()
        },
    )
    .tip;
    for (neighbour, (contact, clearance)) in neighbours.iter().zip(touched) {
        let last = contact.take();
        let Some(tip) = tip else { continue };
        let surface = neighbour.surface(number);
        let found = clearance.detect(&surface, tool, last.as_ref(), &tip);
        let travel = before.map_or(0.0, |before| (tip - before).norm());
        let Some(mut found) = found.filter(|found| last.is_some() || found.depth <= travel) else {
            continue;
        };
        own.stop(tool, &tip, neighbour.stiffness, &mut found);
        *contact = Some(found);
    }
    own.force += own.stopped.force;
}

impl ToolState {
    fn stop(&mut self, tool: &Tool, tip: &Vec3, stiffness: f64, contact: &mut Contact) {
        let frame = contact.frame();
        let mut force = frame * (-stiffness * contact.displacement(tool, tip));
        contact.slide(tool, &mut force);
        let along = match tool.tip_friction {
            Friction::Bonded if !contact.slides => stiffness,
            Friction::Bonded | Friction::Frictionless => 0.0,
        };
        let stiffness = Matrix3::from_diagonal(&Vec3::new(along, along, stiffness));
        self.stopped.force += force;
        self.stopped.gradient -= frame * stiffness * frame.transpose();
        self.stopped.normal = Some(contact.normal());
    }
}
