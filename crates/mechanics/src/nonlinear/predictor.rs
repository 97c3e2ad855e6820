//! Predictor of a step: the last motion, as far as the tools continue their paths.

use super::constraints::Conditions;
use super::contact::Against;
use super::model::NonlinearModel;
use super::state::NonlinearState;
use crate::Vec3;

/// Largest factor with which the last displacement is continued or reversed [-].
const MAX_CONTINUED: f64 = 1.5;

/// Continues the last motion as far as the tools continue their paths; returns whether there was one.
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
    for (coupling, history) in couplings.iter().zip(&state.tools) {
        all_known &= coupling.is_some() == history.is_coupled;
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
        (along / length).clamp(-MAX_CONTINUED, MAX_CONTINUED)
    } else {
        0.0
    };
    let each = last_motion.to.iter().zip(last_motion.from);
    let per_step = part / last_motion.steps;
    for (guess, (to, from)) in guess.iter_mut().zip(each) {
        *guess = to + per_step * (to - from);
    }
    for (coupling, history) in couplings.iter().zip(&mut state.tools) {
        let force = match coupling {
            Some(_) => history.force + part * (history.force - history.previous_force),
            None => Vec3::zeros(),
        };
        history.previous_force = history.force;
        history.force = force;
    }
    for history in &mut state.cavities {
        history.continue_by(part);
    }
    part != 0.0
}

/// Undoes the continuation of a guess.
pub(super) fn stay(state: &mut NonlinearState, guess: &mut [f64]) {
    guess.copy_from_slice(&state.displacements);
    for history in &mut state.tools {
        history.force = history.previous_force;
    }
    for history in &mut state.cavities {
        history.stay();
    }
}
