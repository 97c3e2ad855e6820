//! Where tissue touches the indenter, node by node.
//!
//! A node of the surface that would enter the indenter is caught: at the place where it came in (stick)
//! or on the surface that it came through (slide). One that is pulled is let go, unless it belongs to a
//! face that sticks.

use super::indenter::{Grip, Indenter, IndenterShape, Side};

/// Contact of a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Touch {
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
    /// Slides on the sphere.
    OnSphere,
}

/// A place as the indenter sees it: radius and height above its lowest point [m].
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) radius: f64,
    pub(super) above: f64,
}

impl Indenter {
    /// Contact of a node of the untouched surface at `radius` [m].
    pub(super) fn first_touch(&self, radius: f64) -> Touch {
        // Rounding of the mesh's own lines.
        let under = radius <= self.radius * (1.0 + 1e-9);
        match (self.shape, self.face) {
            (IndenterShape::Flat { .. }, Grip::Stick) if under => Touch::Bonded { radius },
            (IndenterShape::Flat { .. }, Grip::Slide) if under => Touch::OnFace,
            _ => Touch::Free,
        }
    }

    /// How deep a place is inside the indenter [m]; negative outside it.
    pub(super) fn inside(&self, place: Place) -> f64 {
        match self.shape {
            IndenterShape::Flat { .. } if place.above > 0.0 => self.radius - place.radius,
            IndenterShape::Flat { .. } => f64::NEG_INFINITY,
            IndenterShape::Sphere => self.radius - place.radius.hypot(place.above - self.radius),
        }
    }

    /// The contact of a node that came from `then`, outside, to `now`, inside. The part of the way at
    /// which it came in is also answered [-].
    pub(super) fn catch(&self, then: Place, now: Place) -> (Touch, f64) {
        let grip = match self.shape {
            IndenterShape::Flat {
                side: Side::Touches(grip),
            } => grip,
            IndenterShape::Flat { side: Side::Absent } => return (Touch::Free, 0.0),
            IndenterShape::Sphere => self.face,
        };
        match (grip, self.shape) {
            (Grip::Stick, _) => {
                let (outside, inside) = (-self.inside(then), self.inside(now));
                let part = if outside > 0.0 && outside.is_finite() {
                    outside / (outside + inside)
                } else {
                    0.0
                };
                let between = |a: f64, b: f64| a + part * (b - a);
                let touch = Touch::Stuck {
                    radius: between(then.radius, now.radius),
                    above: between(then.above, now.above),
                };
                (touch, part)
            }
            (Grip::Slide, IndenterShape::Flat { .. }) => (Touch::OnSide, 1.0),
            (Grip::Slide, IndenterShape::Sphere) => (Touch::OnSphere, 1.0),
        }
    }

    /// Whether a caught node is to be let go: it is at `place` and the tissue presses on the indenter
    /// with `force` [N], (r, z).
    pub(super) fn lets_go(&self, touch: Touch, place: Place, force: [f64; 2]) -> bool {
        let push = match (touch, self.shape) {
            (Touch::Stuck { .. } | Touch::OnSide, IndenterShape::Flat { .. }) => force[0],
            (Touch::Stuck { .. } | Touch::OnSphere, IndenterShape::Sphere) => {
                force[0] * place.radius + force[1] * (place.above - self.radius)
            }
            _ => return false,
        };
        push < 0.0 || (touch == Touch::OnSide && place.above < 0.0)
    }
}
