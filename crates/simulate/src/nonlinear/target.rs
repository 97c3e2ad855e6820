//! The displacement of the organ by a tool in a step.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen};
use palpate_geometry::Vec3;
use palpate_mechanics::nonlinear::{Coupling, SpreadLoad};
use palpate_mechanics::{Limit, Reached};

use super::{Body, NonlinearOrgan};
use crate::state::ToolState;

/// Largest motion in a step of any part of the organ that a tool loads, relative to the load's radius, and absolute [m,
/// -].
const FARTHEST: f64 = 2e-3;
const FARTHEST_OF_LOAD: f64 = 1.0 / 6.0;

/// A lag behind a tool above this is reported: relative to its motion in a step, and [m].
const REPORTED_LAG: (f64, f64) = (0.1, 1e-4);

/// The target of a tool's displacement in this step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Target {
    pub(super) along: Option<Vec3>,
    /// Its elastic force after the step in the linear approximation, and the present one [N].
    pub(super) forces: [Vec3; 2],
    /// d, C and o: W ᵀu + C Fₑ + o = d with the elastic force Fₑ, of which F relaxes.
    pub(super) displacement: Vec3,
    pub(super) compliance: Matrix3<f64>,
    pub(super) offset: Vec3,
    /// Residual of its condition now [m].
    pub(super) jump: Vec3,
    /// Expected displacement of its load [m].
    pub(super) travel: Vec3,
}

/// Largest displacement of a load in a step [m].
pub(super) fn farthest(load: &SpreadLoad) -> f64 {
    FARTHEST.min(FARTHEST_OF_LOAD * load.radius)
}

/// The present state of a load.
pub(super) struct Now {
    /// ū [m], Fₑ [N] and Z [m/N].
    pub(super) mean: Vec3,
    pub(super) force: Vec3,
    pub(super) compliance: Matrix3<f64>,
    /// The part of Z by which a detached piece goes on, and does not come back [m/N].
    pub(super) drag: Matrix3<f64>,
    pub(super) turn: Rotation3<f64>,
    /// Its self-compliance on a half-space [m/N]: along the surface, and along its normal.
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
            compliance: organ.model.compliance(state, &load.nodes),
            drag: organ.model.drag_compliance(state, &load.nodes),
            turn: state.mean_rotation(&load.nodes),
            own,
        }
    }

    /// Displacement of the load without its force [m].
    pub(super) fn free(&self) -> Vec3 {
        self.mean - (self.compliance - self.drag) * self.force
    }

    /// Expected displacement in a step to the force `goal` [m].
    pub(super) fn travel(&self, goal: &Vec3) -> Vec3 {
        self.compliance * goal - (self.compliance - self.drag) * self.force
    }
}

impl Target {
    /// For a tool with the displacement d [m], where tip and organ together make the force `goal` [N] on the organ, and
    /// have the tangent compliance `both` [m/N].
    pub(super) fn new(
        along: Option<Vec3>,
        displacement: Vec3,
        both: &Matrix3<f64>,
        goal: &Vec3,
        now: &Now,
    ) -> Self {
        let compliance = match along {
            Some(normal) => {
                let own = normal.dot(&((both - now.compliance) * normal)).max(0.0);
                Matrix3::from_diagonal_element(own)
            }
            None => positive(&(both - now.compliance)),
        };
        let offset = displacement - now.free() - (now.compliance + compliance) * goal;
        let travel = now.travel(goal);
        Self {
            along,
            forces: [*goal, now.force],
            displacement,
            compliance,
            offset,
            jump: travel + compliance * (goal - now.force),
            travel,
        }
    }

    /// Reports a step after which the organ lags behind its tool.
    pub(super) fn report_lag(&self, body: &Body, number: usize, tool: &mut ToolState) {
        let mean = body.state.mean_displacement(&body.loads[number].nodes);
        let force = body.histories[number].elastic();
        let lag = self.displacement - self.offset - self.compliance * force - mean;
        let lag = match self.along {
            Some(normal) => normal.dot(&lag).abs(),
            None => lag.norm(),
        };
        let travel = self.travel.norm();
        if lag > REPORTED_LAG.1.max(REPORTED_LAG.0 * travel) {
            let reached = Reached {
                unbounded: travel.max(lag),
                used: (travel.max(lag) - lag).max(0.0),
            };
            tool.limited.add(Limit::Pace, reached);
        }
    }

    /// With this part of the jump `left` [-], after this part of the `travel` [-], where F = γ Fₑ − Fₕ with the share and the
    /// history [N] `relaxes`.
    pub(super) fn coupling<'a>(
        &self,
        nodes: &'a [(u32, f64)],
        left: f64,
        travel: f64,
        relaxes: (f64, Vec3),
    ) -> Coupling<'a> {
        let (follows, history) = relaxes;
        let compliance = self.compliance / follows;
        Coupling {
            advance: self.travel * travel,
            nodes,
            along: self.along,
            displacement: self.displacement,
            compliance,
            offset: self.offset + left * self.jump + compliance * history,
        }
    }
}

/// The stiffness of a slipping tip, with a tangential part that makes it invertible; that part is not used.
pub(super) fn slippery(stiffness: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(stiffness[(2, 2)])
}

/// The nearest positive semidefinite matrix.
pub(super) fn positive(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let mut eigen = SymmetricEigen::new(0.5 * (matrix + matrix.transpose()));
    eigen.eigenvalues.apply(|value| *value = value.max(0.0));
    eigen.recompose()
}
