use nalgebra::Vector3;
use palpate_files::scene::ToolKind;
use palpate_geometry::{ContactPoint, Vec3, follow};

use super::model::cuts;
use super::{Cuts, CuttingModel};
use crate::contact::place;
use crate::simulation::Simulation;
use crate::state::ToolState;
use crate::tool::Tool;

/// A cutting edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Blade {
    /// Its point on the resting surface.
    pub(crate) contact_point: ContactPoint,
    /// Position of the tip without resistance [m].
    tip: Vec3,
}

/// Whether a tool in contact cuts.
pub(super) fn is_down(tool: &Tool, state: &ToolState) -> bool {
    let by_hand = cuts(tool.kind) && state.pose.is_some_and(|pose| pose.cut);
    state.contact.is_some() && (by_hand || state.broken_layers > 0)
}

/// Moves the edge of a cutting tool along the surface, as far as its resistance permits, and attaches the contact to
/// the tissue there.
pub(crate) fn track_blade(
    simulation: &Simulation,
    model: &CuttingModel,
    cuts: &Cuts,
    number: usize,
    state: &mut ToolState,
) {
    let tool = &simulation.tools[number];
    let (true, Some(contact), Some(pose)) = (is_down(tool, state), state.contact, state.pose)
    else {
        state.blade = None;
        return;
    };
    let tip = Vec3::from(pose.position_m);
    let frame = contact.place.frame;
    let flat = |motion: &Vec3| {
        let local = frame.tr_mul(motion);
        frame * Vector3::new(local.x, local.y, 0.0)
    };
    let blade = state.blade.unwrap_or_else(|| {
        // It begins at the contact location.
        let held = tip - flat(&(tip - contact.place.point));
        let contact_point = follow(
            &simulation.surface,
            &tool.patches,
            &contact.contact_point,
            &tip,
            &held,
        );
        Blade {
            contact_point: contact_point.unwrap_or(contact.contact_point),
            tip: held,
        }
    });
    let behind = flat(&(tip - blade.tip));
    let open = cuts.open_before(model, number, &blade.contact_point.point);
    let resistance = model.resistance(open, contact.depth);
    let held = reach(resistance, tool, state).min(behind.norm());
    let goal = tip - behind.try_normalize(0.0).unwrap_or_default() * held;
    let contact_point = follow(
        &simulation.surface,
        &tool.patches,
        &blade.contact_point,
        &blade.tip,
        &goal,
    )
    .unwrap_or(contact.contact_point);
    state.blade = Some(Blade {
        contact_point,
        tip: goal,
    });
    let depth = contact.depth;
    if let Some(contact) = &mut state.contact {
        contact.place = place(
            &simulation.rest_surface(tool),
            tool,
            &contact_point,
            depth,
            Some(&frame),
        );
    }
}

/// How far the tip moves ahead of an edge with this `resistance` [N] before the edge moves [m].
fn reach(resistance: f64, tool: &Tool, state: &ToolState) -> f64 {
    if tool.kind == ToolKind::Scissors {
        return 0.0;
    }
    let Some(contact) = &state.contact else {
        return 0.0;
    };
    let normal = contact.normal();
    let stiffness = 0.5 * (state.stiffness.trace() - normal.dot(&(state.stiffness * normal)));
    if stiffness > 0.0 {
        resistance / stiffness
    } else {
        0.0
    }
}
