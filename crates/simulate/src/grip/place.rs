//! Held tissue in the local model: a place bonded to the jaws.
//!
//! The area of a jaw's face, as a disc, is the contact area of a bonded tip whose tangential and normal stiffness act
//! in pull and push. A model of slipping tips has no tangential stiffness; theirs is that of the half-space, in the
//! ratio of the normal ones.
//!
//! *Limits*: linear for any pull; two graspers do not interact.

use nalgebra::Matrix3;
use palpate_geometry::Vec3;
use palpate_mechanics::contact::{Friction, half_space_stiffness, half_space_tangential_stiffness};
use palpate_mechanics::finite_spheres::{FiniteSphereWorkspace, LocalContact, Response};

use super::grasp::DisplayedGrasp;
use super::{Grasp, Grasped, Swept};
use crate::contact;
use crate::simulation::Simulation;
use crate::state::ToolState;
use crate::tool::Tool;

/// A held place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GraspedPlace {
    pub(crate) place: LocalContact,
    /// The tip [m], and its elastic force [N], at the start of the grasp.
    tip: Vec3,
    force: Vec3,
}

/// Grasps the place at the tool's contact, or a little ahead of it.
pub(super) fn grasp(
    simulation: &Simulation,
    tool: &Tool,
    state: &mut ToolState,
    workspace: &mut FiniteSphereWorkspace,
) -> bool {
    let (Some(swept), Some(jaws)) = (state.swept(tool), tool.jaws) else {
        return false;
    };
    let ahead = || contact::detect(&simulation.rest_surface(tool), tool, None, &swept.far_end());
    let Some(contact) = state.contact.or_else(ahead) else {
        return false;
    };
    let displaced = match state.contact {
        Some(contact) => contact.place.frame * contact.displacement(tool, &swept.tip),
        None => Vec3::zeros(),
    };
    let mut place = contact.place;
    place.radius = (Swept::face(&jaws) / std::f64::consts::PI).sqrt();
    let displayed = DisplayedGrasp {
        triangle: place.triangle,
        place: place.point,
        at: None,
        displaced,
    };
    let held = Grasped::Place(GraspedPlace {
        place,
        tip: swept.tip,
        force: state.elastic,
    });
    let area = Swept::face(&jaws);
    state.grip.grasp = Some(Grasp::new(&swept, area, jaws.opening_m, held, displayed));
    answer(simulation, tool, state, workspace);
    true
}

/// The force of a held place on its tool, and its stiffness; returns whether there is one.
pub(crate) fn answer(
    simulation: &Simulation,
    tool: &Tool,
    state: &mut ToolState,
    workspace: &mut FiniteSphereWorkspace,
) -> bool {
    let Some(hold) = &state.grip.grasp else {
        return false;
    };
    let Grasped::Place(held) = &hold.grasped else {
        return false;
    };
    let response = tool.model.respond(&held.place, workspace);
    state.response = Some(response);
    state.limited = response.limits;
    state.stiffness = stiffness(simulation, tool, &held.place, &response);
    state.elastic = held.force - state.stiffness * (hold.carried(&held.tip) - held.tip);
    true
}

/// Of a held place, in the scene's frame [N/m].
fn stiffness(
    simulation: &Simulation,
    tool: &Tool,
    place: &LocalContact,
    response: &Response,
) -> Matrix3<f64> {
    let law = &simulation.material.at_rest;
    let normal = response.stiffness[(2, 2)];
    let along = match tool.tip_friction {
        Friction::Bonded => 0.5 * (response.stiffness[(0, 0)] + response.stiffness[(1, 1)]),
        Friction::Frictionless => {
            let ratio = normal / half_space_stiffness(law, place.radius, Friction::Frictionless);
            ratio * half_space_tangential_stiffness(law, place.radius)
        }
    };
    let own = Matrix3::from_diagonal(&Vec3::new(along, along, normal));
    place.frame * own * place.frame.transpose()
}
