//! Where the place that a tool touches has gone.

use nalgebra::Rotation3;
use palpate_geometry::Vec3;

use crate::simulation::Simulation;
use crate::state::SimulationState;
use crate::tool::Tool;

/// How the place that a tool touches has moved, without what the tool itself does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moved {
    pub(crate) by: Vec3,
    pub(crate) turn: Rotation3<f64>,
    /// How far it is beyond the mean of what is loaded around it [m], turned back. Without it a tip would leave tissue that bends
    /// within the load as soon as it has met it.
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
    /// Goes with a load that has gone `by` [m] in the mean, and turned.
    pub(super) fn go(&mut self, by: &Vec3, turn: &Rotation3<f64>) {
        self.by = by + turn * self.beyond;
        self.turn = *turn;
    }

    /// A touch begins around `rest` [m], by a tip at `tip` [m] that carried back to rest is at `met` [m].
    pub(super) fn meet(&mut self, rest: &Vec3, tip: &Vec3, met: &Vec3) {
        let further = tip - (rest + self.turn * (met - rest) + self.by);
        self.by += further;
        self.beyond += self.turn.inverse() * further;
    }

    /// A place of the scene [m], carried back to where it would be around `rest` [m] at rest.
    pub(super) fn back(&self, rest: &Vec3, place: &Vec3) -> Vec3 {
        rest + self.turn.inverse() * (place - rest - self.by)
    }
}

/// Where a tip that touches nothing yet would be [m] on the organ at rest, by the triangle that is nearest to it now.
/// None where it is clear of that.
pub(super) fn carry_back_anew(
    simulation: &Simulation,
    tool: &Tool,
    tip: &Vec3,
    state: &SimulationState,
) -> Option<Vec3> {
    let nearest = state.tree.nearest(&state.deformed, tip);
    let outward = state.deformed.area_vector(nearest.triangle);
    let is_outside = outward.dot(&(tip - nearest.on.position)) > 0.0;
    (!is_outside || nearest.distance < tool.overhang())
        .then(|| state.carry_back_from(simulation.surface.mesh(), &nearest, tip))
}
