//! Neighbours at which tools stop: bodies of fixed shape that push a tip back along their surface's normal.
//!
//! A tip that is d deep is pushed with k d, k the neighbour's stiffness. One that sticks is held in place by the same k, up to its friction. A tool
//! touches a neighbour once it comes from outside: one that first appears within it, as where an organ grows through
//! the diaphragm, is let out.
//!
//! *How we know*: `neighbours::…`.
//!
//! *Limits*: no shafts touch them, and only an organ of the nonlinear model stays out of them (`nonlinear::neighbours`).

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

/// A body at which tools stop.
#[derive(Debug, Clone)]
pub(crate) struct Neighbour {
    pub(crate) surface: Surface,
    tree: AabbTree,
    /// Its normals as each tool feels them.
    patches: Vec<PatchField>,
    radius: f64,
    /// Coulomb's coefficient between it and the organ [-].
    pub(crate) friction: f64,
    /// The force on a tip per depth [N/m].
    pub(crate) stiffness: f64,
}

/// What neighbours do to one tool.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Stopped {
    /// Where the tip was in the last step [m].
    tip: Option<Vec3>,
    /// Force on the tool [N], how it changes with the tip's place [N/m], and the normal of what was touched last [-].
    pub(crate) force: Vec3,
    pub(crate) gradient: Matrix3<f64>,
    pub(crate) normal: Option<Vec3>,
}

/// The place of a neighbour that is nearest to another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NearestPlace {
    /// Signed distance, negative inside [m].
    pub(crate) distance: f64,
    /// Smooth normal there [-].
    pub(crate) normal: Vec3,
    pub(crate) triangle: TriangleId,
}

impl Neighbour {
    /// Those of `scene` at which its tools stop. The others are read too, so that a missing file is told here.
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

    /// The place nearest to `place` [m]; the search is faster if `near` is a triangle close to it.
    pub(crate) fn nearest(&self, place: &Vec3, near: Option<TriangleId>) -> NearestPlace {
        let (nearest, distance) = self.surface.signed_distance_from(&self.tree, place, near);
        let corners = self.surface.mesh().corners(nearest.triangle);
        let normals = self.surface.vertex_normals();
        let normal: Vec3 = corners
            .iter()
            .zip(nearest.on.barycentric)
            .map(|(node, weight)| normals[node.index()] * weight)
            .sum();
        NearestPlace {
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
            further: None,
        }
    }
}

/// Adds what neighbours do to tool `number`.
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
        let along = match tool.bond {
            Friction::Bonded if !contact.slides => stiffness,
            Friction::Bonded | Friction::Frictionless => 0.0,
        };
        let stiffness = Matrix3::from_diagonal(&Vec3::new(along, along, stiffness));
        self.stopped.force += force;
        self.stopped.gradient -= frame * stiffness * frame.transpose();
        self.stopped.normal = Some(contact.normal());
    }
}
