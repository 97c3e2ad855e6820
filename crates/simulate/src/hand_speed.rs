//! The largest plausible hand speed. A pose farther from the last one than a hand gets in that time is not a motion but
//! a jump: a tracker that lost the tool, an error in a motion file, a device that restarts.
//! The model knows nothing of the path between the two poses, so it drags nothing along: the tool releases its contact
//! and its held tissue ([`Event::Jump`]) and touches anew at its new pose, as in the first step of a motion.
//!
//! *How we know*: `grip::jumps::…`.

use palpate_files::Pose;
use palpate_files::session::{Event, Events};
use palpate_geometry::Vec3;

use crate::simulation::Simulation;
use crate::state::ToolState;

/// Faster than any hand [m/s]: twice the fist of a boxer, which is the fastest movement of a hand that holds something
/// (8 to 10 m/s), and forty times what instruments do in an organ (below 0.5 m/s). In 5 ms it is 10 cm, as much as
/// the organ is wide.
pub const FASTEST_HAND: f64 = 20.0;

/// Releases the tool's contact and held tissue if `pose` is farther away than a hand gets in `elapsed` [s], and in at
/// least one step of the model.
pub(crate) fn follow(
    simulation: &Simulation,
    pose: Option<&Pose>,
    elapsed: f64,
    state: &mut ToolState,
) -> Events {
    let (Some(before), Some(now)) = (&state.pose, pose) else {
        return Events::NONE;
    };
    let distance = (Vec3::from(now.position_m) - Vec3::from(before.position_m)).norm();
    let speed = distance / elapsed.max(simulation.step);
    if speed <= FASTEST_HAND {
        return Events::NONE;
    }
    state.limits.count_jump(speed);
    let mut events: Events = [Event::Jump].into_iter().collect();
    if state.touches() {
        events.insert(Event::Release);
    }
    if state.grip.grasp.take().is_some() {
        events.insert(Event::GripRelease);
    }
    state.contact = None;
    events
}
