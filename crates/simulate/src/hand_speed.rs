//! A hand has a fastest speed. A pose farther from the last one than a hand gets in that time is not where the tool
//! was moved to but where it was set down: a tracker that lost it, a slip in a motion file, a device that restarts.
//!
//! The model knows nothing of the path between the two poses, so nothing is pulled along it: the tool loses what it
//! touched and held ([`Event::Jump`]) and touches anew where it is now, as in the first step of a motion.
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

/// Releases what the tool touched and held where `pose` is farther away than a hand gets in `elapsed` [s], and at least
/// in a step of the model.
pub(crate) fn follow(
    simulation: &Simulation,
    pose: Option<&Pose>,
    elapsed: f64,
    state: &mut ToolState,
) -> Events {
    let (Some(before), Some(now)) = (&state.pose, pose) else {
        return Events::NONE;
    };
    let way = (Vec3::from(now.position_m) - Vec3::from(before.position_m)).norm();
    let speed = way / elapsed.max(simulation.step);
    if speed <= FASTEST_HAND {
        return Events::NONE;
    }
    state.limits.count_jump(speed);
    let mut events: Events = [Event::Jump].into_iter().collect();
    if state.touches() {
        events.insert(Event::Release);
    }
    if state.grip.hold.take().is_some() {
        events.insert(Event::GripRelease);
    }
    state.contact = None;
    events
}
