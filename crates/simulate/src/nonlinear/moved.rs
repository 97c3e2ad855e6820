//! The motion of the contact location of a tool.

use nalgebra::Rotation3;
use palpate_geometry::{TriangleId, Vec3};

use crate::simulation::Simulation;
use crate::state::SimulationState;
use crate::tool::Tool;

/// The motion of the contact location of a tool, without the tool's own displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moved {
    pub(crate) by: Vec3,
    pub(crate) turn: Rotation3<f64>,
    /// Its displacement beyond the mean of the load around it [m], rotated back. Without it a tip would lose contact
    /// with tissue that bends within the load as soon as they touch.
    beyond: Vec3,
}

impl Default for Moved {
    fn default() -> Self {
        Self {
            by: Vec3::zeros(),
            turn: Rotation3::identity(),
            beyond: Vec3::zeros(),
        }
    }
}

impl Moved {
    /// Follows a load that has moved `by` [m] in the mean, and rotated.
    pub(super) fn go(&mut self, by: &Vec3, turn: &Rotation3<f64>) {
        self.by = by + turn * self.beyond;
        self.turn = *turn;
    }

    /// Begins a touch around `rest` [m], by a tip at `tip` [m] that is at `met` [m] when carried back to rest.
    pub(super) fn begin_contact(&mut self, rest: &Vec3, tip: &Vec3, met: &Vec3) {
        let further = tip - (rest + self.turn * (met - rest) + self.by);
        self.by += further;
        self.beyond += self.turn.inverse() * further;
    }

    /// Carries a `place` of the scene [m] back to its position at rest, around `rest` [m].
    pub(super) fn back(&self, rest: &Vec3, place: &Vec3) -> Vec3 {
        rest + self.turn.inverse() * (place - rest - self.by)
    }
}

/// The tip's position [m] on the organ at rest, if it touches nothing yet, by the triangle that is closest to it now; and that
/// triangle. None if it is clear of that.
pub(super) fn carry_back_anew(
    simulation: &Simulation,
    tool: &Tool,
    tip: &Vec3,
    state: &SimulationState,
) -> Option<(Vec3, TriangleId)> {
    let nearest = state.tree.nearest(&state.deformed, tip);
    let outward = state.deformed.area_vector(nearest.triangle);
    let is_outside = outward.dot(&(tip - nearest.on.position)) > 0.0;
    (!is_outside || nearest.distance < tool.overhang()).then(|| {
        let rest = simulation.surface.mesh();
        let tip = state.carry_back_from(rest, &nearest, tip);
        (tip, nearest.triangle)
    })
}
