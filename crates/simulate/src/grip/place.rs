//! What jaws hold where the local model answers: a place bonded to them.
//!
//! The area of a jaw's face, as a disc, is the touching area of a bonded tip whose tangential and normal
//! stiffness pull as well as they push. A model of tips that slip knows no tangential one; theirs is that
//! of the half-space, in the ratio of the normal ones.
//!
//! *Limits*: linear however far it is pulled; two graspers do not feel one another.

use nalgebra::Matrix3;
use palpate_geometry::Vec3;
use palpate_mechanics::contact::{Friction, half_space_stiffness, half_space_tangential_stiffness};
use palpate_mechanics::finite_spheres::{FiniteSphereWorkspace, LocalContact, Response};

use super::hold::SeenHold;
use super::{Held, Hold, Swept};
use crate::contact;
use crate::simulation::Simulation;
use crate::state::ToolState;
use crate::tool::Tool;

/// A held place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HeldPlace {
    pub(crate) place: LocalContact,
    /// Where the tip was [m], and its elastic force [N], when it took hold.
    tip: Vec3,
    force: Vec3,
}

/// Takes hold of the place that the tool touches, or would touch a little ahead.
pub(super) fn take_hold(
    simulation: &Simulation,
    tool: &Tool,
    state: &mut ToolState,
    workspace: &mut FiniteSphereWorkspace,
) -> bool {
    let (Some(swept), Some(jaws)) = (state.swept(tool), tool.jaws) else {
        return false;
    };
    let ahead = || contact::detect(&simulation.ground(tool), tool, None, &swept.ahead());
    let Some(contact) = state.contact.or_else(ahead) else {
        return false;
    };
    let displaced = match state.contact {
        Some(contact) => contact.place.frame * contact.displacement(tool, &swept.tip),
        None => Vec3::zeros(),
    };
    let mut place = contact.place;
    place.radius = (Swept::face(&jaws) / std::f64::consts::PI).sqrt();
    let seen = SeenHold {
        triangle: place.triangle,
        place: place.point,
        at: None,
        displaced,
    };
    let held = Held::Place(HeldPlace {
        place,
        tip: swept.tip,
        force: state.elastic,
    });
    let area = Swept::face(&jaws);
    state.grip.hold = Some(Hold::new(&swept, area, jaws.opening_m, held, seen));
    answer(simulation, tool, state, workspace);
    true
}

/// The force of a held place on its tool, and its stiffness; whether there is one.
pub(crate) fn answer(
    simulation: &Simulation,
    tool: &Tool,
    state: &mut ToolState,
    workspace: &mut FiniteSphereWorkspace,
) -> bool {
    let Some(hold) = &state.grip.hold else {
        return false;
    };
    let Held::Place(held) = &hold.held else {
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
    let along = match tool.bond {
        Friction::Bonded => 0.5 * (response.stiffness[(0, 0)] + response.stiffness[(1, 1)]),
        Friction::Frictionless => {
            let ratio = normal / half_space_stiffness(law, place.radius, Friction::Frictionless);
            ratio * half_space_tangential_stiffness(law, place.radius)
        }
    };
    let own = Matrix3::from_diagonal(&Vec3::new(along, along, normal));
    place.frame * own * place.frame.transpose()
}
