//! Where tissue touches the indenter, node by node.
//!
//! A node of the surface that would enter the indenter is activated: at the place where it came in (stick)
//! or on the surface that it came through (slide). One that is pulled is let go, unless it belongs to a
//! face that sticks.

use super::super::supports::RigidSurface;
use super::indenter::{Indenter, IndenterShape, Side};
use crate::contact::Friction;

/// Contact of a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ContactStatus {
    /// None.
    Free,
    /// Bonded to the face, at this radius [m].
    Bonded { radius: f64 },
    /// Stays at this radius and height above the lowest point of the indenter [m].
    Stuck { radius: f64, above: f64 },
    /// Slides on the flat face.
    OnFace,
    /// Slides on the side.
    OnSide,
    /// Slides on the sphere or the cone.
    OnSurface,
}

/// A place as the indenter sees it: radius and height above its lowest point [m].
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) radius: f64,
    pub(super) above: f64,
}

impl Indenter {
    /// The surface of a sphere or a cone whose lowest point is at `height` [m]; a flat face has none.
    pub(super) fn surface(&self, height: f64) -> Option<RigidSurface> {
        match self.shape {
            IndenterShape::Flat { .. } => None,
            IndenterShape::Sphere => Some(RigidSurface::Sphere {
                center: height + self.radius,
                radius: self.radius,
            }),
            IndenterShape::Cone { half_angle } => Some(RigidSurface::Cone {
                apex: height,
                half_angle,
            }),
        }
    }

    /// Contact of a node of the untouched surface at `radius` [m].
    pub(super) fn first_touch(&self, radius: f64) -> ContactStatus {
        // Rounding of the mesh's own lines.
        let under = radius <= self.radius * (1.0 + 1e-9);
        match (self.shape, self.face) {
            (IndenterShape::Flat { .. }, Friction::Bonded) if under => {
                ContactStatus::Bonded { radius }
            }
            (IndenterShape::Flat { .. }, Friction::Frictionless) if under => ContactStatus::OnFace,
            _ => ContactStatus::Free,
        }
    }

    /// How deep a place is inside the indenter [m]; negative outside it.
    pub(super) fn inside(&self, place: Place) -> f64 {
        match self.surface(0.0) {
            Some(surface) => -surface.beside(place.radius, place.above).distance,
            None if place.above > 0.0 => self.radius - place.radius,
            None => f64::NEG_INFINITY,
        }
    }

    /// The contact of a node that came from `then`, outside, to `now`, inside. The part of the way at
    /// which it came in is also answered [-].
    pub(super) fn activate(&self, then: Place, now: Place) -> (ContactStatus, f64) {
        let grip = match self.shape {
            IndenterShape::Flat {
                side: Side::Touches(grip),
            } => grip,
            IndenterShape::Flat { side: Side::Absent } => return (ContactStatus::Free, 0.0),
            IndenterShape::Sphere | IndenterShape::Cone { .. } => self.face,
        };
        match (grip, self.shape) {
            (Friction::Bonded, _) => {
                let (outside, inside) = (-self.inside(then), self.inside(now));
                let part = if outside > 0.0 && outside.is_finite() {
                    outside / (outside + inside)
                } else {
                    0.0
                };
                let between = |a: f64, b: f64| a + part * (b - a);
                let touch = ContactStatus::Stuck {
                    radius: between(then.radius, now.radius),
                    above: between(then.above, now.above),
                };
                (touch, part)
            }
            (Friction::Frictionless, IndenterShape::Flat { .. }) => (ContactStatus::OnSide, 1.0),
            (Friction::Frictionless, IndenterShape::Sphere | IndenterShape::Cone { .. }) => {
                (ContactStatus::OnSurface, 1.0)
            }
        }
    }

    /// Whether an active node is to be released: it is at `place` and the tissue presses on the indenter
    /// with `force` [N], (r, z).
    pub(super) fn lets_go(&self, touch: ContactStatus, place: Place, force: [f64; 2]) -> bool {
        let push = match (touch, self.surface(0.0)) {
            (ContactStatus::Stuck { .. } | ContactStatus::OnSide, None) => force[0],
            // A sharp apex stays where it has gone in.
            (_, Some(RigidSurface::Cone { .. })) if place.radius == 0.0 => return false,
            // On the axis the radial force is that of symmetry.
            (ContactStatus::Stuck { .. } | ContactStatus::OnSurface, Some(_))
                if place.radius == 0.0 =>
            {
                -force[1]
            }
            (ContactStatus::Stuck { .. } | ContactStatus::OnSurface, Some(surface)) => {
                let normal = surface.beside(place.radius, place.above).normal;
                force[0] * normal[0] + force[1] * normal[1]
            }
            _ => return false,
        };
        push < 0.0 || (touch == ContactStatus::OnSide && place.above < 0.0)
    }
}
