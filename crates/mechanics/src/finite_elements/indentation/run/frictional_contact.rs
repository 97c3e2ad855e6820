//! Stick, slip and contact forces of an indenter with Coulomb friction.

use super::super::contact::ContactStatus;
use super::super::indenter::IndenterShape;
use super::{FiniteElementState, IndentationRun};
use crate::Strain;

/// A node of the surface that touches the indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactNode {
    /// Its distance from the axis [m]: deformed, but at rest with a law for small strain.
    pub radius: f64,
    /// The force of the indenter on it along the indenter's outward normal, over the whole ring [N].
    pub normal_force: f64,
    /// The force of the indenter on it along the tangent (−n_z, n_r) of that normal, over the whole ring [N]: outward on a
    /// face, along the meridian away from the lowest point on a sphere or a cone.
    pub tangential_force: f64,
    /// Coulomb's coefficient where it touches [-]; none where the friction is of another kind, and on a sharp edge
    /// between a face and a side with friction.
    pub coefficient: Option<f64>,
    /// Whether it moves with the indenter.
    pub sticks: bool,
}

/// How an indenter with Coulomb friction touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionalContact {
    /// Radius of the circle that touches [m], with nodes where [`ContactNode::radius`] says: to the last node that touches,
    /// and of all but a sharp punch half way to the next, so that it is known to half the distance of nodes.
    pub contact_radius: f64,
    /// Radius of the circle in which tissue sticks [m]: half way from the last node that sticks to the first that slips,
    /// from the axis outward; as the radius of the contact where all stick.
    pub stick_radius: f64,
    /// Sum of the tangential forces over the whole contact, away from the axis along the surface [N]. They hold each other
    /// across the axis.
    pub tangential_force: f64,
}

impl IndentationRun {
    /// How the indenter touches now, with the forces of the last assembly.
    pub(super) fn frictional_contact(&self) -> FrictionalContact {
        let nodes = self.contact_nodes();
        let radius = |place: usize| nodes.get(place).map_or(0.0, |node| node.radius);
        let last = radius(nodes.len().saturating_sub(1));
        let slip = nodes.iter().position(|node| !node.sticks);
        let next = self.top.iter().zip(&self.now.statuses).rev();
        let next = next.take_while(|(_, status)| **status == ContactStatus::Free);
        let next = next.last().map(|(&node, _)| self.radius_of(node));
        let contact_radius = match (self.indenter.shape, next) {
            (shape, Some(next))
                if !matches!(shape, IndenterShape::Flat { .. }) && !nodes.is_empty() =>
            {
                0.5 * (last + next)
            }
            _ => last,
        };
        FrictionalContact {
            contact_radius,
            stick_radius: match slip {
                None => contact_radius,
                // The axis cannot slip.
                Some(0 | 1) => 0.0,
                Some(slip) => 0.5 * (radius(slip - 1) + radius(slip)),
            },
            // Not the −0 of nothing.
            tangential_force: 0.0 + nodes.iter().map(|node| node.tangential_force).sum::<f64>(),
        }
    }

    /// The nodes that touch the indenter, from the axis outward, with the forces of the last assembly.
    pub fn contact_nodes(&self) -> Vec<ContactNode> {
        let depth = self.now.depth;
        let each = self.top.iter().zip(&self.now.statuses);
        each.filter_map(|(&node, status)| {
            let part = status.part()?;
            let place = self.place(&self.now.state, node, depth);
            let surface = self.indenter.signed_distance(part, place);
            let [normal_force, tangential_force] = surface.components(self.force_on(node));
            Some(ContactNode {
                radius: self.radius_of(node),
                normal_force,
                // On the axis the radial force is that of symmetry.
                tangential_force: if place.radius > 0.0 {
                    tangential_force
                } else {
                    0.0
                },
                coefficient: self.indenter.coefficient_of(*status),
                sticks: matches!(status, ContactStatus::Stuck { .. }),
            })
        })
        .collect()
    }

    /// As [`ContactNode::radius`].
    fn radius_of(&self, node: usize) -> f64 {
        match self.model.law.volume().strain {
            Strain::Small => self.model.mesh().nodes[node].x,
            Strain::Finite => self.place(&self.now.state, node, self.now.depth).radius,
        }
    }

    /// Notes where nodes that slide are at an equilibrium: from there they slip next.
    pub(super) fn note_places(
        &self,
        statuses: &mut [ContactStatus],
        depth: f64,
        state: &FiniteElementState,
    ) {
        for (&node, status) in self.top.iter().zip(statuses) {
            if let ContactStatus::Sliding { slip, .. } = status {
                slip.from = self.place(state, node, depth);
            }
        }
    }
}
