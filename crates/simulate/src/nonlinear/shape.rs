//! The display mesh: its vertices are embedded in the elements, and under each tool they are fitted to the tool.
//!
//! The elements around a tip resolve its load, and not the tip. The remaining gap between surface and tip fades like
//! the dimple of a flat tip, with the distance r from it, and ends where the load ends:
//!
//! ```text
//! e 2/π asin(a/r) (1 − (r/R)²)²
//! ```

use std::f64::consts::FRAC_2_PI;

use palpate_geometry::{Nearest, NodeId, Vec3};

use super::{NonlinearOrgan, NonlinearWorkspace, jaws_radius};
use palpate_mechanics::contact::Friction;

use crate::simulation::Simulation;
use crate::state::SimulationState;

/// A surface that has moved less than this [m] counts as at rest.
const AT_REST: f64 = 1e-7;

/// Depth of a dimple over the radius of the load under it [-]: ten radii of a tip.
const DEEPEST_DIMPLE: f64 = 6.0;

impl NonlinearOrgan {
    /// Updates all vertices of the displayed surface, if it is due, or if a tool has no contact: its first one is sought on the surface
    /// of the last step.
    pub(crate) fn deform(
        &self,
        simulation: &Simulation,
        time: f64,
        state: &mut SimulationState,
        workspace: &mut NonlinearWorkspace,
    ) {
        let have_contact = state.tools.iter().all(|own| own.contact.is_some());
        if have_contact && time < state.shown_at + state.show_every {
            return;
        }
        state.shown_at = time;
        let Some(body) = &mut state.body else {
            return;
        };
        body.move_rims();
        let shown = &mut workspace.shown;
        let mut largest = 0.0_f64;
        let embedded = self.shown.displacements(&body.state);
        for (own, by) in shown.iter_mut().zip(embedded) {
            *own = by;
            largest = largest.max(by.norm_squared());
        }
        if largest < AT_REST.powi(2) && !state.shown_deformed {
            return;
        }
        state.shown_deformed = largest >= AT_REST.powi(2);
        let rest = simulation.surface.mesh();
        for (number, (tool, own)) in simulation.tools.iter().zip(&state.tools).enumerate() {
            let (triangle, place) = match (&own.grip.grasp, &own.contact) {
                (Some(hold), _) => (hold.displayed.triangle, hold.place()),
                (None, Some(_))
                    if self.composition.pieces[body.on[number]].bends_around[number] =>
                {
                    continue;
                }
                (None, Some(contact)) => (contact.place.triangle, contact.point()),
                (None, None) => continue,
            };
            let radius = match own.is_grasping() {
                true => jaws_radius(tool).unwrap_or(tool.typical_radius),
                false => tool.typical_radius,
            };
            let corners = rest.corners(triangle);
            let on = palpate_geometry::closest_on_triangle(&rest.positions(triangle), &place);
            let there: Vec3 = corners
                .iter()
                .zip(on.barycentric)
                .map(|(node, weight)| shown[node.index()] * weight)
                .sum();
            let mut lacks = own.displaced - there;
            if let (Some(contact), Friction::Frictionless) = (&own.contact, tool.tip_friction) {
                // A slipping surface does not follow the tip.
                let normal = contact.normal();
                lacks = normal * normal.dot(&lacks);
            }
            let load = &body.loads[number];
            // No fit to a tool that the organ does not follow: no dimple is that deep.
            if lacks.norm() > DEEPEST_DIMPLE * load.radius {
                continue;
            }
            let square = load.radius.powi(2);
            // Also for a body at rest: the next step has to undo it.
            state.shown_deformed = true;
            let under = self.detached.piece(corners[0]);
            // On both sides of a wall: otherwise the near side would penetrate the far one.
            for (number, (by, vertex)) in shown.iter_mut().zip(rest.vertices()).enumerate() {
                let apart = (vertex - place).norm_squared();
                if apart < square && self.detached.piece(NodeId(number as u32)) == under {
                    let dimple = FRAC_2_PI * (radius / apart.sqrt()).min(1.0).asin();
                    *by += lacks * (dimple * (1.0 - apart / square).powi(2));
                }
            }
        }
        for (number, (from, by)) in rest.vertices().iter().zip(shown.iter()).enumerate() {
            if by.iter().all(|component| component.is_finite()) {
                state.deformed.move_vertex(NodeId(number as u32), from + by);
            }
        }
        let detached = &self.detached;
        state.tree.refit_where(&state.deformed, |triangle| {
            detached.is_within_one(rest, triangle)
        });
    }
}

impl SimulationState {
    /// Carries a point of the scene [m] near the point `nearest` of the deformed surface back to rest, with that
    /// triangle.
    pub(crate) fn carry_back_from(
        &self,
        rest: &palpate_geometry::TriangleMesh,
        nearest: &Nearest,
        place: &Vec3,
    ) -> Vec3 {
        let now = frame(&self.deformed.positions(nearest.triangle));
        let corners = rest.positions(nearest.triangle);
        let at: Vec3 = corners
            .iter()
            .zip(nearest.on.barycentric)
            .map(|(corner, weight)| corner * weight)
            .sum();
        at + frame(&corners) * now.tr_mul(&(place - nearest.on.position))
    }
}

/// The orthogonal frame of a triangle: along its first edge, across it, and its normal.
fn frame([a, b, c]: &[Vec3; 3]) -> nalgebra::Matrix3<f64> {
    let normal = (b - a).cross(&(c - a)).normalize();
    let along = (b - a).normalize();
    nalgebra::Matrix3::from_columns(&[along, normal.cross(&along), normal])
}
