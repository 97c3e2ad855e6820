//! Where an indenter with Coulomb friction sticks and slips, and with which forces.

use super::super::contact::{ContactStatus, Place};
use super::{FiniteElementState, IndentationRun};
use crate::contact::FrictionLaw;

/// A node of the surface that touches the indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactNode {
    /// Its distance from the axis, deformed [m].
    pub radius: f64,
    /// The force of the indenter on it along the indenter's outward normal, over the whole ring [N].
    pub normal_force: f64,
    /// The force of the indenter on it along the tangent (−n_z, n_r) of that normal, over the whole ring [N]: outward on a
    /// face, along the meridian away from the lowest point on a sphere or a cone.
    pub tangential_force: f64,
    /// Coulomb's coefficient where it touches [-]; none where the friction is of another kind.
    pub coefficient: Option<f64>,
    /// Whether it moves with the indenter.
    pub sticks: bool,
}

/// How an indenter with Coulomb friction touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionalContact {
    /// Distance from the axis of the outermost node that touches, deformed [m].
    pub contact_radius: f64,
    /// Radius of the circle in which tissue sticks [m]: half way from the last node that sticks to the first that slips,
    /// from the axis outward, so that it is known to half the distance of nodes.
    pub stick_radius: f64,
    /// Sum of the tangential forces over the whole contact, away from the axis along the surface [N]. They hold each other
    /// across the axis.
    pub tangential_force: f64,
}

impl FrictionalContact {
    /// From the nodes that touch, from the axis outward.
    pub(super) fn of(nodes: &[ContactNode]) -> Self {
        let slip = nodes.iter().position(|node| !node.sticks);
        let radius = |place: usize| nodes.get(place).map_or(0.0, |node| node.radius);
        let last = radius(nodes.len().saturating_sub(1));
        Self {
            contact_radius: last,
            stick_radius: match slip {
                None => last,
                // The axis cannot slip.
                Some(0 | 1) => 0.0,
                Some(slip) => 0.5 * (radius(slip - 1) + radius(slip)),
            },
            tangential_force: nodes.iter().map(|node| node.tangential_force).sum(),
        }
    }
}

impl IndentationRun {
    /// The nodes that touch the indenter, from the axis outward, with the forces of the last assembly.
    pub fn contact_nodes(&self) -> Vec<ContactNode> {
        let depth = self.now.depth;
        let each = self.top.iter().zip(&self.now.touch);
        each.filter_map(|(&node, touch)| {
            let part = touch.part()?;
            let place = self.place(&self.now.state, node, depth);
            let beside = self.indenter.beside(part, place);
            let [normal_force, tangential_force] = beside.components(self.force_on(node));
            Some(ContactNode {
                radius: place.radius,
                normal_force,
                // On the axis the radial force is that of symmetry.
                tangential_force: if place.radius > 0.0 {
                    tangential_force
                } else {
                    0.0
                },
                coefficient: match self.indenter.friction(part) {
                    FrictionLaw::Coulomb(coefficient) => Some(coefficient),
                    FrictionLaw::Bonded | FrictionLaw::Frictionless => None,
                },
                sticks: matches!(touch, ContactStatus::Stuck { .. }),
            })
        })
        .collect()
    }

    /// Notes where nodes that slide are at an equilibrium: from there they slip next.
    pub(super) fn note_places(
        &self,
        touch: &mut [ContactStatus],
        (depth, state): (f64, &FiniteElementState),
    ) {
        for (&node, touch) in self.top.iter().zip(touch) {
            if let ContactStatus::Sliding { slip, .. } = touch {
                let place: Place = self.place(state, node, depth);
                slip.from = place;
            }
        }
    }
}
