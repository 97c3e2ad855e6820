use palpate_geometry::Vec3;
use palpate_mechanics::contact::Friction;
use palpate_servo::AffineForce;

use crate::state::ToolState;
use crate::tool::Tool;

/// The force that the servo loop receives for `tool` after a step, in the scene's frame: f₀ is the relaxed force, K the
/// instantaneous stiffness, since tissue does not relax within two steps. A pulling force is handed over unchanged, and
/// the loop removes the pull: a hand that turns around meets the tissue at its current position. Tissue held by jaws
/// pulls and pushes. `time` [s] is that of the pose.
pub fn affine_force(tool: &Tool, state: &ToolState, time: f64) -> AffineForce {
    let organ = of_organ(tool, state, time);
    let Some(pose) = &state.pose else {
        return organ;
    };
    let pushed = state.is_pushed().then(|| state.pushed.force.normalize());
    // A tip inside a wrapping wall has no law of its own: the wall's points push it like a shaft.
    let has_law = organ.contact && organ.gradient != nalgebra::Matrix3::zeros();
    let normal = match (has_law, state.stopped.normal, pushed) {
        (_, None, None) => return organ,
        (false, Some(normal), None) | (false, None, Some(normal)) => normal,
        // Two surfaces that push have no common normal.
        _ => Vec3::zeros(),
    };
    let force = organ.force + state.stopped.force + state.pushed.force;
    let gradient = organ.gradient + state.stopped.gradient + state.pushed.gradient;
    AffineForce {
        normal,
        ..AffineForce::new(time, Vec3::from(pose.position_m), force, gradient)
    }
}

/// The same of the organ alone.
fn of_organ(tool: &Tool, state: &ToolState, time: f64) -> AffineForce {
    if let (true, Some(pose)) = (state.is_grasping(), &state.pose) {
        let tip = Vec3::from(pose.position_m);
        let answer = AffineForce::new(time, tip, state.with_pull, -state.stiffness);
        let finite = answer.gradient.iter().chain(answer.force.iter());
        return match finite.into_iter().all(|component| component.is_finite()) {
            true => answer,
            false => AffineForce::none(time),
        };
    }
    let (Some(contact), Some(pose)) = (&state.contact, &state.pose) else {
        return AffineForce::none(time);
    };
    let normal = contact.normal();
    let gradient = match tool.tip_friction == Friction::Frictionless || contact.slides {
        // Without friction nothing holds the tip along the surface.
        true => -normal.dot(&(state.stiffness * normal)) * normal * normal.transpose(),
        false => -state.stiffness,
    };
    let finite = gradient.iter().chain(state.with_pull.iter());
    if !finite.into_iter().all(|component| component.is_finite()) {
        return AffineForce::none(time);
    }
    AffineForce {
        normal,
        ..AffineForce::new(time, Vec3::from(pose.position_m), state.with_pull, gradient)
    }
}
