//! Where a tool moves the organ in a step.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen};
use palpate_geometry::Vec3;
use palpate_mechanics::nonlinear::{Coupling, SpreadLoad};
use palpate_mechanics::{Limit, Reached};

use super::{Body, NonlinearOrgan};
use crate::state::ToolState;

/// Farther than this a step moves no part of the organ that a tool loads, and no farther than a part of the load's radius
/// [m, -].
const FARTHEST: f64 = 2e-3;
const FARTHEST_OF_LOAD: f64 = 1.0 / 6.0;

/// A lag behind a tool is told from this on: in parts of its way in a step, and [m].
const TOLD_LAG: (f64, f64) = (0.1, 1e-4);

/// Where a tool moves the organ in this step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Target {
    pub(super) along: Option<Vec3>,
    /// The elastic force that it will make as far as the organ is linear, and the one that it makes [N].
    pub(super) forces: [Vec3; 2],
    /// d, C and o: W ᵀu + C Fₑ + o = d with the elastic force Fₑ, of which F relaxes.
    pub(super) displacement: Vec3,
    pub(super) compliance: Matrix3<f64>,
    pub(super) offset: Vec3,
    /// What its condition lacks now [m].
    pub(super) jump: Vec3,
    /// How far what it loads will move [m].
    pub(super) way: Vec3,
}

/// How far a load moves in a step, at most [m].
pub(super) fn farthest(load: &SpreadLoad) -> f64 {
    FARTHEST.min(FARTHEST_OF_LOAD * load.radius)
}

/// A load as it is now.
pub(super) struct Now {
    /// ū [m], Fₑ [N] and Z [m/N].
    pub(super) mean: Vec3,
    pub(super) force: Vec3,
    pub(super) yields: Matrix3<f64>,
    pub(super) turn: Rotation3<f64>,
    /// What it moves itself by on a half-space [m/N]: along the surface, and along its normal.
    pub(super) own: [f64; 2],
}

impl Now {
    pub(super) fn of(organ: &NonlinearOrgan, body: &Body, number: usize) -> Self {
        let load = &body.loads[number];
        let state = &body.state;
        let piece = &organ.composition.pieces[body.on[number]];
        let yields = piece.regions.yields_to_load(load.radius);
        let own = load.own_compliance(piece.law());
        let own = [0, 1].map(|axis| own[axis] * yields[axis]);
        Self {
            mean: state.mean_displacement(&load.nodes),
            force: body.histories[number].elastic(),
            yields: organ.model.compliance(state, &load.nodes),
            turn: state.mean_rotation(&load.nodes),
            own,
        }
    }
}

impl Target {
    /// Of a tool that is displaced by d [m], of which tip and organ together make the force `goal` [N] on the organ, and
    /// yield `both` [m/N] to more.
    pub(super) fn new(
        along: Option<Vec3>,
        displacement: Vec3,
        both: &Matrix3<f64>,
        goal: &Vec3,
        now: &Now,
    ) -> Self {
        let compliance = match along {
            Some(normal) => {
                let own = normal.dot(&((both - now.yields) * normal)).max(0.0);
                Matrix3::from_diagonal_element(own)
            }
            None => positive(&(both - now.yields)),
        };
        let free = now.mean - now.yields * now.force;
        let offset = displacement - free - (now.yields + compliance) * goal;
        let way = now.yields * (goal - now.force);
        Self {
            along,
            forces: [*goal, now.force],
            displacement,
            compliance,
            offset,
            jump: way + compliance * (goal - now.force),
            way,
        }
    }

    /// Tells of a step that did not take the organ to where its tool has it.
    pub(super) fn tell_pace(&self, body: &Body, number: usize, tool: &mut ToolState) {
        let mean = body.state.mean_displacement(&body.loads[number].nodes);
        let force = body.histories[number].elastic();
        let lag = self.displacement - self.offset - self.compliance * force - mean;
        let lag = match self.along {
            Some(normal) => normal.dot(&lag).abs(),
            None => lag.norm(),
        };
        let way = self.way.norm();
        if lag > TOLD_LAG.1.max(TOLD_LAG.0 * way) {
            let reached = Reached {
                asked: way.max(lag),
                used: (way.max(lag) - lag).max(0.0),
            };
            tool.limited.add(Limit::Pace, reached);
        }
    }

    /// With this part of the jump `left` [-], after this part of the `way` [-], where F = γ Fₑ − Fₕ with the share and the
    /// history [N] `relaxes`.
    pub(super) fn coupling<'a>(
        &self,
        nodes: &'a [(u32, f64)],
        left: f64,
        way: f64,
        relaxes: (f64, Vec3),
    ) -> Coupling<'a> {
        let (follows, history) = relaxes;
        let compliance = self.compliance / follows;
        Coupling {
            advance: self.way * way,
            nodes,
            along: self.along,
            displacement: self.displacement,
            compliance,
            offset: self.offset + left * self.jump + compliance * history,
        }
    }
}

/// The stiffness of a tip that slips, with enough along the surface for an inverse: it is not asked for there.
pub(super) fn slippery(stiffness: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(stiffness[(2, 2)])
}

/// The nearest matrix that gives no energy.
pub(super) fn positive(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let mut eigen = SymmetricEigen::new(0.5 * (matrix + matrix.transpose()));
    eigen.eigenvalues.apply(|value| *value = value.max(0.0));
    eigen.recompose()
}
