//! Where a step begins: the last motion, as far as the tools continue their paths.

use super::constraints::Conditions;
use super::contact::Against;
use super::model::NonlinearModel;
use super::state::NonlinearState;
use crate::Vec3;

/// Largest factor with which the last displacement is continued, or gone back [-].
const MOST_CONTINUED: f64 = 1.5;

/// Continues the last motion as far as the tools continue their paths; whether there was one to be continued.
pub(super) fn predict(
    model: &NonlinearModel,
    conditions: Conditions<'_>,
    state: &mut NonlinearState,
    guess: &mut [f64],
) -> bool {
    let Conditions {
        couplings,
        contacts,
    } = conditions;
    let last_motion = state.motion();
    let (mut along, mut length, mut all_known) = (0.0, 0.0, true);
    for (coupling, memory) in couplings.iter().zip(&state.tools) {
        all_known &= coupling.is_some() == memory.is_coupled;
        if let Some(coupling) = coupling {
            let last = last_motion.of(coupling.nodes);
            along += coupling.advance.dot(&last);
            length += last.norm_squared();
        }
    }
    for contact in contacts {
        if let Against::Tool { motion, .. } = contact.against
            && state.force_of(model, contact) > 0.0
        {
            let nodes = &model.tool_points()[contact.point as usize].nodes;
            let last = contact.normal.dot(&last_motion.of(nodes));
            along += contact.normal.dot(&motion) * last;
            length += last * last;
        }
    }
    // Friction depends on the way, which is not known yet.
    let part = if all_known && state.is_smooth && length > 0.0 && !state.has_friction() {
        (along / length).clamp(-MOST_CONTINUED, MOST_CONTINUED)
    } else {
        0.0
    };
    let each = last_motion.to.iter().zip(last_motion.from);
    let per_step = part / last_motion.steps;
    for (guess, (to, from)) in guess.iter_mut().zip(each) {
        *guess = to + per_step * (to - from);
    }
    for (coupling, memory) in couplings.iter().zip(&mut state.tools) {
        let force = match coupling {
            Some(_) => memory.force + part * (memory.force - memory.force_in_series),
            None => Vec3::zeros(),
        };
        memory.force_in_series = memory.force;
        memory.force = force;
    }
    for memory in &mut state.cavities {
        memory.continue_by(part);
    }
    part != 0.0
}

/// Takes back what a guess continued.
pub(super) fn stay(state: &mut NonlinearState, guess: &mut [f64]) {
    guess.copy_from_slice(&state.displacements);
    for memory in &mut state.tools {
        memory.force = memory.force_in_series;
    }
    for memory in &mut state.cavities {
        memory.stay();
    }
}
