//! Contact status of the nodes at an equilibrium, and the domain of validity.

use super::super::contact::{ContactStatus, Part, Place, Tolerances};
use super::super::indenter::{IndenterShape, Side};
use super::super::sensitivities::{Entry, Sensitivities};
use super::{Failure, FiniteElementState, IndentationRun};
use crate::Error;
use crate::contact::FrictionLaw;

/// A node that is deeper than this inside after a step has come in too fast [-].
const DEEPEST_CATCH: f64 = 0.1;
/// Depth inside a sphere or a cone up to which a released node is not activated again at the same depth, in
/// radii of the contact [-]: a hundredth of the smallest elements.
const REACTIVATION_DEPTH: f64 = 1e-3;
/// Tolerance of a tangential force beyond the cone of friction, in parts of the largest normal force on a node [-]: ten
/// times the relative residual that an equilibrium has.
const CONE: f64 = 1e-6;
/// Slip along the force of friction that is rounding, in radii of the contact [-].
const NO_SLIP: f64 = 1e-9;

impl IndentationRun {
    /// Activates nodes that have entered the indenter, releases those that pull, and lets nodes stick or slip; returns
    /// whether any status changed. Fails when tissue went in too deep to know where it entered.
    pub(super) fn update_statuses(
        &self,
        depth: f64,
        state: &FiniteElementState,
        statuses: &mut [ContactStatus],
        released: &mut [bool],
        mut slopes: Option<&mut Sensitivities>,
    ) -> Result<bool, Failure> {
        if self.is_linear() && !self.has_friction {
            return Ok(false);
        }
        let mut changed = false;
        let tolerances = Tolerances {
            force: match self.has_friction {
                true => CONE * self.largest_normal_force(statuses, depth, state),
                false => 0.0,
            },
            slip: NO_SLIP * self.scale,
        };
        let statuses = statuses.iter_mut().zip(released);
        for (&node, (status, released)) in self.top.iter().zip(statuses) {
            let now = self.place(state, node, depth);
            let force = self.force_on(node);
            if *status == ContactStatus::Free {
                let inside = self.indenter.inside(now) / self.scale;
                // Rounding is no contact, and a node that pulled does not come back for a hair.
                let least = if *released { REACTIVATION_DEPTH } else { 1e-9 };
                if inside > least && self.has_side() && !self.is_linear() {
                    if inside > DEEPEST_CATCH {
                        return Err(Failure::NotConverged);
                    }
                    let then = self.place(&self.now.state, node, self.now.depth);
                    let (activated, part) = self.indenter.activate(then, now);
                    if let (Some(slopes), Some(old)) = (&mut slopes, &self.now.slopes) {
                        let entry = Entry {
                            node,
                            ways: [self.indenter.inside(then), self.indenter.inside(now)],
                            part,
                            rise: now.above - then.above,
                        };
                        slopes.activate(&entry, old);
                    }
                    *status = activated;
                    changed = true;
                }
            } else if !self.is_linear() && self.indenter.is_released(*status, now, force) {
                *released = status.part() == Some(Part::Round);
                *status = ContactStatus::Free;
                changed = true;
            } else if now.radius > 0.0
                && let Some(next) = self.indenter.stick_or_slip(*status, now, force, tolerances)
            {
                *status = next;
                changed = true;
            }
        }
        Ok(changed)
    }

    /// The force of the indenter on a node that touches it, at the last assembly [N]: (r, z).
    pub(super) fn force_on(&self, node: usize) -> [f64; 2] {
        [0, 1].map(|i| self.workspace.residual[2 * node + i])
    }

    fn largest_normal_force(
        &self,
        statuses: &[ContactStatus],
        depth: f64,
        state: &FiniteElementState,
    ) -> f64 {
        let each = self.top.iter().zip(statuses);
        each.filter_map(|(&node, status)| {
            let place = self.place(state, node, depth);
            let [normal, _] = self
                .indenter
                .signed_distance(status.part()?, place)
                .components(self.force_on(node));
            Some(normal)
        })
        .fold(0.0, f64::max)
    }

    /// Whether nodes without friction are activated and released.
    pub(super) fn slides(&self) -> bool {
        match self.indenter.shape {
            IndenterShape::Flat { side } => side == Side::Touches(FrictionLaw::Frictionless),
            IndenterShape::RoundedPunch { .. }
            | IndenterShape::Sphere
            | IndenterShape::Cone { .. } => self.indenter.face == FrictionLaw::Frictionless,
        }
    }

    pub(super) fn has_side(&self) -> bool {
        self.indenter.shape != IndenterShape::Flat { side: Side::Absent }
    }

    /// Checks the domain of validity: an indenter without a side is valid until tissue would be where
    /// the side is, and a face without friction until the tissue under it folds over itself or moves
    /// out beyond it.
    pub(super) fn check_domain(&self) -> Result<(), Error> {
        if self.is_linear() {
            return Ok(());
        }
        let (depth, radius) = (self.now.depth, self.indenter.radius);
        let place = |node: usize| self.place(&self.now.state, node, depth);
        let mut each = self.top.iter().zip(&self.now.statuses);
        let entered = |(&node, status): (&usize, &ContactStatus)| {
            *status == ContactStatus::Free && self.indenter.inside(place(node)) > 1e-9 * radius
        };
        if !self.has_side() && each.any(entered) {
            return Err(Error::TissueEntersPunch { depth });
        }
        // Corners of elements: every second node.
        let corners = self.top.iter().zip(&self.now.statuses).step_by(2);
        let under: Vec<f64> = corners
            .filter(|(_, status)| status.part() == Some(Part::Face))
            .map(|(&node, _)| place(node).radius)
            .collect();
        let outside = under.last().is_some_and(|&r| r > 1.05 * radius);
        if outside || under.windows(2).any(|w| w[1] <= w[0]) {
            return Err(Error::SurfaceFolds { depth });
        }
        Ok(())
    }

    pub(super) fn place(&self, state: &FiniteElementState, node: usize, depth: f64) -> Place {
        let at = self.model.mesh().nodes[node] + state.displacement(&self.model, node);
        Place {
            radius: at.x,
            above: at.y + depth,
        }
    }
}
